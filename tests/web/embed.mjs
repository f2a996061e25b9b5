// Figures in other pages: the page in an <iframe>, and the package for npm. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createReadStream, mkdirSync, readFileSync, readdirSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { TYPES, open, page, root, tmp } from "./harness.mjs";

const PACKED = ["LICENSE", "README.md", "THIRD_PARTY.md", "example.html", "figure.d.ts", "figure.js", "index.d.ts", "index.js",
  "knurl.wasm", "package.json", "plate_1d.glb"];

// Runs use(address) with a web server of a folder; begins: its index page, if it is not a file.
async function serve(folder, use, begins = "") {
  const server = createServer((request, response) => {
    const path = decodeURI(new URL(request.url, "http://x").pathname);
    response.writeHead(200, { "Content-Type": TYPES[extname(path)] ?? "text/html" });
    if (path === "/") {
      response.end(begins);
    } else {
      createReadStream(join(folder, path)).on("error", () => response.end()).pipe(response);
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  try {
    await use(`http://127.0.0.1:${server.address().port}/`);
  } finally {
    server.close();
  }
}

export const cases = {
  async "a figure that is copied plays in a page of another origin"() {
    const tab = await open({ before: (bare) => bare.addInitScript(() => { // the clipboard is other cases', too
      navigator.clipboard.writeText = async (text) => { globalThis.copied = text; };
    }) });
    await tab.selectOption("#preset", { label: "S1 pushes" });
    await tab.click("#embed");
    await tab.waitForFunction(() => /^The figure is/.test(document.querySelector("#status").textContent));
    const frame = await tab.evaluate(() => globalThis.copied);
    await serve(tmp, async (address) => {
      const other = await open({ url: address, waits: false });
      const inside = other.frameLocator("iframe");
      await inside.locator("html[data-ready]").waitFor();
      await inside.locator('#methods label:nth-of-type(1) output:text-matches("pushes 3[234] %")').waitFor();
      assert.ok(await inside.locator("#methods").isVisible());
      for (const part of ["h1", "#controls", "#scope"]) {
        assert.ok(!await inside.locator(part).isVisible(), part);
      }
      const fits = await inside.locator("html").evaluate((html) => html.scrollHeight <= innerHeight && html.scrollWidth <= innerWidth);
      assert.ok(fits, "without a scroll bar");
      await other.screenshot({ path: join(tmp, "embedded.png") });
      const [whole] = await Promise.all([other.waitForEvent("popup"), inside.locator("#whole").click()]);
      await whole.waitForSelector("html[data-ready]");
      assert.ok(await whole.isVisible("#controls"));
      assert.equal(await whole.evaluate(() => document.querySelector("#preset").selectedOptions[0].label), "S1 pushes");
    }, `<!doctype html><title>x</title>${frame}`);
  },

  async "the package holds what it needs, and its example runs from there"() {
    const folder = `${page}-npm`;
    const [{ files, size }] = JSON.parse(execFileSync("npm", ["pack", "--json", "--pack-destination", tmp], { cwd: folder, encoding: "utf8" }));
    assert.deepEqual(files.map(({ path }) => path).sort(), PACKED);
    console.log(`  the package: ${(size / 1000).toFixed(0)} kB`);
    const manifest = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const header = readFileSync(join(root, "sdk/include/knurl/base.h"), "utf8");
    assert.equal(manifest.version, ["MAJOR", "MINOR", "PATCH"].map((part) => header.match(new RegExp(`KNURL_VERSION_${part} +(\\d+)`))[1]).join("."));
    const types = readFileSync(join(folder, "index.d.ts"), "utf8");
    const source = readFileSync(join(root, "samples/web/npm/index.js"), "utf8");
    const names = [...source.matchAll(/export \{ (.*?) \}/g)].flatMap(([, list]) => list.split(", "));
    names.forEach((name) => assert.match(types, new RegExp(`export (const|class) ${name}\\b`), `${name} has no type`));
    const unpacked = join(tmp, "package");
    rmSync(unpacked, { recursive: true, force: true });
    mkdirSync(unpacked);
    execFileSync("tar", ["-xzf", join(tmp, `${manifest.name}-${manifest.version}.tgz`), "-C", tmp]);
    await serve(unpacked, async (address) => {
      const tab = await open({ url: `${address}example.html`, waits: false });
      await tab.waitForFunction(() => /^bar 1 mm: 200 Hz, 0\.\d+ N$/.test(document.querySelector("body > p > output, p > output").textContent));
      const figure = tab.locator("knurl-figure");
      await figure.locator('div > div:nth-of-type(1) p:text-matches("pushes 3[234] %")').waitFor();
      await figure.locator('div > div:nth-of-type(2) p:text-matches("^\\\\d+ % false tones$")').waitFor();
      await figure.locator("input").fill("0.2");
      await figure.locator('label output:text-is("0.20 m/s")').waitFor();
      await figure.locator('div > div:nth-of-type(1) p:text-matches("pushes (19|20|21) %")').waitFor(); // 3 of 5 ticks are up
      await tab.evaluate(readFileSync(join(page, "../web-work/page/node_modules/axe-core/axe.min.js"), "utf8"));
      const { violations } = await tab.evaluate(() => globalThis.axe.run("knurl-figure"));
      assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
      const alone = await tab.evaluate(async () => {
        const { AT: at, Knurl } = await import("./index.js");
        const knurl = await Knurl.create();
        const { rows } = knurl.tick([0, 0, 0]); // without a scene
        knurl.load(await (await fetch("plate_1d.glb")).arrayBuffer(), "plate_1d.glb");
        let said = "";
        try {
          knurl.setDevice({ rate: 50 });
        } catch ({ message }) {
          said = message;
        }
        knurl.load(await (await fetch("plate_1d.glb")).arrayBuffer(), "plate_1d.glb"); // with the device before
        return { force: [...rows.subarray(at.force, at.force + 3)], rate: knurl.rate, said };
      });
      assert.deepEqual([alone.force, alone.rate], [[0, 0, 0], 1000]);
      assert.match(alone.said, /50/);
      await tab.screenshot({ path: join(tmp, "package.png") });
    });
  },

  async "the folder is complete, and its size is told"() {
    const sizes = readdirSync(page, { recursive: true }).map((name) => join(page, name)).filter((path) => statSync(path).isFile())
      .map((path) => readFileSync(path)).map((bytes) => [bytes.length, gzipSync(bytes, { level: 9 }).length]);
    const sum = (i) => (sizes.reduce((total, size) => total + size[i], 0) / 1e6).toFixed(2);
    console.log(`  the folder: ${sizes.length} files, ${sum(0)} MB, ${sum(1)} MB by gzip`);
    assert.match(readFileSync(join(page, "draco/LICENSE"), "utf8"), /Apache License/);
    assert.ok(sum(0) < 4);
  },
};
