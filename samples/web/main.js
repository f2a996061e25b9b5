// The page: what is loaded and set, the pointer's way to the worker, and what comes back from it.
// SPDX-License-Identifier: MIT
import { History, drawLens, drawScope, drawSpectrum } from "./scope.js";
import { Sound } from "./sound.js";
import { View } from "./view.js";

const ROW = 16;
const MOST_BYTES = 64 * 1024 * 1024;
const METHODS = ["locked", "S1", "S2", "locked", "area"];
const $ = (id) => document.getElementById(id);
const history = new History();
const sound = new Sound();
const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
const waiting = new Map();
const settings = new URLSearchParams(location.hash.slice(1));
let view = null;
let surfaces = [];
let under = null; // what the pointer is over: {point, normal}
let latest = null; // the latest tick's row
let crossed = 0;
let played = 0;
let cost = 0;

function tell(text, isError = false) {
  $("status").textContent = text;
  $("status").classList.toggle("error", isError);
}

// Asks the worker and waits for its answer.
function ask(kind, message = {}, transfer = []) {
  const id = (ask.next = (ask.next ?? 0) + 1);
  return new Promise((resolve) => {
    waiting.set(id, resolve);
    worker.postMessage({ kind, id, ...message }, transfer);
  });
}

function take({ rows, samples, cost: microseconds }) {
  sound.play(samples);
  cost = microseconds;
  for (let at = 0; at < rows.length; at += ROW) {
    const row = rows.subarray(at, at + ROW);
    const height = row[10];
    history.add({ height, force: Math.hypot(row[0], row[1], row[2]), frequency: row[11] });
    crossed += row[11] / history.rate;
    played += height * (latest?.[10] ?? 0) < 0 ? 0.5 : 0;
    latest = row;
  }
}

worker.onmessage = ({ data }) => {
  if (data.kind === "ticks") {
    take(data);
  } else if (data.kind === "answer") {
    waiting.get(data.id)?.(data);
    waiting.delete(data.id);
  } else {
    start();
  }
};
worker.onerror = () => tell("WebAssembly could not be started in this browser: there is nothing to feel here.", true);

async function open(bytes, name) {
  if (bytes.byteLength > MOST_BYTES) {
    tell(`${name}: ${bytes.byteLength} bytes; expected at most ${MOST_BYTES}`, true);
    return;
  }
  const { error, surfaces: found } = await ask("load", { bytes, name });
  if (error) {
    tell(error, true); // what was there goes on
    return;
  }
  surfaces = found;
  under = null;
  crossed = played = 0;
  $("surface").replaceChildren(...found.map(({ name: label }, index) => new Option(label, index)));
  showFeel();
  try {
    await view?.show(bytes);
    tell(`${name}: ${found.length} ${found.length === 1 ? "surface" : "surfaces"} to stroke`);
  } catch {
    tell(`${name}: it can be felt along its first surface, with the arrow keys, but not drawn`, true);
  }
}

async function openDemo(name) {
  try {
    const answer = await fetch(new URL(`assets/${name}`, import.meta.url));
    await open(await answer.arrayBuffer(), name);
  } catch (problem) {
    tell(`${name} could not be fetched: ${problem.message}`, true);
  }
}

// --- how it feels ---

const SLIDERS = [["fsx", 0, 1], ["fsy", 1, 1], ["amplitude", 2, 1000], ["stiffness", 3, 1], ["friction", 4, 1]];

function showOutputs() {
  for (const slider of document.querySelectorAll('input[type="range"]')) {
    slider.parentElement.querySelector("output").textContent = slider.value + slider.dataset.unit;
  }
  const feel = surfaces[$("surface").value]?.feel;
  if (feel) {
    const tag = { version: 1, spatial_frequency: [feel[0], feel[1]], amplitude: feel[2], stiffness: feel[3],
      friction: feel[4], method: METHODS[feel[5]] };
    $("extras").textContent = JSON.stringify({ knurl: tag }, null, 1);
  }
}

function showFeel() {
  const { feel } = surfaces[$("surface").value];
  for (const [id, index, scale] of SLIDERS) {
    $(id).value = feel[index] * scale;
  }
  $("method").value = feel[5] || 3;
  showOutputs();
}

async function setFeel() {
  const index = Number($("surface").value);
  const feel = [...SLIDERS.map(([id, , scale]) => Number($(id).value) / scale), Number($("method").value)];
  const { error } = await ask("feel", { index, feel });
  if (error) {
    tell(error, true);
  } else {
    surfaces[index].feel = feel;
  }
  showOutputs();
}

async function setDevice() {
  const rate = Number($("rate").value);
  const { error } = await ask("device", { rate, resolution: Number($("resolution").value), protections: 15 });
  history.clear(rate);
  if (error) {
    tell(error, true);
  }
}

const SHARED = ["model", "surface", "method", "fsx", "fsy", "amplitude", "stiffness", "friction", "depth", "exaggeration",
  "rate", "resolution"];

async function share() {
  location.hash = new URLSearchParams(SHARED.map((id) => [id, $(id).value])).toString();
  try {
    await navigator.clipboard.writeText(location.href);
    tell("The link is in the clipboard.");
  } catch {
    tell("The link is in the address bar.");
  }
}

