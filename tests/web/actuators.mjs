// Actuators of the page, with a gamepad that only notes its commands, and Chromium's fake sound outputs: nothing was
// tried with real ones. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { FLAGS, chromium, executablePath, open, port, recorded } from "./harness.mjs";

// In the page: a gamepad.
function plugIn() {
  globalThis.told = [];
  const vibrationActuator = { playEffect: async (kind, strengths) => { globalThis.told.push({ kind, ...strengths }); } };
  navigator.getGamepads = () => [null, { vibrationActuator }];
}

// In the page: notes the samples for an output's queue.
function listenIn() {
  globalThis.heard = [];
  globalThis.sinks = [];
  const { postMessage } = MessagePort.prototype;
  MessagePort.prototype.postMessage = function (data, ...rest) {
    if (data instanceof Float32Array) {
      globalThis.heard.push(...data);
    }
    return postMessage.call(this, data, ...rest);
  };
  const { setSinkId } = AudioContext.prototype;
  AudioContext.prototype.setSinkId = function (id) {
    globalThis.sinks.push(id);
    return setSinkId.call(this, id);
  };
}

const unfold = (tab) => tab.evaluate(() => { document.getElementById("feel").open = true; });
const deviation = (values) => {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
};

export const cases = {
  async "a gamepad's slow motor plays slow ridges, its fast one fast ridges, and neither a rest"() {
    const tab = await open({ before: (bare) => bare.addInitScript(plugIn) });
    await unfold(tab);
    await tab.click("#rumble");
    const strengths = async (fsx) => {
      await tab.fill("#fsx", fsx);
      await tab.waitForTimeout(800);
      await tab.evaluate(() => globalThis.told.splice(0));
      await tab.waitForTimeout(1000);
      const told = await tab.evaluate(() => globalThis.told);
      assert.ok(told.length >= 5 && told.length <= 25, `${told.length} commands a second`);
      assert.ok(told.every(({ kind, duration }) => kind === "dual-rumble" && duration >= 100));
      return ["strongMagnitude", "weakMagnitude"].map((key) => Math.max(...told.map((strength) => strength[key])));
    };
    const slow = await strengths("300"); // 36 Hz
    const fast = await strengths("2000"); // 240 Hz
    console.log(`  slow and fast motor: ${slow.map((part) => part.toFixed(3))} at 36 Hz, ${fast.map((part) => part.toFixed(3))} at 240 Hz`);
    assert.ok(slow[0] > 0.03 && slow[0] > slow[1]);
    assert.ok(fast[1] > 0.03 && fast[1] > 3 * fast[0]);
    await tab.click("#ghost");
    await tab.waitForTimeout(1000);
    const last = await tab.evaluate(() => globalThis.told.at(-1));
    assert.ok(last.strongMagnitude < 0.001 && last.weakMagnitude < 0.001);
  },

  async "the force is played on the sound output that is chosen"() {
    const other = await chromium.launch({ executablePath, args: [...FLAGS, "--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream"] });
    try {
      const tab = await (await other.newContext({ acceptDownloads: true })).newPage();
      await tab.addInitScript(listenIn);
      await tab.goto(`http://127.0.0.1:${port}/`);
      await tab.waitForSelector("html[data-ready]");
      await unfold(tab);
      await tab.click("#outputs");
      await tab.waitForFunction(() => document.getElementById("output").options.length > 2);
      const { value, label } = await tab.evaluate(() => {
        const { value: id, label: name } = [...document.getElementById("output").options].at(-1);
        return { value: id, label: name };
      });
      await tab.selectOption("#output", value);
      await tab.waitForFunction(() => globalThis.heard.length > 0);
      assert.deepEqual(await tab.evaluate(() => globalThis.sinks), [value]);
      await tab.waitForTimeout(1000);
      await tab.evaluate(() => globalThis.heard.splice(0));
      const rows = await recorded(tab, "coil.csv");
      const { heard, error } = await tab.evaluate(() => ({ heard: globalThis.heard, error: document.querySelector("#status.error")?.textContent }));
      assert.equal(error, undefined);
      const steady = rows.slice(-200).map(({ fy, fz }) => Math.hypot(fy, fz));
      const [force, played] = [deviation(steady), deviation(heard.slice(-9600))];
      console.log(`  on "${label}": ${heard.length} samples for ${rows.length} ticks; force ${force.toFixed(4)} N, played ${played.toFixed(4)}`);
      assert.ok(heard.length >= 48 * rows.length, `${heard.length} samples`);
      assert.ok(Math.abs(played / force - 1) < 0.1, "a sample is 1 for a newton");
      await tab.selectOption("#output", "");
      await tab.waitForTimeout(200);
      const count = await tab.evaluate(() => globalThis.heard.length);
      await tab.waitForTimeout(300);
      assert.equal(await tab.evaluate(() => globalThis.heard.length), count, "silent");
    } finally {
      await other.close();
    }
  },
};
