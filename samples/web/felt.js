// The sound of a texture as it is felt: the height times the stiffness, each value held for a tick, as a device holds its
// force. SPDX-License-Identifier: MIT
const FULL_N = 0.25; // plays at 0.5
const TOP_HZ = 500; // touch feels little above: second order, so that an image or alias that is felt is heard, too
const LOW_HZ = 20; // below, nothing is heard: a mean force is left out

export class Felt {
  constructor(rate, sampleRate = 48000) {
    this.samples = sampleRate / rate; // per tick
    this.owed = 0;
    const w = Math.tan((Math.PI * TOP_HZ) / sampleRate);
    const norm = 1 / (1 + Math.SQRT2 * w + w * w); // Butterworth, bilinear transform
    Object.assign(this, { b: w * w * norm, a1: 2 * (w * w - 1) * norm, a2: (1 - Math.SQRT2 * w + w * w) * norm });
    this.decay = Math.exp((-2 * Math.PI * LOW_HZ) / sampleRate);
    this.in = [0, 0];
    this.out = [0, 0];
    this.mean = 0;
  }

  // The sound of ticks with these forces, N.
  render(forces) {
    const samples = new Float32Array(Math.ceil(forces.length * this.samples + 1));
    let count = 0;
    for (const force of forces) {
      this.owed += this.samples;
      for (; this.owed >= 1; this.owed--) {
        samples[count++] = Math.max(-1, Math.min(1, this.filter((0.5 * force) / FULL_N)));
      }
    }
    return samples.slice(0, count);
  }

  filter(value) {
    this.mean = value + this.decay * (this.mean - value);
    const x = value - this.mean;
    const y = this.b * (x + 2 * this.in[0] + this.in[1]) - this.a1 * this.out[0] - this.a2 * this.out[1];
    this.in = [x, this.in[0]];
    this.out = [y, this.out[0]];
    return y;
  }
}
