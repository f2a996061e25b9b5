// One stroke by every method, a card each; the chosen one is heard and seen. SPDX-License-Identifier: MIT
import { drawCards } from "./cards.js";
import { $ } from "./page.js";
import { METHODS } from "./rows.js";

const cards = [...document.querySelectorAll("#methods label")].map((label) =>
  ({ canvas: label.querySelector("canvas"), text: label.querySelector("output") }));

// The method that is heard and seen: 1 to METHODS.
export const method = () => Number($("controls").elements.method.value);

export function setMethod(number) {
  $("controls").elements.method.value = String(number);
}

// chosen(): after another method was chosen.
export function listen(chosen) {
  $("methods").addEventListener("change", chosen);
  addEventListener("keydown", ({ key, target, ctrlKey, altKey, metaKey }) => {
    const isText = target.matches?.("select, input:not([type=radio], [type=range])");
    const isBlind = document.documentElement.dataset.blind === "1";
    if (!isBlind && key >= "1" && key <= String(METHODS) && !isText && !ctrlKey && !altKey && !metaKey) {
      setMethod(Number(key));
      chosen();
    }
  });
}

// amplitude: of the touched surface, m.
export const drawComparison = (history, amplitude) => drawCards(cards, history, amplitude);
