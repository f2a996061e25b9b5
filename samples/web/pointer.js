// Converts mouse, finger, pen and keyboard input to the HIP's target. SPDX-License-Identifier: MIT
import { $, scene, surface } from "./page.js";

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Pointer {
  constructor(simulation) {
    this.simulation = simulation;
    this.under = null; // the stroked point: {point, normal}
    const canvas = $("view");
    canvas.addEventListener("pointerdown", (event) => {
      if (scene.view && event.isPrimary && event.button === 0) {
        canvas.setPointerCapture(event.pointerId);
        this.stroke(event);
      }
    });
    canvas.addEventListener("pointermove", (event) => {
      if (scene.view && event.isPrimary && event.buttons & 1) {
        this.stroke(event);
      }
    });
    for (const end of ["pointerup", "pointercancel", "blur"]) {
      canvas.addEventListener(end, () => this.lift());
    }
    canvas.addEventListener("keydown", (event) => this.strokeByKey(event));
    $("depth").addEventListener("input", () => this.under && this.press());
  }

  press() {
    const depth = Number($("depth").value) / 1000;
    this.simulation.move(this.under && this.under.point.map((value, i) => value - depth * this.under.normal[i]));
  }

  stroke(event) {
    this.under = scene.view.pick(event);
    this.press();
  }

  lift() {
    if (this.under) {
      this.under = null;
      this.press();
    }
  }

  strokeByKey(event) {
    const way = ARROWS[event.key];
    if (event.key === "Escape") {
      this.under = null;
      this.press();
    }
    if (!way || !surface()) {
      return;
    }
    event.preventDefault();
    const { anchor, normal: upward, x } = surface();
    const { point: from, normal: n } = this.under ?? { point: anchor, normal: upward };
    const y = [n[1] * x[2] - n[2] * x[1], n[2] * x[0] - n[0] * x[2], n[0] * x[1] - n[1] * x[0]];
    const point = from.map((value, i) => value + 0.002 * (way[0] * x[i] + way[1] * y[i]));
    this.under = scene.view?.pickBelow(point, n) ?? { point, normal: n };
    this.press();
  }
}
