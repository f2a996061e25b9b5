// Everyday materials as swatches, which set the chosen surface's ridges. SPDX-License-Identifier: MIT
import { materials } from "./materials.json"; // of assets
import { $, SLIDERS } from "./page.js";

// Until they are moved, sliders take numbers between their steps and beyond their ends.
function loosen(feel) {
  SLIDERS.forEach(([id, scale], i) => {
    const slider = $(id);
    slider.dataset.step ??= slider.step;
    slider.step = "any";
    slider.max = Math.max(slider.max, feel[i] * scale);
  });
}

function tighten({ target }) {
  target.step = target.dataset.step ?? target.step;
}

// take(feel, color) is given a material's numbers: ridges along x and y (1/m), amplitude (m), stiffness (N/m), friction.
export function showSwatches(take) {
  for (const { title, color, period, depth, tag } of materials) {
    const { orientation } = tag;
    const feel = [...tag.spatial_frequency, tag.amplitude, tag.stiffness, tag.friction];
    const swatch = document.createElement("button");
    const sources = `${title}. Period: ${period}. Depth: ${depth}.`;
    swatch.type = "button";
    swatch.style.setProperty("--colour", color);
    swatch.textContent = swatch.title = title;
    swatch.addEventListener("click", async () => {
      loosen(feel);
      await take(feel, color);
      $("material-text").textContent = sources +
        (orientation ? ` Turned by ${Math.round(orientation * 180 / Math.PI)}°, which this page leaves out.` : "");
    });
    $("materials").append(swatch);
  }
  SLIDERS.forEach(([id]) => ["pointerdown", "keydown"].forEach((event) => $(id).addEventListener(event, tighten)));
}
