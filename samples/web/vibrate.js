// A phone's motor: a pulse for each ridge while it can follow, a buzz above. SPDX-License-Identifier: MIT
import { $, isPressed, press, tell } from "./page.js";

const MOST_HZ = 25; // such motors take some 40 ms to start and stop
const PULSE_MS = 15;
const BUZZ_MS = 80; // renewed before it ends
const RENEW_MS = 50;

export class Vibration {
  // vibrate(ms): as navigator.vibrate
  constructor(vibrate) {
    this.vibrate = vibrate;
    this.crossed = 0; // ridges so far
    this.buzzes = -Infinity; // ms: since when
  }

  // After some ticks: ridges crossed so far, ridges a second, ms. Returns "pulse", "buzz" or "".
  take(crossed, frequency, now) {
    const isNext = Math.floor(crossed) > Math.floor(this.crossed);
    this.crossed = crossed;
    if (frequency > MOST_HZ) {
      if (now - this.buzzes >= RENEW_MS) {
        this.vibrate(BUZZ_MS);
        this.buzzes = now;
      }
      return "buzz";
    }
    if (isNext) {
      this.vibrate(PULSE_MS);
    } else if (frequency === 0 && this.buzzes > -Infinity) {
      this.vibrate(0);
    }
    this.buzzes = -Infinity;
    return isNext ? "pulse" : "";
  }
}

// The button, if there is a motor. Returns take() of a vibration that is off until it is pressed.
export function offer() {
  if (!navigator.vibrate || !matchMedia("(pointer: coarse)").matches) {
    return () => {};
  }
  const vibration = new Vibration((ms) => navigator.vibrate(ms));
  let said = false;
  $("vibrate").hidden = false;
  $("vibrate").addEventListener("click", () => press("vibrate", !isPressed("vibrate")));
  return (...ticks) => {
    if (isPressed("vibrate") && vibration.take(...ticks) === "buzz" && !said) {
      said = true;
      tell(`Above ${MOST_HZ} ridges a second a phone's motor can only buzz: stroke slowly, or move the ridges apart.`);
    }
  };
}
