// Knurl in WebAssembly. Positions and lengths in m, forces in N, in the model's axes.

/** Numbers of a tick's row. */
export const ROW: number;
/** Methods whose heights a tick gives: S1, S2, bandlimited, numbers 1 to 3. */
export const METHODS: number;
/** Positions that tick() takes at once. */
export const MOST: number;
/** Places in a row: vectors begin there. */
export const AT: Readonly<Record<"force" | "hip" | "proxy" | "depth" | "height" | "frequency" | "cycles" | "contact" | "surface" |
  "time" | "velocity" | "spatial" | "normal", number>>;

/** Ridges along x and y (1/m), amplitude (m), stiffness (N/m), friction, method (1 to 3). */
export type Feel = [fsx: number, fsy: number, amplitude: number, stiffness: number, friction: number, method: number];
export type Vector = [x: number, y: number, z: number];

export interface Surface {
  name: string;
  feel: Feel;
  /** A point on it, and its normal and x axis there. */
  anchor: Vector;
  normal: Vector;
  x: Vector;
  /** From there to its edge, m: along x, against x. */
  reach: [number, number];
}

export interface Device {
  /** Hz, 100 to 10000; default 1000. */
  rate?: number;
  /** m: positions are rounded to it; default 0: exact. */
  resolution?: number;
  /** KNURL_PROTECT_ bits; default 15: all. */
  protections?: number;
}

export interface Ticks {
  /** ROW numbers a tick; see AT. */
  rows: Float64Array;
  /** m: METHODS a tick, of the same stroke. */
  heights: Float32Array;
}

/** A scene with one haptic interaction point. One thread at a time. */
export class Knurl {
  /** Loads knurl.wasm, which lies beside the module. options: of Emscripten, such as locateFile. */
  static create(options?: { locateFile?: (name: string, folder: string) => string }): Promise<Knurl>;
  /** Hz, as set by setDevice(). */
  readonly rate: number;
  /** Loads a tagged .glb in place of the present scene. Throws an Error with the reason; then the present scene stays. */
  load(bytes: ArrayBuffer | Uint8Array, name: string): void;
  surfaces(): Surface[];
  /** Changes a surface. Throws. */
  setFeel(index: number, feel: Feel): void;
  /** Sets the device, and resets the interaction point. Throws. */
  setDevice(device: Device): void;
  /** The surface that a straight line meets. */
  cast(from: Vector, to: Vector): { point: Vector; normal: Vector } | null;
  /** Ticks at positions, three numbers each (NaN: no position), at most MOST. gain, 0 to 1: on the force. */
  tick(positions: Float64Array | number[], gain?: number): Ticks;
}
