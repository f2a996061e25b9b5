"""Metrics of a periodic signal with one value per tick, held until the next tick; the same as `knurl metrics` prints.
SPDX-License-Identifier: MIT"""
from math import ceil, floor, gcd, isnan
from typing import Any, Dict, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import check, ffi, lib

_LONGEST = 200000 # ticks: the longest actual period that is searched for
_METHODS = {"T1": "KNURL_WAVE_T1", "T2": "KNURL_WAVE_T2", "T3": "KNURL_WAVE_T3"}


def _values_of(values: ArrayLike, name: str = "values") -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or len(array) == 0 or not np.isfinite(array).all():
        raise ValueError(f"{name}: expected a row of finite numbers, found an array of shape {array.shape}")
    return array


def _whole_ticks(period: float) -> int:
    """The smallest number of ticks that is a whole number of periods, to 1e-9 of it; 0: not found."""
    ticks = period * np.arange(1, int(_LONGEST / period) + 1)
    whole = np.flatnonzero(np.abs(ticks - np.floor(ticks + 0.5)) <= 1e-9 * ticks)
    return int(ticks[whole[0]] + 0.5) if len(whole) else 0


def _actual_period(wave: Any) -> int:
    if wave.method == lib.KNURL_WAVE_T1:
        return _whole_ticks(wave.period_ticks)
    period = 1
    for part in wave.parts[0:wave.part_count]:
        period *= part.length // gcd(period, part.length)
    return period if period <= _LONGEST else 0


def wave_method(method: str) -> int:
    """KNURL_WAVE_ of a temporal method's name."""
    if method not in _METHODS:
        raise ValueError(f"method: expected T1, T2 or T3, found {method!r}")
    return int(getattr(lib, _METHODS[method]))


def wave(method: str, period: float, amplitude: float = 1.0, rate: float = 1000.0, ticks: Union[int, None] = None) -> np.ndarray:
    """A temporal signal of the paper: method T1, T2 or T3, period in s, amplitude, rate in Hz. ticks: number of values;
    None: one actual period, after which the signal repeats."""
    made = ffi.new("knurl_wave *")
    check(lib.knurl_wave_prepare(wave_method(method), period, amplitude, rate, made))
    count = _actual_period(made) if ticks is None else ticks
    if ticks is None and count == 0:
        raise ValueError(f"period: no whole number of periods of {period} s within {_LONGEST} ticks")
    return np.array([lib.knurl_wave_value(made, tick) for tick in range(count)])


