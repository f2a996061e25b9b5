// Mouse, finger, pen and keyboard: strokes as rays with their times, and turns of the view. SPDX-License-Identifier: MIT
import { $, scene, surface } from "./page.js";

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const TURN = Math.PI / 24; // of the view, by a key
const CLICK_PX = 4; // a press that moves less is a click

export class Pointer {
  // taken(): called when a hand begins. clicked(event): a press that did not move.
  constructor(simulation, { taken, clicked }) {
    Object.assign(this, { simulation, taken, clicked });
    this.down = new Set(); // ids of pointers
    this.stroke = null; // {id, x, y, moved}
    this.held = new Set(); // arrow keys
    const canvas = $("view");
    canvas.addEventListener("pointerdown", (event) => this.begin(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    ["pointerup", "pointercancel"].forEach((end) => canvas.addEventListener(end, (event) => this.end(event)));
    canvas.addEventListener("blur", () => this.lift());
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("keyup", (event) => this.held.delete(event.key) && surface() && this.hold(false));
  }

  begin(event) {
    this.down.add(event.pointerId);
    if (this.down.size > 1) { // two fingers turn the view
      this.lift();
    } else if (scene.view && event.button === 0) {
      $("view").setPointerCapture(event.pointerId);
      this.stroke = { id: event.pointerId, x: event.clientX, y: event.clientY, moved: false };
      this.taken();
      this.send([event]);
    }
  }

  move(event) {
    if (this.stroke?.id === event.pointerId) {
      const { x, y } = this.stroke;
      this.stroke.moved ||= Math.hypot(event.clientX - x, event.clientY - y) > CLICK_PX;
      const samples = event.getCoalescedEvents?.() ?? [];
      this.send(samples.length > 0 ? samples : [event]);
    }
  }

  end(event) {
    this.down.delete(event.pointerId);
    if (this.stroke?.id === event.pointerId) {
      if (!this.stroke.moved && event.type === "pointerup") {
        this.clicked(event);
      }
      this.lift();
    }
  }

  // Each sample as a ray from the camera, at its own time.
  send(events) {
    const rays = events.map((event) => [performance.timeOrigin + event.timeStamp, ...scene.view.ray(event)]);
    this.simulation.send("stroke", { rays: Float64Array.from(rays.flat()) });
  }

  lift() {
    this.stroke = null;
    this.held.clear();
    this.simulation.send("lift", { t: performance.timeOrigin + performance.now() });
  }

  key(event) {
    const way = ARROWS[event.key];
    const zoom = { "+": 1 / 1.2, "=": 1 / 1.2, "-": 1.2 }[event.key];
    if (event.key === "Escape") {
      this.held.clear();
      this.simulation.send("travel", { way: null });
    } else if (zoom) {
      scene.view?.turn(0, 0, zoom);
    } else if (way && event.shiftKey) {
      scene.view?.turn(-TURN * way[0], -TURN * way[1], 1);
    } else if (way && surface() && !event.repeat) {
      this.held.add(event.key);
      this.taken();
      this.hold(true);
    }
    if (zoom || way) {
      event.preventDefault();
    }
  }

  hold(begins) {
    const way = [...this.held].reduce(([x, y], key) => [x + ARROWS[key][0], y + ARROWS[key][1]], [0, 0]);
    const { anchor, normal, x } = surface();
    this.simulation.send("hold", { way, begins, anchor, normal, x });
  }
}
