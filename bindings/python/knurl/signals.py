"""Parts of a tick by themselves: velocities from positions, and the heights of a grating. SPDX-License-Identifier: MIT"""
from typing import Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._library import arrays_of, check, ffi, lib
from .methods import raise_error
from .scene import _method, _rows, _tuple_of
from .ticks import Ticks, as_ticks

_VELOCITIES = {"auto": "KNURL_VELOCITY_AUTO", "difference": "KNURL_VELOCITY_DIFFERENCE", "foaw": "KNURL_VELOCITY_FOAW"}
_HEIGHTS = arrays_of("knurl_grating_output")


class Velocity:
    """A velocity estimator of one point, see knurl/motion.h. method: "auto", "difference", "foaw". resolution:
    the positions' quantum, m, 0 if they are exact. rate: Hz."""

    def __init__(self, method: str = "auto", resolution: float = 0.0, rate: float = 1000.0) -> None:
        if method not in _VELOCITIES:
            raise ValueError(f"method: expected one of {', '.join(_VELOCITIES)}, found {method!r}")
        self._state = ffi.new("knurl_velocity *")
        check(lib.knurl_velocity_prepare(getattr(lib, _VELOCITIES[method]), resolution, rate, self._state))

    def play(self, positions: ArrayLike) -> np.ndarray:
        """The velocities (n, 3), m/s, of the next ticks' positions (n, 3), m."""
        rows = _rows(positions, 3, "f8", "positions")
        if not np.isfinite(rows).all():
            raise ValueError("positions: expected finite numbers")
        found = np.empty_like(rows)
        begin, to = ffi.from_buffer("double[]", rows), ffi.from_buffer("double[]", found)
        for i in range(0, rows.size, 3):
            lib.knurl_velocity_update(self._state, begin + i, to + i)
        return found


class Grating:
    """One HIP on one grating, without contact or force; see knurl/grating.h. method: as Material's. spatial_frequency:
    cycles/m along x and y; amplitude: m; rate: Hz; resolution: the positions' quantum, m."""

    def __init__(self, spatial_frequency: Sequence[float] = (1000.0, 0.0), amplitude: float = 1.0, method: Optional[str] = None,
                 rate: float = 1000.0, resolution: float = 0.0) -> None:
        self._grating, self._state = ffi.new("knurl_grating *"), ffi.new("knurl_grating_state *")
        self._grating.method = _method(method)
        self._grating.spatial_frequency = _tuple_of(spatial_frequency, 2, "spatial_frequency")
        self._grating.amplitude, self._grating.update_rate_hz, self._grating.resolution = amplitude, rate, resolution
        check(lib.knurl_grating_check(self._grating))

    def play(self, positions: ArrayLike, velocities: ArrayLike) -> Ticks:
        """The next ticks, rows of knurl_grating_output ("height", "temporal_frequency", "event" ...): positions (n, 2), m, and
        velocities (n, 2), m/s, along the surface's x and y."""
        at, speed = _rows(positions, 2, "f8", "positions"), _rows(velocities, 2, "f8", "velocities")
        if at.shape != speed.shape:
            raise ValueError(f"velocities: expected {len(at)} rows as of positions, found {len(speed)}")
        found = np.zeros(len(at), _HEIGHTS)
        x, v = ffi.from_buffer("double[]", at), ffi.from_buffer("double[]", speed)
        to = ffi.from_buffer("knurl_grating_output[]", found)
        for i in range(len(at)):
            lib.knurl_grating_step(self._grating, self._state, x + 2 * i, v + 2 * i, to + i)
        raise_error()
        return as_ticks(found, self._grating.update_rate_hz)
