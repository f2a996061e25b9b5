// The page: files, incoming ticks, and drawing. SPDX-License-Identifier: MIT
import { $, save, scene, setSurfaces, surface, tell } from "./page.js";
import { Pointer } from "./pointer.js";
import { Recording } from "./recording.js";
import { AT, ROW, length, vector } from "./rows.js";
import { History, drawLens, drawNeedle, drawScope, drawSpectrum } from "./scope.js";
import { Settings, showFeel, showOutputs, shownFeel, tag } from "./settings.js";
import { Sound } from "./sound.js";
import { Simulation, watch } from "./sources.js";
import { nodesWithMesh, withTag } from "./tag.js";

const PANELS_MS = 100; // between drawings of curves and numbers
const NET_S = 0.05;
const MOST_BYTES = 64 * 1024 * 1024;
const linked = new URLSearchParams(location.hash.slice(1));
const history = new History();
const sound = new Sound();
const ticks = { latest: null, crossed: 0, played: 0, missed: 0, cost: 0 };
let simulation = null; // or null: the page shows a run of the tool
let pointer = null;
let rate = 1000; // Hz, of the source
let panelsDrawn = 0; // ms

// --- incoming ticks ---

function take(rows) {
  for (let at = 0; at < rows.length; at += ROW) {
    const row = rows.subarray(at, at + ROW);
    const { latest } = ticks;
    history.add({ height: row[AT.height], force: length(row), frequency: row[AT.frequency] });
    ticks.crossed += row[AT.frequency] / history.rate;
    ticks.played += row[AT.height] * (latest?.[AT.height] ?? 0) < 0 ? 0.5 : 0;
    ticks.missed += latest ? Math.max(0, Math.round((row[AT.time] - latest[AT.time]) * history.rate) - 1) : 0;
    ticks.latest = row;
  }
}

function arrive(rows) {
  if (!recording.isReplaying) {
    take(rows);
    recording.add(rows);
  }
}

function forget(shownRate) {
  history.clear(shownRate);
  Object.assign(ticks, { latest: null, crossed: 0, played: 0, missed: 0 });
}

// The source's rate has changed.
function setRate(hz) {
  rate = hz;
  forget(hz);
}

const recording = new Recording({ show: take, begin: forget, end: () => forget(rate) });

// --- files ---

// three.js is most of the page: it is loaded while WebAssembly and the model are.
const viewModule = import("./view.js");
viewModule.catch(() => {}); // draw3d() reports it

const undrawn = () => (scene.view ? "" : " with the arrow keys; there is no WebGL in this browser, so that it is not drawn");

function makeView(View) {
  try {
    return new View($("view"));
  } catch {
    return null; // undrawn() reports it
  }
}

async function draw3d(bytes, name) {
  try {
    const { View, read } = await viewModule;
    const reading = read(bytes); // decodes its images while WebGL starts
    if (scene.view === undefined) {
      scene.view = makeView(View);
    }
    const model = await reading;
    scene.view?.show(model);
    return true;
  } catch {
    tell(`${name}: it cannot be drawn, but all else works; with the arrow keys its first surface is stroked`, true);
    return false;
  }
}

// isOurs: it is known to load, so it is drawn meanwhile
async function open(bytes, name, isOurs = false) {
  const drawing = isOurs ? draw3d(bytes, name) : null;
  const { error, surfaces } = await simulation.ask("load", { bytes, name });
  const nodes = nodesWithMesh(bytes);
  if (nodes.length > 0) { // a file without a tag can be given one
    Object.assign(scene, { bytes, name });
    $("node").replaceChildren(...nodes.map((node) => new Option(node.name, node.index)));
  }
  if (error) { // keep the present scene
    tell(/nothing is tagged/.test(error) ? `${error}; a mesh of it can be tagged below` : error, true);
    return;
  }
  setSurfaces(surfaces);
  pointer.lift();
  forget(rate);
  showFeel();
  if (await (drawing ?? draw3d(bytes, name))) {
    tell(`${name}: ${surfaces.length} ${surfaces.length === 1 ? "surface" : "surfaces"} to stroke${undrawn()}`);
  }
}

async function openDemo(name) {
  try {
    const answer = await fetch(new URL(`assets/${name}`, import.meta.url));
    await open(await answer.arrayBuffer(), name, true);
  } catch (problem) {
    tell(`${name} could not be fetched: ${problem.message}`, true);
  }
}

