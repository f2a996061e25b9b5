"""Python functions that a device or a loop calls. The C callbacks are module-level and never freed, so that no thread
can call a freed one; their `user` is a handle of the object with the Python functions. SPDX-License-Identifier: MIT"""
import threading
from typing import Any, Callable, Dict, NamedTuple, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._library import ffi, lib
from .ticks import OUTPUTS

_kept: Dict[Any, Any] = {} # a reference for each `user` pointer that C holds
_thread = threading.local()


class Sample(NamedTuple):
    """A device's reading: position in m, device axes; buttons, bit 0 is the first; orientation of the stylus, a
    quaternion x, y, z, w, zeros if it is not measured; angle of its gripper, rad, 0 if it is closed or there is none;
    angles of its joints, rad, as many as its maker tells."""

    position: Tuple[float, float, float]
    buttons: int = 0
    orientation: Tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    grip: float = 0.0
    joints: Tuple[float, ...] = ()


class Torque(NamedTuple):
    """A torque about the device's axes, N m, right-handed, and a gripper's force, N, positive if it opens the gripper."""

    torque: ArrayLike = (0.0, 0.0, 0.0)
    grip: float = 0.0


class Calls:
    """The functions of one loop, and the first exception that one of them raised."""

    def __init__(self, force: Optional[Callable[..., Any]], torque: Optional[Callable[..., Any]],
                 tick: Optional[Callable[..., Any]], record: Any, hip: Any) -> None:
        self.force, self.torque, self.tick, self.record, self.hip = force, torque, tick, record, hip
        self.error: Optional[BaseException] = None
        self.loop: Any = None # the C pointer, set before a thread can call


def keep(subject: Any) -> Any:
    """A `user` pointer to a Python object, which is kept alive until let_go()."""
    user = ffi.new_handle(subject)
    _kept[user] = subject
    return user


def let_go(user: Any) -> None:
    _kept.pop(user, None)


def in_callback() -> Optional[Calls]:
    """The loop whose callback this thread is in, or None."""
    return getattr(_thread, "inside", None)


def _call(calls: Calls, function: Callable[..., Any], *arguments: Any) -> Any:
    """None after an exception, which ends the loop and is raised by its next wait(), step(), stop() or close()."""
    if calls.error is not None:
        return None
    was_inside, _thread.inside = in_callback(), calls # a callback may step another loop
    try:
        return function(*arguments)
    except BaseException as error: # pylint: disable=broad-except
        calls.error = error
        lib.knurl_loop_request_stop(calls.loop)
        return None
    finally:
        _thread.inside = was_inside


def _three(found: ArrayLike, to: Any, name: str) -> None:
    values = np.asarray(found, dtype=float)
    if values.shape != (3,):
        raise ValueError(f"{name}: expected 3 numbers, found an array of shape {values.shape}")
    to[0:3] = values.tolist()


def _sample(of: Any) -> Sample:
    return Sample((*of.position,), of.buttons, (*of.orientation,), of.grip, tuple(of.joints[0 : of.joint_count])) # type: ignore


@ffi.callback("void(uint64_t, const knurl_device_sample *, double *, void *)")
def force_callback(tick: int, sample: Any, force: Any, user: Any) -> None:
    calls = ffi.from_handle(user)
    force[0] = force[1] = force[2] = 0.0
    _call(calls, lambda: _three(calls.force(tick, _sample(sample)), force, "force"))


def _take_torque(found: Any, to: Any) -> None:
    made = found if isinstance(found, Torque) else Torque(found)
    grip = float(made.grip)
    _three(made.torque, to.torque, "torque")
    to.grip = grip


@ffi.callback("void(uint64_t, const knurl_device_sample *, knurl_device_torque *, void *)")
def torque_callback(tick: int, sample: Any, torque: Any, user: Any) -> None:
    calls = ffi.from_handle(user)
    _call(calls, lambda: _take_torque(calls.torque(tick, _sample(sample)), torque))


@ffi.callback("void(const knurl_tick_output *, void *)")
def tick_callback(output: Any, user: Any) -> None:
    calls = ffi.from_handle(user)
    if calls.record is not None:
        lib.knurl_record_put(output, calls.record)
    if calls.tick is not None:
        _call(calls, lambda: calls.tick(np.frombuffer(ffi.buffer(output), OUTPUTS)[0].copy()))


class Functions:
    """The Python functions of a device of the caller's own."""

    def __init__(self, read: Callable[[], Any], write: Callable[..., Any], info: Dict[str, Any],
                 start: Optional[Callable[[float], Any]], reopen: Optional[Callable[[], Any]],
                 close: Optional[Callable[[], Any]]) -> None:
        self.read, self.write, self.info, self.start, self.reopen, self.close = read, write, info, start, reopen, close
        self.error: Optional[BaseException] = None

    def guarded(self, function: Callable[[], int]) -> int:
        """An exception is a lost device; the first one is kept for Device.error."""
        try:
            return function()
        except BaseException as error: # pylint: disable=broad-except
            self.error = self.error or error
            return int(lib.KNURL_ERROR_DEVICE_LOST)


@ffi.callback("void(void *, knurl_device_info *)")
def _get_info(user: Any, info: Any) -> None:
    for name, value in ffi.from_handle(user).info.items():
        setattr(info, name, value)


def _take_sample(device: Functions, to: Any) -> int:
    found = device.read()
    if found is None:
        return int(lib.KNURL_ERROR_DEVICE_NOT_READY)
    sample = found if isinstance(found, Sample) else Sample(found)
    _three(sample.position, to.position, "position")
    to.buttons, to.orientation, to.grip = sample.buttons, list(sample.orientation), sample.grip
    to.joint_count, to.joints = len(sample.joints), list(sample.joints)
    return 0


@ffi.callback("knurl_result(void *, double)")
def _start(user: Any, rate: float) -> int:
    device = ffi.from_handle(user)
    return int(device.guarded(lambda: (device.start(rate), 0)[1] if device.start else 0))


@ffi.callback("knurl_result(void *, knurl_device_sample *)")
def _read(user: Any, sample: Any) -> int:
    device = ffi.from_handle(user)
    return int(device.guarded(lambda: _take_sample(device, sample)))


@ffi.callback("knurl_result(void *, const double *)")
def _write(user: Any, force: Any) -> int:
    device = ffi.from_handle(user)
    return int(device.guarded(lambda: (device.write(np.array(ffi.unpack(force, 3))), 0)[1]))


@ffi.callback("knurl_result(void *)")
def _reopen(user: Any) -> int:
    device = ffi.from_handle(user)
    return int(device.guarded(lambda: (device.reopen(), 0)[1]))


@ffi.callback("void(void *)")
def _close(user: Any) -> None:
    device = ffi.from_handle(user)
    if device.close:
        device.guarded(lambda: (device.close(), 0)[1])
    let_go(user)


def fill_functions(functions: Any, device: Functions) -> Any:
    """Fills in knurl_device_functions; returns `user`, which knurl_device_close() releases."""
    functions.user = user = keep(device)
    functions.get_info, functions.start, functions.read, functions.write = _get_info, _start, _read, _write
    functions.reopen = _reopen if device.reopen else ffi.NULL
    functions.close = _close
    return user
