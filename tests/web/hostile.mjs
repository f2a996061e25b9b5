// Hostile conditions: files that are not models, browsers without some features, hidden windows and tabs.
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { once } from "node:events";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { startLive } from "./equal.mjs";
import { drop, forgive, open, page, shown, status, strokeAcross, tmp, withoutWebGL } from "./harness.mjs";

// The demo plate with a texture at another host.
function textured(url) {
  const whole = readFileSync(join(page, "assets/plate_1d.glb"));
  const size = whole.readUInt32LE(12);
  const model = JSON.parse(whole.subarray(20, 20 + size));
  model.images = [{ uri: url }];
  model.textures = [{ source: 0 }];
  model.materials.forEach((material) => {
    material.pbrMetallicRoughness = { baseColorTexture: { index: 0 } };
  });
  return assemble(whole, size, model);
}

// A .glb with another JSON, whose own has `size` bytes.
function assemble(whole, size, model) {
  const text = Buffer.from(JSON.stringify(model));
  const padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, " ")]);
  const bytes = Buffer.concat([whole.subarray(0, 20), padded, whole.subarray(20 + size)]);
  bytes.writeUInt32LE(bytes.length, 8);
  bytes.writeUInt32LE(padded.length, 12);
  return bytes;
}

// Requests to a server at another port meanwhile.
async function requestsDuring(work) {
  const asked = [];
  const other = createServer((request, response) => {
    asked.push(request.url);
    response.writeHead(204, { "Access-Control-Allow-Origin": "*" }).end();
  });
  await new Promise((resolve) => other.listen(0, "127.0.0.1", resolve));
  try {
    await work(`http://127.0.0.1:${other.address().port}`);
  } finally {
    other.close();
  }
  return asked;
}

const noTexture = () => forgive(/load texture/);

