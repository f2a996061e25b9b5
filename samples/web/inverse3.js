// Haply's Inverse3 by its maker's service on this computer, as sdk/src/device/inverse3 drives it: a message has a force,
// its answer a position, and so on. The force is 0 after GAP_MS without a position, after any fault and in a hidden tab;
// then it ramps up. SPDX-License-Identifier: MIT
const GAP_MS = 5;
const HELLO_MS = 500; // for the service's first message
const GIVE_UP_MS = 1000; // without a position
const RAMP_S = 0.02;
const TOLD_MS = 1000; // between numbers for the page
const LONGEST = 65536; // of a message
const NONE = [0, 0, 0];

// By type: N that the motors hold for long, and N/m.
const MODELS = { inverse3: { name: "Haply Inverse3", force: 3.3, stiffness: 1000 },
  inverse3x: { name: "Haply Inverse3x", force: 3.3, stiffness: 1000 },
  minverse: { name: "Haply Minverse", force: 0.8, stiffness: 500 } };

// Its devices that have an id; null if it is not a message of the service.
function read(text) {
  try {
    const { inverse3 } = text.length > LONGEST ? {} : JSON.parse(text);
    return Array.isArray(inverse3) ? inverse3.filter((device) => typeof device?.device_id === "string") : null;
  } catch {
    return null;
  }
}

// In the scene's axes, m; null if it is not three numbers.
function positionOf(device) {
  const { x, y, z } = device?.state?.cursor_position ?? {};
  return [x, y, z].every(Number.isFinite) ? [x, z, -y] : null;
}

const isDenied = (value) => value !== undefined && value !== true;

// Why it plays no forces, or "".
function troubleOf({ status }) {
  return isDenied(status?.power_supply) ? "its power supply is unplugged: plug it in"
    : isDenied(status?.calibrated) ? "it is not calibrated: the Haply Hub shows how"
      : isDenied(status?.ready) ? "it is not ready: the Haply Hub shows why" : "";
}

function command(id, [x, y, z], configures) {
  return JSON.stringify({ inverse3: [{ device_id: id,
    ...(configures ? { configure: { preset: { preset: "arm_front_centered" }, damping: { scalar: 0 } } } : {}),
    commands: { set_cursor_force: { vector: { x, y: -z, z: y } } } }] });
}

export class Inverse3 {
  // host: rate (Hz); tick(positions, gain): the last one's force, N; rest(): there is no position; events: begin(model,
  // id), trouble(why), numbers(exchanges a second and their times), end(why).
  constructor(port, host) {
    Object.assign(this, { port, host, id: "", most: 0, isHidden: false, trouble: "", trips: [], gaps: 0 });
    this.unanswered = 1; // messages, each is answered once, in order; the service begins
    this.sent = NONE;
    this.sentAt = this.goodAt = this.toldAt = performance.now();
    this.gain = 0;
    this.at = null; // {position, time: ms, ticked: ms, of the last tick}
    this.socket = new WebSocket(`ws://localhost:${port}`);
    this.socket.onopen = () => {
      this.goodAt = performance.now();
      this.timer = setInterval(() => this.watch(performance.now()), GAP_MS);
    };
    this.socket.onmessage = ({ data }) => this.take(data, performance.now());
    this.socket.onclose = () => this.end(this.id ? "its service has ended: start it again (the Haply Hub does)" : "closed");
  }

  send(force, configures = false) {
    this.unanswered++;
    this.sent = force;
    this.sentAt = performance.now();
    this.socket.send(command(this.id, force, configures));
  }

  // No force, at once; the next position counts as the first.
  halt() {
    this.gain = 0;
    if (this.at) {
      this.at = null;
      this.host.rest();
    }
    if (this.id && this.sent.some(Boolean)) {
      this.send(NONE);
    }
  }

  // After other work of this thread, which began with halt(): its time is not a silence of the device's.
  resume() {
    this.goodAt = performance.now();
  }

