// The blind comparison of two methods. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { join } from "node:path";
import { open, root, status } from "./harness.mjs";

const TRIALS = 16;

export const cases = {
  async "a blind comparison hides which method is which, and counts what is preferred"() {
    const tab = await open();
    await tab.evaluate(() => { document.getElementById("blind").open = true; });
    await tab.selectOption("#blind-other", "1");
    await tab.click("#blind-begin");
    assert.match(await status(tab), /two different/);
    await tab.selectOption("#blind-other", "2");
    await tab.click("#blind-begin");
    const telling = await tab.locator("#methods, #scope, #gauge, #preset, #extras, #share").evaluateAll((all) =>
      all.filter((part) => part.checkVisibility()).map(({ id }) => id));
    assert.deepEqual(telling, [], "told meanwhile");
    assert.doesNotMatch(await tab.evaluate(() => document.body.innerText.replace(/One method[^]*?bandlimited[^]*?bandlimited/, "")), /S1|S2|false tones/);
    const played = () => tab.evaluate(() => document.getElementById("controls").elements.method.value);
    const first = [];
    for (let i = 0; i < TRIALS; i++) { // whoever chooses prefers S1, except in the first trial
      first.push(await played());
      const isA = (first.at(-1) === "1") === (i > 0);
      await tab.focus("#view");
      await tab.keyboard.press("b");
      assert.notEqual(await played(), first.at(-1), "B is the other one");
      await tab.keyboard.press("1"); // a method's key
      assert.notEqual(await played(), first.at(-1));
      await tab.click(isA ? "#prefer-a" : "#prefer-b");
      assert.match(await tab.textContent("#blind-count"), new RegExp(`^Trial ${i + 2}:`));
    }
    assert.deepEqual([...new Set(first)].sort(), ["1", "2"], "either comes first");
    await tab.click("#blind-begin");
    const lines = (await tab.textContent("#blind-result")).split("\n");
    assert.equal(lines[0], `Preferred: S1 ${TRIALS - 1}, S2 1, of ${TRIALS} trials.`);
    assert.match(lines[1], /probability 0\.00052\./); // 2 (1 + 16) / 2^16
    assert.match(lines[2], /^plate_1d\.glb, bar 1 mm: 1000 and 0 ridges\/m, 0\.2 mm, 400 N\/m, friction 0, 1000 Hz$/);
    const rows = lines.slice(5).map((line) => line.split(","));
    assert.deepEqual(rows.map(([, a]) => a), first.map((number) => `S${number}`));
    assert.deepEqual(rows.map(([, , , preferred]) => preferred), ["S2", ...Array(TRIALS - 1).fill("S1")]);
    await tab.click("#blind-copy");
    await tab.waitForFunction(() => /^The result is/.test(document.querySelector("#status").textContent));
    assert.ok(await tab.isChecked('[name="method"][value="3"]'), "the method before");
    assert.ok(await tab.isVisible("#methods"));
  },

  async "a blind comparison ends when another scene is opened, with the result so far"() {
    const tab = await open();
    await tab.evaluate(() => { document.getElementById("blind").open = true; });
    await tab.click("#blind-begin");
    await tab.click("#prefer-a");
    await tab.setInputFiles("#file", join(root, "assets/grid_2d.glb"));
    await tab.waitForFunction(() => /comparison ended/.test(document.querySelector("#status").textContent));
    const lines = (await tab.textContent("#blind-result")).split("\n");
    assert.match(lines[0], /of 1 trials\.$/);
    assert.match(lines[2], /^plate_1d\.glb, bar 1 mm:/);
    assert.ok(await tab.isVisible("#methods"));
  },

  async "the probability is the binomial test's"() {
    globalThis.document ??= { querySelectorAll: () => [] }; // its module's other half is for a page
    const { chance } = await import(join(root, "samples/web/blind.js"));
    for (const [one, other, wanted] of [[5, 5, 1], [0, 0, 1], [10, 0, 2 / 1024], [3, 9, 2 * (1 + 12 + 66 + 220) / 4096], [60, 40, 0.0568879]]) {
      assert.ok(Math.abs(chance(one, other) - wanted) < 1e-6, `${one}, ${other}: ${chance(one, other)}`);
    }
  },
};
