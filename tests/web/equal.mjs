// The page compared with the tool: forces, sound, live runs and recordings. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Felt } from "../../samples/web/felt.js";
import { drop, modules, open, page, ROW, status, tmp, tool } from "./harness.mjs";

const STIFFNESS = 400; // of the plate's bars

// A stroke in contact from 10 ms on, by the tool: its rows.
function strokeNatively(name) {
  const rows = Array.from({ length: 1500 }, (_, k) => [0.00012 * k - 0.05, 0.001 - Math.min(k, 20) * 1e-4, 0]);
  writeFileSync(join(tmp, `${name}-trace.csv`), `t,x,y,z\n${rows.map((row, k) => `${k / 1000},${row.join()}`).join("\n")}\n`);
  const summary = JSON.parse(execFileSync(tool, ["run", join(page, "assets/plate_1d.glb"), "--trace", join(tmp, `${name}-trace.csv`),
    "--fast", "--out", join(tmp, `${name}.csv`)], { stdio: ["ignore", "pipe", "inherit"] }));
  const native = readFileSync(join(tmp, `${name}.csv`), "utf8").trim().split("\n").slice(1).map((line) => line.split(","));
  return { native, summary };
}

// The same positions in the page's worker.
function strokeInWorker(tab, native) {
  return tab.evaluate(async (positions) => {
    const worker = new Worker("worker.js", { type: "module" });
    const next = (kind) => new Promise((resolve) => {
      worker.addEventListener("message", ({ data }) => (data.kind === kind || data.to === kind) && resolve(data));
    });
    worker.postMessage({ kind: "begin", compiled: await WebAssembly.compileStreaming(fetch("knurl.wasm")) });
    const bytes = await (await fetch("assets/plate_1d.glb")).arrayBuffer();
    worker.postMessage({ kind: "load", bytes, name: "plate" });
    await next("load");
    const first = {};
    const device = { rate: 1000, resolution: 0, protections: 15 };
    const costs = []; // the browser compiles as it goes: the last is the machine's own speed
    for (let i = 0; i < 20; i++) {
      worker.postMessage({ kind: "play", positions: Float64Array.from(positions), ...device });
      const { rows, cost } = await next("play");
      costs.push(cost);
      if (i === 0) {
        first.rows = [...rows];
      }
    }
    worker.terminate();
    return { ...first, costs };
  }, native.flatMap((cells) => cells.slice(1, 4).map(Number)));
}

// The output of the page's AudioWorklet for ticks that arrive like the worker's, 12 ms at a time.
async function playThroughWorklet(tab, rows) {
  const here = dirname(fileURLToPath(import.meta.url));
  const bundle = execFileSync(join(modules, "@esbuild/linux-x64/bin/esbuild"), [join(here, "../../samples/web/sound.js"), "--bundle",
    "--format=iife", "--global-name=made"], { encoding: "utf8" });
  await tab.addScriptTag({ content: `${bundle}\nglobalThis.Sound = made.Sound;` });
  return tab.evaluate(async ([all, numbers, stiffness]) => {
    const batch = 12;
    const count = all.length / numbers;
    const context = new OfflineAudioContext(1, count * 48 + 4800, 48000);
    const sound = new globalThis.Sound();
    await sound.attach(context);
    sound.on = true;
    for (let k = 0; k < count; k += batch) {
      context.suspend(Math.round((k * 48) / 128) * 128 / 48000).then(async () => {
        sound.play(Float64Array.from(all.slice(k * numbers, (k + batch) * numbers)), [{ feel: [0, 0, 0, stiffness] }]);
        await new Promise((resolve) => setTimeout(resolve, 4));
        context.resume();
      });
    }
    return [...(await context.startRendering()).getChannelData(0)];
  }, [rows, ROW, STIFFNESS]);
}

const distance = (a, b) => a.reduce((worst, value, i) => Math.max(worst, Math.abs(value - b[i])), 0);

