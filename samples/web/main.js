// The page: incoming ticks, and drawing. SPDX-License-Identifier: MIT
import { Actuators } from "./actuators.js";
import { Blind } from "./blind.js";
import { drawComparison } from "./compare.js";
import { Files, draw3d } from "./files.js";
import { drawGauge } from "./gauge.js";
import { Link } from "./link.js";
import { $, isPressed, press, scene, setSurfaces, surface, tell } from "./page.js";
import { Pointer } from "./pointer.js";
import { Recording } from "./recording.js";
import { AT, METHODS, ROW, length, vector } from "./rows.js";
import { History, drawScope } from "./scope.js";
import { Settings, showFeel, showOutputs } from "./settings.js";
import { Sound } from "./sound.js";
import { Simulation, watch } from "./sources.js";
import { offer } from "./vibrate.js";

const PANELS_MS = 100; // between drawings of curves and numbers
const NET_S = 0.05;
const history = new History();
const sound = new Sound();
const vibrate = offer();
const ticks = { latest: null, crossed: 0, played: 0, missed: 0, cost: null };
let actuators = null;
let simulation = null; // or null: the page shows a run of the tool
let rate = 1000; // Hz, of the source
let panelsDrawn = 0; // ms

// --- incoming ticks ---

// heights: by each method; null in runs of the tool and recordings
function take(rows, heights = null) {
  for (let at = 0, k = 0; at < rows.length; at += ROW, k += METHODS) {
    const row = rows.subarray(at, at + ROW);
    const { latest } = ticks;
    history.add(row, heights?.subarray(k, k + METHODS));
    ticks.crossed += row[AT.frequency] / history.rate;
    ticks.played += row[AT.height] * (latest?.[AT.height] ?? 0) < 0 ? 0.5 : 0;
    ticks.missed += latest ? Math.max(0, Math.round((row[AT.time] - latest[AT.time]) * history.rate) - 1) : 0;
    ticks.latest = row;
  }
  sound.play(rows, scene.surfaces);
  vibrate(ticks.crossed, ticks.latest?.[AT.frequency] ?? 0, performance.now());
}

function arrive(rows, heights) {
  if (!recording.isReplaying) {
    take(rows, heights);
    recording.add(rows);
  }
}

function forget(shownRate) {
  history.clear(shownRate);
  sound.setRate(shownRate);
  Object.assign(ticks, { latest: null, crossed: 0, played: 0, missed: 0 });
  panelsDrawn = -Infinity; // the next frame draws the panels
}

// The source's rate has changed.
function setRate(hz) {
  rate = hz;
  forget(hz);
}

const recording = new Recording({ show: (rows) => take(rows), begin: forget, end: () => forget(rate) });

// --- drawing ---

// Avoids "-0.00".
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "");

function numbers() {
  const { latest, crossed, played, missed, cost } = ticks;
  return [["force", `${(latest ? length(latest) : 0).toFixed(2)} N`],
    ["f_t", `${(latest?.[AT.frequency] ?? 0).toFixed(0)} Hz`],
    ["cycles crossed", crossed.toFixed(1)], ["played", played.toFixed(1)],
    ["net height", `${fixed(1000 * history.net(NET_S), 3)} mm`],
    ...(cost === null ? [] : [["a tick here", `${cost.toFixed(2)} µs`]]),
    ...(actuators?.numbers() ?? []),
    ...(missed ? [["ticks missed", String(missed)]] : [])];
}

// The sliders are those of the surface that is stroked.
function followSurface(index) {
  if (String(index) !== $("surface").value && scene.surfaces[index] && simulation) {
    $("surface").value = String(index);
    showFeel();
  }
}

function draw(now) {
  requestAnimationFrame(draw);
  const { latest } = ticks;
  const touches = latest && latest[AT.contact] > 0;
  const lifted = touches ? latest[AT.height] * Number($("exaggeration").value) : 0;
  scene.view?.moveCursor(touches ? vector(latest, AT.proxy) : null, lifted, latest && vector(latest, AT.normal), latest);
  scene.view?.draw($("lens"));
  if (now - panelsDrawn < PANELS_MS) {
    return;
  }
  panelsDrawn = now;
  if (touches) {
    followSurface(latest[AT.surface]);
  }
  drawScope($("scope"), history);
  drawGauge(history);
  drawComparison(history, surface()?.feel[2] ?? 0);
  $("numbers").innerHTML = numbers().map(([key, value]) => `<div><dt>${key}</dt><dd>${value}</dd></div>`).join("");
}

// --- begin ---

async function switchSound() {
  const on = !isPressed("sound");
  try {
    await (on ? sound.start() : sound.stop());
    press("sound", on);
  } catch (problem) {
    tell(`There is no sound in this browser (${problem.message}); all else works.`, true);
  }
}

function listen(openFile) {
  addEventListener("dragover", (event) => {
    event.preventDefault();
    $("scene").classList.add("drop");
  });
  addEventListener("dragleave", () => $("scene").classList.remove("drop"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    $("scene").classList.remove("drop");
    const [file] = event.dataTransfer.files;
    return file && openFile(file);
  });
  $("file").addEventListener("change", () => $("file").files[0] && openFile($("file").files[0]));
  $("sound").addEventListener("click", switchSound);
  document.querySelectorAll('input[type="range"]').forEach((slider) => slider.addEventListener("input", showOutputs));
  $("controls").addEventListener("submit", (event) => event.preventDefault());
}

function ready() {
  document.documentElement.dataset.ready = "1";
}

// Shows a run of the tool, whose settings cannot be changed here.
function show(run) {
  setRate(run.rate_hz);
  setSurfaces(run.surfaces);
  tell(`${run.file} on ${run.device}, ${run.rate_hz} Hz`);
  fetch("scene").then((answer) => answer.arrayBuffer()).then((bytes) => draw3d(bytes, run.file));
}

function watchRun() {
  listen((file) => (/\.csv$/i.test(file.name) ? recording.open(file)
    : tell(`${file.name}: while a run is shown, only recordings (.csv) can be opened`, true)));
  document.documentElement.dataset.live = "1";
  showOutputs();
  watch({ hello: show, rows: arrive, ended: () => tell("The run is over, or this page is not the one it gave.", true) });
  ready();
}

function simulate() {
  simulation = new Simulation(globalThis.started, {
    ticks: (came) => {
      ticks.cost = came.cost ?? ticks.cost;
      arrive(came.rows, came.heights);
      actuators.play(came);
    },
    inverse3: (event) => actuators.take(event),
    failed: () => tell("WebAssembly could not be started in this browser: there is nothing to feel here.", true),
  });
  const files = new Files(simulation, async (name) => {
    forget(rate);
    await link.opened(name);
    settings.move();
    blind.opened();
  });
  const settings = new Settings(simulation, (name) => files.openDemo(name), setRate);
  const link = new Link(settings);
  listen((file) => (/\.csv$/i.test(file.name) ? recording.open(file) : files.openFile(file)));
  const blind = new Blind(() => settings.setMethods());
  actuators = new Actuators(simulation, () => settings.rest());
  new Pointer(simulation, { taken: () => press("ghost", false), clicked: (event) => files.give(scene.view.meshAt(event)) });
  link.follow().then(ready);
}

requestAnimationFrame(draw);
if (new URLSearchParams(location.hash.slice(1)).has("live")) {
  watchRun();
} else if (globalThis.started) { // start.js said why not
  simulate();
}
