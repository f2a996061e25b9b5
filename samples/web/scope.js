// The oscilloscope: height, force and f_t over the last second, the force's spectrum, and the ridges under the cursor.
// SPDX-License-Identifier: MIT
const SPAN_S = 1;
const TOP_HZ = 500;
const LENS_M = 0.006;

function prepare(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio);
  canvas.width = Math.max(1, canvas.clientWidth * ratio);
  canvas.height = Math.max(1, canvas.clientHeight * ratio);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name);
  context.font = "12px system-ui, sans-serif";
  return { context, colour, width: canvas.clientWidth, height: canvas.clientHeight };
}

export class History {
  constructor() {
    this.clear(1000);
  }

  clear(rate) {
    this.rate = rate;
    this.rows = []; // {height, force, f_t}
  }

  add(row) {
    this.rows.push(row);
    if (this.rows.length > 2 * SPAN_S * this.rate) {
      this.rows.splice(0, this.rows.length - SPAN_S * this.rate);
    }
  }

  latest(count) {
    return this.rows.slice(-count);
  }

  // The mean over the last `seconds`.
  mean(key, seconds) {
    const rows = this.latest(Math.max(1, Math.round(seconds * this.rate)));
    return rows.length > 0 ? rows.reduce((sum, row) => sum + row[key], 0) / rows.length : 0;
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
    const most = Math.max(least, ...values.map(Math.abs));
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

const WINDOW = 512;
const COSINES = Float64Array.from({ length: WINDOW }, (_, i) => Math.cos((2 * Math.PI * i) / WINDOW));

// Amplitudes at multiples of rate/512 by a direct sum: at most 256 lines, ten times per second.
function spectrum(values, rate) {
  const mean = values.reduce((sum, value) => sum + value, 0) / WINDOW;
  const weighted = Float64Array.from(values, (value, i) => (value - mean) * (1 - COSINES[i]));
  const lines = Math.min(WINDOW / 2, Math.floor((TOP_HZ * WINDOW) / rate));
  return Array.from({ length: lines }, (_, k) => {
    let re = 0;
    let im = 0;
    for (let i = 0; i < WINDOW; i++) {
      const turn = k * i;
      re += weighted[i] * COSINES[turn % WINDOW];
      im += weighted[i] * COSINES[(turn + WINDOW / 4) % WINDOW];
    }
    return (2 * Math.hypot(re, im)) / WINDOW;
  });
}

export function drawSpectrum(canvas, history) {
  const { context, colour, width, height } = prepare(canvas);
  const rows = history.latest(WINDOW);
  context.fillStyle = colour("--ink");
  context.fillText(`spectrum of the force, 0 to ${TOP_HZ} Hz`, 6, 13);
  if (rows.length < WINDOW) {
    return;
  }
  const lines = spectrum(rows.map((row) => row.force), history.rate);
  const most = Math.max(0.02, ...lines);
  context.fillStyle = colour("--accent");
  const wide = (width * history.rate) / WINDOW / TOP_HZ;
  lines.forEach((line, k) => {
    const tall = (line / most) * (height - 20);
    context.fillRect(k * wide, height - tall, Math.max(1, wide - 1), tall);
  });
}

// Draws Eq. 11 around the cursor, to scale; x to the right, y up.
export function drawLens(canvas, cycles, feel) {
  const { context, colour, width, height } = prepare(canvas);
  const [light, dark] = [colour("--paper"), colour("--accent")];
  const side = 2;
  for (let i = 0; cycles && i < width; i += side) {
    for (let j = 0; j < height; j += side) {
      const x = cycles[0] + feel[0] * LENS_M * (i / width - 0.5);
      const y = cycles[1] + feel[1] * LENS_M * (0.5 - j / height);
      const up = Math.cos(2 * Math.PI * x) > 0 === Math.cos(2 * Math.PI * y) > 0;
      context.fillStyle = up ? dark : light;
      context.fillRect(i, j, side, side);
    }
  }
  context.fillStyle = colour("--asked");
  context.beginPath();
  context.arc(width / 2, height / 2, 4, 0, 7);
  context.fill();
}

// Draws the mean push as a needle: upright: no push; flat: as much as the amplitude.
export function drawNeedle(canvas, share) {
  const { context, colour, width, height } = prepare(canvas);
  const turn = (Math.PI / 2) * Math.max(-1, Math.min(1, share));
  const reach = Math.max(0, Math.min(width / 2, height) - 6);
  context.strokeStyle = colour("--line");
  context.lineWidth = 2;
  context.beginPath();
  context.arc(width / 2, height - 4, reach, Math.PI, 0);
  context.stroke();
  context.strokeStyle = colour("--asked");
  context.beginPath();
  context.moveTo(width / 2, height - 4);
  context.lineTo(width / 2 + reach * Math.sin(turn), height - 4 - reach * Math.cos(turn));
  context.stroke();
}
