// An Inverse3 from the page: its messages beside a simulated clock, and the page with an emulated service of its maker.
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { dirname, join } from "node:path";
import { FLAGS, chromium, drop, executablePath, forgive, open, port, root, shown, status, tool, withoutWebGL } from "./harness.mjs";

const MOST_N = 3.3; // of an Inverse3, for long
const FAULT_S = 0.8; // after the connection
const COLUMNS = ["t", "messages", "force", "greatest", "rise", "whileOff", "zeroSince"];

// Runs use(port, log) with an emulated service; log(): its last line.
async function withService(fault, use) {
  const emulator = join(dirname(tool), "tests/emulate_inverse3");
  const child = spawn(emulator, [fault, "sh", "-c", "echo PORT; cat >/dev/null"], { env: { ...process.env, KNURL_EMULATOR_LOG: "1" } });
  let last = {};
  child.stderr.on("data", (lines) => {
    const numbers = String(lines).trim().split("\n").at(-1).split(" ").map(Number);
    last = Object.fromEntries(COLUMNS.map((name, i) => [name, numbers[i]]));
  });
  const at = await new Promise((resolve) => child.stdout.once("data", (text) => resolve(Number(text))));
  try {
    await use(at, () => last);
  } finally {
    child.stdin.end();
  }
}

// The page without WebGL, which a computer without a graphics processor draws slowly, connected to the service.
async function connect(at) {
  const tab = await open({ hash: `#inverse3=${at}`, before: withoutWebGL });
  forgive(/WebGL/); // three.js' own
  await tab.evaluate(() => { document.getElementById("feel").open = true; });
  await tab.click("#inverse3");
  return tab;
}