async function restore() {
  const known = SHARED.filter((id) => settings.has(id));
  const set = (id) => {
    $(id).value = settings.get(id); // what it does not know it refuses
    $(id).selectedIndex = $(id).selectedIndex === -1 ? 0 : $(id).selectedIndex;
  };
  known.filter((id) => ["model", "depth", "exaggeration", "rate", "resolution"].includes(id)).forEach(set);
  await setDevice();
  await openDemo($("model").value);
  if (settings.has("surface") && surfaces.length > 0) {
    set("surface");
    showFeel();
  }
  known.filter((id) => ["method", ...SLIDERS.map(([slider]) => slider)].includes(id)).forEach(set);
  if (surfaces.length > 0) {
    await setFeel();
  }
}

// --- the pointer ---

function press() {
  const depth = Number($("depth").value) / 1000;
  const target = under && under.point.map((value, i) => value - depth * under.normal[i]);
  worker.postMessage({ kind: "move", target });
}

function stroke(event) {
  if (event.isPrimary && (event.buttons & 1 || event.type === "pointerdown")) {
    under = view.pick(event);
    press();
  }
}

function lift() {
  under = null;
  press();
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

function strokeByKey(event) {
  const way = ARROWS[event.key];
  const surface = surfaces[$("surface").value];
  if (event.key === "Escape") {
    lift();
  }
  if (!way || !surface) {
    return;
  }
  event.preventDefault();
  const from = under ?? { point: surface.anchor, normal: surface.normal };
  const [n, x] = [from.normal, surface.x];
  const y = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]];
  const point = from.point.map((value, i) => value + 0.002 * (way[0] * x[i] + way[1] * y[i]));
  under = view?.pickBelow(point, n) ?? { point, normal: n };
  press();
}

function listen() {
  const canvas = $("view");
  canvas.addEventListener("pointerdown", (event) => {
    if (view && event.isPrimary && event.button === 0) {
      canvas.setPointerCapture(event.pointerId);
      stroke(event);
    }
  });
  canvas.addEventListener("pointermove", (event) => view && stroke(event));
  for (const end of ["pointerup", "pointercancel", "blur"]) {
    canvas.addEventListener(end, lift);
  }
  canvas.addEventListener("keydown", strokeByKey);
  const scene = $("scene");
  window.addEventListener("dragover", (event) => {
    event.preventDefault();
    scene.classList.add("drop");
  });
  window.addEventListener("dragleave", () => scene.classList.remove("drop"));
  window.addEventListener("drop", async (event) => {
    event.preventDefault();
    scene.classList.remove("drop");
    const [file] = event.dataTransfer.files;
    if (file) {
      await openFile(file);
    }
  });
  $("file").addEventListener("change", () => $("file").files[0] && openFile($("file").files[0]));
  $("model").addEventListener("change", () => openDemo($("model").value));
  $("surface").addEventListener("change", showFeel);
  $("share").addEventListener("click", share);
  $("sound").addEventListener("change", switchSound);
  ["rate", "resolution"].forEach((id) => $(id).addEventListener("change", setDevice));
  ["method", ...SLIDERS.map(([id]) => id)].forEach((id) => $(id).addEventListener("input", setFeel));
  ["depth", "exaggeration"].forEach((id) => $(id).addEventListener("input", showOutputs));
  $("depth").addEventListener("input", press);
  $("controls").addEventListener("submit", (event) => event.preventDefault());
}

async function openFile(file) {
  if (file.size > MOST_BYTES) {
    tell(`${file.name}: ${file.size} bytes; expected at most ${MOST_BYTES}`, true);
  } else {
    await open(await file.arrayBuffer(), file.name);
  }
}

async function switchSound() {
  try {
    await ($("sound").checked ? sound.start() : sound.stop());
  } catch (problem) {
    $("sound").checked = false;
    tell(`There is no sound in this browser (${problem.message}); all else works.`, true);
  }
}

// --- what is shown ---

let frames = 0;

function draw() {
  requestAnimationFrame(draw);
  const touches = latest && latest[14] > 0;
  const index = touches ? latest[15] : $("surface").value;
  const normal = under?.normal ?? [0, 1, 0];
  const lifted = touches ? latest[10] * Number($("exaggeration").value) : 0;
  view?.moveCursor(touches ? latest.slice(6, 9) : null, lifted, normal, latest?.slice(0, 3));
  view?.draw();
  if (frames++ % 6 !== 0) {
    return;
  }
  drawScope($("scope"), history);
  drawSpectrum($("spectrum"), history);
  drawLens($("lens"), touches ? latest.slice(12, 14) : null, surfaces[index]?.feel ?? [0, 0]);
  const force = latest ? Math.hypot(latest[0], latest[1], latest[2]) : 0;
  const numbers = [["force", `${force.toFixed(2)} N`], ["f_t", `${(latest?.[11] ?? 0).toFixed(0)} Hz`],
    ["cycles crossed", crossed.toFixed(1)], ["played", played.toFixed(1)], ["a tick", `${cost.toFixed(2)} µs`]];
  $("numbers").innerHTML = numbers.map(([key, value]) => `<div><dt>${key}</dt><dd>${value}</dd></div>`).join("");
}

async function start() {
  try {
    view = new View($("view"));
  } catch {
    tell("There is no WebGL in this browser: nothing is drawn in 3D; the arrow keys stroke the surface all the same.", true);
  }
  listen();
  await restore();
  document.documentElement.dataset.ready = "1";
  draw();
}
