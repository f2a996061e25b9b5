// The haptic thread of the page: ticks the scene in WebAssembly at its update rate, and sends the results some 80 times
// per second. SPDX-License-Identifier: MIT
import { Knurl, MOST } from "./core.js";
import { Hand } from "./hand.js";
import { Inverse3 } from "./inverse3.js";
import { ROW } from "./rows.js";

const BATCH_MS = 12;
const GIVE_UP_MS = 100; // longer gaps, such as a tab in the background, are skipped
const HANDS = ["stroke", "lift", "hold", "travel"];
const QUICK = ["depth", "feel", "inverse3", "voice"]; // other messages may take longer than an Inverse3 may wait

// The first message has the compiled WebAssembly; earlier messages are answered once all is ready.
const early = [];
const compiled = await new Promise((resolve) => {
  onmessage = (event) => (event.data.kind === "begin" ? resolve(event.data.compiled) : early.push(event));
});
const knurl = await Knurl.create({
  instantiateWasm: (imports, done) => {
    WebAssembly.instantiate(compiled, imports).then(done);
    return {};
  },
});
const { module, memory } = knurl;
const hand = new Hand((from, to) => knurl.cast(from, to));
const state = { loaded: false, settings: {}, last: 0, ms: 0, ticks: 0 };

// The error message of something that may fail, or "".
function errorOf(act) {
  try {
    act();
    return "";
  } catch ({ message }) {
    return message;
  }
}

// Ticks, with the samples for actuators.
function tick(positions, gain = 1) {
  const started = performance.now();
  const ticks = knurl.tick(positions, gain);
  state.ms += performance.now() - started;
  state.ticks += positions.length / 3;
  return { ...ticks, ...(knurl.hasVoice ? knurl.speak(positions.length / 3) : {}) };
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
  const count = Math.min(MOST, Math.floor(((now - state.last) * knurl.rate) / 1000));
  if (count === 0) {
    return;
  }
  const ticks = tick(hand.positions(count, knurl.rate, performance.timeOrigin + state.last));
  state.last += (count * 1000) / knurl.rate;
  show(ticks);
}

// An Inverse3 in place of the hand.
const device = {
  ticked: [], // to be shown
  get rate() {
    return knurl.rate;
  },
  begin(model, id) {
    Object.assign(this, { model, ticked: [] });
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
  return errorOf(() => knurl.setDevice({ ...state.settings, ...device.model }));
}

function coordinates({ points, depth }) {
  const found = new Float32Array(points.length / 2);
  for (let at = 0; at < points.length; at += 6 * MOST) {
    const some = points.subarray(at, at + 6 * MOST);
    module.HEAPF64.set(some, memory.positions / 8);
    module._web_coordinates(some.length / 6, memory.positions, depth, memory.rows);
    found.set(module.HEAPF32.subarray(memory.rows / 4, memory.rows / 4 + some.length / 2), at / 2);
  }
  return { found };
}

const answers = {
  load: ({ bytes, name }) => {
    const error = errorOf(() => knurl.load(bytes, name));
    if (!error) {
      state.loaded = true;
      hand.rest();
    }
    return { error, surfaces: knurl.surfaces() };
  },
  stroke: ({ rays }) => hand.stroke(rays),
  lift: ({ t }) => hand.lift(t),
  hold: (keys) => hand.hold(keys),
  depth: ({ depth }) => {
    hand.depth = depth;
  },
  travel: ({ way }) => (way ? hand.travel(way) : hand.rest()),
  feel: ({ index, feel }) => ({ error: errorOf(() => knurl.setFeel(index, feel)) }),
  device: ({ rate, resolution, protections }) => {
    state.settings = { rate, resolution, protections };
    return { error: setDevice() };
  },
  voice: ({ on }) => knurl.setVoice(on),
  inverse3: ({ port, isHidden }) => {
    if (port && !device.client) {
      device.client = new Inverse3(port, device);
    } else if (port === 0) {
      device.client?.end("");
    }
    if (device.client) {
      device.client.isHidden = isHidden;
      if (isHidden) { // so it is when the tab is closed, after which nothing is sent
        device.client.halt();
      }
    }
  },
  survey: ({ bytes, name }) => ({ error: errorOf(() => knurl.withFile(bytes, name, module._web_survey)) }),
  coordinates,
  surveyed: () => module._web_survey_end(),
  tag: ({ bytes, name, node, tag }) => {
    const error = errorOf(() => knurl.withFile(bytes, name, (at, size, text) =>
      knurl.withText(JSON.stringify(tag), (json) => module._web_tag(at, size, text, node, json))));
    const at = module._web_written();
    return { error, bytes: error ? null : module.HEAPU8.slice(at, at + module._web_written_size()).buffer };
  },
  // Plays a new device at given positions, as fast as possible: for comparisons.
  play: ({ positions, ...settings }) => {
    answers.device(settings);
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
  if (!QUICK.includes(data.kind)) {
    device.client?.resume();
  }
  if (answer) {
    postMessage({ kind: "answer", to: data.kind, id: data.id, ...answer });
  }
};
early.forEach(onmessage);
setInterval(tickOn, BATCH_MS);
