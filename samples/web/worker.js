// The haptic thread of the page: ticks the scene in WebAssembly at its update rate, and sends the results some 80 times
// per second. SPDX-License-Identifier: MIT
import { Hand } from "./hand.js";
import { Inverse3 } from "./inverse3.js";
import makeKnurl from "./knurl.mjs";
import { METHODS, ROW } from "./rows.js";

const MOST = 2000; // ticks, rays or points at once
const BATCH_MS = 12;
const GIVE_UP_MS = 100; // longer gaps, such as a tab in the background, are skipped
const SURFACE = 17; // numbers of a surface
const SAMPLE_RATE = 48000; // of the voice for actuators
const MOST_SAMPLES = 96; // a tick, at 500 Hz

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
  positions: knurl._malloc(MOST * 6 * 8),
  rows: knurl._malloc(MOST * ROW * 8),
  heights: knurl._malloc(MOST * METHODS * 4),
  samples: knurl._malloc(MOST * MOST_SAMPLES * 4),
  numbers: knurl._malloc(SURFACE * 8),
};
const HANDS = ["stroke", "lift", "hold", "travel"];
const QUICK = ["depth", "feel", "inverse3", "voice"]; // other messages may take longer than an Inverse3 may wait
const state = { loaded: false, voice: false, rate: 1000, resolution: 0, protections: 15, last: 0, ms: 0, ticks: 0, owed: 0 };

const doubles = (at, count) => knurl.HEAPF64.slice(at / 8, at / 8 + count);
const message = (result) => (result ? knurl.UTF8ToString(knurl._web_message()) : "");

// Calls use(address, size) with a copy of the bytes, ended by a 0; undefined without memory for it.
function withBytes(bytes, use) {
  const at = knurl._malloc(bytes.length + 1);
  if (!at) {
    return undefined;
  }
  knurl.HEAPU8.set(bytes, at);
  knurl.HEAPU8[at + bytes.length] = 0;
  try {
    return use(at, bytes.length);
  } finally {
    knurl._free(at);
  }
}

const withText = (text, use) => withBytes(new TextEncoder().encode(text), use);

// Calls a function of a file: use(address, size, name). Returns its error message, or "".
function withFile(bytes, name, use) {
  const error = withBytes(new Uint8Array(bytes), (at, size) => withText(name, (text) => message(use(at, size, text))));
  return error ?? `${name}: ${bytes.byteLength} bytes are more than this page has memory for`;
}

function cast(from, to) {
  knurl.HEAPF64.set([...from, ...to], memory.numbers / 8);
  const found = memory.numbers + 6 * 8;
  return knurl._web_cast(memory.numbers, found) ? { point: [...doubles(found, 3)], normal: [...doubles(found + 24, 3)] } : null;
}

const hand = new Hand(cast);

function surfaces() {
  return Array.from({ length: knurl._web_count() }, (_, index) => {
    const name = knurl.UTF8ToString(knurl._web_surface(index, memory.numbers));
    const n = [...doubles(memory.numbers, SURFACE)];
    return { name, feel: n.slice(0, 6), anchor: n.slice(6, 9), normal: n.slice(9, 12), x: n.slice(12, 15), reach: n.slice(15) };
  });
}

// The ticks' force for actuators: samples, and the strengths of a gamepad's two motors.
function speak(count) {
  state.owed += (count * SAMPLE_RATE) / state.rate;
  const samples = Math.floor(state.owed);
  state.owed -= samples;
  knurl._web_voice_fill(memory.samples, samples, memory.numbers);
  return { coil: knurl.HEAPF32.slice(memory.samples / 4, memory.samples / 4 + samples), rumble: [...doubles(memory.numbers, 2)] };
}

// Ticks at positions, three numbers each, with a gain on the force; returns a row per tick, the heights by each method,
// and what actuators play.
function tick(positions, gain = 1) {
  const count = positions.length / 3;
  knurl.HEAPF64.set(positions, memory.positions / 8);
  const started = performance.now();
  knurl._web_tick(count, memory.positions, gain, memory.rows, memory.heights);
  state.ms += performance.now() - started;
  state.ticks += count;
  const at = memory.heights / 4;
  return { rows: doubles(memory.rows, count * ROW), heights: knurl.HEAPF32.slice(at, at + count * METHODS),
    ...(state.voice ? speak(count) : {}) };
}

// us per tick, over a thousand or more: clocks of browsers are coarse. Undefined until then.
function takeCost() {
  if (state.ticks < 1000) {
    return undefined;
  }
  const cost = (1000 * state.ms) / state.ticks;
  state.ms = state.ticks = 0;
  return cost;
}

function show(ticks) {
  postMessage({ kind: "ticks", ...ticks, cost: takeCost() }, [ticks.rows.buffer, ticks.heights.buffer]);
}

