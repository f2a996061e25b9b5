// Timed cases: printed, because they depend on the machine's load. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { open, page } from "./harness.mjs";

// In the page: notes when a force is first shown. The page's own hand moves as soon as all is there.
function noteTheFirstForce() {
  const timer = setInterval(() => {
    if (/force0*[.0]*[1-9]/.test(document.getElementById("numbers")?.textContent)) {
      globalThis.feltAt = performance.now();
      clearInterval(timer);
    }
  }, 10);
}

export const cases = {
  async "a stroke is felt soon after the page is asked for"() {
    const times = [];
    for (let i = 0; i < 3; i++) {
      const tab = await open({ before: (bare) => bare.addInitScript(noteTheFirstForce), waits: false });
      await tab.waitForFunction(() => globalThis.feltAt, null, { polling: 100 }); // not in each frame: that slows the page
      const { felt, painted, names } = await tab.evaluate(() => ({ felt: globalThis.feltAt,
        painted: performance.getEntriesByName("first-contentful-paint")[0].startTime,
        names: performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname) }));
      times.push({ felt, painted, names: ["index.html", ...new Set([...names, "/worker.js"])] });
    }
    times.sort((a, b) => a.felt - b.felt);
    const sizes = times[0].names.map((name) => readFileSync(join(page, name)))
      .map((bytes) => [bytes.length, gzipSync(bytes, { level: 9 }).length]);
    const sum = (i) => (sizes.reduce((total, size) => total + size[i], 0) / 1000).toFixed(0);
    console.log(`  first paint and a stroke felt, s after navigation: ${times.map(({ painted, felt }) =>
      `${(painted / 1000).toFixed(2)} ${(felt / 1000).toFixed(2)}`).join(", ")}`);
    console.log(`  ${sizes.length} files, ${sum(0)} kB, ${sum(1)} kB by gzip`);
    assert.ok(sum(1) < 1500);
  },
};
