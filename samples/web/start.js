// The simulation takes longest to start, so it starts first, before the modules. A page that shows a run (#live) has no
// simulation.
// SPDX-License-Identifier: MIT
if (!new URLSearchParams(location.hash.slice(1)).has("live")) {
  const worker = new Worker("worker.js", { type: "module" });
  worker.onerror = () => { worker.failed = true; }; // until main.js listens
  globalThis.started = { worker, wasm: fetch("knurl.wasm") };
}
