// The simulation takes longest to start, so it starts first, before the modules. A page that shows a run (#live) has no
// simulation. Says why, if the page cannot start. SPDX-License-Identifier: MIT
function refuse(why) {
  const say = () => {
    if (!document.documentElement.dataset.ready) {
      const status = document.getElementById("status");
      status.textContent = why;
      status.classList.add("error");
    }
  };
  if (document.readyState === "loading") {
    addEventListener("DOMContentLoaded", say);
  } else {
    say();
  }
}

// A stricter policy of the server, or a file that is missing.
addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI }) =>
  refuse(`The server's Content-Security-Policy (${violatedDirective}) forbids ${blockedURI}, which this page needs.`));
addEventListener("error", ({ target }) => target.src && refuse(`${target.src} could not be loaded.`), true);

// In another page, as a figure: the scene and the methods alone.
if (new URLSearchParams(location.hash.slice(1)).has("embed")) {
  document.documentElement.dataset.embed = "1";
}

if (location.protocol === "file:") {
  refuse("A browser does not run this page from a folder. Serve it: python3 -m http.server, then open http://127.0.0.1:8000/");
} else if (!new URLSearchParams(location.hash.slice(1)).has("live")) {
  const worker = new Worker("worker.js", { type: "module" });
  worker.onerror = () => { worker.failed = true; }; // until main.js listens
  globalThis.started = { worker, wasm: fetch("knurl.wasm") };
}
