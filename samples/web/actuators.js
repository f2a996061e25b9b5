// Other players of the forces: an Inverse3, an actuator on a sound output, a gamepad's motors. SPDX-License-Identifier: MIT
import { $, isPressed, press, tell } from "./page.js";
import { Output } from "./sound.js";

const PORT = 10001; // of the Inverse3's service; a link may name another
const RUMBLE_MS = 50; // between commands to a gamepad
const RUMBLES_MS = 150; // without another command it ends

// Why a connection to a program of this computer failed: browsers let pages of this computer do it, others ask.
async function explain(port) {
  const asked = await navigator.permissions.query({ name: "loopback-network" }).then(({ state }) => state, () => "");
  return !isSecureContext ? "Browsers let only pages by https reach programs on this computer."
    : /^(localhost|127\.0\.0\.1)$/.test(location.hostname) || !asked || asked === "granted"
      ? `The Haply Inverse Service does not answer at localhost:${port}: start it (the Haply Hub does).`
      : "The browser does not let this page reach programs on this computer: allow it if asked, or in the page's settings beside the address.";
}

export class Actuators {
  // began(): an Inverse3 takes the hand's place.
  constructor(simulation, began) {
    Object.assign(this, { simulation, began, exchanges: null, rumbled: 0 });
    const port = Number(new URLSearchParams(location.hash.slice(1)).get("inverse3"));
    this.port = Number.isInteger(port) && port > 0 && port < 65536 ? port : PORT;
    this.coil = new Output();
    $("inverse3").addEventListener("click", () => this.connect(isPressed("inverse3") ? 0 : this.port));
    document.addEventListener("visibilitychange", () => this.connect());
    $("outputs").addEventListener("click", () => this.findOutputs());
    $("output").addEventListener("change", () => this.choose($("output").value));
    $("rumble").addEventListener("click", () => this.switchRumble());
  }

  // port: 0: disconnects; undefined: tells only whether the tab is hidden
  connect(port) {
    this.simulation.send("inverse3", { port, isHidden: document.hidden });
  }

  // A message of the worker's about the Inverse3.
  async take({ on, most, off, trouble, exchanges }) {
    this.exchanges = off === undefined ? exchanges ?? this.exchanges : null;
    if (on || off !== undefined) {
      press("inverse3", Boolean(on));
      $("ghost").disabled = Boolean(on);
    }
    if (on) {
      this.began();
      tell(`${on} is the hand now: at most ${most} N.`);
    } else if (off !== undefined) {
      tell(off === "closed" ? await explain(this.port) : off ? `Haply Inverse3: ${off}` : "The Inverse3 is let go.", off !== "");
    } else if (trouble !== undefined) {
      tell(trouble ? `Haply Inverse3: no forces, ${trouble}` : "Haply Inverse3: it plays forces again", trouble !== "");
    }
  }

  numbers() {
    const { rate, p50, p99, gaps } = this.exchanges ?? {};
    return this.exchanges ? [["exchanges a second", rate.toFixed(0)],
      ["round trip", `${p50.toFixed(2)} ms, 1 of 100 over ${p99.toFixed(2)} ms`], ["gaps", String(gaps)]] : [];
  }

  // --- a sound output ---

  // Chromium names outputs to pages only that may use the microphone; Firefox has a chooser of its own.
  async findOutputs() {
    try {
      if (navigator.mediaDevices.selectAudioOutput) {
        const { deviceId, label } = await navigator.mediaDevices.selectAudioOutput();
        $("output").append(new Option(label, deviceId, false, true));
        await this.choose(deviceId);
        return;
      }
      const stream = await navigator.mediaDevices.getUserMedia({ audio: true });
      stream.getTracks().forEach((track) => track.stop());
      const outputs = (await navigator.mediaDevices.enumerateDevices()).filter(({ kind }) => kind === "audiooutput");
      $("output").replaceChildren(new Option("none", ""), ...outputs.map(({ deviceId, label }) => new Option(label, deviceId)));
      tell(`${outputs.length} sound outputs: choose the one that the actuator is on.`);
    } catch (problem) {
      tell(`The browser does not name its sound outputs: ${problem.message}`, true);
    }
  }

  async choose(id) {
    try {
      await (id ? this.coil.start(id) : this.coil.stop());
    } catch (problem) {
      $("output").value = "";
      this.coil.stop();
      tell(`This output cannot be used: ${problem.message}`, true);
    }
    this.speak();
  }

  // --- a gamepad ---

  switchRumble() {
    press("rumble", !isPressed("rumble"));
    if (isPressed("rumble") && !this.pad()) {
      tell("Press a button of the gamepad: the browser shows it to the page then.");
    }
    this.speak();
  }

  pad() {
    return [...navigator.getGamepads()].find((pad) => pad?.vibrationActuator);
  }

  // The worker renders samples only while something plays them.
  speak() {
    this.simulation.send("voice", { on: Boolean(this.coil.on) || isPressed("rumble") });
  }

  play({ coil, rumble }) {
    if (coil?.length > 0) {
      this.coil.send(coil);
    }
    const now = performance.now();
    if (rumble && isPressed("rumble") && now - this.rumbled >= RUMBLE_MS) {
      const [strongMagnitude, weakMagnitude] = rumble.map((strength) => Math.min(1, strength));
      this.rumbled = now;
      this.pad()?.vibrationActuator.playEffect("dual-rumble", { duration: RUMBLES_MS, strongMagnitude, weakMagnitude }).catch(() => {});
    }
  }
}
