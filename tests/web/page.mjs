// The page's features: strokes, keys, links, the failures' catalogue, tags; accessible without sight or a mouse.
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { drop, modules, open, page, shown, status, strokeAcross, tmp, tool } from "./harness.mjs";

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, colorScheme: "dark" };

// The greatest of a number that is shown, over a second.
async function greatest(tab, key) {
  let most = 0;
  for (let i = 0; i < 20; i++) {
    most = Math.max(most, Math.abs(parseFloat(await shown(tab, key))));
    await tab.waitForTimeout(50);
  }
  return most;
}

// The colour of a canvas at a position, as a word.
function pixels(tab, id, row) {
  return tab.evaluate(([name, share]) => {
    const canvas = document.getElementById(name);
    const y = Math.floor(share * (canvas.height - 1));
    const { data } = canvas.getContext("2d").getImageData(0, y, canvas.width, 1);
    return Array.from({ length: canvas.width }, (_, x) => data.slice(4 * x, 4 * x + 4).join());
  }, [id, row]);
}

// A failure of the catalogue, and waits until it is stroked.
async function choose(tab, label) {
  await tab.selectOption("#preset", { label });
  await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
}

// A preset's stroke as the page records it: the CSV file's rows by column.
async function recorded(tab, name) {
  await tab.click("#record");
  await tab.waitForTimeout(500);
  await tab.click("#record");
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#save")]);
  await download.saveAs(join(tmp, name));
  const [header, ...lines] = readFileSync(join(tmp, name), "utf8").trim().split("\n");
  const names = header.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((cell, i) => [names[i], Number(cell)])));
}