  end(why) {
    clearInterval(this.timer);
    this.halt();
    this.socket.onopen = this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.host.end(why);
  }

  watch(now) {
    if (now - this.goodAt > (this.id ? GIVE_UP_MS : HELLO_MS)) {
      this.end(this.id ? "it does not answer: plug it in, and its power supply as well"
        : `the server at localhost:${this.port} is not the Haply Inverse Service 3.5 or newer`);
    } else if (this.id && now - this.sentAt > GAP_MS) {
      this.halt();
      if (now > this.sentAt) { // halt() has sent nothing
        this.send(NONE);
      }
    }
  }

  take(text, now) {
    this.unanswered--;
    if (this.unanswered > 0) {
      return; // of an earlier message: too old
    }
    const devices = typeof text === "string" ? read(text) : null;
    if (!this.id) {
      this.choose(devices);
      return;
    }
    this.trips.push(now - this.sentAt);
    const device = devices?.find(({ device_id: id }) => id === this.id);
    const position = positionOf(device);
    if (!position) {
      this.halt();
    }
    const force = position ? this.follow(position, troubleOf(device), now) : NONE;
    if (this.unanswered === 0) { // otherwise halt() has sent one
      this.send(force);
    }
    this.tell(now);
  }

  choose(devices) {
    const device = devices?.find(({ device_id: id }) => /^[\w-]{1,15}$/.test(id));
    const { type, preset } = device?.config ?? {};
    if (!devices) {
      this.end(`the server at localhost:${this.port} is not the Haply Inverse Service 3.5 or newer`);
    } else if (!device) {
      this.end("its service lists no Inverse3: plug it in, and its power supply as well; the Haply Hub shows it then");
    } else if (typeof preset !== "string") {
      this.end("its service is older than 3.5: update it (the Haply Hub does)");
    } else if (!Object.hasOwn(MODELS, type)) {
      this.end(`a ${type} is unknown to this version, and so is its force limit`);
    } else {
      this.id = device.device_id;
      this.most = MODELS[type].force;
      this.host.begin(MODELS[type], this.id);
      this.send(NONE, true);
    }
  }

  // The force at a position. Ticks are even in time, at positions between the last two.
  follow(position, trouble, now) {
    const isLate = now - this.goodAt > GAP_MS;
    this.goodAt = now;
    if (trouble !== this.trouble) {
      this.trouble = trouble;
      this.host.trouble(trouble);
    }
    if (trouble || this.isHidden || isLate) {
      this.gaps += this.at && isLate ? 1 : 0;
      this.halt();
    }
    const { at } = this;
    this.at = trouble || this.isHidden ? null : { position, time: now, ticked: now };
    if (!at || !this.at) {
      return NONE;
    }
    const { rate } = this.host;
    const count = Math.floor(((now - at.ticked) * rate) / 1000);
    this.at.ticked = at.ticked + (count * 1000) / rate;
    if (count === 0) {
      return this.sent;
    }
    const places = Array.from({ length: count }, (_, k) => {
      const share = (at.ticked + ((k + 1) * 1000) / rate - at.time) / (now - at.time);
      return position.map((value, i) => at.position[i] + share * (value - at.position[i]));
    });
    this.gain = Math.min(1, this.gain + count / (1 + RAMP_S * rate));
    const force = this.host.tick(places.flat(), this.gain);
    return Math.hypot(...force) <= this.most + 1e-9 ? force : NONE;
  }

  tell(now) {
    if (now - this.toldAt >= TOLD_MS) {
      const trips = this.trips.sort((a, b) => a - b);
      const share = (part) => trips[Math.floor(part * (trips.length - 1))];
      this.host.numbers({ rate: (1000 * trips.length) / (now - this.toldAt), p50: share(0.5), p99: share(0.99), gaps: this.gaps });
      this.trips = [];
      this.toldAt = now;
    }
  }
}
