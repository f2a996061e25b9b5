// Everyday materials as swatches, which set the chosen surface's ridges. SPDX-License-Identifier: MIT
import { MATERIALS } from "./materials.js";
import { $ } from "./page.js";

const SLIDERS = [["fsx", 1], ["fsy", 1], ["amplitude", 1000], ["stiffness", 1], ["friction", 1]]; // and units a feel's unit

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
  for (const { title, color, period, depth, feel, orientation } of MATERIALS) {
    const swatch = document.createElement("button");
    const sources = `${title}. Period: ${period}. Depth: ${depth}.`;
    swatch.type = "button";
    swatch.style.background = color;
    swatch.title = sources;
    swatch.setAttribute("aria-label", title);
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
