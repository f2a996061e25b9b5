// Sources of ticks: the simulation in a worker, a run of the tool on this computer, or a recording.
// SPDX-License-Identifier: MIT
import { AT, ROW } from "./rows.js";

// Runs while the worker starts, which takes as long. answer: the result of fetch()
async function compile(answer) {
  try {
    return await WebAssembly.compileStreaming(answer);
  } catch { // servers without the MIME type of .wasm
    return WebAssembly.compile(await (await fetch((await answer).url)).arrayBuffer());
  }
}

export class Simulation {
  // Takes the worker and the fetch of WebAssembly that index.html started. Calls ticks({rows, heights, cost, coil,
  // rumble}) some 80 times per second, and inverse3() for its events.
  constructor({ worker, wasm }, { ticks, inverse3, failed }) {
    this.waiting = new Map();
    this.asked = 0;
    this.worker = worker;
    this.worker.onerror = failed;
    if (worker.failed) {
      failed();
    }
    compile(wasm)
      .then((compiled) => this.worker.postMessage({ kind: "begin", compiled }), failed);
    this.worker.onmessage = ({ data }) => {
      if (data.kind === "ticks") {
        ticks(data);
      } else if (data.kind === "inverse3") {
        inverse3(data);
      } else {
        this.waiting.get(data.id)?.(data);
        this.waiting.delete(data.id);
      }
    };
  }

  // Waits for the worker's answer.
  ask(kind, message = {}) {
    const id = ++this.asked;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.worker.postMessage({ kind, id, ...message });
    });
  }

  // Sends a message without an answer.
  send(kind, message = {}) {
    this.worker.postMessage({ kind, ...message });
  }
}

// Connects to `knurl run --view` at this page's address.
export function watch({ hello, rows, ended }) {
  const socket = new WebSocket(new URL("live", location.href).href.replace(/^http/, "ws"), "knurl");
  socket.binaryType = "arraybuffer";
  socket.onmessage = ({ data }) => (typeof data === "string" ? hello(JSON.parse(data)) : rows(new Float64Array(data)));
  socket.onclose = ended;
}

// Plays a recording's rows at their times. Returns a function that stops it.
export function replay(recording, { rows, ended }) {
  const begin = performance.now();
  let sent = 0;
  const timer = setInterval(() => {
    const until = recording[AT.time] + (performance.now() - begin) / 1000;
    const from = sent;
    while (sent < recording.length && recording[sent + AT.time] <= until) {
      sent += ROW;
    }
    rows(recording.subarray(from, sent));
    if (sent >= recording.length) {
      clearInterval(timer);
      ended();
    }
  }, 12);
  return () => clearInterval(timer);
}
