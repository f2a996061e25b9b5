// Models: demos and own files; drawn, surveyed for their ridges, tagged and saved. SPDX-License-Identifier: MIT
import { $, save, scene, setSurfaces, tell } from "./page.js";
import { showFeel, shownFeel, tag } from "./settings.js";

const MOST_BYTES = 64 * 1024 * 1024;

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

export async function draw3d(bytes, name, { isOurs = false, keepsCamera = false } = {}) {
  try {
    const { View, read } = await viewModule;
    const reading = read(bytes, isOurs); // decodes its images while WebGL starts
    if (scene.view === undefined) {
      scene.view = makeView(View);
    }
    const model = await reading;
    scene.view?.show(model, keepsCamera);
    return true;
  } catch {
    tell(`${name}: it cannot be drawn, but all else works; with the arrow keys its first surface is stroked`, true);
    return false;
  }
}

// Whether a .glb is compressed in a way that the library does not read.
function isPacked(bytes) {
  const size = bytes.byteLength < 20 ? 0 : Math.min(bytes.byteLength - 20, new DataView(bytes).getUint32(12, true));
  const json = new TextDecoder().decode(new Uint8Array(bytes, size > 0 ? 20 : 0, size));
  return /"(KHR_draco_mesh_compression|EXT_meshopt_compression)"/.test(json);
}

export class Files {
  // opened(): after a model has been loaded.
  constructor(simulation, opened) {
    Object.assign(this, { simulation, opened, surveys: 0 });
    $("model").addEventListener("change", () => this.openDemo($("model").value).then(() => this.opened(null)));
    $("give").addEventListener("click", () => this.give({ node: Number($("part").value), surface: -1 }));
    $("tag").addEventListener("click", () => this.saveTagged());
  }

  // isOurs: it is known to load, so it is drawn meanwhile
  async open(bytes, name, { isOurs = false, keepsCamera = false } = {}) {
    const drawing = isOurs ? draw3d(bytes, name, { isOurs }) : null;
    const { error, surfaces } = await this.simulation.ask("load", { bytes, name });
    if (error) { // keep the present scene
      tell(error, true);
      return false;
    }
    Object.assign(scene, { bytes, name, isOwn: !isOurs });
    setSurfaces(surfaces);
    showFeel();
    $("tag").disabled = surfaces.length === 0;
    const isDrawn = await (drawing ?? draw3d(bytes, name, { keepsCamera }));
    if (isDrawn) {
      tell(surfaces.length === 0 ? `${name}: nothing is tagged yet. Click a part of it to give it ridges.`
        : `${name}: ${surfaces.length} ${surfaces.length === 1 ? "surface" : "surfaces"} to stroke${undrawn()}`);
    }
    this.listParts();
    if (scene.view && isDrawn) {
      this.survey(bytes, name, isOurs);
    }
    return true;
  }

  // Finds the places of the ridges, while the model can already be stroked. A newer survey ends it.
  async survey(bytes, name, isOurs) {
    const number = ++this.surveys;
    const { error } = await this.simulation.ask("survey", { bytes, name });
    if (!error && number === this.surveys) {
      const ask = async (points, depth) => (await this.simulation.ask("coordinates", { points, depth })).found;
      await scene.view.findRidges(ask, isOurs);
    }
    if (number !== this.surveys) {
      return; // the worker has the newer one's scene
    }
    if (!error) {
      scene.view.setRidges(scene.surfaces);
      this.listParts();
    }
    this.simulation.send("surveyed");
    document.documentElement.dataset.surveyed = name;
  }

  // The parts of an own file that can still be given ridges.
  listParts() {
    const parts = scene.isOwn ? scene.view?.parts ?? [] : [];
    const chosen = $("part").value;
    $("part").replaceChildren(...parts.map(({ node, name }) => new Option(name, node, false, String(node) === chosen)));
    $("give").disabled = parts.length === 0;
  }

  async openDemo(name) {
    try {
      const answer = await fetch(new URL(`assets/${name}`, import.meta.url));
      await this.open(await answer.arrayBuffer(), name, { isOurs: true });
    } catch (problem) {
      tell(`${name} could not be fetched: ${problem.message}`, true);
    }
  }

  async openFile(file) {
    if (file.size > MOST_BYTES) {
      tell(`${file.name}: ${file.size} bytes; expected at most ${MOST_BYTES}`, true);
      return;
    }
    const bytes = await this.read(file);
    if (bytes && await this.open(bytes, file.name)) {
      $("own").open = true;
      this.opened(file.name);
    }
  }

  // A file's bytes, unpacked; null after telling why not.
  async read(file) {
    const bytes = await file.arrayBuffer();
    if (!isPacked(bytes)) {
      return bytes;
    }
    try {
      tell(`${file.name}: unpacking…`);
      const { unpack } = await import("./unpack.js");
      return await unpack(bytes);
    } catch (problem) {
      tell(`${file.name}: it cannot be unpacked (${problem.message})`, true);
      return null;
    }
  }

  // A click on a part without ridges gives it those that are set.
  async give(part) {
    if (!scene.isOwn || part?.node === undefined || part.surface >= 0) {
      return;
    }
    const feel = shownFeel();
    feel[0] ||= 1000;
    const { error, bytes } = await this.simulation.ask("tag", { bytes: scene.bytes, name: scene.name, node: part.node, tag: tag(feel) });
    if (error) {
      tell(error, true);
      return;
    }
    const known = scene.surfaces.map(({ name }) => name);
    if (await this.open(bytes, scene.name, { keepsCamera: true })) {
      $("surface").value = String(Math.max(0, scene.surfaces.findIndex(({ name }) => !known.includes(name))));
      showFeel();
      this.opened(null);
    }
  }

  // Writes the changed settings into the nodes' tags, and saves the file.
  async saveTagged() {
    const name = scene.name.replace(/(-tagged)?\.glb$/i, "-tagged.glb");
    let { bytes } = scene;
    for (const [index, { feel, changed, name: surfaceName }] of scene.surfaces.entries()) {
      const node = changed ? scene.view?.nodeOf(index) : undefined;
      if (changed && node === undefined) {
        tell(`${surfaceName}: it is not drawn, so that its changed tag cannot be written`, true);
        return;
      }
      const answer = changed ? await this.simulation.ask("tag", { bytes, name: scene.name, node, tag: tag(feel) }) : { bytes };
      if (answer.error) {
        tell(answer.error, true);
        return;
      }
      bytes = answer.bytes;
    }
    save(bytes, name);
    tell(`${name} is saved, with ${scene.surfaces.length} tagged ${scene.surfaces.length === 1 ? "surface" : "surfaces"}`);
  }
}