function tickOn() {
  const now = performance.now();
  if (device.client) {
    device.show();
  }
  if (!state.loaded || device.client || now - state.last > GIVE_UP_MS) {
    state.last = now;
    return;
  }
  const count = Math.min(MOST, Math.floor(((now - state.last) * state.rate) / 1000));
  if (count === 0) {
    return;
  }
  const ticks = tick(hand.positions(count, state.rate, performance.timeOrigin + state.last));
  state.last += (count * 1000) / state.rate;
  show(ticks);
}

// An Inverse3 in place of the hand.
const device = {
  ticked: [], // to be shown
  get rate() {
    return state.rate;
  },
  begin(model, id) {
    this.model = model;
    setDevice();
    postMessage({ kind: "inverse3", on: `${model.name} ${id}`, most: model.force });
  },
  tick(positions, gain) {
    if (!state.loaded) {
      return [0, 0, 0];
    }
    const ticks = tick(positions, gain);
    this.ticked.push(ticks);
    return [...ticks.rows.subarray(ticks.rows.length - ROW, ticks.rows.length - ROW + 3)];
  },
  rest() {
    this.tick([NaN, NaN, NaN], 0);
  },
  trouble: (why) => postMessage({ kind: "inverse3", trouble: why }),
  numbers: (exchanges) => postMessage({ kind: "inverse3", exchanges }),
  end(why) {
    this.client = this.model = null;
    setDevice();
    postMessage({ kind: "inverse3", off: why });
  },
  show() {
    const join = (Type, key) => Type.from(this.ticked.flatMap((ticks) => [...ticks[key] ?? []]));
    if (this.ticked.length > 0) {
      show({ rows: join(Float64Array, "rows"), heights: join(Float32Array, "heights"), coil: join(Float32Array, "coil"),
        rumble: this.ticked.at(-1).rumble });
      this.ticked = [];
    }
  },
};

function setDevice() {
  const { rate, resolution, protections, voice } = state;
  knurl._web_voice(voice ? rate : 0, SAMPLE_RATE);
  return message(knurl._web_device(rate, resolution, protections, device.model?.force ?? 0, device.model?.stiffness ?? 0));
}

function coordinates({ points, depth }) {
  const found = new Float32Array(points.length / 2);
  for (let at = 0; at < points.length; at += 6 * MOST) {
    const some = points.subarray(at, at + 6 * MOST);
    knurl.HEAPF64.set(some, memory.positions / 8);
    knurl._web_coordinates(some.length / 6, memory.positions, depth, memory.rows);
    found.set(knurl.HEAPF32.subarray(memory.rows / 4, memory.rows / 4 + some.length / 2), at / 2);
  }
  return { found };
}

const answers = {
  load: ({ bytes, name }) => {
    const error = withFile(bytes, name, knurl._web_load);
    if (!error) {
      state.loaded = true;
      hand.rest();
    }
    return { error, surfaces: surfaces() };
  },
  stroke: ({ rays }) => hand.stroke(rays),
  lift: ({ t }) => hand.lift(t),
  hold: (keys) => hand.hold(keys),
  depth: ({ depth }) => {
    hand.depth = depth;
  },
  travel: ({ way }) => (way ? hand.travel(way) : hand.rest()),
  feel: ({ index, feel }) => {
    knurl.HEAPF64.set(feel, memory.numbers / 8);
    return { error: message(knurl._web_feel(index, memory.numbers)) };
  },
  device: ({ rate, resolution, protections }) => {
    Object.assign(state, { rate, resolution, protections });
    return { error: setDevice() };
  },
  voice: ({ on }) => {
    state.voice = on;
    knurl._web_voice(on ? state.rate : 0, SAMPLE_RATE);
  },
  inverse3: ({ port, isHidden }) => {
    if (device.client) {
      device.client.isHidden = isHidden;
    }
    if (port && !device.client) {
      device.client = new Inverse3(port, device);
      device.client.isHidden = isHidden;
    } else if (port === 0) {
      device.client?.end("");
    }
  },
  survey: ({ bytes, name }) => ({ error: withFile(bytes, name, knurl._web_survey) }),
  coordinates,
  surveyed: () => knurl._web_survey_end(),
  tag: ({ bytes, name, node, tag }) => {
    const error = withFile(bytes, name, (at, size, text) =>
      withText(JSON.stringify(tag), (json) => knurl._web_tag(at, size, text, node, json)));
    const at = knurl._web_written();
    return { error, bytes: error ? null : knurl.HEAPU8.slice(at, at + knurl._web_written_size()).buffer };
  },
  // Plays a new device at given positions, as fast as possible: for comparisons.
  play: ({ positions, ...device }) => {
    answers.device(device);
    const started = performance.now();
    const ticks = tick(positions);
    return { ...ticks, cost: ((performance.now() - started) * 1000) / (positions.length / 3) };
  },
};

onmessage = ({ data }) => {
  if (device.client && HANDS.includes(data.kind)) {
    return;
  }
  if (!QUICK.includes(data.kind)) {
    device.client?.halt();
  }
  const answer = answers[data.kind](data);
  if (answer) {
    postMessage({ kind: "answer", to: data.kind, id: data.id, ...answer });
  }
};
early.forEach(onmessage);
setInterval(tickOn, BATCH_MS);
