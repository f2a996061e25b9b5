// The library in WebAssembly: a scene with one HIP. For the page's worker, and for programs by npm (npm/README.md).
// SPDX-License-Identifier: MIT
import makeModule from "./knurl.mjs";
import { METHODS, ROW } from "./rows.js";

export const MOST = 2000; // ticks, rays or points at once
const SURFACE = 17; // numbers of a surface
export const SAMPLE_RATE = 48000; // of the voice for actuators
const MOST_SAMPLES = 96; // a tick, at 500 Hz; at a lower rate fewer ticks fill the buffer

export class Knurl {
  // options: of Emscripten's module, such as locateFile.
  static async create(options) {
    return new Knurl(await makeModule(options));
  }

  constructor(module) {
    this.module = module;
    this.memory = { positions: module._malloc(MOST * 6 * 8), rows: module._malloc(MOST * ROW * 8),
      heights: module._malloc(MOST * METHODS * 4), samples: module._malloc(MOST * MOST_SAMPLES * 4),
      numbers: module._malloc(SURFACE * 8) };
    this.rate = 1000;
    this.voiced = 0; // samples that are due
    this.hasVoice = false;
  }

  doubles(at, count) {
    return this.module.HEAPF64.slice(at / 8, at / 8 + count);
  }

  check(result) {
    if (result) {
      throw new Error(this.module.UTF8ToString(this.module._web_message()));
    }
  }

  // Calls use(address, size) with a copy of the bytes, ended by a 0.
  withBytes(bytes, use, what = "text") {
    const { module } = this;
    const at = module._malloc(bytes.length + 1);
    if (!at) {
      throw new Error(`${what}: ${bytes.length} bytes are more than there is memory for`);
    }
    module.HEAPU8.set(bytes, at);
    module.HEAPU8[at + bytes.length] = 0;
    try {
      return use(at, bytes.length);
    } finally {
      module._free(at);
    }
  }

  withText(text, use) {
    return this.withBytes(new TextEncoder().encode(text), use);
  }

  // Calls a function of a file: use(address, size, name).
  withFile(bytes, name, use) {
    this.withBytes(new Uint8Array(bytes), (at, size) => this.withText(name, (text) => this.check(use(at, size, text))), name);
  }

  load(bytes, name) {
    this.withFile(bytes, name, this.module._web_load);
  }

  surfaces() {
    const { module, memory } = this;
    return Array.from({ length: module._web_count() }, (_, index) => {
      const name = module.UTF8ToString(module._web_surface(index, memory.numbers));
      const n = [...this.doubles(memory.numbers, SURFACE)];
      return { name, feel: n.slice(0, 6), anchor: n.slice(6, 9), normal: n.slice(9, 12), x: n.slice(12, 15), reach: n.slice(15) };
    });
  }

  setFeel(index, feel) {
    this.module.HEAPF64.set(feel, this.memory.numbers / 8);
    this.check(this.module._web_feel(index, this.memory.numbers));
  }

  // force, stiffness: limits of an Inverse3; 0: the HIP is the caller's.
  setDevice({ rate = 1000, resolution = 0, protections = 15, force = 0, stiffness = 0 }) {
    this.check(this.module._web_device(rate, resolution, protections, force, stiffness));
    this.rate = rate;
    this.setVoice(this.hasVoice);
  }

  cast(from, to) {
    const { module, memory } = this;
    module.HEAPF64.set([...from, ...to], memory.numbers / 8);
    const found = memory.numbers + 6 * 8;
    return module._web_cast(memory.numbers, found) ? { point: [...this.doubles(found, 3)], normal: [...this.doubles(found + 24, 3)] } : null;
  }

  // Ticks at positions, three numbers each, with a gain on the force; returns a row per tick, and the heights by each method.
  tick(positions, gain = 1) {
    const { module, memory } = this;
    const count = positions.length / 3;
    if (!(count <= MOST)) {
      throw new Error(`expected at most ${MOST} positions at once, found ${count}`);
    }
    module.HEAPF64.set(positions, memory.positions / 8);
    module._web_tick(count, memory.positions, gain, memory.rows, memory.heights);
    const at = memory.heights / 4;
    return { rows: this.doubles(memory.rows, count * ROW), heights: module.HEAPF32.slice(at, at + count * METHODS) };
  }

  setVoice(on) {
    this.hasVoice = on;
    this.check(this.module._web_voice(on ? this.rate : 0, SAMPLE_RATE));
  }

  // The last ticks' force for actuators: samples, and the strengths of a gamepad's two motors.
  speak(count) {
    const { module, memory } = this;
    this.voiced += (count * SAMPLE_RATE) / this.rate;
    const due = Math.floor(this.voiced);
    const samples = Math.min(due, MOST * MOST_SAMPLES);
    this.voiced -= due;
    module._web_voice_fill(memory.samples, samples, memory.numbers);
    const at = memory.samples / 4;
    return { coil: module.HEAPF32.slice(at, at + samples), rumble: [...this.doubles(memory.numbers, 2)] };
  }
}
