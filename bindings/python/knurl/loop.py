"""The loop that plays a scene on a device at its update rate, on a thread of its own that never waits for Python.
SPDX-License-Identifier: MIT"""
import atexit
import threading
import weakref
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import callbacks, metrics
from ._library import KnurlError, Owner, check, described, ffi, fill, lib, open_objects, to_python
from .device import Device
from .methods import raise_error
from .scene import Scene, _tuple_of
from .ticks import OUTPUTS, Ticks, as_ticks, copy_fields, packed

_STATES = {getattr(lib, name): name[len("KNURL_LOOP_"):].lower() for name in dir(lib._parts[""]) if name.startswith("KNURL_LOOP_")}
_SLICE_S = 0.05        # longest wait in C, after which Python handles Ctrl-C and exceptions of callbacks
_STEP = 4096           # ticks that step() runs between two checks for exceptions; a record's ring has room for twice as many
_RECORD_S = 10.0       # length of a record's ring; it is emptied five times a second
_DRAIN_S = 0.2         # period of emptying it
_DRAINED = 1024        # rows taken at a time


class _Record:
    """The ring that the haptic thread fills, and the ticks taken out of it so far."""

    def __init__(self, rate: float, fields: Optional[Sequence[str]]) -> None:
        self.type, self.rate, self.parts = packed(fields), rate, [] # type: Tuple[np.dtype, float, List[np.ndarray]]
        self.rows = np.zeros(max(2 * _STEP, int(_RECORD_S * rate)), OUTPUTS)
        self.ring = ffi.new("knurl_record *")
        self.ring.rows, self.ring.capacity = ffi.from_buffer("knurl_tick_output[]", self.rows), len(self.rows)
        self.taken = np.zeros(_DRAINED, OUTPUTS)
        self.lock = threading.Lock() # the ring has one reader

    def drain(self) -> None:
        with self.lock:
            while True:
                count = lib.knurl_record_take(self.ring, ffi.from_buffer("knurl_tick_output[]", self.taken), _DRAINED)
                if count == 0:
                    return
                self.parts.append(np.empty(count, self.type))
                copy_fields(self.taken[:count], self.parts[-1])

    def ticks(self) -> Ticks:
        self.drain()
        with self.lock:
            if len(self.parts) != 1:
                self.parts = [np.concatenate(self.parts) if self.parts else np.empty(0, self.type)]
            return as_ticks(self.parts[0], self.rate)


def _drain_until_closed(loop: "weakref.ref[Loop]", pause: threading.Event) -> None:
    while not pause.wait(_DRAIN_S):
        alive = loop()
        if alive is None or alive._record is None:
            return
        alive._record.drain()
        del alive


_later: List[Callable[[], None]] = [] # releases of loops whose last reference went within a callback, which cannot wait for
# its own thread to end


@atexit.register
def _finish_later() -> None:
    while _later and not callbacks.in_callback():
        _later.pop()()


