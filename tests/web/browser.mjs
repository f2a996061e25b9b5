// The page that ./run web builds, in a real browser: first timed cases, then LANES cases at once, which mostly wait.
// ONLY=WORDS: the cases whose names hold them; SHORT=1: a few of all. usage: node browser.mjs PAGE MODULES KNURL TMP CHROMIUM
// SPDX-License-Identifier: MIT
import { complaints, finish, runCase } from "./harness.mjs";
import { cases as actuators } from "./actuators.mjs";
import { cases as blind } from "./blind.mjs";
import { cases as embed } from "./embed.mjs";
import { cases as equal } from "./equal.mjs";
import { cases as felt } from "./felt.mjs";
import { cases as hostile } from "./hostile.mjs";
import { cases as inverse3 } from "./inverse3.mjs";
import { cases as own } from "./own.mjs";
import { cases as packed } from "./packed.mjs";
import { cases as page } from "./page.mjs";
import { cases as pictures } from "./pictures.mjs";
import { cases as report } from "./report.mjs";
import { cases as timed } from "./timed.mjs";

const LANES = 2;
const SHORT = ["a stroke by the pointer crosses ridges and pushes back", "arrow keys stroke", "axe finds nothing, in light and dark",
  "a file without tags is shown; a click gives a part ridges that are felt and saved", "forces are the native tick's, and their sound is played",
  "a hostile file gets a sentence, and what was there goes on",
  "each fault of an Inverse3's messages takes the force away at once, and it ramps up again",
  "an Inverse3 gets no force after 5 ms without an answer, nor in a hidden tab, and late answers are left out"];
const isChosen = ([name]) => name.includes(process.env.ONLY ?? "") && (!process.env.SHORT || SHORT.includes(name));
const total = [page, pictures, equal, felt, own, packed, hostile, inverse3, actuators, blind, embed, report, timed].reduce((sum, cases) => sum + Object.keys(cases).length, 0);
let count = 0;
let failed = 0;

async function runAll(cases) {
  for (let next = cases.shift(); next; next = cases.shift()) {
    const [name, run] = next;
    const begin = performance.now();
    count++;
    try {
      await runCase(run);
      console.log(`ok: ${name} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
    } catch (problem) {
      failed++;
      console.log(`FAILED: ${name}: ${problem.stack}`);
    }
  }
}

await runAll(Object.entries(timed).filter(isChosen));
const others = Object.entries({ ...page, ...pictures, ...equal, ...felt, ...own, ...packed, ...hostile, ...inverse3, ...actuators, ...blind, ...embed, ...report }).filter(isChosen);
await Promise.all(Array.from({ length: LANES }, () => runAll(others)));
if (complaints.length > 0) {
  failed++;
  console.log(`FAILED: the console is clean: ${complaints.join("\n")}`);
}
console.log(`${count} of ${total} cases, ${failed} failed`);
await finish();
process.exit(failed ? 1 : 0);
