// The page that ./run web builds, in a real browser. ONLY=WORDS: the cases whose names hold them.
// usage: node browser.mjs PAGE MODULES KNURL TMP CHROMIUM
// SPDX-License-Identifier: MIT
import { complaints, finish } from "./harness.mjs";
import { cases as equal } from "./equal.mjs";
import { cases as hostile } from "./hostile.mjs";
import { cases as page } from "./page.mjs";
import { cases as pictures } from "./pictures.mjs";

const cases = Object.entries({ ...page, ...pictures, ...equal, ...hostile }).filter(([name]) => name.includes(process.env.ONLY ?? ""));
let failed = 0;
for (const [name, run] of cases) {
  const begin = performance.now();
  try {
    await run();
    console.log(`ok: ${name} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (problem) {
    failed++;
    console.log(`FAILED: ${name}: ${problem.stack}`);
  }
}
if (complaints.length > 0) {
  failed++;
  console.log(`FAILED: the console is clean: ${complaints.join("\n")}`);
}
console.log(`${cases.length} cases, ${failed} failed`);
await finish();
process.exit(failed ? 1 : 0);