export const cases = {
  async "a model's image at another host is not asked for"() {
    const asked = await requestsDuring(async (other) => {
      const tab = await open();
      await drop(tab, textured(`${other}/dropped.png`), "textured.glb");
      await tab.waitForFunction(() => /textured\.glb/.test(document.querySelector("#status").textContent));
      assert.equal(await tab.locator("#status.error").count(), 0);
      writeFileSync(join(tmp, "textured.glb"), textured(`${other}/live.png`));
      const { run, url } = await startLive(join(tmp, "textured.glb"));
      try {
        const live = await open({ url });
        await live.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
        await live.waitForTimeout(500);
      } finally {
        run.kill("SIGINT");
        await (run.exitCode === null && run.signalCode === null ? once(run, "exit") : null);
      }
    });
    assert.deepEqual(asked, []);
    noTexture();
  },

  async "a script of the page may ask nothing of another host"() {
    const asked = await requestsDuring(async (other) => {
      const { run, url } = await startLive();
      try {
        for (const address of [undefined, url]) {
          const tab = await open({ url: address });
          const refused = await tab.evaluate(async (place) => {
            const violations = [];
            document.addEventListener("securitypolicyviolation", ({ effectiveDirective }) => violations.push(effectiveDirective));
            await fetch(`${place}/fetched`).catch(() => {});
            new Image().src = `${place}/image.png`;
            const inline = document.createElement("script");
            inline.textContent = "globalThis.wasInline = true";
            document.head.append(inline);
            await new Promise((resolve) => setTimeout(resolve, 300));
            return [...new Set(violations)].sort().concat(globalThis.wasInline === true);
          }, other);
          assert.deepEqual(refused, ["connect-src", "img-src", "script-src-elem", false]);
        }
      } finally {
        run.kill("SIGINT");
        await (run.exitCode === null && run.signalCode === null ? once(run, "exit") : null);
      }
    });
    assert.deepEqual(asked, []);
    forgive(/Content Security Policy/);
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

  async "a recording that is none gets a sentence"() {
    const tab = await open();
    const header = "t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz";
    for (const [text, why] of [["", /no t/], ["t,x\n1,2\n3,4\n", /no y/], [`${header}\n`, /two rows/],
      [`${header}\n${"0,".repeat(13)}1\n${"0,".repeat(13)}x\n`, /line 3: expected a number for fz, found 'x'/]]) {
      await drop(tab, Buffer.from(text), "hostile.csv");
      await tab.waitForFunction((source) => new RegExp(source).test(document.querySelector("#status.error")?.textContent), why.source);
    }
  },

  async "a file of 200 MB is refused unread"() {
    const tab = await open();
    await tab.evaluate(() => {
      const data = new DataTransfer();
      data.items.add(new File(Array(200).fill(new Uint8Array(2 ** 20)), "huge.glb"));
      window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
    });
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /^huge\.glb: 209715200 bytes; expected at most/);
  },

  async "without WebGL the arrow keys stroke, and the page says so"() {
    const tab = await open({ before: withoutWebGL });
    assert.match(await status(tab), /no WebGL/);
    await tab.focus("#view");
    for (let i = 0; i < 20; i++) {
      await tab.keyboard.press("ArrowRight", { delay: 10 });
    }
    await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
    forgive(/WebGL/); // three.js' own
  },

  async "a browser without WebAssembly gets a sentence"() {
    const tab = await open({ waits: false, before: (bare) => bare.addInitScript(() => delete globalThis.WebAssembly) });
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /^WebAssembly could not be started/);
  },

  async "opened from a folder, the page says how to serve it"() {
    const tab = await open({ url: `file://${page}/index.html`, waits: false });
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /Serve it: python3 -m http.server/);
    forgive(/file:|ERR_FAILED/); // the browser's own
  },

  async "a policy of the server that forbids the page is named"() {
    const under = (policy) => open({ waits: false, before: (bare) => bare.route("**/", async (route) => {
      const answer = await route.fetch();
      await route.fulfill({ response: answer, headers: { ...answer.headers(), "content-security-policy": policy } });
    }) });
    const strict = await under("script-src 'self'; worker-src 'self'");
    await strict.waitForSelector("#status.error");
    assert.match(await status(strict), /WebAssembly|wasm/);
    const none = await under("script-src 'none'"); // no script can tell
    const told = await none.locator("#status").evaluate((part) => getComputedStyle(part, "::after").content);
    assert.match(told, /server may forbid/);
    forgive(/Content Security Policy|wasm|WebAssembly/i);
  },

  async "two fingers turn the view, and do not stroke"() {
    const tab = await open({ hash: "#hand=rests", options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });
    const session = await tab.context().newCDPSession(tab);
    const camera = async () => {
      await tab.click("#share");
      await tab.evaluate(() => scrollTo(0, 0));
      return new URLSearchParams(new URL(tab.url()).hash.slice(1)).get("camera");
    };
    const before = await camera();
    const box = await tab.locator("#view").boundingBox();
    const at = (dx, dy) => ({ x: Math.round(box.x + box.width / 2 + dx), y: Math.round(box.y + box.height / 2 + dy) });
    const touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map((point, id) => ({ ...point, id })) });
    await touch("touchStart", at(0, 0));
    for (let i = 0; i < 10; i++) {
      await touch("touchMove", at(3 * i, 0));
      await tab.waitForTimeout(15);
    }
    await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
    await touch("touchStart", at(30, 0), at(60, 40));
    for (let i = 0; i < 10; i++) {
      await touch("touchMove", at(30 + 4 * i, 0), at(60 + 4 * i, 40));
      await tab.waitForTimeout(15);
    }
    await tab.waitForFunction(() => /force0\.00/.test(document.querySelector("#numbers").textContent));
    await touch("touchEnd");
    assert.notEqual(await camera(), before, "two fingers turn");
  },

  async "the seventieth surface has its name, and a ray finds it"() {
    const whole = readFileSync(join(page, "assets/plate_1d.glb"));
    const size = whole.readUInt32LE(12);
    const model = JSON.parse(whole.subarray(20, 20 + size));
    model.nodes = Array.from({ length: 70 }, (_, i) => ({ mesh: 0, name: `bar ${i}`, translation: [0, 0, -0.03 * i] }));
    model.scenes[0].nodes = model.nodes.map((_, i) => i);
    const tab = await open();
    await drop(tab, assemble(whole, size, model), "many.glb");
    await tab.waitForFunction(() => /^many.glb: 70 surfaces/.test(document.querySelector("#status").textContent));
    await tab.evaluate(() => { document.querySelector("#more").open = true; });
    await tab.selectOption("#surface", { label: "bar 69" });
    await tab.waitForTimeout(500);
    await tab.click("#record");
    await tab.waitForTimeout(300);
    await tab.click("#record");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#save")]);
    const names = readFileSync(await download.path(), "utf8").trim().split("\n").slice(1).map((line) => line.split(",")[6]);
    assert.deepEqual([...new Set(names)], ["bar 69"]);
  },

  async "a server that does not know WebAssembly will do"() {
    const tab = await open({ before: (bare) => bare.route("**/knurl.wasm", (route) =>
      route.fulfill({ path: join(page, "knurl.wasm"), contentType: "application/octet-stream" })) });
    assert.match(await status(tab), /to stroke$/);
  },

  async "without sound all else works"() {
    const tab = await open({ before: (bare) => bare.addInitScript(() => delete window.AudioContext) });
    await tab.click("#sound");
    await tab.waitForSelector("#status.error");
    assert.match(await status(tab), /^There is no sound in this browser/);
    assert.equal(await tab.getAttribute("#sound", "aria-pressed"), "false");
    await strokeAcross(tab);
    assert.ok(parseFloat(await shown(tab, "force")) > 0.05);
  },

  async "a window of no size draws nothing, and goes on when it has one"() {
    const tab = await open({ options: { viewport: { width: 800, height: 600 }, bypassCSP: true } }); // for the test's style
    await tab.addStyleTag({ content: "body.gone main > * { height: 0; width: 0; min-height: 0 } body.gone canvas { height: 0; width: 0 }" });
    await tab.evaluate(() => document.body.classList.add("gone"));
    await tab.waitForTimeout(300);
    await tab.evaluate(() => document.body.classList.remove("gone"));
    await strokeAcross(tab);
    assert.ok(parseFloat(await shown(tab, "force")) > 0.05);
  },

  async "what a stopped worker has missed is not made up for"() {
    const stopped = 1500; // ms, as in the background
    const tab = await open();
    await tab.selectOption("#preset", { label: "S1 pushes" });
    const [worker] = tab.workers();
    await worker.evaluate((ms) => {
      const post = globalThis.postMessage;
      globalThis.count = 0;
      globalThis.postMessage = (message, transfer) => {
        globalThis.count += message.kind === "ticks" ? message.rows.length / 23 : 0;
        post(message, transfer);
      };
      globalThis.begin = performance.now();
      while (performance.now() < globalThis.begin + ms) { /* nothing else runs */ }
    }, stopped);
    await tab.waitForTimeout(500);
    const { count, ran } = await worker.evaluate((ms) =>
      ({ count: globalThis.count, ran: performance.now() - globalThis.begin - ms }), stopped);
    console.log(`  ${count} ticks in the ${ran.toFixed(0)} ms that it ran`);
    assert.ok(count > 0);
    assert.ok(count < ran + 150); // the worker drops ticks that are 100 ms late
  },
};
