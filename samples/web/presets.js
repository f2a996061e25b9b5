// Failures from the catalogue (samples/study/failures.md), each with a stroke that shows it: `half` m to each side of
// the middle, at a steady speed (m/s), or with `eased` the maximum of a sine. SPDX-License-Identifier: MIT
export const PRESETS = [
  {
    title: "S1 pushes",
    text: "At 333 Hz a cycle has three ticks, two of them up or two of them down. The net height is a third of the amplitude, " +
      "and pushes; switch to bandlimited, and it is gone.",
    settings: { method: 1 }, half: 0.05, speed: 1 / 3,
  },
  {
    title: "S1 falls silent",
    text: "At the update rate every tick sees the same place of its cycle, so that nothing is felt or heard. " +
      "Half of the update rate is as far as S1 goes.",
    settings: { method: 1, rate: 500 }, half: 0.05, speed: 0.5,
  },
  {
    title: "S1 plays another frequency",
    text: "900 Hz are crossed at 1000 ticks a second; 100 Hz are felt and heard. " +
      "Above half of the update rate ticks sample an alias.",
    settings: { method: 1, surface: 1, fsx: 2000 }, half: 0.05, speed: 0.45,
  },
  {
    title: "S2 plays other cycles than are crossed",
    text: "Just below 3.5 ticks a cycle the period is rounded to 3, and nothing makes up for it. " +
      "Played cycles run 17 % ahead of crossed ones; bandlimited keeps them together.",
    settings: { method: 2 }, half: 0.05, speed: 0.2862,
  },
  {
    title: "S2 freezes and loses step",
    text: "An event takes the speed at its beginning for its whole length, and at a turn that is slow. " +
      "Watch the height stand still as the hand sets off again.",
    settings: { method: 2 }, half: 0.04, speed: 0.3, eased: true,
  },
  {
    title: "bandlimited wavers near half the update rate",
    text: "At 480 Hz the samples beat with their image at 520 Hz. " +
      "The level rises and falls forty times a second; at 4 kHz there is nothing of it.",
    settings: { method: 3 }, half: 0.05, speed: 0.48,
  },
  {
    title: "bandlimited plays half the update rate above it",
    text: "700 Hz are crossed at 1000 ticks a second, and no tick can play them: 500 Hz are felt and heard. " +
      "At 2 kHz they are played.",
    settings: { method: 3 }, half: 0.05, speed: 0.7,
  },
  {
    title: "slow motion comes in bursts",
    text: "An encoder of 0.055 mm gives 18 counts a second at 1 mm/s, and between them nothing moves. " +
      "The speed that is estimated jumps, and S2's temporal frequency with it.",
    settings: { method: 2, resolution: "0.000055" }, half: 0.01, speed: 0.001,
  },
];
// Defaults of each: the bar with 1 mm ridges.
PRESETS.common = { model: "plate_1d.glb", surface: 0, fsx: 1000, fsy: 0, amplitude: 0.2, stiffness: 400, friction: 0, depth: 1,
  rate: 1000, resolution: "0" };
