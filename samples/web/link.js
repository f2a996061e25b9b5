// A link holds the work: model, settings, failure, camera and whether the hand moves. SPDX-License-Identifier: MIT
import { $, isPressed, scene, tell } from "./page.js";
import { PRESETS } from "./presets.js";
import { SETTINGS, showPreset, value } from "./settings.js";

const slug = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, "-");

function describe() {
  const link = new URLSearchParams(SETTINGS.map((id) => [id, value(id)]));
  const preset = PRESETS[$("preset").value];
  if (preset) {
    link.set("preset", slug(preset.title));
  }
  if (scene.isOwn) { // a file is not in a link
    link.delete("model");
    link.set("file", scene.name);
  }
  if (!isPressed("ghost")) {
    link.set("hand", "rests");
  }
  if (scene.view?.model) {
    link.set("camera", scene.view.pose.map((part) => part.toFixed(2)).join());
  }
  return link;
}

async function copy() {
  history.pushState(null, "", `#${describe()}`);
  const own = scene.isOwn ? ` It needs ${scene.name}: send that, too.` : "";
  try {
    await navigator.clipboard.writeText(location.href);
    tell(`The link is in the clipboard.${own}`);
  } catch {
    tell(`The link is in the address bar.${own}`);
  }
}

// The same as a figure in another page.
async function copyFigure() {
  const address = `${location.href.replace(/#.*/, "")}#embed=1&${describe()}`.replaceAll("&", "&amp;");
  const frame = `<iframe src="${address}" width="640" height="420" loading="lazy" title="Ridges as a force-feedback device plays them"></iframe>`;
  try {
    await navigator.clipboard.writeText(frame);
    tell("The figure is in the clipboard: an <iframe>, in HTML.");
  } catch {
    tell(frame);
  }
}

export class Link {
  constructor(settings) {
    this.settings = settings;
    this.waiting = null; // a link whose file has still to be opened
    $("share").addEventListener("click", copy);
    $("embed").addEventListener("click", copyFigure);
    $("whole").addEventListener("click", () => {
      $("whole").href = `#${describe()}`;
    });
    addEventListener("hashchange", () => this.follow()); // pasted, or Back
    addEventListener("popstate", () => this.follow());
  }

  // Follows the address bar.
  async follow() {
    const link = new URLSearchParams(location.hash.slice(1));
    if (this.followed === location.hash) {
      return;
    }
    this.followed = location.hash;
    const index = PRESETS.findIndex(({ title }) => slug(title) === link.get("preset"));
    const still = link.get("hand") === "rests" || matchMedia("(prefers-reduced-motion: reduce)").matches;
    $("preset").value = index < 0 ? "" : String(index);
    showPreset(PRESETS[index]);
    this.settings.rest();
    const preset = index < 0 ? {} : { ...PRESETS.common, ...PRESETS[index].settings };
    await this.settings.use(new Map([...Object.entries(preset), ...link]));
    if (link.get("hand") !== "rests" && (index >= 0 || !still)) {
      this.settings.move();
    }
    const pose = (link.get("camera") ?? "").split(",").map(Number);
    if (scene.view?.model && pose.length === 3 && pose.every((part) => Math.abs(part) < 50) && pose.some(Boolean)) {
      scene.view.pose = pose;
    }
    this.waiting = link.has("file") ? link : null;
    if (this.waiting) {
      tell(`This link is of ${link.get("file")}, a file of its sender: drop it on the page.`);
    }
  }

  // After a file was opened: the link's settings, if it is the link's file.
  async opened(name) {
    if (this.waiting?.get("file") === name) {
      await this.settings.useFeel(this.waiting);
    }
    this.waiting = null;
  }
}
