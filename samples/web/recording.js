// Records and replays ticks, and reads and writes them as CSV files. SPDX-License-Identifier: MIT
import { $, isPressed, press, save, scene, tell } from "./page.js";
import { AT, ROW, fromCsv, toCsv } from "./rows.js";
import { replay } from "./sources.js";

const MOST_ROWS = 300000; // five minutes at 1 kHz

export class Recording {
  // show(rows) draws; begin(rate) and end() clear the drawing.
  constructor({ show, begin, end }) {
    Object.assign(this, { show, begin, end });
    this.parts = [];
    this.count = 0;
    this.stop = null; // ends the replay
    $("record").addEventListener("click", () => this.switch());
    $("replay").addEventListener("click", () => (this.stop ? this.endReplay() : this.play()));
    $("save").addEventListener("click", () => save(toCsv(this.rows(), scene.surfaces), "knurl.csv"));
  }

  get isReplaying() {
    return this.stop !== null;
  }

  get isRecording() {
    return isPressed("record");
  }

  add(rows) {
    if (this.isRecording) {
      this.parts.push(rows);
      this.count += rows.length / ROW;
      if (this.count >= MOST_ROWS) {
        this.finish();
      }
    }
  }

  switch() {
    if (this.isRecording) {
      this.finish();
      return;
    }
    this.endReplay();
    this.parts = [];
    this.count = 0;
    press("record", true);
    tell("Recording…");
  }

  finish() {
    press("record", false);
    $("replay").disabled = $("save").disabled = this.count < 2;
    tell(`${this.count} ticks are recorded`);
  }

  rows() {
    const rows = new Float64Array(this.count * ROW);
    let at = 0;
    for (const part of this.parts) {
      rows.set(part, at);
      at += part.length;
    }
    return rows;
  }

  play() {
    const rows = this.rows();
    const seconds = rows[rows.length - ROW + AT.time] - rows[AT.time];
    this.begin(seconds > 0 ? Math.round((this.count - 1) / seconds) : 1000);
    press("replay", true);
    this.stop = replay(rows, { rows: this.show, ended: () => {
      this.endReplay();
      tell("The recording is over.");
    } });
  }

  endReplay() {
    if (this.stop) {
      this.stop();
      this.stop = null;
      press("replay", false);
      this.end();
    }
  }

  async open(file) {
    try {
      const rows = fromCsv(await file.text(), scene.surfaces);
      this.endReplay();
      this.parts = [rows];
      this.count = rows.length / ROW;
      this.finish();
      this.play();
      tell(`${file.name}: ${this.count} ticks are played`);
    } catch (problem) {
      tell(`${file.name}: ${problem.message}`, true);
    }
  }
}
