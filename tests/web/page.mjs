// The page's features: strokes, keys, links, the failures' catalogue, tags; accessible without sight or a mouse.
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { drop, modules, open, page, recorded, shown, status, strokeAcross, tmp } from "./harness.mjs";

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

// The colours along a row of an element as it is on the screen, each as "red,green,blue".
async function pixels(tab, selector, share) {
  const shot = await tab.locator(selector).screenshot();
  return tab.evaluate(async ([bytes, at]) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(bytes)]));
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, Math.floor(at * (image.height - 1)), image.width, 1);
    return Array.from({ length: image.width }, (_, x) => data.slice(4 * x, 4 * x + 3).join());
  }, [[...shot], share]);
}

// Opens folded parts.
const unfold = (tab) => tab.evaluate(() => document.querySelectorAll("details").forEach((part) => { part.open = true; }));

// A failure of the catalogue, and waits until it is stroked.
async function choose(tab, label) {
  await tab.selectOption("#preset", { label });
  await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
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
    assert.equal(await shown(tab, "net height"), "0.000 mm", "at rest nothing pushes");
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
    const values = await tab.evaluate(() => ["model", "fsx", "stiffness"].map((id) => document.getElementById(id).value));
    assert.deepEqual(values, ["grid_2d.glb", "700", "600"]);
    assert.ok(await tab.isChecked('[name="method"][value="1"]'));
  },

  async "a link that is copied holds every setting"() {
    const tab = await open({ hash: "#hand=rests" });
    await unfold(tab);
    const chosen = { model: "grid_2d.glb", fsx: "350", fsy: "70", amplitude: "0.13", stiffness: "610", friction: "0.35",
      depth: "1.7", exaggeration: "9", rate: "4000", resolution: "0.0002" };
    for (const [id, value] of Object.entries(chosen)) {
      const isList = await tab.evaluate((name) => document.getElementById(name).tagName === "SELECT", id);
      await (isList ? tab.selectOption(`#${id}`, value) : tab.fill(`#${id}`, value));
      await tab.waitForFunction(() => document.querySelector("#status").textContent.endsWith("to stroke"));
    }
    await tab.check('[name="method"][value="2"]');
    await tab.click("#share");
    await tab.waitForFunction(() => /^The link is/.test(document.querySelector("#status").textContent));
    const other = await open({ url: tab.url() });
    assert.ok(await other.isChecked('[name="method"][value="2"]'));
    const values = await other.evaluate((ids) => ids.map((id) => [id, document.getElementById(id).value]), Object.keys(chosen));
    assert.deepEqual(Object.fromEntries(values), chosen);
  },

  async "the lens shows the ridges in true scale, however the view is turned"() {
    const tab = await open();
    await choose(tab, "S1 pushes");
    await tab.waitForSelector("html[data-surveyed]");
    for (const [fsx, cycles] of [["500", 3], ["1000", 6]]) { // the lens is 6 mm wide
      await tab.fill("#fsx", fsx);
      await tab.waitForTimeout(300);
      const [dark, light] = [await pixels(tab, "#lens", 0.45), await pixels(tab, "#lens", 0.55)].map((row) => {
        const red = row.slice(6, -6).map((colour) => Number(colour.split(",")[0]));
        const middle = (Math.max(...red) + Math.min(...red)) / 2;
        return red.filter((value, x) => x > 0 && value > middle !== red[x - 1] > middle).length;
      });
      const wanted = 2 * cycles * (100 / 112); // 6 pixels to each side are left out
      assert.ok(Math.abs(dark - wanted) <= 1.5 && Math.abs(light - wanted) <= 1.5, `${dark} and ${light} edges for ${cycles} cycles`);
    }
    await tab.focus("#view");
    for (let i = 0; i < 12; i++) { // a quarter turn
      await tab.keyboard.press("Shift+ArrowRight");
    }
    await tab.waitForTimeout(300);
    const row = (await pixels(tab, "#lens", 0.4)).slice(30, -30);
    const reds = row.map((colour) => Number(colour.split(",")[0]));
    assert.ok(Math.max(...reds) - Math.min(...reds) < 60, "ridges lie across now: a row is of one colour");
  },

  async "the highest line of the chosen method's spectrum is at f_t"() {
    const tab = await open();
    await choose(tab, "S1 pushes"); // 333 of 520 Hz
    await tab.waitForTimeout(1500);
    const card = "#methods label:nth-of-type(1) canvas";
    const row = await pixels(tab, card, 0.25);
    const paper = row[2];
    const highest = row.map((colour, x) => (colour === paper ? -1 : x / row.length)).filter((share) => share >= 0);
    assert.ok(highest.length > 0 && highest.every((share) => Math.abs(share - 333 / 520) < 0.03), highest.join());
  },

  async "the encoder rounds positions, and ticks come at the update rate"() {
    const tab = await open();
    await unfold(tab);
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
    await unfold(tab);
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

  async "sound can be switched on and off"() {
    const tab = await open();
    for (const on of ["true", "false"]) {
      await tab.click("#sound");
      await tab.waitForSelector(`#sound[aria-pressed="${on}"]`);
    }
  },

  async "by keyboard alone every control is reached, seen to be, and has a name, a role and a value"() {
    const tab = await open();
    await unfold(tab);
    const session = await tab.context().newCDPSession(tab);
    const wanted = await tab.evaluate(() => [...document.querySelectorAll("canvas[tabindex], select, input, button, summary, pre")]
      .filter((e) => !e.disabled && e.checkVisibility() && (e.type !== "radio" || e.checked)).map((e) => e.id || e.name || e.textContent));
    const [reached, walk] = [[], []];
    for (let i = 0; i < wanted.length; i++) {
      await tab.keyboard.press("Tab");
      const { result } = await session.send("Runtime.evaluate", { expression: "document.activeElement" });
      const { nodes: [{ name, role, value, properties }] } = await session.send("Accessibility.getPartialAXTree",
        { objectId: result.objectId, fetchRelatives: false });
      const [id, outline, kind] = await tab.evaluate(() => [document.activeElement.id || document.activeElement.name ||
        document.activeElement.textContent, getComputedStyle(document.activeElement).outlineStyle, document.activeElement.type]);
      const state = (key) => properties.find((one) => one.name === key)?.value.value;
      const said = state("valuetext") || value?.value || state("pressed") || state("checked") || (state("expanded") === undefined ? "" : `expanded ${state("expanded")}`);
      reached.push(id);
      walk.push(`${role.value}: ${name.value}${said === "" ? "" : ` = ${said}`}`);
      assert.notEqual(outline, "none", `${id} has no outline`);
      assert.ok(name.value && role.value !== "generic", `${id}: ${role.value}, ${name.value}`);
      assert.ok(!["range", "radio", "select-one"].includes(kind) || said !== "", `${id} has no value`);
      if (kind === "range") { // it moves by a key, and says so
        const before = await tab.getAttribute(`#${id}`, "aria-valuetext");
        await tab.keyboard.press(await tab.evaluate(() => document.activeElement.value === document.activeElement.max) ? "ArrowLeft" : "ArrowRight");
        assert.notEqual(await tab.getAttribute(`#${id}`, "aria-valuetext"), before, id);
      }
    }
    writeFileSync(join(tmp, "walk.txt"), `${walk.join("\n")}\n`);
    assert.deepEqual(reached, wanted);
    assert.ok(wanted.length >= 60, `${wanted.length} controls`);
  },

  async "every control has a name, a role and a value, and a target of 24 px"() {
    const tab = await open({ options: PHONE });
    await unfold(tab);
    const session = await tab.context().newCDPSession(tab);
    const { nodes } = await session.send("Accessibility.getFullAXTree");
    const controls = nodes.filter(({ ignored, role }) => !ignored && /^(button|slider|radio|combobox|meter)$/i.test(role?.value));
    const nameless = controls.filter(({ name }) => !name?.value);
    assert.deepEqual(nameless.map(({ role }) => role.value), []);
    const sliders = controls.filter(({ role }) => role.value === "slider");
    assert.deepEqual(sliders.map(({ name }) => name.value), ["Ridges", "Ridges along y", "Amplitude", "Stiffness", "Friction", "Depth",
      "Exaggeration"]);
    assert.ok(sliders.every(({ properties }) => properties.some(({ name, value }) => name === "valuetext" && value.value)));
    assert.equal(controls.find(({ role }) => role.value === "meter").name.value, "Ridges a second");
    const small = await tab.evaluate(() => [...document.querySelectorAll("select, input, button, summary, #methods label")]
      .filter((part) => part.checkVisibility()).map((part) => [part.id || part.name, part.getBoundingClientRect()])
      .filter(([, { width, height }]) => width < 24 || height < 24).map(([id]) => id));
    assert.deepEqual(small.filter((id) => id !== "method"), [], "smaller than 24 px"); // a method's label is its target
  },

  async "axe finds nothing, in light and dark"() {
    for (const colorScheme of ["light", "dark"]) {
      const tab = await open({ options: { viewport: { width: 1280, height: 860 }, colorScheme } });
      await unfold(tab);
      await tab.evaluate(readFileSync(join(modules, "axe-core/axe.min.js"), "utf8"));
      const { violations, passes } = await tab.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
      assert.ok(passes.length > 15, `${passes.length} rules`);
    }
  },

  async "a swatch gives the surface a material's own numbers and tells their sources"() {
    const tab = await open();
    const materials = JSON.parse(readFileSync(new URL("../../assets/materials.json", import.meta.url), "utf8")).materials;
    const labels = await tab.locator("#materials button").evaluateAll((all) => all.map((swatch) => swatch.textContent));
    assert.deepEqual(labels, materials.map(({ title }) => title));
    for (const { title, tag, period, depth } of materials.filter((_, i) => i % 5 === 0)) {
      await tab.click(`#materials button:text-is("${title}")`);
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
    await tab.check('[name="method"][value="3"]');
    await tab.waitForTimeout(300);
    const bandlimited = await greatest(tab, "net height");
    console.log(`  net height: S1 ${s1} mm, bandlimited ${bandlimited} mm, of 0.2`);
    assert.ok(Math.abs(s1 - 0.2 / 3) < 0.007);
    assert.ok(bandlimited < 0.03);
  },

  async "S2 plays a sixth more cycles than are crossed just below 3.5 ticks"() {
    const tab = await open({ hash: "#hand=rests" }); // so that no other cycles are counted
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

  async "each failure has two sentences, and strokes; after it the settings are those before"() {
    const tab = await open();
    await tab.fill("#fsx", "770");
    const count = await tab.locator("#preset option").count();
    assert.equal(count, 9);
    for (let i = 0; i < count - 1; i++) {
      await tab.selectOption("#preset", String(i));
      await tab.waitForFunction(() => document.querySelector("#status").textContent.endsWith("to stroke"));
      await tab.waitForFunction(() => !/force0.00/.test(document.querySelector("#numbers").textContent));
      assert.match(await tab.textContent("#preset-text"), /^[^]+\. [^]+\.$/);
    }
    await tab.selectOption("#preset", "");
    await tab.waitForFunction(() => document.querySelector("#fsx").value === "770");
    const values = await tab.evaluate(() => ["resolution", "rate", "depth"].map((id) => document.getElementById(id).value));
    assert.deepEqual(values, ["0", "1000", "1"]);
    assert.ok(await tab.isChecked('[name="method"][value="3"]'));
    assert.equal(await tab.textContent("#preset-text"), "");
  },

};