async function until(is, what, ms = 20000) {
  for (const end = Date.now() + ms; !is(); ) {
    assert.ok(Date.now() < end, `${what} within ${ms} ms`);
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function staysAt0(log, what) {
  await until(() => log().zeroSince >= 0, what);
  for (let i = 0; i < 10; i++) {
    assert.equal(log().force, 0, what);
    await pause(30);
  }
}

// --- the client alone ---

const hello = (change = {}) => ({ inverse3: [{ device_id: "049D", config: { type: "inverse3", preset: "defaults" }, state: { cursor_position: { x: 0, y: 0, z: 0 } }, ...change }] });
const answer = (y, change = {}) => ({ inverse3: [{ device_id: "049D", state: { cursor_position: { x: 0, y: 0, z: y } }, ...change }] });

// The client with a wall of 1 N along y, on a simulated clock.
async function client(use) {
  const { Inverse3 } = await import(join(root, "samples/web/inverse3.js"));
  const kept = { WebSocket: globalThis.WebSocket, performance: globalThis.performance, setInterval: globalThis.setInterval };
  const sim = { now: 1000, sent: [], events: [], timers: [] };
  globalThis.WebSocket = class {
    constructor() { sim.socket = this; }
    send(text) { sim.sent.push(JSON.parse(text).inverse3[0]); }
    close() { sim.isClosed = true; }
  };
  globalThis.performance = { now: () => sim.now };
  globalThis.setInterval = (run) => sim.timers.push(run);
  sim.force = () => sim.sent.at(-1).commands.set_cursor_force.vector;
  sim.say = (message, ms = 0.25) => {
    sim.now += ms;
    sim.socket.onmessage({ data: typeof message === "string" ? message : JSON.stringify(message) });
  };
  const told = (name) => (...values) => { sim.events.push([name, ...values]); };
  const host = { rate: 1000, wall: 1, ticks: [], tick: (places, gain) => { host.ticks.push(places); return [0, gain * host.wall, 0]; },
    begin: told("begin"), rest: told("rest"), trouble: told("trouble"), numbers: told("numbers"), end: told("end") };
  try {
    sim.client = new Inverse3(10001, host);
    sim.socket.onopen();
    use(sim, host); // at once: the other cases have the real clock
  } finally {
    Object.assign(globalThis, kept);
  }
}

function begin(sim) {
  sim.say(hello());
  for (let i = 0; i < 200; i++) {
    sim.say(answer(0.001 * i));
  }
}

export const cases = {
  "an Inverse3's session is set up, its force ramps up over 20 ms, and ticks are even in time": () => client((sim, host) => {
    sim.say(hello());
    assert.deepEqual(sim.sent[0].configure, { preset: { preset: "arm_front_centered" }, damping: { scalar: 0 } });
    const rise = [];
    for (let i = 0; i < 200; i++) {
      sim.say(answer(0.001 * i));
      rise.push(sim.force().z);
    }
    assert.equal(sim.sent.length, 201);
    assert.ok(rise[9] < 0.15 && rise[40] > 0.4 && rise[40] < 0.6 && rise.at(-1) === 1, `${rise[9]} ${rise[40]}`);
    const heights = host.ticks.map(([, y]) => y);
    assert.equal(heights.length, 49, "a tick a millisecond");
    assert.ok(heights.slice(1).every((y, i) => Math.abs(y - heights[i] - 0.004) < 1e-9), "4 mm each");
  }),

  "each fault of an Inverse3's messages takes the force away at once, and it ramps up again": () => client((sim, host) => {
    begin(sim);
    const faults = { "not JSON": "{", "no object": "7", "too long": JSON.stringify(answer(0.5)) + " ".repeat(65537), "no devices": { inverse3: [] }, "another": answer(0, { device_id: "0A11" }),
      "no number": answer(null), "a text": answer("0.5"), "no device": { inverse3: [null, { device_id: 7 }] },
      "endless": JSON.stringify(answer(0.5)).replace("0.5", "1e999"),
      "unpowered": answer(0, { status: { power_supply: false } }), "uncalibrated": answer(0, { status: { calibrated: false } }),
      "not ready": answer(0, { status: { ready: false } }), "unpowered, as a text": answer(0, { status: { power_supply: "false" } }) };
    for (const [name, message] of Object.entries(faults)) {
      const before = sim.sent.length;
      sim.say(message);
      assert.deepEqual(sim.force(), { x: 0, y: 0, z: 0 }, name);
      assert.equal(sim.sent.length, before + 1, `${name}: one answer, one message`);
      for (let i = 0; i < 8; i++) {
        sim.say(answer(0.001 * i));
      }
      assert.ok(sim.force().z < 0.1, `${name}: ramps`);
      for (let i = 0; i < 120; i++) {
        sim.say(answer(0.001 * i));
      }
      assert.equal(sim.force().z, 1, name);
    }
    const troubles = sim.events.filter(([name]) => name === "trouble").map(([, why]) => why.split(":")[0]);
    assert.deepEqual(troubles, ["its power supply is unplugged", "", "it is not calibrated", "", "it is not ready", "",
      "its power supply is unplugged", ""]);
    host.wall = 3.4; // more than it may play
    sim.say(answer(0, {}), 1);
    assert.equal(sim.force().z, 0);
    host.wall = NaN;
    sim.say(answer(0, {}), 1);
    assert.equal(sim.force().z, 0);
  }),

  "an Inverse3 gets no force after 5 ms without an answer, nor in a hidden tab, and late answers are left out": () => client((sim) => {
    begin(sim);
    sim.say(answer(0), 4.9);
    assert.equal(sim.force().z, 1, "4.9 ms are allowed");
    sim.say(answer(0), 5.1);
    assert.equal(sim.force().z, 0);
    begin(sim);
    const before = sim.sent.length;
    sim.now += 5.1;
    sim.timers[0]();
    assert.deepEqual([sim.sent.length, sim.force().z], [before + 1, 0], "zero, by the clock alone");
    const waiting = sim.client.unanswered;
    for (let i = 1; i < waiting; i++) {
      sim.say(answer(0.5));
    }
    assert.equal(sim.sent.length, before + 1, "old answers get none");
    assert.equal(sim.client.at, null, "and do not count");
    sim.now += 5.1;
    sim.timers[0]();
    assert.equal(sim.sent.length, before + 2, "again");
    begin(sim);
    sim.client.halt();
    sim.now += 1500; // a large model is loaded meanwhile
    sim.client.resume();
    sim.timers[0]();
    assert.ok(!sim.isClosed, "the device was not silent");
    assert.equal(sim.force().z, 0);
    while (sim.client.unanswered > 1) {
      sim.say(answer(0));
    }
    begin(sim);
    sim.client.isHidden = true;
    const rests = sim.events.length;
    for (let i = 0; i < 3; i++) {
      sim.say(answer(0));
      assert.equal(sim.force().z, 0);
    }
    assert.deepEqual(sim.events.slice(rests), [["rest"]]);
    sim.client.isHidden = false;
    sim.now += 1100;
    sim.timers[0]();
    assert.match(sim.events.at(-1)[1], /does not answer/);
    assert.ok(sim.isClosed);
  }),

  "an Inverse3 that cannot be driven is refused in a sentence": async () => {
    for (const [message, words] of [["hello", /not the Haply Inverse Service/], [{ inverse3: [] }, /lists no Inverse3/],
      [hello({ config: { type: "inverse3" } }), /older than 3\.5/], [hello({ config: { type: "inverse9", preset: "" } }), /inverse9 is unknown/],
      [hello({ device_id: 'x"}' }), /lists no Inverse3/], [hello({ device_id: undefined }), /lists no Inverse3/],
      [{ inverse3: [null] }, /lists no Inverse3/]]) {
      await client((sim) => {
        sim.say(message);
        assert.match(sim.events.at(-1)[1], words);
        assert.equal(sim.sent.length, 0);
      });
    }
  },

  // --- the page, over a real WebSocket ---

  "an emulated Inverse3 strokes the plate": () => withService("none", async (at, log) => {
    const tab = await connect(at);
    await until(() => log().t > 4, "4 s of exchanges");
    const { messages, t, greatest, rise } = log();
    assert.match(await status(tab), /^Haply Inverse3 049D is the hand now: at most 3\.3 N/);
    assert.ok(greatest > 0.1 && greatest <= MOST_N, `${greatest} N`);
    console.log(`  ${(messages / t).toFixed(0)} exchanges a second, the last second's round trips ${await shown(tab, "round trip")}, ${
      await shown(tab, "gaps")} gaps over 5 ms; at most ${greatest} N, ${rise} N in a message`);
    assert.ok(parseFloat(await shown(tab, "cycles crossed")) > 10);
    await tab.evaluate(() => {
      Object.defineProperty(document, "hidden", { value: true, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    });
    await pause(100);
    await staysAt0(log, "hidden");
    await tab.evaluate(() => {
      delete document.hidden;
      document.dispatchEvent(new Event("visibilitychange"));
    });
    await until(() => log().force > 0, "a force again");
    await drop(tab, Buffer.from("no model"), "broken.glb"); // a task of more than 5 ms begins without a force
    await until(() => log().force > 0, "a force again");
    await tab.click("#inverse3");
    await staysAt0(log, "disconnected");
    assert.match(await status(tab), /let go/);
  }),

  "a tab that is left or closed tells an Inverse3 no force before its connection ends": async () => {
    for (const leave of [(tab) => tab.goto("about:blank"), (tab) => tab.close({ runBeforeUnload: true })]) {
      await withService("none", async (at, log) => {
        const tab = await connect(at);
        await until(() => log().force > 0.1, "a force");
        await leave(tab);
        await staysAt0(log, String(leave));
      });
    }
  },

  async "after each fault of its service an Inverse3 has no force, and the page says why"() {
    const table = { unplugged: /does not answer/, unpowered: /power supply/, unhomed: /not calibrated/, unready: /not ready/,
      closed: /service has ended/, mute: /does not answer/, late: null, garbage: /does not answer/, short: /does not answer/,
      long: /does not answer/, endless: /does not answer/ };
    const times = [];
    for (const [fault, words] of Object.entries(table)) {
      await withService(`${fault}@${FAULT_S}`, async (at, log) => {
        const tab = await connect(at);
        await until(() => log().t > FAULT_S + 0.3, fault);
        if (fault !== "closed") { // nothing can be sent; the session is over
          await staysAt0(log, fault);
          times.push(`${fault} ${Math.max(0, 1000 * (log().zeroSince - FAULT_S)).toFixed(0)}`);
        }
        await (words && tab.waitForFunction((source) => new RegExp(source).test(document.querySelector("#status").textContent), words.source));
        assert.ok(log().whileOff <= 1, `${fault}: forces told after the answer that said so`);
      });
    }
    console.log(`  ms from the fault to a force of 0 at the service: ${times.join(", ")}; closed: its session is over`);
  },

  async "a service that is too old, silent or another program's, and none at all, are told"() {
    for (const [fault, words] of [["old", /older than 3\.5/], ["silent", /not the Haply/], ["strange", /not the Haply/]]) {
      await withService(fault, async (at) => {
        const tab = await connect(at);
        await tab.waitForFunction((source) => new RegExp(source).test(document.querySelector("#status").textContent), words.source);
      });
    }
    const tab = await connect(9);
    await tab.waitForFunction(() => /does not answer at localhost:9: start it/.test(document.querySelector("#status").textContent));
  },

  "a page of another host needs the browser's permission, and says so": () => withService("none", async (at, log) => {
    const url = `http://knurl.test:${port}/`;
    const other = await chromium.launch({ executablePath, args: [...FLAGS, "--host-resolver-rules=MAP knurl.test 127.0.0.1",
      `--ip-address-space-overrides=127.0.0.1:${port}=public`, `--unsafely-treat-insecure-origin-as-secure=${url}`] });
    try {
      const tab = await (await other.newContext()).newPage();
      await tab.goto(`${url}#inverse3=${at}`);
      await tab.waitForSelector("html[data-ready]");
      await tab.evaluate(() => document.getElementById("inverse3").click());
      await tab.waitForFunction(() => /does not let this page reach programs/.test(document.querySelector("#status").textContent));
      assert.equal(log().messages ?? 0, 0);
      const session = await other.newBrowserCDPSession();
      const { browserContextIds: [browserContextId] } = await session.send("Target.getBrowserContexts");
      await session.send("Browser.grantPermissions", { permissions: ["loopbackNetwork"], browserContextId });
      await tab.evaluate(() => document.getElementById("inverse3").click());
      await until(() => log().messages > 100, "exchanges");
    } finally {
      await other.close();
    }
  }),
};