export const cases = {
  async "a stroke by the pointer crosses ridges and pushes back"() {
    const tab = await open({ options: { viewport: { width: 1280, height: 860 } } });
    assert.match(await status(tab), /plate_1d.glb: 3 surfaces/);
    await strokeAcross(tab);
    await strokeAcross(tab);
    await tab.waitForTimeout(100);
    assert.ok(parseFloat(await shown(tab, "force")) > 0.05);
    assert.ok(parseFloat(await shown(tab, "cycles crossed")) > 5);
    await tab.screenshot({ path: join(tmp, "desktop.png") });
    await tab.mouse.up();
    await tab.waitForFunction(() => /0.00 N/.test(document.querySelector("#numbers").textContent));
  },

  async "each demo asset can be dropped"() {
    const tab = await open();
    for (const name of ["grid_2d.glb", "knurled_handle.glb", "plate_1d.glb"]) {
      await drop(tab, readFileSync(join(page, "assets", name)), name);
      await tab.waitForFunction((label) => document.querySelector("#status").textContent.startsWith(label), name);
      assert.match(await status(tab), /to stroke$/);
    }
  },

  async "arrow keys stroke"() {
    const tab = await open();
    await tab.focus("#view");
    for (let i = 0; i < 20; i++) {
      await tab.keyboard.press("ArrowRight", { delay: 10 });
    }
    await tab.waitForTimeout(200);
    assert.ok(parseFloat(await shown(tab, "cycles crossed")) > 5);
  },

  async "the page fits a phone, in the dark"() {
    const tab = await open({ options: PHONE });
    const box = await tab.locator("#view").boundingBox();
    await tab.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
    assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await tab.screenshot({ path: join(tmp, "phone.png"), fullPage: true });
  },

  async "a link holds the settings"() {
    const tab = await open({ hash: "#model=grid_2d.glb&method=1&fsx=700&stiffness=600" });
    assert.match(await status(tab), /grid_2d/);
    const values = await tab.evaluate(() => ["model", "method", "fsx", "stiffness"].map((id) => document.getElementById(id).value));
    assert.deepEqual(values, ["grid_2d.glb", "1", "700", "600"]);
  },

  async "a link that is copied holds every setting"() {
    const tab = await open();
    const chosen = { model: "grid_2d.glb", method: "2", fsx: "350", fsy: "70", amplitude: "0.13", stiffness: "610", friction: "0.35",
      depth: "1.7", exaggeration: "9", rate: "4000", resolution: "0.0002" };
    for (const [id, value] of Object.entries(chosen)) {
      const isList = await tab.evaluate((name) => document.getElementById(name).tagName === "SELECT", id);
      await (isList ? tab.selectOption(`#${id}`, value) : tab.fill(`#${id}`, value));
      await tab.waitForFunction(() => document.querySelector("#status").textContent.endsWith("to stroke"));
    }
    await tab.click("#share");
    await tab.waitForFunction(() => /^The link is/.test(document.querySelector("#status").textContent));
    const other = await open({ url: tab.url() });
    const values = await other.evaluate((ids) => ids.map((id) => [id, document.getElementById(id).value]), Object.keys(chosen));
    assert.deepEqual(Object.fromEntries(values), chosen);
  },

  async "the lens shows the ridges in true scale"() {
    const tab = await open();
    await choose(tab, "S1 pushes");
    for (const [fsx, cycles] of [["500", 3], ["1000", 6]]) { // the lens is 6 mm wide
      await tab.fill("#fsx", fsx);
      await tab.waitForTimeout(300);
      const row = await pixels(tab, "lens", 0.2);
      const changes = row.filter((colour, x) => x > 0 && colour !== row[x - 1]).length;
      assert.ok(Math.abs(changes - 2 * cycles) <= 1, `${changes} edges for ${cycles} cycles`);
    }
  },

  async "the spectrum's highest line is at f_t"() {
    const tab = await open();
    await choose(tab, "S1 pushes"); // 333 of 500 Hz
    await tab.waitForTimeout(1500);
    const highest = (await pixels(tab, "spectrum", 0.3)).map((colour, x, row) => (colour.endsWith(",0") ? -1 : x / row.length))
      .filter((share) => share >= 0.2);
    assert.ok(highest.length > 0 && highest.every((share) => Math.abs(share - 2 / 3) < 0.01), highest.join());
  },

  async "the encoder rounds positions, and ticks come at the update rate"() {
    const tab = await open();
    await choose(tab, "S1 pushes");
    await tab.selectOption("#resolution", "0.0002");
    await tab.selectOption("#rate", "4000");
    const rows = await recorded(tab, "encoder.csv");
    const counts = rows.map(({ x }) => x / 0.0002);
    assert.ok(counts.every((count) => Math.abs(count - Math.round(count)) < 1e-6));
    assert.ok(new Set(counts.map(Math.round)).size > 100);
    rows.slice(1).forEach(({ t }, k) => assert.ok(Math.abs(t - rows[k].t - 1 / 4000) < 1e-9));
  },

  async "friction, stiffness and amplitude are felt as they are set"() {
    const tab = await open();
    await choose(tab, "S1 pushes");
    for (const [id, value] of [["fsx", "0"], ["amplitude", "0"], ["stiffness", "500"], ["friction", "0.5"], ["depth", "1"]]) {
      await tab.fill(`#${id}`, value);
    }
    await tab.waitForTimeout(200);
    const rows = (await recorded(tab, "friction.csv")).filter(({ vx }) => Math.abs(vx) > 0.1).slice(50);
    const normal = rows.map(({ fy }) => fy);
    const along = rows.map(({ fx, fz }) => Math.hypot(fx, fz));
    assert.ok(normal.every((force) => Math.abs(force - 0.5) < 1e-3), `500 N/m at 1 mm: ${Math.max(...normal)} N`);
    assert.ok(Math.abs(Math.max(...along) - 0.25) < 1e-3, `friction ${Math.max(...along)} N`);
  },

  async "sound can be switched on and is played"() {
    const tab = await open();
    await tab.check("#sound");
    await strokeAcross(tab);
    await tab.mouse.up();
    assert.ok(await tab.isChecked("#sound"));
  },

  async "every control is reached by the tabulator, and seen to be"() {
    const tab = await open();
    const wanted = await tab.evaluate(() => [...document.querySelectorAll("canvas[tabindex], select, input, button, summary")]
      .filter((e) => !e.disabled && e.checkVisibility()).map((e) => e.id || e.tagName));
    const reached = [];
    for (let i = 0; i < wanted.length; i++) {
      await tab.keyboard.press("Tab");
      const [id, outline] = await tab.evaluate(() => [document.activeElement.id || document.activeElement.tagName,
        getComputedStyle(document.activeElement).outlineStyle]);
      reached.push(id);
      assert.notEqual(outline, "none", `${id} has no outline`);
    }
    assert.deepEqual(reached, wanted);
    assert.ok(wanted.length >= 19, `${wanted.length} controls`);
  },

  async "axe finds nothing, in light and dark"() {
    for (const colorScheme of ["light", "dark"]) {
      const tab = await open({ options: { viewport: { width: 1280, height: 860 }, colorScheme } });
      await tab.click("summary");
      await tab.evaluate(readFileSync(join(modules, "axe-core/axe.min.js"), "utf8"));
      const { violations, passes } = await tab.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
      assert.ok(passes.length > 15, `${passes.length} rules`);
    }
  },

  async "a swatch gives the surface a material's own numbers and tells their sources"() {
    const tab = await open();
    const materials = JSON.parse(readFileSync(new URL("../../assets/materials.json", import.meta.url), "utf8")).materials;
    const labels = await tab.locator("#materials button").evaluateAll((all) => all.map((swatch) => swatch.getAttribute("aria-label")));
    assert.deepEqual(labels, materials.map(({ title }) => title));
    for (const { title, tag, period, depth } of materials.filter((_, i) => i % 5 === 0)) {
      await tab.click(`#materials button[aria-label="${title}"]`);
      await tab.waitForFunction((words) => document.getElementById("material-text").textContent.startsWith(words), title);
      assert.ok((await tab.textContent("#material-text")).includes(`Period: ${period}. Depth: ${depth}.`));
      const { knurl } = JSON.parse(await tab.textContent("#extras"));
      const close = (a, b) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.abs(b), `${title}: ${a}, not ${b}`);
      tag.spatial_frequency.forEach((value, i) => close(knurl.spatial_frequency[i], value));
      ["amplitude", "stiffness", "friction"].forEach((key) => close(knurl[key], tag[key]));
    }
    await tab.focus("#friction");
    await tab.keyboard.press("ArrowRight"); // steps again
    assert.match(await tab.inputValue("#friction"), /^0\.\d5?$/);
  },

  async "S1 pushes by a third of the amplitude at 333 Hz, and bandlimited does not"() {
    const tab = await open();
    await tab.selectOption("#preset", { label: "S1 pushes" });
    await tab.waitForTimeout(300);
    const s1 = await greatest(tab, "net height");
    const needle = Math.abs(parseFloat((await tab.textContent("#net-force")).replace("net ", "")));
    assert.ok(Math.abs(needle - (400 * 0.0002) / 3) < 0.004, `the needle is at ${needle} N`);
    await tab.selectOption("#method", "3");
    await tab.waitForTimeout(300);
    const bandlimited = await greatest(tab, "net height");
    console.log(`  net height: S1 ${s1} mm, bandlimited ${bandlimited} mm, of 0.2`);
    assert.ok(Math.abs(s1 - 0.2 / 3) < 0.007);
    assert.ok(bandlimited < 0.03);
  },

  async "S2 plays a sixth more cycles than are crossed just below 3.5 ticks"() {
    const tab = await open();
    await tab.selectOption("#preset", { label: "S2 plays other cycles than are crossed" });
    const counts = await tab.waitForFunction(() => { // however long a busy machine takes for them
      const [crossed, played] = ["cycles crossed", "played"].map((key) => parseFloat([...document.querySelectorAll("#numbers div")]
        .find((row) => row.children[0].textContent === key)?.children[1].textContent));
      return crossed > 300 && [crossed, played];
    });
    const [crossed, played] = await counts.jsonValue();
    console.log(`  played ${played} of ${crossed}`);
    assert.ok(Math.abs(played / crossed - 3.5 / 3) < 0.03);
  },

  async "each failure has two sentences, and strokes"() {
    const tab = await open();
    const count = await tab.locator("#preset option").count();
    assert.equal(count, 9);
    for (let i = 0; i < count - 1; i++) {
      await tab.selectOption("#preset", String(i));
      await tab.waitForFunction(() => document.querySelector("#status").textContent.endsWith("to stroke"));
      await tab.waitForFunction(() => !/force0.00/.test(document.querySelector("#numbers").textContent));
      assert.match(await tab.textContent("#preset-text"), /^[^]+\. [^]+\.$/);
    }
    await tab.selectOption("#preset", "");
    await tab.waitForFunction(() => /force0.00/.test(document.querySelector("#numbers").textContent));
  },

  async "a file without tags can be given one, which the tool reads"() {
    const tab = await open();
    const glb = readFileSync(join(page, "assets/plate_1d.glb"));
    const size = glb.readUInt32LE(12);
    const json = glb.toString("utf8", 20, 20 + size).replaceAll("knurl_", "other_");
    const bare = Buffer.concat([glb.subarray(0, 20), Buffer.from(json), glb.subarray(20 + size)]);
    await drop(tab, bare, "bare.glb");
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /^bare.glb: nothing is tagged.*below$/);
    await tab.click("summary");
    await tab.selectOption("#node", { label: "bar 2 mm" });
    await tab.fill("#stiffness", "700");
    await tab.selectOption("#method", "2");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#tag")]);
    assert.equal(download.suggestedFilename(), "bare-tagged.glb");
    await download.saveAs(join(tmp, "tagged.glb"));
    assert.match(await status(tab), /'bar 2 mm' is tagged/);
    const { surfaces } = JSON.parse(execFileSync(tool, ["inspect", join(tmp, "tagged.glb")]));
    assert.deepEqual(surfaces.map(({ name }) => name), ["bar 2 mm"]);
    const { spatial_frequency: fs, amplitude, stiffness, method } = surfaces[0].material;
    assert.deepEqual([fs, amplitude, stiffness, method], [[1000, 0], 0.0002, 700, "S2"]);
    assert.equal(JSON.parse(await tab.textContent("#extras")).knurl.stiffness, 700);
  },
};
