// Shared by the parts of the page. SPDX-License-Identifier: MIT
export const $ = (id) => document.getElementById(id);

export function tell(text, isError = false) {
  $("status").textContent = text;
  $("status").classList.toggle("error", isError);
}

// The scene: its 3D view (undefined before it is tried, null without WebGL), surfaces {name, feel, ...}, and the .glb
// that it came from.
export const scene = { view: undefined, surfaces: [], bytes: null, name: "" };

// Sliders of a surface, in the order of its feel, and their units in one of a feel: m, N/m.
export const SLIDERS = [["fsx", 1], ["fsy", 1], ["amplitude", 1000], ["stiffness", 1], ["friction", 1]];

export const surface = () => scene.surfaces[$("surface").value];

export function setSurfaces(surfaces) {
  scene.surfaces = surfaces;
  $("surface").replaceChildren(...surfaces.map(({ name }, index) => new Option(name, index)));
}

export const press = (id, isPressed) => $(id).setAttribute("aria-pressed", String(isPressed));
export const isPressed = (id) => $(id).getAttribute("aria-pressed") === "true";

export function save(content, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Prepares a canvas of the size that it has on the screen.
export function prepare(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.max(1, width * ratio);
  canvas.height = Math.max(1, height * ratio);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  context.font = "12px system-ui, sans-serif";
  const style = getComputedStyle(canvas);
  return { context, width, height, colour: (name) => style.getPropertyValue(name) };
}
