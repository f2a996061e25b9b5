"""Ticks as rows of an array: tables, verdicts and pictures of them. SPDX-License-Identifier: MIT"""
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

from . import metrics
from ._library import arrays_of, lib

OUTPUTS = arrays_of("knurl_tick_output")

# SI units of fields; those not listed have no unit.
UNITS = {"device_force": "N", "force": "N", "hip": "m", "proxy": "m", "depth": "m", "height": "m", "hip_velocity": "m/s",
         "surface_velocity": "m/s", "spatial_frequency": "1/m", "temporal_frequency": "Hz"}
_PREFIXES = {"": 1.0, "k": 1e-3, "m": 1e3, "u": 1e6}


def packed(fields: Optional[Sequence[str]] = None) -> np.dtype:
    """The type of rows with these fields of knurl_tick_output (None: all) and no gaps."""
    names = list(OUTPUTS.names or ()) if fields is None else list(fields)
    for name in names:
        if name not in (OUTPUTS.fields or {}):
            raise ValueError(f"fields: expected some of {', '.join(OUTPUTS.names or ())}, found {name!r}")
    return np.dtype([(name, OUTPUTS.fields[name][0]) for name in names]) # type: ignore[index]


def copy_fields(rows: np.ndarray, to: np.ndarray) -> None:
    """Copies the fields that `to` has; one by one, which is faster than an assignment of rows."""
    for name in to.dtype.names or ():
        to[name] = rows[name]


def _factor(field: str, unit: str) -> float:
    own = UNITS.get(field, "")
    for prefix, factor in _PREFIXES.items():
        if own and unit == prefix + own:
            return factor
    raise ValueError(f"units: expected one of {', '.join(prefix + own for prefix in _PREFIXES) if own else 'no unit'} "
                     f"for {field!r}, found {unit!r}")


class Ticks(np.ndarray):
    """Rows of knurl_tick_output, or of some of its fields: `ticks["force"]` is (n, 3), `ticks["depth"]` is (n). A numpy
    array with an update rate (`rate`, Hz), which slices keep; as_ticks() restores them after numpy returned a plain
    array, as np.concatenate() does."""

    rate: Optional[float] = None

    def __array_finalize__(self, other: Any) -> None:
        self.rate = getattr(other, "rate", None)

    def __getitem__(self, key: Any) -> Any:
        found = super().__getitem__(key)
        return found.view(np.ndarray) if isinstance(found, Ticks) and found.dtype.names is None else found

    def __reduce__(self) -> Any:
        reduced: Any = super().__reduce__()
        return (*reduced[:2], (reduced[2], self.rate))

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self.rate = state[1]

    def _field(self, name: str) -> np.ndarray:
        if name not in (self.dtype.names or ()):
            raise ValueError(f"ticks: expected the field {name!r} among those asked for, found {self.dtype.names}")
        return np.asarray(self[name])

    def _hz(self) -> float:
        if self.rate is None:
            raise ValueError("ticks: expected their update rate in `rate`, Hz, found None")
        return self.rate

    def to_frame(self, fields: Optional[Sequence[str]] = None, units: Optional[Mapping[str, str]] = None) -> Any:
        """A pandas.DataFrame with one column per number: "depth", "force_x", "force_y", "force_z". fields: some of its
        fields (None: all). units: other units than SI, such as {"depth": "mm", "force": "mN"}; `frame.attrs["units"]`
        has all. The index is the time in s if there is the field "tick"."""
        import pandas

        columns: Dict[str, np.ndarray] = {}
        column_units: Dict[str, str] = {}
        names = list(self.dtype.names or ()) if fields is None else list(fields)
        units = dict(units or {})
        if set(units) - set(names):
            raise ValueError(f"units: expected fields of the frame, found {sorted(set(units) - set(names))}")
        for name in names:
            values = self._field(name)
            unit = units.get(name, UNITS.get(name, ""))
            if name in units:
                values = values * _factor(name, unit)
            parts = [name] if values.ndim == 1 else [f"{name}_{axis}" for axis in "xyz"[:values.shape[1]]]
            for i, part in enumerate(parts):
                columns[part], column_units[part] = values if values.ndim == 1 else values[:, i], unit
        timed = "tick" in (self.dtype.names or ())
        index = pandas.Index(self["tick"] / self._hz(), name="t") if timed else None
        frame = pandas.DataFrame(columns, index=index)
        frame.attrs["units"] = column_units
        return frame

    def verdict(self, amplitude: float = 1.0) -> "Verdict":
        """Compares the half cycles played with those crossed; see Verdict. amplitude: A of the grating, m, the unit of
        level, push and crest (1: m). Needs the fields height and temporal_frequency, and
        flags if the hand is not always in contact."""
        height, hz, rate = self._field("height"), self._field("temporal_frequency"), self._hz()
        touched = (self._field("flags") & lib.KNURL_TICK_CONTACT != 0 if "flags" in (self.dtype.names or ()) else
                   np.ones(len(self), bool)) # a Grating's ticks have no flags
        signs = np.sign(height[height != 0.0])
        found = Verdict(crossed=float(2.0 * hz[touched].sum() / rate), played=int(np.count_nonzero(signs[1:] != signs[:-1])),
                        amplitude=amplitude)
        begin, end = _steady_stretch(np.where(touched, hz, 0.0), rate)
        if end > begin:
            found.begin, found.end, found.hz = begin, end, float(hz[begin:end].mean())
            steady = metrics.steady(height[begin:end], rate, found.hz)
            found.false_tones, found.felt_false_tones = steady["false_tones"], steady["felt_false_tones"]
            found.push, found.crest = steady["push"] / amplitude, steady["crest"] / amplitude
            phase = 2j * np.pi * np.cumsum(hz[begin:end]) / rate # of the hand itself: a constant hz would drift from it
            found.level = float(2.0 * abs(np.exp(phase) @ height[begin:end]) / (end - begin) / amplitude)
        return found

    def plot(self, axes: Optional[Sequence[Any]] = None) -> List[Any]:
        """Draws temporal frequency, height and force over time with matplotlib, and returns the three axes. axes: three
        to draw into (None: a new figure). Needs the fields temporal_frequency, height, force and tick."""
        t = self._field("tick") / self._hz()
        if axes is None:
            from matplotlib import pyplot
            axes = list(pyplot.subplots(3, sharex=True, figsize=(8, 5), layout="constrained")[1])
        axes[0].plot(t, self._field("temporal_frequency"), lw=1)
        axes[0].set_ylabel("ridges pass, Hz")
        axes[1].step(t, 1e3 * self._field("height"), where="post", lw=1)
        axes[1].set_ylabel("height, mm")
        for axis, values in zip("xyz", self._field("force").T):
            axes[2].step(t, values, where="post", lw=1, label=f"$F_{axis}$")
        axes[2].set_ylabel("force, N")
        axes[2].set_xlabel("time, s")
        axes[2].legend(loc="upper right", ncols=3, frameon=False)
        return list(axes)


