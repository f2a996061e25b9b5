// Spectra of heights, and the share of false tones in them, as `knurl study` measures it (samples/study/steady.h).
// SPDX-License-Identifier: MIT
const LONGEST_S = 0.512;
const SHORTEST_S = 0.1;
const TOLERANCE = 0.05; // of f_t: a line this near to an odd multiple of f_t belongs to the ridges
const TOLERANCE_HZ = 4;

function transform(re, im) { // in place; a power of two
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    for (let bit = n >> 1; (j ^= bit) < bit; bit >>= 1) { /* bits reversed */ }
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
    }
  }
  for (let half = 1; half < n; half *= 2) {
    for (let k = 0; k < half; k++) {
      const [c, s] = [Math.cos((Math.PI * k) / half), -Math.sin((Math.PI * k) / half)];
      for (let i = k; i < n; i += 2 * half) {
        const [x, y] = [re[i + half] * c - im[i + half] * s, re[i + half] * s + im[i + half] * c];
        [re[i + half], im[i + half]] = [re[i] - x, im[i] - y];
        re[i] += x;
        im[i] += y;
      }
    }
  }
}

// Amplitudes at multiples of rate / values.length, up to half the rate; Hann's window.
export function amplitudes(values) {
  const n = values.length;
  const mean = values.reduce((sum, value) => sum + value, 0) / n;
  const re = Float64Array.from(values, (value, i) => (value - mean) * (1 - Math.cos((2 * Math.PI * i) / n)));
  const im = new Float64Array(n);
  transform(re, im);
  return Array.from({ length: n / 2 + 1 }, (_, k) => (2 * Math.hypot(re[k], im[k])) / n);
}

// Hz, within which a line belongs to the ridges; Hann's window spreads it over a step to each side.
const nearness = (frequency, step) => Math.max(TOLERANCE * frequency, TOLERANCE_HZ) + step;

// Whether hz is near an odd multiple of the ridges' frequency.
export function isRidges(hz, frequency, step) {
  const odd = Math.max(1, 2 * Math.floor(hz / frequency / 2) + 1);
  return Math.abs(hz - odd * frequency) <= nearness(frequency, step);
}

// The share of the varying power up to half the rate that belongs to no ridge. lines: amplitudes().
export function falseTones(lines, rate, frequency) {
  const step = rate / (2 * (lines.length - 1));
  let [all, far] = [0, 0];
  lines.forEach((line, k) => {
    const power = k > 0 ? line * line : 0;
    all += power;
    far += isRidges(k * step, frequency, step) ? 0 : power;
  });
  return all > 0 ? far / all : 1; // a constant is no vibration
}

// The longest part of the rows {frequency, way} at a steady speed, in one direction, or the newest of equally long ones:
// {from, count: a power of two}, or null.
export function findSteady(rows, rate) {
  const [least, most] = [SHORTEST_S * rate, LONGEST_S * rate];
  let found = null;
  for (let end = rows.length; end > least;) {
    const { frequency, way } = rows[end - 1];
    let from = end - 1;
    while (from > 0 && end - from < most && rows[from - 1].way === way && frequency > 0 &&
      Math.abs(rows[from - 1].frequency / frequency - 1) < 0.02) {
      from--;
    }
    const count = 2 ** Math.floor(Math.log2(end - from));
    if (end - from >= least && count > (found?.count ?? 0)) {
      found = { from: end - count, count };
    }
    end = from;
  }
  return found;
}
