// Settings of surface and device; links and the failures' catalogue set them. SPDX-License-Identifier: MIT
import { PRESETS } from "./presets.js";
import { $, scene, surface, tell } from "./page.js";
import { showSwatches } from "./swatches.js";

const METHODS = ["bandlimited", "S1", "S2", "bandlimited"];
const SLIDERS = [["fsx", 0, 1], ["fsy", 1, 1], ["amplitude", 2, 1000], ["stiffness", 3, 1], ["friction", 4, 1]];
const FEEL = ["method", ...SLIDERS.map(([id]) => id)];
const SHARED = ["model", "surface", ...FEEL, "depth", "exaggeration", "rate", "resolution"];

// The tag of a surface for a glTF material's extras.
export function tag(feel) {
  return { version: 1, spatial_frequency: [feel[0], feel[1]], amplitude: feel[2], stiffness: feel[3], friction: feel[4],
    method: METHODS[feel[5]] };
}

export const shownFeel = () =>
  [...SLIDERS.map(([id, , scale]) => Number($(id).value) / scale), Number($("method").value)];

function set(id, value) {
  $(id).value = value; // the control ignores unknown values
  if ($(id).selectedIndex === -1) {
    $(id).selectedIndex = 0;
  }
}

export function showOutputs() {
  for (const slider of document.querySelectorAll('input[type="range"]')) {
    slider.parentElement.querySelector("output").textContent = slider.value + slider.dataset.unit;
  }
  $("extras").textContent = JSON.stringify({ knurl: tag(shownFeel()) }, null, 1);
}

export function showFeel() {
  const feel = surface()?.feel;
  if (!feel) {
    return;
  }
  for (const [id, index, scale] of SLIDERS) {
    $(id).value = feel[index] * scale;
  }
  $("method").value = feel[5] || 3;
  showOutputs();
}

export class Settings {
  // openDemo(name) loads one of the demo models.
  constructor(simulation, openDemo, clear) {
    this.simulation = simulation;
    this.openDemo = openDemo;
    this.clear = clear; // with the new update rate: clears the drawing
    $("preset").append(...PRESETS.map(({ title }, index) => new Option(title, index)));
    $("preset").addEventListener("change", () => this.usePreset(PRESETS[$("preset").value]));
    $("surface").addEventListener("change", showFeel);
    $("share").addEventListener("click", () => this.share());
    ["rate", "resolution"].forEach((id) => $(id).addEventListener("change", () => this.setDevice()));
    FEEL.forEach((id) => $(id).addEventListener("input", () => this.setFeel()));
    showSwatches(async (feel) => {
      await this.setFeel([...feel, Number($("method").value)]);
      showFeel();
    });
  }

  async setFeel(feel = shownFeel()) {
    const index = Number($("surface").value);
    const { error } = await this.simulation.ask("feel", { index, feel });
    if (error) {
      tell(error, true);
    } else if (scene.surfaces[index]) {
      scene.surfaces[index].feel = feel;
    }
    showOutputs();
  }

  async setDevice() {
    const rate = Number($("rate").value);
    const resolution = Number($("resolution").value);
    const { error } = await this.simulation.ask("device", { rate, resolution, protections: 15 });
    this.clear(rate);
    if (error) {
      tell(error, true);
    }
  }

  async share() {
    location.hash = new URLSearchParams(SHARED.map((id) => [id, $(id).value])).toString();
    try {
      await navigator.clipboard.writeText(location.href);
      tell("The link is in the clipboard.");
    } catch {
      tell("The link is in the address bar.");
    }
  }

  // settings: a Map or URLSearchParams of controls' values
  async use(settings) {
    const these = (ids) => ids.filter((id) => settings.has(id)).forEach((id) => set(id, settings.get(id)));
    these(["model", "depth", "exaggeration", "rate", "resolution"]);
    await Promise.all([this.setDevice(), this.openDemo($("model").value)]);
    these(["surface"]);
    showFeel();
    these(FEEL);
    if (surface() && FEEL.some((id) => settings.has(id))) {
      await this.setFeel();
    }
  }

  // Applies a failure of the catalogue: settings, and a stroke that shows it.
  async usePreset(preset) {
    $("preset-text").textContent = preset?.text ?? "";
    this.simulation.travel(null);
    if (!preset) {
      return;
    }
    await this.use(new Map(Object.entries({ ...PRESETS.common, ...preset.settings })));
    const { anchor, normal, x } = surface();
    const depth = Number($("depth").value) / 1000;
    const middle = anchor.map((value, i) => value - depth * normal[i]);
    this.simulation.travel({ middle, along: x.map((value) => value * preset.half), speed: preset.speed,
      eased: Boolean(preset.eased) });
  }
}
