"""Devices, and the loop that plays a scene on one at its update rate, on a thread of its own that never waits for
Python. SPDX-License-Identifier: MIT"""
import atexit
import threading
import weakref
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import callbacks, metrics
from ._library import Owner, check, described, ffi, fill, lib, open_objects, to_python
from .methods import raise_error
from .scene import Scene, Surface, _rows, _tuple_of
from .ticks import OUTPUTS, Ticks, as_ticks, copy_fields, packed

_STATES = ("idle", "running", "done", "lost")
_SLICE_S = 0.05        # longest wait in C, after which Python handles Ctrl-C and exceptions of callbacks
_STEP = 4096           # ticks that step() runs between two checks for exceptions; a record's ring has room for twice as many
_RECORD_S = 10.0       # length of a record's ring; it is emptied five times a second
_DRAIN_S = 0.2         # period of emptying it
_DRAINED = 1024        # rows taken at a time


class Listing(NamedTuple):
    """A connected device, or a kind with no device connected; reason: why it cannot be used; "" if it can."""

    uri: str
    name: str
    reason: str


class Event(NamedTuple):
    """A device's fault or recovery: name, sentence, value in `unit`, and time on a monotonic clock, s."""

    name: str
    text: str
    value: float
    unit: str
    time: float


def devices() -> List[Listing]:
    """The connected devices, and an entry with the reason for each kind without one. Takes some milliseconds."""
    room = 64
    found = ffi.new("knurl_device_listing[]", room)
    count = min(room, lib.knurl_device_list(found, room))
    return [Listing(*(to_python(getattr(found[i], name)) for name in Listing._fields)) for i in range(count)]


