// The hand: a position of the HIP for each tick, from a pointer's samples, from held keys, or along a line.
// SPDX-License-Identifier: MIT

// A pointer is sampled 60 to 1000 times per second, in pixels, and its samples come once per frame. So the HIP follows
// late: at the mean of the samples' path over SPAN_MS that ended LATE_MS ago or, as is learned from the samples' ages,
// so much earlier that newer ones are always there.
const SPAN_MS = 12;
const LATE_MS = 20;
const LATEST_MS = 60;
const LEARNED = 0.05; // ms later per ms: the HIP is as much slower meanwhile
const PAUSE_MS = 50; // a longer gap between samples is a hand that rests
const PARTS = 12; // of the mean
const KEPT_MS = 150;
const PRESS_MS = 20; // from above the surface to the chosen depth
const ABOVE_M = 0.0003;
const KEY_SPEED = 0.06; // m/s
const REACH_M = 0.02; // a surface is searched this far above and below the last point

const add = (a, b, scale) => a.map((value, i) => value + scale * b[i]);
const mix = (a, b, share) => a.map((value, i) => value + share * (b[i] - value));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export class Hand {
  // cast(from, to): the surface that a straight line meets: {point, normal}, or null.
  constructor(cast) {
    this.cast = cast;
    this.depth = 0.001; // m
    this.late = this.needed = LATE_MS;
    this.until = 0; // ms: of the last position
    this.rest();
  }

  // Takes the HIP away.
  rest() {
    this.samples = []; // {t: ms, at: {point, normal} or null: lifted}
    this.drive = null; // by keys: {x, y: axes, way, at, left: m that are owed}
    this.way = null; // along a line: {middle, along, normal, speed, eased, follows}
    this.travelled = 0; // m
    this.pressed = 0; // ms
  }

  // rays: t (ms since 1970), from (3), to (3) of each sample of a pointer.
  stroke(rays) {
    if (this.drive || this.way) {
      this.rest();
    }
    const age = this.until - (this.samples.at(-1)?.t ?? Infinity);
    if (this.samples.at(-1)?.at && rays[0] - this.samples.at(-1).t < PAUSE_MS) {
      this.needed = Math.min(LATEST_MS, Math.max(this.needed, age));
    }
    for (let k = 0; k < rays.length; k += 7) {
      const t = Math.max(rays[k], this.samples.at(-1)?.t ?? 0);
      this.samples.push({ t, at: this.cast(rays.slice(k + 1, k + 4), rays.slice(k + 4, k + 7)) });
    }
  }

  // Ends a stroke by pointer or keys at t, ms since 1970.
  lift(t) {
    this.drive = null;
    if (this.samples.length > 0) {
      this.samples.push({ t: Math.max(t, this.samples.at(-1).t), at: null });
    }
  }

  // Keys: moves on along the surface at a steady speed while `way` is not [0, 0], and 2 mm for each key.
  hold({ way, begins, anchor, normal, x }) {
    this.drive ??= { at: this.latest ?? { point: anchor, normal }, left: 0 };
    this.samples = [];
    this.way = null;
    const moves = way[0] !== 0 || way[1] !== 0;
    Object.assign(this.drive, { x, moves, way: moves ? way : this.drive.way ?? way });
    this.drive.left += begins ? 0.002 : 0;
  }

  travel(way) {
    this.rest();
    this.way = way;
  }

  // `count` positions, the first at `begin` (ms since 1970), three numbers each; NaN: no HIP.
  positions(count, rate, begin) {
    const found = new Float64Array(3 * count);
    this.until = begin + (count * 1000) / rate;
    for (let k = 0; k < count; k++) {
      this.late = Math.min(this.needed, this.late + (LEARNED * 1000) / rate);
      const at = this.way ? this.onLine(rate) : this.drive ? this.byKeys(rate) : this.byPointer(begin + (k * 1000) / rate);
      this.pressed = at ? this.pressed + 1000 / rate : 0;
      this.latest = at;
      found.set(at ? this.press(at) : [NaN, NaN, NaN], 3 * k);
    }
    const old = this.samples.findLastIndex(({ t }) => t < begin - KEPT_MS);
    this.samples.splice(0, Math.max(0, old));
    return found;
  }

  press({ point, normal }) {
    const share = Math.min(1, this.pressed / PRESS_MS);
    return add(point, normal, ABOVE_M - share * (ABOVE_M + this.depth));
  }

  byPointer(now) {
    const last = this.samples.findLastIndex(({ t }) => t <= now - this.late);
    if (last < 0 || !this.samples[last].at) {
      return null;
    }
    let first = last;
    while (first > 0 && this.samples[first - 1].at) {
      first--;
    }
    const path = this.samples.slice(first, this.samples[last + 1]?.at ? last + 2 : last + 1);
    const sum = { point: [0, 0, 0], normal: [0, 0, 0] };
    for (let i = 0, k = 0; i < PARTS; i++) {
      const t = now - this.late - SPAN_MS * (1 - (i + 0.5) / PARTS);
      while (k + 2 < path.length && path[k + 1].t <= t) {
        k++;
      }
      const [a, b] = [path[k], path[Math.min(k + 1, path.length - 1)]];
      const share = b.t > a.t ? Math.max(0, Math.min(1, (t - a.t) / (b.t - a.t))) : 0;
      sum.point = add(sum.point, mix(a.at.point, b.at.point, share), 1 / PARTS);
      sum.normal = add(sum.normal, mix(a.at.normal, b.at.normal, share), 1 / PARTS);
    }
    return { point: sum.point, normal: sum.normal.map((value) => value / (Math.hypot(...sum.normal) || 1)) };
  }

  byKeys(rate) {
    const { drive } = this;
    if (drive.moves || drive.left > 0) {
      const y = cross(drive.at.normal, drive.x);
      const step = KEY_SPEED / rate / Math.hypot(...drive.way);
      const next = add(add(drive.at.point, drive.x, step * drive.way[0]), y, step * drive.way[1]);
      drive.at = this.below(next, drive.at.normal) ?? drive.at; // at an edge it stays
      drive.left = Math.max(0, drive.left - KEY_SPEED / rate);
    }
    return drive.at;
  }

  // To and fro along a line at a steady speed, or with `eased` the maximum of a sine.
  onLine(rate) {
    const { middle, along, normal, speed, eased, follows } = this.way;
    const way = (this.travelled += speed / rate) / Math.hypot(...along); // in units of half the line
    const point = add(middle, along, eased ? -Math.cos(way) : 1 - Math.abs((way % 4) - 2));
    return (follows && this.below(point, normal)) || { point, normal };
  }

  // The surface at a point near it, or null.
  below(point, normal) {
    return this.cast(add(point, normal, REACH_M), add(point, normal, -REACH_M));
  }
}
