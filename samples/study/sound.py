#!/usr/bin/python3
"""Draws a run's sound beside its force: spectrograms of `knurl run ... --wav FELT.wav --out RUN.csv`, each with the
temporal frequency f_t of the motion. Both have the same lines up to half the update rate; the sound continues above it.

usage: sound.py RUN.csv [FELT.wav] --out PICTURE.png     the sound: by default RUN.wav

SPDX-License-Identifier: MIT
"""
import argparse
import os
import sys
import wave

try:
    import matplotlib
    import numpy as np
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from style import ASKED, GREY, INPUTS, SHADES, STYLE, BadInput, heading, read_table, save
except ImportError as missing:
    sys.exit(f"sound.py: {missing} for {sys.executable}; apt-get install python3-matplotlib, then use /usr/bin/python3")

RANGE_DB = 50.0  # below the loudest
SOUND_TOP_HZ = 1500.0


def read_sound(path):
    try:
        with open(path, "rb") as file, wave.open(file) as sound:
            found = os.fstat(file.fileno())
            INPUTS.append((found.st_dev, found.st_ino))
            if (sound.getnchannels(), sound.getsampwidth()) != (1, 2):
                raise BadInput(f"{path}: expected one channel of 16 bits, as knurl run --wav writes")
            return np.frombuffer(sound.readframes(sound.getnframes()), "<i2") / 32768.0, sound.getframerate()
    except (OSError, EOFError, wave.Error) as error:
        raise BadInput(f"{path}: expected a WAV file, found: {error}") from None


def draw(axes, signal, rate, window_s, run, top):
    """A spectrogram with f_t over it."""
    window = int(window_s * rate)
    power, frequencies, times, image = axes.specgram(signal + 1e-12, NFFT=window, Fs=rate, noverlap=window * 7 // 8,
                                                     window=np.hanning(window), cmap=SHADES)
    loudest = 10 * np.log10(power.max())
    image.set_clim(loudest - RANGE_DB, loudest)
    axes.plot(run["t"], run["ft"], color=ASKED, linewidth=0.8)
    axes.set(xlim=(run["t"][0], run["t"][-1]), ylim=(0, top), xlabel="time (s)", ylabel="frequency (Hz)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("run")
    parser.add_argument("wav", nargs="?")
    parser.add_argument("--out", required=True)
    given = parser.parse_args()
    run = read_table(os.path.dirname(given.run) or ".", os.path.basename(given.run))
    sound, rate = read_sound(given.wav or os.path.splitext(given.run)[0] + ".wav")
    force = np.sqrt(run["fx"] ** 2 + run["fy"] ** 2 + run["fz"] ** 2)
    ticks = round(1.0 / (run["t"][1] - run["t"][0]))
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    figure.subplots_adjust(left=0.065, right=0.985, top=0.74, bottom=0.13, wspace=0.18)
    heading(figure, "The same grating, felt and heard", "strength within 50 dB of the strongest; the line is f_t")
    draw(axes[0], np.diff(force, prepend=force[0]), ticks, 0.16, run, ticks / 2)
    draw(axes[1], sound, rate, 0.08, run, SOUND_TOP_HZ)
    axes[0].set_title(f"change of the force, {ticks} Hz", color=GREY)
    axes[1].set_title(f"sound, {rate} Hz", color=GREY)
    save(figure, given.out)


if __name__ == "__main__":
    try:
        main()
    except BadInput as problem:
        sys.exit(f"sound.py: {problem}")