async function openFile(file) {
  if (file.size > MOST_BYTES) {
    tell(`${file.name}: ${file.size} bytes; expected at most ${MOST_BYTES}`, true);
  } else if (/\.csv$/i.test(file.name)) {
    await recording.open(file);
  } else if (simulation) {
    simulation.travel(null);
    await open(await file.arrayBuffer(), file.name);
  } else {
    tell(`${file.name}: while a run is shown, only recordings (.csv) can be opened`, true);
  }
}

async function writeTag() {
  const node = Number($("node").value);
  const name = scene.name.replace(/(-tagged)?\.glb$/i, "-tagged.glb");
  const chosen = $("node").selectedOptions[0]?.textContent;
  if (!scene.bytes || chosen === undefined) {
    tell("There is no mesh to tag.", true);
    return;
  }
  const bytes = withTag(scene.bytes, node, tag(shownFeel()));
  await open(bytes, name);
  if (!$("status").classList.contains("error")) {
    save(bytes, name);
    tell(`${name}: '${chosen}' is tagged as shown`);
  }
}

// --- drawing ---

// Avoids "-0.00".
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "");

function numbers() {
  const { latest, crossed, played, missed, cost } = ticks;
  const net = history.mean("height", NET_S);
  return [["force", `${(latest ? length(latest) : 0).toFixed(2)} N`],
    ["f_t", `${(latest?.[AT.frequency] ?? 0).toFixed(0)} Hz`],
    ["cycles crossed", crossed.toFixed(1)], ["played", played.toFixed(1)],
    ["net height", `${fixed(1000 * net, 3)} mm`],
    ...(!simulation ? [] : [["a tick", `${cost.toFixed(2)} µs`]]),
    ...(missed ? [["ticks missed", String(missed)]] : [])];
}

function draw(now) {
  requestAnimationFrame(draw);
  const { latest } = ticks;
  const touches = latest && latest[AT.contact] > 0;
  const lifted = touches ? latest[AT.height] * Number($("exaggeration").value) : 0;
  scene.view?.moveCursor(touches ? vector(latest, AT.proxy) : null, lifted, latest && vector(latest, AT.normal), latest);
  scene.view?.draw();
  if (now - panelsDrawn < PANELS_MS) {
    return;
  }
  panelsDrawn = now;
  const felt = touches ? scene.surfaces[latest[AT.surface]] : surface();
  drawScope($("scope"), history);
  drawSpectrum($("spectrum"), history);
  drawLens($("lens"), touches ? latest.subarray(AT.cycles, AT.cycles + 2) : null, felt?.feel ?? [0, 0]);
  const net = felt ? felt.feel[3] * history.mean("height", NET_S) : 0;
  drawNeedle($("net"), net / ((felt?.feel[3] * felt?.feel[2]) || 1));
  $("net-force").textContent = `net ${fixed(net, 3)} N`;
  $("numbers").innerHTML = numbers().map(([key, value]) => `<div><dt>${key}</dt><dd>${value}</dd></div>`).join("");
}

// --- begin ---

async function switchSound() {
  try {
    await ($("sound").checked ? sound.start() : sound.stop());
  } catch (problem) {
    $("sound").checked = false;
    tell(`There is no sound in this browser (${problem.message}); all else works.`, true);
  }
}

function listen() {
  window.addEventListener("dragover", (event) => {
    event.preventDefault();
    $("scene").classList.add("drop");
  });
  window.addEventListener("dragleave", () => $("scene").classList.remove("drop"));
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    $("scene").classList.remove("drop");
    const [file] = event.dataTransfer.files;
    return file && openFile(file);
  });
  $("file").addEventListener("change", () => $("file").files[0] && openFile($("file").files[0]));
  $("model").addEventListener("change", () => openDemo($("model").value));
  $("sound").addEventListener("change", switchSound);
  $("tag").addEventListener("click", writeTag);
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

listen();
requestAnimationFrame(draw);
if (linked.has("live")) {
  document.documentElement.dataset.live = "1";
  showOutputs();
  watch({ hello: show, rows: arrive, ended: () => tell("The run is over, or this page is not the one it gave.", true) });
  ready();
} else {
  simulation = new Simulation(globalThis.started, {
    ticks: ({ rows, samples, cost }) => {
      sound.play(samples);
      ticks.cost += 0.02 * (cost - ticks.cost); // clocks of browsers are coarse
      arrive(rows);
    },
    failed: () => tell("WebAssembly could not be started in this browser: there is nothing to feel here.", true),
  });
  pointer = new Pointer(simulation);
  new Settings(simulation, openDemo, setRate).use(linked).then(ready);
}
