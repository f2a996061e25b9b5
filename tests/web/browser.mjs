// The page that ./run web builds, in a real browser: loaded, stroked, and its forces held against the native tick's.
// usage: node browser.mjs PAGE PLAYWRIGHT KNURL TMP CHROMIUM. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createReadStream, existsSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { pathToFileURL } from "node:url";

const [page, modules, tool, tmp, executablePath] = process.argv.slice(2);
const { chromium } = await import(pathToFileURL(join(modules, "playwright-core/index.mjs")));
const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader"];
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm",
  ".glb": "model/gltf-binary" };

// A plain file server: no header that a page may not count on.
const server = createServer((request, response) => {
  const path = join(page, normalize(new URL(request.url, "http://x").pathname).replace(/\/$/, "/index.html"));
  if (!path.startsWith(page) || !existsSync(path)) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "Content-Type": TYPES[extname(path)] ?? "application/octet-stream" });
  createReadStream(path).pipe(response);
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const address = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({ executablePath, args: FLAGS });
const complaints = [];

let context = null; // of the case that runs

async function open(options = { viewport: { width: 800, height: 600 } }, hash = "") {
  context = await browser.newContext(options);
  context.setDefaultTimeout(15000);
  const tab = await context.newPage();
  tab.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  tab.on("pageerror", (problem) => complaints.push(String(problem)));
  await tab.goto(address + hash);
  await tab.waitForSelector("html[data-ready]");
  return tab;
}

const status = (tab) => tab.textContent("#status");
const shown = (tab, key) =>
  tab.evaluate((name) => [...document.querySelectorAll("#numbers div")]
    .find((row) => row.children[0].textContent === name)?.children[1].textContent, key);

async function drop(tab, bytes, name) {
  await tab.evaluate(([content, label]) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(content)], label));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
  }, [[...bytes], name]);
}

async function strokeAcross(tab) {
  const box = await tab.locator("#view").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await tab.mouse.move(x - 60, y);
  await tab.mouse.down();
  for (let i = 0; i <= 20; i++) {
    await tab.mouse.move(x - 60 + 6 * i, y);
    await tab.waitForTimeout(12);
  }
}

const cases = {
  async "a stroke by the pointer crosses ridges and pushes back"() {
    const tab = await open({ viewport: { width: 1280, height: 860 } });
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

  async "a hostile file gets a sentence, and what was there goes on"() {
    const tab = await open();
    const whole = readFileSync(join(page, "assets/grid_2d.glb"));
    for (const bytes of [Buffer.from("no model"), Buffer.alloc(0), whole.subarray(0, whole.length / 2)]) {
      await drop(tab, bytes, "hostile.glb");
      await tab.waitForSelector("#status.error");
      assert.match(await status(tab), /^hostile\.glb: /);
      await strokeAcross(tab);
      assert.ok(parseFloat(await shown(tab, "force")) > 0.05);
      await tab.mouse.up();
      await drop(tab, whole, "grid_2d.glb");
      await tab.waitForSelector("#status:not(.error)");
    }
  },

  async "a file of 65 MB is refused unread"() {
    const tab = await open();
    await tab.evaluate(() => {
      const data = new DataTransfer();
      data.items.add(new File([new Uint8Array(65 * 2 ** 20)], "huge.glb"));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
    });
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /^huge\.glb: 68157440 bytes; expected at most/);
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
    const tab = await open({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, colorScheme: "dark" });
    const box = await tab.locator("#view").boundingBox();
    await tab.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
    assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await tab.screenshot({ path: join(tmp, "phone.png"), fullPage: true });
  },

  async "a link holds the settings"() {
    const tab = await open({ viewport: { width: 800, height: 600 } }, "#model=grid_2d.glb&method=1&fsx=700&stiffness=600");
    assert.match(await status(tab), /grid_2d/);
    const values = await tab.evaluate(() => ["model", "method", "fsx", "stiffness"].map((id) => document.getElementById(id).value));
    assert.deepEqual(values, ["grid_2d.glb", "1", "700", "600"]);
  },

  async "sound can be switched on and is played"() {
    const tab = await open();
    await tab.check("#sound");
    await strokeAcross(tab);
    await tab.mouse.up();
    assert.ok(await tab.isChecked("#sound"));
  },

  async "forces are the native tick's"() {
    const rows = Array.from({ length: 1500 }, (_, k) => [0.00012 * k - 0.05, 0.001 - Math.min(k, 20) * 1e-4, 0]);
    writeFileSync(join(tmp, "trace.csv"), `t,x,y,z\n${rows.map((row, k) => `${k / 1000},${row.join()}`).join("\n")}\n`);
    execFileSync(tool, ["run", join(page, "assets/plate_1d.glb"), "--trace", join(tmp, "trace.csv"), "--fast", "--out",
      join(tmp, "native.csv")], { stdio: ["ignore", "ignore", "inherit"] });
    const native = readFileSync(join(tmp, "native.csv"), "utf8").trim().split("\n").slice(1).map((line) => line.split(","));
    const tab = await open();
    const answer = await tab.evaluate(async (positions) => {
      const worker = new Worker("worker.js", { type: "module" });
      const next = (kind) => new Promise((resolve) => {
        worker.addEventListener("message", ({ data }) => (data.kind === kind || data.to === kind) && resolve(data));
      });
      await next("ready");
      const bytes = await (await fetch("assets/plate_1d.glb")).arrayBuffer();
      worker.postMessage({ kind: "load", bytes, name: "plate" });
      await next("load");
      worker.postMessage({ kind: "device", rate: 1000, resolution: 0, protections: 15 });
      await next("device");
      worker.postMessage({ kind: "play", positions: Float64Array.from(positions) });
      const { rows, cost } = await next("play");
      worker.terminate();
      return { rows: [...rows], cost };
    }, native.flatMap((cells) => cells.slice(1, 4).map(Number)));
    let worst = 0;
    let most = 0;
    native.forEach((cells, k) => {
      for (let i = 0; i < 3; i++) {
        worst = Math.max(worst, Math.abs(Number(cells[11 + i]) - answer.rows[16 * k + i]));
        most = Math.max(most, Math.abs(Number(cells[11 + i])));
      }
    });
    console.log(`  forces to ${most.toFixed(2)} N, at most ${worst} N apart; a tick takes ${answer.cost.toFixed(2)} us`);
    assert.ok(most > 0.1);
    assert.ok(worst < 1e-9);
  },
};

let failed = 0;
for (const [name, run] of Object.entries(cases)) {
  try {
    await run();
    console.log(`ok: ${name}`);
  } catch (problem) {
    failed++;
    console.log(`FAILED: ${name}: ${problem.stack}`);
  }
  await context?.close();
}
if (complaints.length > 0) {
  failed++;
  console.log(`FAILED: the console is clean: ${complaints.join("\n")}`);
}
console.log(`${Object.keys(cases).length} cases, ${failed} failed`);
await browser.close();
server.close();
process.exit(failed ? 1 : 0);
