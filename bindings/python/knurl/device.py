"""Devices. SPDX-License-Identifier: MIT"""
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import callbacks
from ._library import Owner, check, described, ffi, fill, lib, open_objects, to_python
from .scene import Scene, Surface, _rows


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
    has it open by the same URI and it cannot be opened twice, the earlier object and its loop are closed."""

    _order = 1
    _functions: Optional[callbacks.Functions] = None

    def __init__(self, uri: str = "fake") -> None:
        lib.knurl_device_zero_on_exit(0)
        device = ffi.new("knurl_device **")
        result = lib.knurl_device_open(uri.encode(), device)
        if result == lib.KNURL_ERROR_SYSTEM: # open already, such as by a notebook's cell that is run again
            for earlier in [other for other in open_objects(Device) if other._uri == uri]:
                for loop in [owner for owner in open_objects(Owner) if getattr(owner, "_device", None) is earlier]:
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
        first is in `error`. info: other fields of knurl_device_info, such as resolution or workspace_min.

        The functions are called on the loop's haptic thread, which then waits for Python: a Python program that does
        other work at the same time delays it by milliseconds. For simulations use Loop.step(); for real hardware write the
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