def as_ticks(rows: np.ndarray, rate: float) -> Ticks:
    """The rows of ticks as ticks at a rate, Hz; not copied."""
    ticks = rows.view(Ticks)
    ticks.rate = rate
    return ticks


BLOCK_S = 0.05   # length of a block, over which the frequency is averaged
STEADY = 0.05    # largest relative difference of the frequencies of a steady stretch's blocks
LEAST_BLOCKS = 5


def _steady_stretch(hz: np.ndarray, rate: float) -> Tuple[int, int]:
    """The longest run of blocks whose mean frequencies differ by at most STEADY: begin and end, ticks; 0, 0 if it
    has fewer than LEAST_BLOCKS."""
    block = max(1, int(BLOCK_S * rate + 0.5))
    means = hz[:len(hz) // block * block].reshape(-1, block).mean(axis=1)
    best, begin = (0, 0), 0
    for end in range(1, len(means) + 1):
        while begin < end and not (means[begin:end].min() > 0.0 and
                                   means[begin:end].max() <= (1.0 + STEADY) * means[begin:end].min()):
            begin += 1
        if end - begin > best[1] - best[0]:
            best = (begin, end)
    return (best[0] * block, best[1] * block) if best[1] - best[0] >= LEAST_BLOCKS else (0, 0)


@dataclass
class Verdict:
    """Measures of a stroke. crossed, played: half cycles, of all ticks. The others are of the longest stretch, ticks
    `begin` to `end`, over which ridges pass at a steady `hz` (within 5 % for 0.25 s at least), NaN if there is none:
    false_tones and felt_false_tones (shares of the power), level (of the line that keeps step with the hand; a square
    wave has 4/pi), push (the height that stays over 50 ms) and crest, in units of `amplitude`: see `metrics.steady`."""

    crossed: float
    played: int
    amplitude: float = 1.0
    begin: int = 0
    end: int = 0
    hz: float = float("nan")
    false_tones: float = float("nan")
    felt_false_tones: float = float("nan")
    level: float = float("nan")
    push: float = float("nan")
    crest: float = float("nan")

    def __str__(self) -> str:
        unit = "m" if self.amplitude == 1.0 else "A"
        counts = f"{self.crossed:.1f} half cycles crossed, {self.played} played"
        if self.begin == self.end:
            return f"{counts}; the speed was never steady for {LEAST_BLOCKS * BLOCK_S:g} s"
        return (f"{counts}; at {self.hz:.1f} Hz: false tones {100 * self.false_tones:.2g} %, felt "
                f"{100 * self.felt_false_tones:.2g} %, level {self.level:.3g} {unit}, push {self.push:.2g} {unit}, crest "
                f"{self.crest:.3g} {unit}")
