// A browser with the page that ./run web built, and a user's actions. SPDX-License-Identifier: MIT
import { AsyncLocalStorage } from "node:async_hooks";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join, normalize } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

// usage: node browser.mjs PAGE MODULES KNURL TMP CHROMIUM
export const [page, modules, tool, tmp, executablePath] = process.argv.slice(2);
export const ROW = 23; // numbers a tick, as samples/web/rows.js has it
export const { chromium } = await import(pathToFileURL(join(modules, "playwright-core/index.mjs")));
export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
export const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader"];
export const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm",
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
export const { port } = server.address();
const address = `http://127.0.0.1:${port}/`;
export const browser = await chromium.launch({ executablePath, args: FLAGS });
export const complaints = []; // of the console

// Removes those that a case expects.
export const forgive = (pattern) => complaints.splice(0, complaints.length, ...complaints.filter((text) => !pattern.test(text)));

const SMALL = { viewport: { width: 800, height: 600 } };
const lane = new AsyncLocalStorage(); // {context} of the case that runs

// Runs a case; its tabs are closed after it.
export function runCase(run) {
  return lane.run({ context: null }, async () => {
    try {
      await run();
    } finally {
      await lane.getStore().context?.close();
    }
  });
}

// A tab with the page, ready if it waits. before(tab): removes features of the browser.
export async function open({ options = SMALL, hash = "", url = address + hash, before, waits = true } = {}) {
  await lane.getStore().context?.close();
  const context = await browser.newContext(options);
  lane.getStore().context = context;
  context.setDefaultTimeout(60000); // for busy machines
  const tab = await context.newPage();
  await before?.(tab);
  tab.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  tab.on("pageerror", (problem) => complaints.push(String(problem)));
  await tab.goto(url);
  if (waits) {
    await tab.waitForSelector("html[data-ready]");
  }
  return tab;
}

// For open({before}): a browser without WebGL.
export function withoutWebGL(tab) {
  return tab.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return /webgl/.test(kind) ? null : getContext.call(this, kind, ...rest);
    };
  });
}

export const status = (tab) => tab.textContent("#status");
export const shown = (tab, key) =>
  tab.evaluate((name) => [...document.querySelectorAll("#numbers div")]
    .find((row) => row.children[0].textContent === name)?.children[1].textContent, key);

export async function drop(tab, bytes, name) {
  await tab.evaluate(([content, label]) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(content)], label));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
  }, [[...bytes], name]);
}

// Half a second as the page records it: the CSV file's rows by column.
export async function recorded(tab, name) {
  await tab.click("#record");
  await tab.waitForTimeout(500);
  await tab.click("#record");
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#save")]);
  await download.saveAs(join(tmp, name));
  const [header, ...lines] = readFileSync(join(tmp, name), "utf8").trim().split("\n");
  const names = header.split(",");
  return lines.map((line) => Object.fromEntries(line.split(",").map((cell, i) => [names[i], Number(cell)])));
}

export async function strokeAcross(tab) {
  await tab.locator("#view").scrollIntoViewIfNeeded();
  const box = await tab.locator("#view").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await tab.mouse.move(x - 60, y);
  await tab.mouse.down();
  for (let i = 0; i <= 20; i++) {
    await tab.mouse.move(x - 60 + 6 * i, y);
    await tab.waitForTimeout(12);
  }
}

export async function finish() {
  await browser.close();
  server.close();
}
