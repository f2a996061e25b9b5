// A card for each method: the spectrum of its height, false tones and push. SPDX-License-Identifier: MIT
import { prepare } from "./page.js";
import { amplitudes, falseTones, findSteady, isRidges } from "./spectrum.js";

const TOP_HZ = 520;
const SHOWN_S = 1.5; // of history: a whole stroke of the hand is in it

function drawCard({ canvas, text }, lines, rate, frequency, said) {
  const { context, colour, width, height } = prepare(canvas);
  const step = rate / (2 * (lines.length - 1));
  const most = Math.max(1e-9, ...lines);
  const x = (hz) => (hz / TOP_HZ) * width;
  context.fillStyle = colour("--line");
  context.fillRect(0, height - 1, width, 1);
  lines.forEach((line, k) => {
    const tall = (line / most) * (height - 3);
    context.fillStyle = colour(isRidges(k * step, frequency, step) ? "--accent" : "--asked");
    context.fillRect(x(k * step) - 1, height - 1 - tall, Math.max(1.5, x(step) - 0.5), tall);
  });
  text.textContent = said;
}

// cards: {canvas, text, method: its place, if the cards are not all methods'}. history has rows {frequency, way, heights: m by
// each method}. amplitude: of the touched surface, m.
export function drawCards(cards, history, amplitude) {
  const rows = history.latest(SHOWN_S * history.rate);
  const steady = rows.length > 0 && rows[0].heights ? findSteady(rows, history.rate) : null;
  if (!steady) {
    return; // the last values stay
  }
  const part = rows.slice(steady.from, steady.from + steady.count);
  const { frequency } = part[part.length - 1];
  cards.forEach((card, i) => {
    const values = part.map(({ heights }) => heights[card.method ?? i]);
    const lines = amplitudes(values);
    const mean = Math.abs(values.reduce((sum, value) => sum + value, 0) / values.length);
    const silent = Math.max(...values.map(Math.abs)) * 20 < amplitude || Math.max(...lines) * 20 < amplitude;
    const wrong = Math.round(100 * falseTones(lines, history.rate, frequency));
    const push = amplitude > 0 ? Math.round((100 * mean) / amplitude) : 0;
    drawCard(card, lines, history.rate, frequency,
      silent ? "silent" : `${wrong} % false tones${push > 5 ? `, pushes ${push} %` : ""}`);
  });
}
