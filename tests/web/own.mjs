// Own files: shown without a tag, tagged by a click, saved; links to them. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { PRESETS } from "../../samples/web/presets.js";
import { drop, open, page, root, shown, status, tmp, tool } from "./harness.mjs";

// The demo plate without tags.
export function bare() {
  const glb = readFileSync(join(page, "assets/plate_1d.glb"));
  const size = glb.readUInt32LE(12);
  const json = glb.toString("utf8", 20, 20 + size).replaceAll("knurl_", "other_");
  return Buffer.concat([glb.subarray(0, 20), Buffer.from(json), glb.subarray(20 + size)]);
}

const says = (tab, source) => tab.waitForFunction((text) => new RegExp(text).test(document.querySelector("#status").textContent), source);

async function clickMiddle(tab) {
  const box = await tab.locator("#view").boundingBox();
  await tab.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
}

export const cases = {
  async "a file without tags is shown; a click gives a part ridges that are felt and saved"() {
    const tab = await open();
    await drop(tab, bare(), "bare.glb");
    await says(tab, "^bare.glb: nothing is tagged yet");
    assert.equal(await tab.locator("#status.error").count(), 0);
    assert.ok(await tab.isDisabled("#tag"));
    await clickMiddle(tab);
    await says(tab, "^bare.glb: 1 surface to stroke");
    await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent)); // the hand moves over it
    await tab.evaluate(() => { document.querySelector("#more").open = true; });
    await tab.fill("#stiffness", "700");
    await tab.check('[name="method"][value="2"]');
    await tab.waitForFunction((name) => document.documentElement.dataset.surveyed === name, "bare.glb");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#tag")]);
    assert.equal(download.suggestedFilename(), "bare-tagged.glb");
    const saved = join(tmp, "bare-tagged.glb");
    await download.saveAs(saved);
    execFileSync(tool, ["inspect", saved, "--check"]);
    const { surfaces } = JSON.parse(execFileSync(tool, ["inspect", saved]));
    assert.deepEqual(surfaces.map(({ name }) => name), ["bar 1 mm"]);
    const { spatial_frequency: fs, amplitude, stiffness, method } = surfaces[0].material;
    assert.deepEqual([fs, amplitude, stiffness, method], [[1000, 0], 0.0002, 700, "S2"]);
    assert.equal(JSON.parse(await tab.textContent("#extras")).knurl.stiffness, 700);
    const [before, after] = [bare(), readFileSync(saved)].map((bytes) => bytes.subarray(20 + bytes.readUInt32LE(12)));
    assert.ok(before.equals(after), "all but the JSON is as it was, byte for byte");
  },

  async "without a mouse a part is chosen by its name"() {
    const tab = await open();
    await drop(tab, bare(), "bare.glb");
    await says(tab, "^bare.glb: nothing is tagged yet");
    await tab.selectOption("#part", { label: "bar 2 mm" });
    await tab.press("#give", "Enter");
    await says(tab, "^bare.glb: 1 surface to stroke");
    assert.deepEqual(await tab.locator("#surface option").allTextContents(), ["bar 2 mm"]);
  },

  async "a link to an own file says which, and sets it once it is opened"() {
    const tab = await open();
    await drop(tab, readFileSync(join(page, "assets/grid_2d.glb")), "mine.glb");
    await says(tab, "^mine.glb: ");
    await tab.fill("#fsx", "640");
    await tab.click("#share");
    await says(tab, "It needs mine.glb");
    const other = await open({ url: tab.url() });
    assert.match(await status(other), /^This link is of mine.glb/);
    await drop(other, readFileSync(join(page, "assets/grid_2d.glb")), "mine.glb");
    await other.waitForFunction(() => document.querySelector("#fsx").value === "640");
  },

  async "a link that is pasted into the open page is followed, and Back goes back"() {
    const tab = await open({ hash: "#hand=rests" });
    await tab.evaluate(() => { location.hash = "#preset=s1-plays-another-frequency"; });
    await says(tab, "to stroke$");
    await tab.waitForFunction(() => /Ridges crossed (89|90)\d, played (9|10)\d /.test(document.querySelector("#speed").textContent));
    assert.equal(await tab.$eval("#preset", ({ selectedOptions: [{ textContent }] }) => textContent), "S1 plays another frequency");
    await tab.goBack();
    await tab.waitForFunction(() => /force0.00/.test(document.querySelector("#numbers").textContent));
    assert.equal(await tab.inputValue("#preset"), "");
    assert.equal(await tab.textContent("#preset-text"), "");
  },

  async "docs/methods.md has a link to each failure that the page plays, and no other"() {
    const links = [...readFileSync(join(root, "docs/methods.md"), "utf8").matchAll(/^\[(\w+)\]: http:\/\/127\.0\.0\.1:8000\/#(.*)$/gm)];
    const presets = links.map(([, , hash]) => new URLSearchParams(hash).get("preset")).filter(Boolean);
    assert.deepEqual(presets.toSorted(), PRESETS.map(({ title }) => title.toLowerCase().replace(/[^a-z0-9]+/g, "-")).toSorted());
    const text = readFileSync(join(root, "docs/methods.md"), "utf8");
    links.forEach(([, name]) => assert.ok(text.includes(`][${name}]`), `${name} is used`));
    for (const [, , hash] of links.filter(([, , words]) => !words.startsWith("preset"))) {
      const tab = await open({ hash: `#${hash}` });
      for (const [id, value] of new URLSearchParams(hash)) {
        assert.equal(await tab.evaluate((name) => (name === "method" ? document.getElementById("controls").elements.method
          : document.getElementById(name)).value, id), value, hash);
      }
    }
  },

  async "a failure's link plays the same ticks in a fresh browser"() {
    const places = [];
    for (let i = 0; i < 2; i++) {
      const tab = await open({ hash: "#preset=s2-plays-other-cycles-than-are-crossed" });
      await tab.click("#record");
      await tab.waitForTimeout(4000); // so long that both are of the same ticks on a busy machine, too
      await tab.click("#record");
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#save")]);
      const lines = readFileSync(await download.path(), "utf8").trim().split("\n").slice(1).map((line) => line.split(","));
      places.push(new Map(lines.map((cells) => [cells[1], cells.slice(2, 14).join()]))); // x: all that was felt there
    }
    const both = [...places[0].keys()].filter((x) => places[1].has(x));
    const same = both.filter((x) => places[0].get(x) === places[1].get(x));
    console.log(`  ${both.length} places in both, ${same.length} with the same ticks`);
    assert.ok(both.length > 100 && same.length === both.length);
  },

  async "nothing moves by itself where that is not wanted"() {
    const tab = await open({ options: { viewport: { width: 800, height: 600 }, reducedMotion: "reduce" } });
    await tab.waitForTimeout(300);
    assert.equal(await shown(tab, "force"), "0.00 N");
    await tab.click("#ghost");
    await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
  },

  // MODELS=100 for a long run
  async "many models leave nothing behind"() {
    const more = Number(process.env.MODELS ?? 12) - 1;
    const tab = await open({ before: async (bare_) => {
      await bare_.addInitScript(() => {
        globalThis.held = { Buffer: 0, Texture: 0 };
        for (const kind of Object.keys(globalThis.held)) {
          for (const [act, change] of [["create", 1], ["delete", -1]]) {
            const real = WebGL2RenderingContext.prototype[act + kind];
            WebGL2RenderingContext.prototype[act + kind] = function (...rest) {
              globalThis.held[kind] += change;
              return real.apply(this, rest);
            };
          }
        }
      });
      await bare_.route("**/worker.js", async (route) => { // notes the memory of WebAssembly
        const answer = await route.fetch();
        await route.fulfill({ response: answer, body: `const { instantiate } = WebAssembly; WebAssembly.instantiate = async (...all) => {
          const made = await instantiate(...all);
          globalThis.wasm = Object.values(made.exports).find((part) => part instanceof WebAssembly.Memory);
          return made; };${await answer.text()}` });
      });
    } });
    const session = await tab.context().newCDPSession(tab);
    const load = async (name) => {
      await tab.evaluate(() => { delete document.documentElement.dataset.surveyed; });
      await drop(tab, readFileSync(join(page, "assets", name)), name);
      await tab.waitForSelector("html[data-surveyed]");
      await tab.waitForTimeout(50);
    };
    const held = async () => {
      await tab.waitForTimeout(200);
      await session.send("HeapProfiler.collectGarbage");
      const { usedSize } = await session.send("Runtime.getHeapUsage");
      return { ...await tab.evaluate(() => globalThis.held), heap: usedSize / 1e6, wasm: await tab.workers()[0].evaluate(() => globalThis.wasm.buffer.byteLength / 1e6) };
    };
    const names = ["grid_2d.glb", "knurled_handle.glb", "plate_1d.glb"];
    for (const name of [...names, ...names]) {
      await load(name);
    }
    const first = await held();
    for (let i = 0; i < more; i++) {
      await load(names[(i + 2 * more) % 3]); // the last one is the first's
    }
    const last = await held();
    const told = ({ Buffer: buffers, Texture, heap, wasm }) => `${buffers} buffers, ${Texture} textures, heap ${heap.toFixed(1)} MB, WebAssembly ${wasm.toFixed(1)} MB`;
    console.log(`  after 6 models: ${told(first)}; after ${6 + more}: ${told(last)}`);
    assert.deepEqual([last.Buffer, last.Texture, last.wasm], [first.Buffer, first.Texture, first.wasm]);
    assert.ok(last.heap < first.heap + 2, "the heap grows by less than 2 MB");
  },

  async "the sliders are those of the surface that is stroked, and its ridges follow"() {
    const tab = await open({ hash: "#hand=rests", options: { viewport: { width: 1280, height: 800 } } });
    await tab.waitForSelector("html[data-surveyed]");
    const box = await tab.locator("#view").boundingBox();
    await tab.mouse.move(box.x + box.width / 2, box.y + 0.68 * box.height);
    await tab.mouse.down();
    for (let i = 0; i < 20; i++) {
      await tab.mouse.move(box.x + box.width / 2 + 4 * i, box.y + 0.68 * box.height);
      await tab.waitForTimeout(10);
    }
    await tab.waitForFunction(() => document.querySelector("#surface").selectedOptions[0].textContent === "bar 2 mm");
    assert.equal(await tab.inputValue("#fsx"), "500");
    await tab.fill("#fsx", "300");
    await tab.mouse.move(box.x + box.width / 2, box.y + 0.68 * box.height, { steps: 40 });
    await tab.waitForTimeout(200);
    assert.equal(await tab.inputValue("#fsx"), "300", "the stroked surface has it now");
    assert.ok(parseFloat(await shown(tab, "cycles crossed")) > 3);
    await tab.mouse.up();
  },
};
