// The haptic thread of the page: ticks the scene in WebAssembly at its update rate, and sends the results some 60 times
// per second. SPDX-License-Identifier: MIT
import makeKnurl from "./knurl.mjs";
import { ROW } from "./rows.js";

const MOST = 2000; // ticks at once
const BATCH_MS = 12;
const GIVE_UP_MS = 100; // longer gaps, such as a tab in the background, are skipped
const SMOOTH_S = 0.012; // pointers are sampled 60 to 120 times per second: a filter smooths their steps
const SAMPLE_RATE = 48000;

// The first message has the compiled WebAssembly; earlier messages are answered once all is ready.
const early = [];
const compiled = await new Promise((resolve) => {
  onmessage = (event) => (event.data.kind === "begin" ? resolve(event.data.compiled) : early.push(event));
});
const knurl = await makeKnurl({
  instantiateWasm: (imports, done) => {
    WebAssembly.instantiate(compiled, imports).then(done);
    return {};
  },
});
const memory = {
  positions: knurl._malloc(MOST * 3 * 8),
  rows: knurl._malloc(MOST * ROW * 8),
  numbers: knurl._malloc(15 * 8),
  samples: knurl._malloc(MOST * 480 * 4),
};
const state = { loaded: false, rate: 1000, last: 0, target: null, hip: null, speed: [0, 0, 0], way: null,
  travelled: 0 };

function withText(text, use) {
  const bytes = new TextEncoder().encode(text);
  const at = knurl._malloc(bytes.length + 1);
  knurl.HEAPU8.set(bytes, at);
  knurl.HEAPU8[at + bytes.length] = 0;
  try {
    return use(at);
  } finally {
    knurl._free(at);
  }
}

function load(bytes, name) {
  const at = knurl._malloc(Math.max(1, bytes.length));
  if (!at) {
    return `${name}: ${bytes.length} bytes are more than this page has memory for`;
  }
  knurl.HEAPU8.set(bytes, at);
  const result = withText(name, (text) => knurl._web_load(at, bytes.length, text));
  knurl._free(at);
  if (result) {
    return knurl.UTF8ToString(knurl._web_message());
  }
  state.loaded = true;
  state.hip = state.target = state.way = null;
  return "";
}

function surfaces() {
  return Array.from({ length: knurl._web_count() }, (_, index) => {
    const name = knurl.UTF8ToString(knurl._web_surface(index, memory.numbers));
    const n = Array.from(knurl.HEAPF64.subarray(memory.numbers / 8, memory.numbers / 8 + 15));
    return { name, feel: n.slice(0, 6), anchor: n.slice(6, 9), normal: n.slice(9, 12), x: n.slice(12, 15) };
  });
}

// Ticks at positions, three numbers each; returns one row per tick.
function tick(positions) {
  const count = positions.length / 3;
  knurl.HEAPF64.set(positions, memory.positions / 8);
  knurl._web_tick(count, memory.positions, memory.rows);
  return knurl.HEAPF64.slice(memory.rows / 8, memory.rows / 8 + count * ROW);
}

// Renders the sound of `count` ticks.
function hear(count) {
  const frames = Math.round((count * SAMPLE_RATE) / state.rate);
  knurl._web_sound(memory.samples, frames);
  return knurl.HEAPF32.slice(memory.samples / 4, memory.samples / 4 + frames);
}

// Moves the HIP to the pointer: a critically damped spring.
function follow(count) {
  const positions = new Float64Array(3 * count);
  const dt = 1 / state.rate;
  const omega = 2 / SMOOTH_S;
  if (!state.target) {
    state.hip = null;
    return positions.fill(NaN);
  }
  state.hip ??= [...state.target];
  for (let k = 0; k < count; k++) {
    for (let i = 0; i < 3; i++) {
      const away = state.target[i] - state.hip[i];
      state.speed[i] += dt * (omega * omega * away - 2 * omega * state.speed[i]);
      state.hip[i] += dt * state.speed[i];
      positions[3 * k + i] = state.hip[i];
    }
  }
  return positions;
}

// Moves the HIP to and fro along a line: {middle, along: to its end, speed: m/s, eased: speed is the maximum of a
// sine}.
function travel(count) {
  const positions = new Float64Array(3 * count);
  const { middle, along, speed, eased } = state.way;
  const half = Math.hypot(...along);
  for (let k = 0; k < count; k++) {
    const way = (state.travelled += speed / state.rate) / half; // in units of half the line
    const at = eased ? -Math.cos(way) : 1 - Math.abs((way % 4) - 2);
    for (let i = 0; i < 3; i++) {
      positions[3 * k + i] = middle[i] + at * along[i];
    }
  }
  return positions;
}

function tickOn() {
  const now = performance.now();
  if (!state.loaded || now - state.last > GIVE_UP_MS) {
    state.last = now;
    return;
  }
  const count = Math.min(MOST, Math.floor(((now - state.last) * state.rate) / 1000));
  if (count === 0) {
    return;
  }
  state.last += (count * 1000) / state.rate;
  const started = performance.now();
  const rows = tick(state.way ? travel(count) : follow(count));
  const cost = ((performance.now() - started) * 1000) / count;
  const samples = hear(count);
  postMessage({ kind: "ticks", rows, samples, cost }, [rows.buffer, samples.buffer]);
}

const answers = {
  load: ({ bytes, name }) => ({ error: load(new Uint8Array(bytes), name), surfaces: surfaces() }),
  move: ({ target }) => {
    state.target = target;
    state.way = null;
  },
  travel: ({ way }) => {
    state.way = way;
    state.travelled = 0;
    state.hip = state.target = null;
  },
  feel: ({ index, feel }) => {
    knurl.HEAPF64.set(feel, memory.numbers / 8);
    return { error: knurl._web_feel(index, memory.numbers) ? knurl.UTF8ToString(knurl._web_message()) : "" };
  },
  device: ({ rate, resolution, protections }) => {
    state.rate = rate;
    return { error: knurl._web_device(rate, resolution, protections) ? knurl.UTF8ToString(knurl._web_message()) : "" };
  },
  // Plays a new device at given positions, as fast as possible, and then its sound: for comparisons.
  play: ({ positions, ...device }) => {
    answers.device(device);
    const count = positions.length / 3;
    const started = performance.now();
    const rows = tick(positions);
    const cost = ((performance.now() - started) * 1000) / count;
    const samples = Array.from({ length: Math.ceil(count / BATCH_MS) }, (_, k) => [...hear(Math.min(BATCH_MS, count - BATCH_MS * k))]);
    return { rows, samples: Float32Array.from(samples.flat()), cost };
  },
};

onmessage = ({ data }) => {
  const answer = answers[data.kind](data);
  if (answer) {
    postMessage({ kind: "answer", to: data.kind, id: data.id, ...answer });
  }
};
early.forEach(onmessage);
setInterval(tickOn, BATCH_MS);
