// The speed gauge: ridges a second against half the update rate, above which no device can play them.
// SPDX-License-Identifier: MIT
import { $ } from "./page.js";

const SHOWN_S = 0.5;

// rows: {height, frequency} of the last ticks. Shows the mean over SHOWN_S.
export function drawGauge(history) {
  const rows = history.latest(SHOWN_S * history.rate);
  const mean = (key) => (rows.length > 0 ? rows.reduce((sum, row) => sum + row[key], 0) / rows.length : 0);
  const ridges = Math.round(mean("frequency"));
  const limit = history.rate / 2;
  const khz = history.rate % 1000 ? `${history.rate} Hz` : `${history.rate / 1000} kHz`;
  const turns = rows.filter(({ height }, i) => i > 0 && height * rows[i - 1].height < 0).length;
  const played = Math.round((turns * history.rate) / 2 / Math.max(1, rows.length));
  const isAbove = ridges > limit;
  $("speed").textContent = isAbove ? `Ridges crossed ${ridges}, played ${played} a second: at this speed a device at ${
    khz} cannot play them.` : ridges > 0 ? `${ridges} ridges a second` : "";
  $("limit").textContent = `${limit}: the most at ${khz}`;
  $("gauge").classList.toggle("above", isAbove);
  $("gauge").setAttribute("aria-valuemax", String(2 * limit));
  $("gauge").setAttribute("aria-valuenow", String(Math.min(2 * limit, ridges)));
  $("gauge").setAttribute("aria-valuetext", `${$("speed").textContent || "at rest"} (${$("limit").textContent})`);
  $("fill").style.setProperty("clip-path", `inset(0 ${100 - Math.min(100, (50 * ridges) / limit)}% 0 0 round 4px)`);
}
