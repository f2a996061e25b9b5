"""Metrics of a periodic signal, a value a tick, each held until the next: what `knurl metrics` prints.
SPDX-License-Identifier: MIT"""
from math import ceil, gcd, isnan
from typing import Any, Dict, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import check, ffi, lib

_LONGEST = 200000 # ticks of an actual period that is looked for
_METHODS = {"T1": "KNURL_WAVE_T1", "T2": "KNURL_WAVE_T2", "T3": "KNURL_WAVE_T3"}


def _values_of(values: ArrayLike, name: str = "values") -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or len(array) == 0 or not np.isfinite(array).all():
        raise ValueError(f"{name}: expected a row of finite numbers, found an array of shape {array.shape}")
    return array


def _whole_ticks(period: float) -> int:
    """The least whole number of ticks that is a whole number of periods, to 1e-9 of it; 0: none in reach."""
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


def wave(method: str, period: float, amplitude: float = 1.0, rate: float = 1000.0, ticks: Union[int, None] = None) -> np.ndarray:
    """A temporal signal of the paper's: method T1, T2 or T3, period in s, amplitude, rate in Hz. ticks: how many values;
    None: one actual period, after which all repeats."""
    if method not in _METHODS:
        raise ValueError(f"method: expected T1, T2 or T3, found {method!r}")
    made = ffi.new("knurl_wave *")
    check(lib.knurl_wave_prepare(getattr(lib, _METHODS[method]), period, amplitude, rate, made))
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
    best = int(np.argmax(held >= held.max() * (1.0 - 1e-5))) # of equals the lowest
    return {"hz": best * rate / len(signal), "amplitude": float(held[best])}


def pcc(a: ArrayLike, b: ArrayLike) -> float:
    """Pearson's correlation of two signals, each an actual period, over the least common multiple of both. NaN where either
    does not vary."""
    x, y = _values_of(a, "a"), _values_of(b, "b")
    common = gcd(len(x), len(y))
    x, y = x - x.mean(), y - y.mean()
    # over that multiple a tick of one meets those of the other that are as far from a multiple of `common`
    ab = sum(x[k::common].sum() * y[k::common].sum() for k in range(common))
    size = np.sqrt(len(y) // common * (x @ x) * (len(x) // common * (y @ y)))
    return float(ab / size) if size > 0.0 else float("nan")


def _push(values: np.ndarray, rate: float, frequency: float) -> float:
    ticks = max(1.0, np.floor(0.05 * frequency + 0.5)) / frequency * rate
    edges = np.floor(ticks * np.arange(int(len(values) / ticks) + 2) + 0.5).astype(int)
    edges = edges[edges <= len(values)]
    blocks = [abs(values[begin:end].mean()) for begin, end in zip(edges[:-1], edges[1:])]
    return float(np.mean(blocks)) if blocks else float("nan")


def steady(values: ArrayLike, rate: float, frequency: float) -> Dict[str, float]:
    """What a hand gets of a signal at `frequency` Hz: "fundamental" (the line there; a square wave of 1 has 4/pi),
    "unevenness" (standard deviation over mean of the rms in 12 ms, as the window moves), "net_50ms" (mean over blocks of 50 ms, to
    whole cycles, of |mean|). values: 50 ms and a cycle at least."""
    signal = _values_of(values)
    push = _push(signal, rate, frequency)
    if isnan(push):
        raise ValueError(f"values: expected 50 ms and a cycle of {frequency} Hz at least, found {len(signal)} ticks")
    line = np.exp(2j * np.pi * np.fmod(frequency * np.arange(len(signal)) / rate, 1.0)) @ signal
    window = max(1, int(0.012 * rate + 0.5))
    sums = np.concatenate(([0.0], np.cumsum(signal**2)))
    levels = np.sqrt(np.maximum(0.0, (sums[window:] - sums[:-window]) / window))
    mean = levels.mean() if len(levels) else 0.0
    return {"fundamental": float(2.0 * abs(line) / len(signal)), "unevenness": float(levels.std() / mean) if mean else 0.0,
            "net_50ms": push}


def temporal(method: str, period: float, amplitude: float = 1.0, rate: float = 1000.0) -> Dict[str, Any]:
    """All metrics of a temporal signal, with the names that `knurl metrics` prints. period in s, rate in Hz."""
    signal = wave(method, period, amplitude, rate)
    count = len(signal) * ceil(max(1.0, 20.0 * period) * rate / len(signal))
    line = dominant(signal, rate)
    found = {"actual_period_ms": 1e3 * len(signal) / rate, "dominant_hz": line["hz"], "dominant_amplitude": line["amplitude"],
             "net": float(signal.mean()), "rms": float(np.sqrt((signal**2).mean()))}
    found.update(steady(np.tile(signal, count // len(signal)), rate, 1.0 / period))
    found["pcc"] = {}
    for other in _METHODS:
        try:
            found["pcc"][other] = pcc(signal, wave(other, period, amplitude, rate))
        except ValueError: # no whole period within reach
            found["pcc"][other] = float("nan")
    return found