class Device(Owner):
    """A device by its URI: "fake", "touch", "falcon", "rawhid" ...; see knurl_device_open(). If this program already
    has it
    open by the same URI and it cannot be opened twice, the earlier object and its loop are closed."""

    _order = 1
    _functions: Optional[callbacks.Functions] = None

    def __init__(self, uri: str = "fake") -> None:
        lib.knurl_device_zero_on_exit(0)
        device = ffi.new("knurl_device **")
        result = lib.knurl_device_open(uri.encode(), device)
        if result == lib.KNURL_ERROR_SYSTEM: # open already, such as by a notebook's cell that is run again
            for earlier in [other for other in open_objects(Device) if other._uri == uri]:
                for loop in [loop for loop in open_objects(Loop) if loop._device is earlier]:
                    loop.close() # it keeps a closed device
                earlier.close()
                result = lib.knurl_device_open(uri.encode(), device)
        check(result)
        self._own(device[0], lib.knurl_device_close)
        self._uri = uri

    @classmethod
    def of_functions(cls, read: Callable[[], Any], write: Callable[[np.ndarray], Any], max_force: float, *,
                     start: Optional[Callable[[float], Any]] = None, reopen: Optional[Callable[[], Any]] = None,
                     close: Optional[Callable[[], Any]] = None, blocking: bool = False, motors_known: bool = False,
                     name: str = "own", **info: Any) -> "Device":
        """A device of your own; see knurl_device_functions. read(): the position, 3 numbers in m, or a Sample; None: no
        new one. write(force): N, 3 numbers, max_force at most. An exception in a function counts as a lost device; the
        first
        is in `error`. info: other fields of knurl_device_info, such as resolution or workspace_min.

        The functions are called on the loop's haptic thread, which then waits for Python: a Python program that does
        other
        work at the same time delays it by milliseconds. For simulations use Loop.step(); for real hardware write the
        functions in C."""
        lib.knurl_device_zero_on_exit(0)
        described_info = {"name": name.encode(), "max_force": max_force, **info}
        fill(ffi.new("knurl_device_info *"), described_info) # raises here, not in a callback, if a name is unknown
        functions = described("knurl_device_functions")
        functions.blocking, functions.motors_known = blocking, motors_known
        device = cls.__new__(cls)
        device._functions = callbacks.Functions(read, write, described_info, start, reopen, close)
        device._uri = name
        user = callbacks.fill_functions(functions, device._functions)
        opened = ffi.new("knurl_device **")
        result = lib.knurl_device_open_functions(functions, opened)
        if result != 0:
            callbacks.let_go(user)
        check(result)
        device._own(opened[0], lib.knurl_device_close)
        return device

    def __repr__(self) -> str:
        return f"<knurl.Device {self._uri!r}: {'closed' if self.closed else self.info['name']}>"

    @property
    def info(self) -> Dict[str, Any]:
        """The fields of knurl_device_info: name, workspace, resolution, max_force ..."""
        info = described("knurl_device_info")
        check(lib.knurl_device_get_info(self.handle, info))
        return dict(to_python(info))

    @property
    def status(self) -> Dict[str, Any]:
        """The fields of knurl_device_status: lost, halted, buttons ..."""
        status = described("knurl_device_status")
        check(lib.knurl_device_get_status(self.handle, status))
        return dict(to_python(status))

    @property
    def error(self) -> Optional[BaseException]:
        """The first exception that a function of an own device raised, or None."""
        return self._functions.error if self._functions else None

    def events(self) -> Iterator[Event]:
        """Removes and yields the faults and recoveries since the last call, the oldest first."""
        event = ffi.new("knurl_device_event *")
        while lib.knurl_device_next_event(self.handle, event):
            name, text, unit = (ffi.string(of(event.code)).decode() for of in
                                (lib.knurl_fault_name, lib.knurl_fault_string, lib.knurl_fault_unit))
            yield Event(name, text, event.value, unit, 1e-9 * event.time_ns)

    def halt(self) -> None:
        """Zeroes the force at once. A loop then ramps up again."""
        lib.knurl_device_halt(self.handle)

    def lay_stroke(self, scene: Scene, surface: Surface, stroke: str = "line", hip: int = 0) -> None:
        """Makes the fake device's hand stroke a surface; see knurl_fake_lay_stroke()."""
        number = ffi.new("int32_t *")
        check(lib.knurl_stroke_from_name(stroke.encode(), number))
        check(lib.knurl_fake_lay_stroke(self.handle, scene.handle, hip, surface.id, number[0], ffi.NULL))

    def set_stroke(self, stroke: str = "line", **values: Any) -> None:
        """Makes the fake device's hand stroke in device coordinates; values: fields of knurl_stroke_desc."""
        desc, number = described("knurl_stroke_desc"), ffi.new("int32_t *")
        check(lib.knurl_stroke_from_name(stroke.encode(), number))
        fill(desc, {"stroke": number[0], **values})
        check(lib.knurl_fake_set_stroke(self.handle, desc))

    def set_trace(self, times: ArrayLike, positions: ArrayLike) -> None:
        """The fake device plays recorded positions (n, 3), m, at times (n), s; see knurl_fake_set_trace()."""
        rows = _rows(np.column_stack([np.asarray(times, dtype=float), _rows(positions, 3, "f8", "positions")]), 4, "f8", "trace")
        check(lib.knurl_fake_set_trace(self.handle, ffi.from_buffer("double[]", rows), len(rows)))


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
    can. A
    `with` starts it, and stops and closes it at the end; stats and ticks can still be read then. A device or a HIP has
    one
    loop: making another closes the earlier one, so that a notebook's cell can be run again."""

    def __init__(self, scene: Optional[Scene], device: Device, hip: int = 0, *,
                 force_callback: Optional[Callable[[int, callbacks.Sample], Any]] = None,
                 tick_callback: Optional[Callable[[np.ndarray], Any]] = None,
                 record: Union[bool, Sequence[str]] = False, **values: Any) -> None:
        """force_callback(tick, sample), if scene is None: the force, 3 numbers, N, device axes. tick_callback(row):
        called
        with each tick's output. Both run on the haptic thread, which then waits for Python (see Device.of_functions());
        after an exception the force is zero, the loop ends, and wait(), step() or stop() raises it. record: True, or
        some
        fields of knurl_tick_output: `ticks` has every tick, for nanoseconds a tick on the haptic thread. values: other
        fields of
        knurl_loop_desc, such as update_rate_hz, tick_limit, ramp_s, reconnect."""
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
        self._calls = callbacks.Calls(force_callback, tick_callback, self._record.ring if self._record else None)
        user = callbacks.keep(self._calls)
        if force_callback:
            desc.force_callback, desc.user = callbacks.force_callback, user
        if tick_callback:
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
            self.wait(5.0)

    def close(self) -> None:
        """Stops the loop and releases its device and HIP. Does not raise an exception of a callback; stop() does."""
        handle = self._handle
        if handle is None:
            return
        lib.knurl_loop_request_stop(handle)
        if not callbacks.in_callback():
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
