// The oscilloscope: height, force and f_t over the last second. SPDX-License-Identifier: MIT
import { prepare } from "./page.js";
import { AT, length } from "./rows.js";

const SPAN_S = 1;
const KEPT_S = 1.5;

export class History {
  constructor() {
    this.clear(1000);
  }

  clear(rate) {
    this.rate = rate;
    this.rows = []; // {height, force, frequency, way, heights}
  }

  // A tick, and its heights by each method, if they are known.
  add(row, heights) {
    const [vx, vy] = row.subarray(AT.velocity, AT.velocity + 2);
    this.rows.push({ height: row[AT.height], force: length(row), frequency: row[AT.frequency],
      way: Math.sign(Math.abs(vx) >= Math.abs(vy) ? vx : vy), heights });
    if (this.rows.length > 2 * KEPT_S * this.rate) {
      this.rows.splice(0, this.rows.length - KEPT_S * this.rate);
    }
  }

  latest(count) {
    return this.rows.slice(-count);
  }

  // The mean height over the last `seconds`, m; 0 if less than a ridge was crossed: at rest a height is no error.
  net(seconds) {
    const rows = this.latest(Math.max(1, Math.round(seconds * this.rate)));
    const crossed = rows.reduce((sum, { frequency }) => sum + frequency / this.rate, 0);
    return crossed >= 1 ? rows.reduce((sum, { height }) => sum + height, 0) / rows.length : 0;
  }
}

export function drawScope(canvas, history) {
  const { context, colour, width, height } = prepare(canvas);
  const rows = history.latest(SPAN_S * history.rate);
  const traces = [
    ["height", "mm", 1000, "--accent", 0.05, 2],
    ["force", "N", 1, "--ink", 0.1, 2],
    ["frequency", "Hz", 1, "--asked", 50, 0],
  ];
  traces.forEach(([key, unit, scale, name, least, digits], index) => {
    const top = (index * height) / 3;
    const values = rows.map((row) => row[key] * scale);
    const most = values.reduce((found, value) => Math.max(found, Math.abs(value)), least);
    const low = key === "height" ? -most : 0;
    context.fillStyle = context.strokeStyle = colour(name);
    context.fillText(`${key} ${(values.at(-1) ?? 0).toFixed(digits)} of ${most.toFixed(digits)} ${unit}`, 6, top + 13);
    context.beginPath();
    values.forEach((value, i) => {
      const x = width * (1 - (values.length - i) / (SPAN_S * history.rate));
      context.lineTo(x, top + height / 3 - 3 - ((value - low) / (most - low)) * (height / 3 - 20));
    });
    context.stroke();
  });
}