class Loop(Owner):
    """Plays a scene on a device, or a force of your own: start() at the update rate, or step() as fast as the machine
    can. A `with` starts it, and stops and closes it at the end; stats and ticks can still be read then. A device or a
    HIP has one loop: making another closes the earlier one, so that a notebook's cell can be run again."""

    _stepped = False

    def __init__(self, scene: Optional[Scene], device: Device, hip: int = 0, *,
                 force_callback: Optional[Callable[[int, callbacks.Sample], Any]] = None,
                 torque_callback: Optional[Callable[[int, callbacks.Sample], Any]] = None,
                 tick_callback: Optional[Callable[[np.ndarray], Any]] = None,
                 record: Union[bool, Sequence[str]] = False, **values: Any) -> None:
        """force_callback(tick, sample), if scene is None: the force, 3 numbers, N, device axes. torque_callback(tick,
        sample), beside a scene or a force_callback, for devices that play torques: 3 numbers, N m, or a Torque, which has
        a gripper's force, too. tick_callback(row): called with each tick's output. All run on the haptic thread, which
        then waits for Python (see Device.of_functions()); after an exception force and torque are zero, the loop ends,
        and wait(), step() or stop() raises it. record: True, or some fields of knurl_tick_output: `ticks` has every tick,
        for nanoseconds a tick on the haptic thread. values: other fields of knurl_loop_desc, such as update_rate_hz,
        tick_limit, ramp_s, reconnect."""
        if scene is None and (record or tick_callback):
            raise ValueError("record, tick_callback: expected a scene, found None; a force_callback gets every sample itself")
        _finish_later()
        for other in open_objects(Loop):
            if other._device is device or (scene is not None and (other._scene, other._hip) == (scene, hip)):
                other._closed_because = "closed, because another loop was made with its device or HIP"
                other.close()
        self._scene, self._device, self._hip = scene, device, hip
        self._stepping: Any = scene._hip(hip) if scene is not None else threading.Lock()
        self._closing = threading.Event()
        self._last: Dict[str, Any] = {}
        desc = described("knurl_loop_desc")
        fill(desc, values)
        desc.scene, desc.device, desc.hip = scene.handle if scene is not None else ffi.NULL, device.handle, hip
        self._record = (_Record(desc.update_rate_hz, None if record is True else record) # type: ignore[arg-type]
                        if record else None)
        self._calls = callbacks.Calls(force_callback, torque_callback, tick_callback, self._record.ring if self._record else None,
                                      self._stepping)
        user = callbacks.keep(self._calls)
        if force_callback:
            desc.force_callback, desc.user = callbacks.force_callback, user
        if torque_callback:
            desc.torque_callback, desc.user = callbacks.torque_callback, user
        if tick_callback or (torque_callback and self._record): # there is one `user` for all
            desc.tick_callback, desc.user = callbacks.tick_callback, user
        elif self._record:
            desc.tick_callback, desc.user = ffi.addressof(lib._parts["knurl_record_"], "knurl_record_put"), self._record.ring
        loop = ffi.new("knurl_loop **")
        with self._stepping:
            result = lib.knurl_loop_create(desc, loop)
        if result != 0:
            callbacks.let_go(user)
        check(result)
        self._calls.loop, self._rate = loop[0], desc.update_rate_hz
        self._own(loop[0], _release(user, self._record))

    def __repr__(self) -> str:
        stats = self.stats
        return f"<knurl.Loop: {'closed' if self.closed else stats['state']}, {stats['ticks']} ticks at {self._rate:g} Hz>"

    def start(self) -> None:
        if self._scene is not None:
            self._scene._hip(self._hip).loop = weakref.ref(self)
        check(lib.knurl_loop_start(self.handle))
        if self._record is not None:
            threading.Thread(target=_drain_until_closed, args=(weakref.ref(self), self._closing), daemon=True).start()

    def step(self, ticks: int) -> None:
        """Runs `ticks` ticks, fewer if the loop ends; see `stats`. One thread at a time, as Scene.tick()."""
        with self._stepping:
            self._stepped = True
            for done in range(0, ticks, _STEP):
                check(lib.knurl_loop_step(self.handle, min(_STEP, ticks - done)))
                self._raise_error()
                if self._record is not None:
                    self._record.drain()

    def wait(self, seconds: Optional[float] = None) -> bool:
        """Waits up to `seconds` (None: for ever) for its end; True if it has ended. Other Python threads run
        meanwhile."""
        left = float("inf") if seconds is None else seconds
        while not lib.knurl_loop_wait(self.handle, max(0.0, min(left, _SLICE_S))):
            left -= _SLICE_S
            if left <= 0.0:
                self._raise_error()
                return False
        self._raise_error()
        return True

    def stop(self) -> None:
        """Ramps the force down to zero, ends the loop and waits for that, 5 s at most."""
        lib.knurl_loop_request_stop(self.handle)
        if not callbacks.in_callback():
            self._end_steps(self.handle)
            self.wait(5.0)

    def _end_steps(self, handle: Any) -> None:
        """A stepped loop has no thread that would end it."""
        if self._stepped:
            try:
                with self._stepping:
                    check(lib.knurl_loop_step(handle, 0))
            except KnurlError: # another thread steps it, and ends it
                pass

    def close(self) -> None:
        """Stops the loop and releases its device and HIP. Does not raise an exception of a callback; stop() does."""
        handle = self._handle
        if handle is None:
            return
        lib.knurl_loop_request_stop(handle)
        if not callbacks.in_callback():
            self._end_steps(handle)
            lib.knurl_loop_wait(handle, 5.0)
        self._last = self.stats
        del handle
        self._closing.set()
        super().close()

    def _raise_error(self) -> None:
        if self._calls.error is not None:
            raise self._calls.error
        raise_error()

    def __enter__(self) -> "Loop":
        self.start()
        return self

    def __exit__(self, *raised: Any) -> None:
        self.close()
        if not any(raised):
            self._raise_error()

    def pause(self) -> None:
        """The force ramps down to zero and contacts end, until resume(); ticks go on."""
        lib.knurl_loop_pause(self.handle)

    def resume(self) -> None:
        lib.knurl_loop_resume(self.handle)

    def set_gain(self, gain: float) -> None:
        """Scales all forces that are sent: 0 to 1."""
        check(lib.knurl_loop_set_gain(self.handle, gain))

    def set_force(self, force: ArrayLike) -> None:
        """Adds a constant force to the surfaces': N, scene axes, until the next call; zeros end it."""
        check(lib.knurl_loop_set_force(self.handle, _tuple_of(force, 3, "force")))

    def vibrate(self, frequency: float, amplitude: float, direction: ArrayLike = (0, 1, 0), seconds: float = 1.0,
                method: str = "T3") -> None:
        """Adds a vibration by T1, T2 or T3 to the surfaces' forces: Hz, N, direction in scene axes; 0 s ends it."""
        check(lib.knurl_loop_vibrate(self.handle, metrics.wave_method(method), frequency, amplitude,
                                     _tuple_of(direction, 3, "direction"), seconds))

    def heartbeat(self) -> None:
        """Reports that the program is alive; see heartbeat_s of knurl_loop_desc."""
        lib.knurl_loop_heartbeat(self.handle)

    @property
    def ticks(self) -> Ticks:
        """All ticks so far, if the loop was made with `record`."""
        if self._record is None:
            raise ValueError("ticks: expected a loop made with record=True or with a list of fields")
        return self._record.ticks()

    @property
    def lost(self) -> int:
        """The number of ticks that were not recorded, because Python did not run for 10 s; normally 0."""
        return int(self._record.ring.lost) if self._record is not None else 0

    @property
    def stats(self) -> Dict[str, Any]:
        """The fields of knurl_loop_stats, the state by its name: "idle", "running", "done", "lost"."""
        if self.closed:
            return dict(self._last)
        stats = described("knurl_loop_stats")
        check(lib.knurl_loop_get_stats(self.handle, stats))
        return {**to_python(stats), "state": _STATES[stats.state]}


def _release(user: Any, record: Any) -> Callable[[Any], None]:
    """The destructor of a loop's pointer; after it C holds no pointer to the callbacks or the ring."""

    def release(pointer: Any) -> None:
        if callbacks.in_callback():
            lib.knurl_loop_request_stop(pointer)
            _later.append(lambda: release(pointer))
            return
        lib.knurl_loop_destroy(pointer)
        callbacks.let_go(user)
        if record is not None:
            record.drain()

    return release