export async function startLive(file = join(page, "assets/plate_1d.glb")) {
  const run = spawn(tool, ["run", file, "--view", "--stroke", "sweep", "--seconds", "60"],
    { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  for await (const text of run.stderr) {
    said += text;
    const url = /http:\/\/\S+/.exec(said)?.[0];
    if (url) {
      return { run, url };
    }
  }
  throw new Error(said);
}

export const cases = {
  async "forces are the native tick's, and their sound is played"() {
    const { native, summary } = strokeNatively("native");
    const tab = await open({ options: { bypassCSP: true } }); // for a script that the test adds
    const answer = await strokeInWorker(tab, native);
    const forces = native.flatMap((cells) => cells.slice(11, 14).map(Number));
    const found = native.flatMap((_, k) => answer.rows.slice(ROW * k, ROW * k + 3));
    const apart = distance(forces, found);
    const most = Math.max(...forces.map(Math.abs));
    const [first] = answer.costs;
    const warm = answer.costs.sort((a, b) => a - b)[answer.costs.length / 2];
    const native_us = summary.tick_ns.p50 / 1000;
    console.log(`  forces to ${most.toFixed(2)} N, at most ${apart} N apart`);
    console.log(`  a tick by every method takes ${warm.toFixed(2)} us in WebAssembly (${first.toFixed(2)} as it is compiled); natively, ` +
      `by one, ${native_us.toFixed(2)} us: ratio ${(warm / native_us).toFixed(1)}`);
    assert.ok(most > 0.1);
    assert.ok(apart < 1e-9);
    const part = native.slice(0, 480); // 0.48 s
    const samples = new Felt(1000).render(part.map((cells) => STIFFNESS * Number(cells[10]))); // the tool's heights
    const heard = await playThroughWorklet(tab, answer.rows.slice(0, ROW * part.length));
    const begin = samples.findIndex((value) => value !== 0);
    const late = heard.findIndex((value) => value !== 0) - begin;
    const played = distance([...samples], heard.slice(late));
    console.log(`  sound to ${Math.max(...samples).toFixed(3)}; played ${late} samples late, ${played} apart`);
    assert.ok(Math.max(...samples) > 0.05);
    assert.ok(played < 1e-6);
    assert.ok(late >= 0 && late < 4800);
  },

  async "the tool's own rows are replayed"() {
    strokeNatively("replayed");
    const tab = await open();
    const csv = readFileSync(join(tmp, "replayed.csv"), "utf8");
    const cycles = csv.trim().split("\n").slice(1).reduce((sum, line) => sum + Number(line.split(",")[9]) / 1000, 0);
    await drop(tab, Buffer.from(csv), "native.csv");
    await tab.waitForFunction(() => document.querySelector("#status").textContent === "native.csv: 1500 ticks are played");
    // Cycles in the second frame from now, so that they are not those from before the replay; null if it is over.
    const read = () => tab.evaluate(async () => {
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const row = [...document.querySelectorAll("#numbers div")].find(({ children }) => children[0].textContent === "cycles crossed");
      return document.querySelector("#replay").ariaPressed === "true" ? Number(row.children[1].textContent) : null;
    });
    let most = 0;
    for (let round = 0; round < 10 && most < 0.9 * cycles; round++) { // a busy machine may draw nothing in the 1.5 s
      for (let crossed = await read(); crossed !== null; crossed = await read()) {
        most = Math.max(most, crossed);
      }
      assert.match(await status(tab), /is over/);
      await tab.click("#replay");
    }
    assert.ok(most > 0.9 * cycles && most <= cycles + 0.1, `${most} of ${cycles}`);
  },

  async "names in CSV are no formulas, and a surface called none is one"() {
    const { fromCsv, toCsv } = await import("../../samples/web/rows.js");
    const names = ["plate", "none", "=1+1", "-1", "＝1", "'none", "=a,\"b\""];
    const surfaces = names.map((name) => ({ name }));
    const rows = new Float64Array(ROW * (names.length + 1));
    for (let k = 0; k <= names.length; k++) {
      rows.set([k < names.length ? 1 : 0, k < names.length ? k : -1], ROW * k + 14); // contact, surface
    }
    const csv = toCsv(rows, surfaces);
    assert.deepEqual(csv.trim().split("\n").slice(1).map((line) => line.split(/^(?:[^,]*,){6}/)[1].split(/,0,/)[0]),
      ["plate", "'none", "'=1+1", "'-1", "'＝1", "''none", "\"'=a,\"\"b\"\"\"", "none"]);
    assert.deepEqual([...fromCsv(csv, surfaces)], [...rows]);
  },

  async "a run with --view is seen, recorded and replayed"() {
    const { run, url } = await startLive();
    try {
      const tab = await open({ url, options: { viewport: { width: 1000, height: 800 }, acceptDownloads: true } });
      await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
      assert.match(await status(tab), /plate_1d.glb on fake .*1000 Hz/);
      assert.equal(await tab.isVisible("#stiffness"), false);
      await tab.evaluate(readFileSync(join(modules, "axe-core/axe.min.js"), "utf8"));
      const { violations } = await tab.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.map(({ id }) => id), []);
      await tab.click("#record");
      await tab.waitForTimeout(1000);
      await tab.click("#record");
      await tab.screenshot({ path: join(tmp, "live.png") });
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#save")]);
      await download.saveAs(join(tmp, "live.csv"));
      const lines = readFileSync(join(tmp, "live.csv"), "utf8").trim().split("\n");
      assert.ok(lines[0].startsWith("t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz"));
      assert.ok(lines.length > 500, `${lines.length} lines`);
      const times = lines.slice(1).map((line) => Math.round(1000 * parseFloat(line)));
      assert.ok(times.every((t, i) => i === 0 || t === times[i - 1] + 1), "a tick is missing");
      run.kill("SIGINT");
      await tab.waitForSelector("#status.error");
      assert.match(await status(tab), /The run is over/);
      await tab.click("#replay");
      await tab.waitForFunction(() => /cycles crossed[1-9]/.test(document.querySelector("#numbers").textContent));
    } finally {
      run.kill("SIGINT");
      await (run.exitCode === null && run.signalCode === null ? once(run, "exit") : null);
    }
  },
};
