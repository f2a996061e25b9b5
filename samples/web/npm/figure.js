// <knurl-figure>: a hand strokes ridges; beside it a card shows how each method plays them. SPDX-License-Identifier: MIT
import { drawCards } from "../cards.js";
import { Hand } from "../hand.js";
import { AT, METHODS, ROW } from "../rows.js";
import { History } from "../scope.js";
import { Knurl, MOST } from "./index.js";

const NAMES = ["S1", "S2", "bandlimited"];
const HALF_M = 0.045; // of the stroke
const SHOWN_M = 0.006; // of the ridges
const LONGEST_MS = 100; // longer gaps are skipped
const STYLE = `
:host { display: block; color-scheme: light dark; font: 14px/1.4 system-ui, sans-serif; color: var(--ink);
  --ink: #1c2b33; --line: #b5c0c6; --accent: #0f6e84; --asked: #b34a12; }
@media (prefers-color-scheme: dark) { :host { --ink: #e6edf3; --line: #4a545e; --accent: #5fb8cb; --asked: #f0975f; } }
:host([hidden]) { display: none; }
canvas { display: block; width: 100%; height: 46px; }
#ridges { height: 64px; border-radius: 6px; }
#cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(7rem, 1fr)); gap: 0.6rem; margin: 0.5rem 0; }
p { margin: 0; min-height: 1.4em; font-variant-numeric: tabular-nums; }
label { display: flex; gap: 0.6rem; align-items: center; }
input { flex: 1; min-width: 0; accent-color: var(--accent); height: 28px; }`;
const DEFAULTS = { ridges: 1000, amplitude: 0.2, stiffness: 400, speed: 0.12, rate: 1000 };

const model = () => fetch(new URL("plate_1d.glb", import.meta.url)).then((answer) => answer.arrayBuffer());
export class KnurlFigure extends HTMLElement {
  static observedAttributes = [...Object.keys(DEFAULTS), "methods"];

  constructor() {
    super();
    this.attachShadow({ mode: "open" }).innerHTML = `<style>${STYLE}</style><canvas id="ridges" role="img"></canvas><div id="cards"></div>
      <label>Speed <input type="range" min="0.02" max="1" step="0.001"><output></output></label><p role="status"></p>`;
    [this.speed, this.said] = ["input", "label output"].map((part) => this.shadowRoot.querySelector(part));
    this.speed.addEventListener("input", () => {
      this.isMoving = true;
      this.move();
    });
    this.isMoving = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.shown = new IntersectionObserver(([{ isIntersecting }]) => { this.isShown = isIntersecting; });
  }

  // The value of an attribute, or its default.
  number(name) {
    const value = Number(this.getAttribute(name) ?? NaN);
    return Number.isFinite(value) && value >= 0 ? value : DEFAULTS[name];
  }

  async connectedCallback() {
    this.shown.observe(this);
    try {
      const [knurl, bytes] = await Promise.all([this.knurl ?? Knurl.create(), model()]);
      knurl.load(bytes, "plate_1d.glb");
      this.knurl = knurl;
      this.hand = new Hand((from, to) => this.knurl.cast(from, to));
      this.attributeChangedCallback();
    } catch (problem) {
      this.shadowRoot.querySelector("p[role=status]").textContent = `Knurl: ${problem.message}`;
      this.dispatchEvent(new ErrorEvent("error", { error: problem, message: problem.message }));
      return;
    }
    if (this.isConnected) {
      cancelAnimationFrame(this.frame); // of a connection before
      this.frame = requestAnimationFrame((now) => this.draw(now));
    }
  }

  disconnectedCallback() {
    this.shown.disconnect();
    cancelAnimationFrame(this.frame);
  }

  attributeChangedCallback() {
    if (!this.hand) {
      return;
    }
    const names = (this.getAttribute("methods") ?? NAMES.join(" ")).split(/\s+/).filter((name) => NAMES.includes(name));
    this.cards = names.map((name) => {
      const card = document.createElement("div");
      card.innerHTML = `<b></b><canvas role="img"></canvas><p></p>`;
      const [title, canvas, text] = card.children;
      title.textContent = name;
      canvas.ariaLabel = `What ${name} plays: its spectrum up to 520 Hz`;
      return { card, canvas, text, method: NAMES.indexOf(name) };
    });
    this.shadowRoot.getElementById("cards").replaceChildren(...this.cards.map(({ card }) => card));
    const rate = Math.min(10000, Math.max(100, this.number("rate")));
    this.knurl.setDevice({ rate });
    this.knurl.setFeel(0, [this.number("ridges"), 0, this.number("amplitude") / 1000, this.number("stiffness"), 0, this.cards[0]?.method + 1 || 3]);
    this.history = new History();
    this.history.clear(rate);
    this.speed.value = String(this.number("speed"));
    this.move();
  }

  // The hand at the chosen speed, m/s.
  move() {
    const [{ anchor, normal, x }] = this.knurl.surfaces();
    this.hand.travel({ middle: anchor, normal, along: x.map((part) => part * HALF_M), speed: Number(this.speed.value) });
    this.history.clear(this.knurl.rate);
    this.said.textContent = `${Number(this.speed.value).toFixed(2)} m/s`;
    this.shadowRoot.getElementById("ridges").ariaLabel = `${this.number("ridges")} ridges a metre, stroked at ${this.said.textContent}`;
  }

  draw(now) {
    this.frame = requestAnimationFrame((next) => this.draw(next));
    const late = now - (this.at ?? now);
    if (!this.isShown || !this.isMoving || late > LONGEST_MS || late < 0) {
      this.at = now;
      return;
    }
    this.at ??= now;
    const { rate } = this.knurl;
    const count = Math.min(MOST, Math.floor((late * rate) / 1000));
    if (count === 0) {
      return;
    }
    this.at += (count * 1000) / rate;
    const { rows, heights } = this.knurl.tick(this.hand.positions(count, rate, 0));
    for (let k = 0; k < count; k++) {
      this.history.add(rows.subarray(ROW * k, ROW * (k + 1)), heights.subarray(METHODS * k, METHODS * (k + 1)));
    }
    this.drawRidges(rows.subarray(rows.length - ROW));
    drawCards(this.cards, this.history, this.number("amplitude") / 1000);
  }

  // The ridges from above, as they pass under the hand; it is raised by the height.
  drawRidges(row) {
    const canvas = this.shadowRoot.getElementById("ridges");
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    [canvas.width, canvas.height] = [width, height];
    const context = canvas.getContext("2d");
    const style = getComputedStyle(canvas);
    const perPixel = (this.number("ridges") * SHOWN_M) / width;
    for (let x = 0; x < width; x++) {
      const phase = row[AT.cycles] + (x - width / 2) * perPixel;
      context.fillStyle = Math.sin(2 * Math.PI * phase) < 0 ? "#8a6d1f" : "#e0b23c";
      context.fillRect(x, 0, 1, height);
    }
    context.fillStyle = style.getPropertyValue("--asked");
    context.beginPath();
    context.arc(width / 2, height / 2 - (row[AT.height] / (this.number("amplitude") / 1000 || 1)) * (height / 5), 7, 0, 2 * Math.PI);
    context.fill();
  }
}

customElements.define("knurl-figure", KnurlFigure);
