// Settings of surface and device; links and the failures' catalogue set them. SPDX-License-Identifier: MIT
import { listen, method, setMethod } from "./compare.js";
import { $, SLIDERS, isPressed, press, scene, surface, tell } from "./page.js";
import { PRESETS } from "./presets.js";
import { showSwatches } from "./swatches.js";

const METHODS = ["bandlimited", "S1", "S2", "bandlimited"];
const DEVICE = ["depth", "exaggeration", "rate", "resolution"];
const GHOST = { half: 0.045, speed: 0.12 }; // m, m/s
export const SETTINGS = ["model", "surface", "method", ...SLIDERS.map(([id]) => id), ...DEVICE];

// The tag of a surface for a glTF material's extras.
export function tag(feel) {
  return { version: 1, spatial_frequency: [feel[0], feel[1]], amplitude: feel[2], stiffness: feel[3], friction: feel[4],
    method: METHODS[feel[5]] };
}

export const shownFeel = () => [...SLIDERS.map(([id, scale]) => Number($(id).value) / scale), method()];

export const value = (id) => (id === "method" ? String(method()) : $(id).value);

function set(id, wanted) {
  if (id === "method") {
    setMethod(wanted);
    return;
  }
  $(id).value = wanted; // the control ignores unknown values
  if ($(id).selectedIndex === -1) {
    $(id).selectedIndex = 0;
  }
}

const spoken = ({ id, value: shown, dataset }) => (id !== "fsx" ? shown + dataset.unit
  : Number(shown) > 0 ? `${(1000 / shown).toFixed(2)} mm apart` : "none");

export function showOutputs() {
  for (const slider of document.querySelectorAll('input[type="range"]')) {
    const text = spoken(slider);
    slider.parentElement.querySelector("output").textContent = text;
    slider.setAttribute("aria-valuetext", text);
  }
  $("extras").textContent = JSON.stringify({ knurl: tag(shownFeel()) }, null, 1);
}

export function showFeel() {
  const feel = surface()?.feel;
  if (!feel) {
    return;
  }
  SLIDERS.forEach(([id, scale], i) => {
    $(id).value = feel[i] * scale;
  });
  setMethod(feel[5] || 3);
  showOutputs();
}

export function showPreset(preset) {
  $("preset-text").textContent = preset?.text ?? "";
  $("preset").options[0].textContent = preset ? "back to the settings before" : "choose a failure";
}

export class Settings {
  // openDemo(name) loads one of the demo models. clear(rate): a new update rate.
  constructor(simulation, openDemo, clear) {
    Object.assign(this, { simulation, openDemo, clear });
    this.before = null; // the settings before a failure was chosen
    $("preset").append(...PRESETS.map(({ title }, index) => new Option(title, index)));
    $("preset").addEventListener("change", () => this.usePreset(PRESETS[$("preset").value]));
    $("surface").addEventListener("change", () => this.chooseSurface());
    $("depth").addEventListener("input", () => this.setDepth());
    ["rate", "resolution"].forEach((id) => $(id).addEventListener("change", () => this.setDevice()));
    SLIDERS.forEach(([id]) => $(id).addEventListener("input", () => this.setFeel()));
    showSwatches(async (feel, color) => {
      const index = Number($("surface").value);
      await this.send(index, [...feel, method()]);
      showFeel();
      scene.view?.setRidges(scene.surfaces);
      scene.view?.paint(index, color);
    });
    listen(() => this.setMethods());
    $("ghost").addEventListener("click", () => (isPressed("ghost") ? this.rest() : this.move()));
  }

  async send(index, feel) {
    const { error } = await this.simulation.ask("feel", { index, feel });
    if (error) {
      tell(error, true);
    } else if (scene.surfaces[index]) {
      Object.assign(scene.surfaces[index], { feel, changed: true });
    }
  }

  async setFeel() {
    showOutputs();
    if (surface()) {
      await this.send(Number($("surface").value), shownFeel());
      scene.view?.setRidges(scene.surfaces);
    }
  }

  // A method is chosen for all surfaces.
  async setMethods() {
    showOutputs();
    await Promise.all(scene.surfaces.map(({ feel }, index) => this.send(index, [...feel.slice(0, 5), method()])));
  }

  setDepth() {
    this.simulation.send("depth", { depth: Number($("depth").value) / 1000 });
  }

  async setDevice() {
    const rate = Number($("rate").value);
    const resolution = Number($("resolution").value);
    this.setDepth();
    const { error } = await this.simulation.ask("device", { rate, resolution, protections: 15 });
    this.clear(rate);
    if (error) {
      tell(error, true);
    }
  }

  chooseSurface() {
    showFeel();
    if (isPressed("ghost")) {
      this.move();
    }
  }

  // settings: a Map or URLSearchParams of controls' values
  async use(settings) {
    const these = (ids) => ids.filter((id) => settings.has(id)).forEach((id) => set(id, settings.get(id)));
    these(["model", ...DEVICE]);
    await Promise.all([this.setDevice(), this.openDemo($("model").value)]);
    await this.useFeel(settings);
  }

  // The settings of the surface.
  async useFeel(settings) {
    if (settings.has("surface")) {
      set("surface", settings.get("surface"));
      showFeel();
    }
    SLIDERS.filter(([id]) => settings.has(id)).forEach(([id]) => set(id, settings.get(id)));
    await this.setFeel();
    if (settings.has("method")) {
      set("method", settings.get("method"));
      await this.setMethods();
    }
  }

  // Applies a failure of the catalogue: settings, and a stroke that shows it; without one, the settings before.
  async usePreset(preset) {
    showPreset(preset);
    const before = this.before ?? new Map(SETTINGS.map((id) => [id, value(id)]));
    this.before = preset ? before : null;
    this.rest();
    await this.use(preset ? new Map(Object.entries({ ...PRESETS.common, ...preset.settings })) : before);
    this.move();
  }

  // Strokes the surface to and fro: as the failure that is chosen says, or slowly.
  move() {
    if (!surface() || $("ghost").disabled) { // a device is the hand
      return;
    }
    const preset = PRESETS[$("preset").value];
    const { anchor, normal, x, reach } = surface();
    const half = preset?.half ?? Math.min(GHOST.half, 0.8 * Math.min(...reach));
    const way = { middle: anchor, normal, along: x.map((part) => part * half), speed: preset?.speed ?? GHOST.speed,
      eased: Boolean(preset?.eased), follows: !preset };
    this.simulation.send("travel", { way });
    press("ghost", true);
  }

  rest() {
    this.simulation.send("travel", { way: null });
    press("ghost", false);
  }
}
