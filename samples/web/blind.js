// A blind comparison of two methods: each trial calls them A and B in an order that nobody sees, and counts which is
// preferred. All that tells them apart is hidden meanwhile. SPDX-License-Identifier: MIT
import { method, setMethod } from "./compare.js";
import { $, press, scene, surface, tell } from "./page.js";

const NAMES = ["", "S1", "S2", "bandlimited"];

// Of a fair coin: the probability of a result as uneven as this (two-sided binomial test).
export function chance(one, other) {
  const count = one + other;
  let sum = 0;
  for (let k = 0, ways = 1; k <= Math.min(one, other); ways *= (count - k) / (k + 1), k++) {
    sum += ways / 2 ** count;
  }
  return Math.min(1, 2 * sum);
}

// trials: {a, b, preferred}: numbers of methods. what: the surface and its settings.
export function report(trials, [one, other], what) {
  const count = (number) => trials.filter(({ preferred }) => preferred === number).length;
  const [first, second] = [count(one), count(other)];
  return [`Preferred: ${NAMES[one]} ${first}, ${NAMES[other]} ${second}, of ${trials.length} trials.`,
    `A fair coin is as uneven as this, or more, with probability ${chance(first, second).toPrecision(2)}.`, what, "", "trial,A,B,preferred",
    ...trials.map(({ a, b, preferred }, i) => `${i + 1},${NAMES[a]},${NAMES[b]},${NAMES[preferred]}`)].join("\n");
}

// The surface that is stroked, and its settings.
function compared() {
  const [fsx, fsy, amplitude, stiffness, friction] = surface()?.feel ?? [];
  return `${scene.name}, ${surface()?.name}: ${fsx} and ${fsy} ridges/m, ${1000 * amplitude} mm, ${stiffness} N/m, friction ${
    friction}, ${$("rate").value} Hz`;
}

export class Blind {
  // choose(): a method has been set.
  constructor(choose) {
    Object.assign(this, { choose, trials: [], two: [1, 3], order: [1, 3] });
    $("blind-begin").addEventListener("click", () => (this.isOn ? this.end() : this.begin()));
    ["a", "b"].forEach((letter, i) => {
      $(`play-${letter}`).addEventListener("click", () => this.play(i));
      $(`prefer-${letter}`).addEventListener("click", () => this.prefer(i));
    });
    $("blind-copy").addEventListener("click", () => this.copy());
    addEventListener("keydown", ({ key, target, ctrlKey, altKey, metaKey }) => {
      const which = "ab".indexOf(key.toLowerCase());
      const isText = target.matches?.("select, input:not([type=radio], [type=range])");
      if (this.isOn && which >= 0 && key.length === 1 && !isText && !ctrlKey && !altKey && !metaKey) {
        this.play(which);
      }
    });
  }

  get isOn() {
    return document.documentElement.dataset.blind === "1";
  }

  begin() {
    const two = ["blind-one", "blind-other"].map((id) => Number($(id).value));
    if (two[0] === two[1]) {
      tell("Choose two different methods.", true);
      return;
    }
    Object.assign(this, { two, trials: [], before: method(), what: compared() });
    this.show(true);
    this.next();
  }

  show(isOn) {
    document.documentElement.dataset.blind = isOn ? "1" : "0";
    $("blind-begin").textContent = isOn ? "End, and show the result" : "Begin";
    $("blind-trial").hidden = !isOn;
    $("blind-end").hidden = isOn;
  }

  next() {
    const [one, other] = this.two;
    this.order = crypto.getRandomValues(new Uint8Array(1))[0] % 2 ? [one, other] : [other, one];
    $("blind-count").textContent = `Trial ${this.trials.length + 1}: feel, hear and see both, then choose.`;
    this.play(0);
  }

  play(which) {
    setMethod(this.order[which]);
    this.choose();
    press("play-a", which === 0);
    press("play-b", which === 1);
  }

  prefer(which) {
    const [a, b] = this.order;
    this.trials.push({ a, b, preferred: this.order[which] });
    this.what = compared();
    this.next();
  }

  // Another scene was opened: trials with it would be of another surface.
  opened() {
    if (this.isOn) {
      this.end();
      tell("The blind comparison ended, because another scene was opened.");
    }
  }

  end() {
    $("blind-result").textContent = report(this.trials, this.two, this.what);
    this.show(false);
    setMethod(this.before);
    this.choose();
    $("blind-result").focus();
  }

  async copy() {
    try {
      await navigator.clipboard.writeText($("blind-result").textContent);
      tell("The result is in the clipboard.");
    } catch {
      getSelection().selectAllChildren($("blind-result"));
      tell("The result is selected: copy it.");
    }
  }
}
