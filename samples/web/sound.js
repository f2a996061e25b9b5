// The sound of the ticks, as they are felt, and samples for an actuator on another output, each by an AudioWorklet's
// queue. They share no memory, so any web server will do.
// SPDX-License-Identifier: MIT
import { Felt } from "./felt.js";
import { AT, ROW } from "./rows.js";

const SAMPLE_RATE = 48000;
const WORKLET = `
registerProcessor("knurl", class extends AudioWorkletProcessor {
  constructor() {
    super();
    this.queue = [];
    this.at = 0;
    this.waiting = 0;
    this.plays = false;
    this.port.onmessage = ({ data }) => {
      this.queue.push(data);
      this.waiting += data.length;
      while (this.waiting > 7200) { // 150 ms late: leave the oldest out
        this.waiting -= this.queue.shift().length - this.at;
        this.at = 0;
      }
    };
  }
  process(_, [[out]]) {
    this.plays = this.waiting >= (this.plays ? out.length : 1920); // 40 ms in reserve to begin with
    for (let i = 0; this.plays && i < out.length; i++) {
      out[i] = this.queue[0][this.at++];
      this.waiting--;
      if (this.at === this.queue[0].length) {
        this.queue.shift();
        this.at = 0;
      }
    }
    return true;
  }
});`;

// Plays samples on an output of this computer; "": the usual one.
export class Output {
  // Call it from a click: browsers allow no sound before. Throws if there is no sound, or no such output.
  async start(id = "") {
    if (!this.context) {
      await this.attach(new AudioContext({ sampleRate: SAMPLE_RATE, latencyHint: "interactive" }));
    }
    if (id !== "") {
      await this.context.setSinkId(id);
    }
    await this.context.resume();
    this.on = true;
  }

  async attach(context) {
    const url = URL.createObjectURL(new Blob([WORKLET], { type: "text/javascript" }));
    await context.audioWorklet.addModule(url);
    URL.revokeObjectURL(url);
    this.node = new AudioWorkletNode(context, "knurl", { outputChannelCount: [1] });
    this.node.connect(context.destination);
    this.context = context;
  }

  stop() {
    this.on = false;
    this.context?.suspend();
  }

  send(samples) {
    if (this.on) {
      this.node.port.postMessage(samples, [samples.buffer]);
    }
  }
}

export class Sound extends Output {
  constructor() {
    super();
    this.setRate(1000);
  }

  // Hz, of the ticks.
  setRate(rate) {
    this.felt = new Felt(rate, SAMPLE_RATE);
  }

  // surfaces: of the scene, for their stiffness.
  play(rows, surfaces) {
    if (this.on) {
      const forces = Float64Array.from({ length: rows.length / ROW }, (_, k) => {
        const at = k * ROW;
        return rows[at + AT.height] * (surfaces[rows[at + AT.surface]]?.feel[3] ?? 0);
      });
      this.send(this.felt.render(forces));
    }
  }
}