def dominant(values: ArrayLike, rate: float) -> Dict[str, float]:
    """The strongest line of a held signal up to rate / 2: {"hz", "amplitude" (peak)}. values: whole actual periods."""
    signal = _values_of(values)
    lines = np.arange(len(signal) // 2 + 1)
    held = 2.0 / len(signal) * np.abs(np.fft.rfft(signal)) * np.sinc(lines / len(signal))
    held[0] = 0.0
    best = int(np.argmax(held >= held.max() * (1.0 - 1e-5))) # the lowest of equal lines
    return {"hz": best * rate / len(signal), "amplitude": float(held[best])}


def pcc(a: ArrayLike, b: ArrayLike) -> float:
    """Pearson's correlation of two signals, each one actual period, over the least common multiple of both. NaN if
    either is constant."""
    x, y = _values_of(a, "a"), _values_of(b, "b")
    common = gcd(len(x), len(y))
    x, y = x - x.mean(), y - y.mean()
    # over that multiple a tick of one coincides with those of the other at the same distance from a multiple of
    # `common`
    ab = sum(x[k::common].sum() * y[k::common].sum() for k in range(common))
    size = np.sqrt(len(y) // common * (x @ x) * (len(x) // common * (y @ y)))
    return float(ab / size) if size > 0.0 else float("nan")


def _push(values: np.ndarray, rate: float, frequency: float) -> float:
    ticks = max(1.0, np.floor(0.05 * frequency + 0.5)) / frequency * rate
    edges = np.floor(ticks * np.arange(int(len(values) / ticks) + 2) + 0.5).astype(int)
    edges = edges[edges <= len(values)]
    blocks = [abs(values[begin:end].mean()) for begin, end in zip(edges[:-1], edges[1:])]
    return float(np.mean(blocks)) if blocks else float("nan")


def _wavering(values: np.ndarray, window: int) -> float:
    sums = np.concatenate(([0.0], np.cumsum(values**2)))
    levels = np.sqrt(np.maximum(0.0, (sums[window:] - sums[:-window]) / window))
    mean = levels.mean() if len(levels) else 0.0
    return float(levels.std() / mean) if mean else 0.0


def felt_weight(hz: ArrayLike) -> np.ndarray:
    """The sensitivity to a force at a frequency: the motion that it causes in a device of 45 g and 0.5 N s/m, held by a
    hand of 5 N s/m and 700 N/m, over the detection threshold of a fingertip (flat to 40 Hz, -12 dB an octave to 250 Hz
    and +12 above: Verrillo 1963); zero up to 8 Hz. A model, not a measurement: only ratios have a meaning."""
    f = np.asarray(hz, dtype=float)
    w, over = 2.0 * np.pi * f, np.maximum(f, 1e-9) / 250.0
    threshold = np.where(f < 40.0, (250.0 / 40.0) ** 2, np.maximum(over**-2, over**2))
    return np.where(f > 8.0, 1.0 / np.hypot(700.0 - 0.045 * w**2, 5.5 * w) / threshold, 0.0)


def _false_share(power: np.ndarray, ridges: np.ndarray) -> float:
    return float(power[~ridges].sum() / power.sum()) if power.sum() > 0.0 else 1.0


def steady(values: ArrayLike, rate: float, frequency: float) -> Dict[str, float]:
    """Metrics of the signal of ridges that pass at `frequency` Hz, with the names and definitions of the study
    `tradeoff` (samples/study/tradeoff.md), in the unit of `values` unless noted. Needs at least 50 ms and one cycle.

    false_tones, felt_false_tones: the share (0 to 1) of the power, below rate / 2 or as felt, that is farther than 5 %
    of the frequency (at least 4 Hz) from each of its odd multiples. level: the line at the frequency; a square wave of
    1 has 4/pi. push: mean over blocks of 50 ms, to whole cycles, of |mean|. net: |mean|, through Hann's window.
    wavering, wavering_50: standard deviation over mean of the rms in windows of 12 and 50 ms. crest: the largest
    |value|."""
    signal = _values_of(values)
    push = _push(signal, rate, frequency)
    if isnan(push):
        raise ValueError(f"values: expected 50 ms and a cycle of {frequency} Hz at least, found {len(signal)} ticks")
    ticks = np.arange(len(signal))
    line = np.exp(2j * np.pi * np.fmod(frequency * ticks / rate, 1.0)) @ signal
    hann = 0.5 - 0.5 * np.cos(2.0 * np.pi * (ticks + 0.5) / len(signal))
    net = (hann @ signal) / hann.sum()
    hz = ticks[1:] * (rate / len(signal))
    power = np.abs(np.fft.fft(hann * (signal - net))[1:]) ** 2
    odd = np.maximum(1.0, 2.0 * np.floor(0.5 * hz / frequency) + 1.0)
    ridges = np.abs(hz - odd * frequency) <= max(0.05 * frequency, 4.0)
    felt = power * (np.sinc(hz / rate) * felt_weight(hz)) ** 2 # with the hold's images up to the update rate
    return {"false_tones": _false_share(np.where(hz <= rate / 2.0, power, 0.0), ridges),
            "felt_false_tones": _false_share(felt, ridges), "level": float(2.0 * abs(line) / len(signal)), "push": push,
            "net": float(abs(net)), "wavering": _wavering(signal, max(1, int(0.012 * rate + 0.5))),
            "wavering_50": _wavering(signal, max(1, int(0.05 * rate + 0.5))), "crest": float(np.abs(signal).max())}


def step(values: ArrayLike, cycles: ArrayLike) -> float:
    """The largest error of phase between the played half cycles and the ridges, in cycles: the distance of a tick's
    position on the grating from the half cycle that is played, counted by sign changes of `values`; 0 within half a
    cycle. cycles: the position of each tick (`cycles` along the stroked axis), a whole number at the start of each
    rise. At each turn of the hand, the first half cycle is matched to the nearest one of its sign. For S1 and
    bandlimited; S2's events, which may have rests between, are counted by the study."""
    signs, phase = np.sign(_values_of(values)), _values_of(cycles, "cycles")
    if len(signs) != len(phase):
        raise ValueError(f"cycles: expected a number for each of {len(signs)} values, found {len(phase)}")
    directions = np.sign(np.diff(phase, prepend=phase[:1]))
    worst, way, felt, half = 0.0, 0.0, 0.0, 0.0 # felt: the last sign, 0 from a turn on
    for sign, place, direction in zip(signs.tolist(), phase.tolist(), directions.tolist()):
        if direction * way < 0.0:
            felt = 0.0
        way = direction or way
        if sign == 0.0:
            continue
        ahead, odd = 0.5 - place if way < 0.0 else place, float(sign < 0.0)
        if felt == 0.0:
            half = 2.0 * floor(ahead - 0.5 * odd + 0.25) + odd
        elif sign != felt:
            half += 1.0
        felt = sign
        worst = max(worst, 0.5 * half - ahead, ahead - 0.5 * (half + 1.0))
    return worst


def temporal(method: str, period: float, amplitude: float = 1.0, rate: float = 1000.0) -> Dict[str, Any]:
    """All metrics of a temporal signal, with the names that `knurl metrics` prints. period in s, rate in Hz."""
    signal = wave(method, period, amplitude, rate)
    count = len(signal) * ceil(max(1.0, 20.0 * period) * rate / len(signal))
    line = dominant(signal, rate)
    found: Dict[str, Any] = {"actual_period_ms": 1e3 * len(signal) / rate, "dominant_hz": line["hz"], "dominant_amplitude": line["amplitude"],
             "net": float(signal.mean()), "rms": float(np.sqrt((signal**2).mean()))}
    repeated = steady(np.tile(signal, count // len(signal)), rate, 1.0 / period)
    found.update({name: repeated[name] for name in ("level", "wavering", "push", "false_tones", "felt_false_tones")})
    found["pcc"] = {}
    for other in _METHODS:
        try:
            found["pcc"][other] = pcc(signal, wave(other, period, amplitude, rate))
        except ValueError: # no whole period within reach
            found["pcc"][other] = float("nan")
    return found
