"""Devices, and the loop that plays a scene on one at its update rate, on a thread of its own that never waits for
Python. SPDX-License-Identifier: MIT"""
from typing import Any, Dict

from ._library import check, described, ffi, lib
from .scene import Scene, Surface

_STATES = ("idle", "running", "done", "lost")


class Device:
    """A device by its URI: "fake", "touch", "falcon", "rawhid"; see knurl/device.h. Closed when nobody refers to it."""

    def __init__(self, uri: str = "fake") -> None:
        lib.knurl_device_zero_on_exit(0)
        device = ffi.new("knurl_device **")
        check(lib.knurl_device_open(uri.encode(), device))
        self.handle = ffi.gc(device[0], lib.knurl_device_close)

    def lay_stroke(self, scene: Scene, surface: Surface, stroke: str = "line", hip: int = 0) -> None:
        """The fake device's hand strokes a surface, as knurl_fake_lay_stroke()."""
        number = ffi.new("int32_t *")
        check(lib.knurl_stroke_from_name(stroke.encode(), number))
        check(lib.knurl_fake_lay_stroke(self.handle, scene.handle, hip, surface.id, number[0], ffi.NULL))


class Loop:
    """Plays a scene on a device: start() at the update rate, or step() as fast as the machine can, with a fake device.
    As a context it starts, and stops at the end."""

    def __init__(self, scene: Scene, device: Device, hip: int = 0, **values: float) -> None:
        """values: other fields of knurl_loop_desc, such as update_rate_hz, tick_limit, reconnect."""
        desc = described("knurl_loop_desc")
        desc.scene, desc.device, desc.hip = scene.handle, device.handle, hip
        for name, value in values.items():
            setattr(desc, name, value)
        loop = ffi.new("knurl_loop **")
        check(lib.knurl_loop_create(desc, loop))
        self.handle = ffi.gc(loop[0], lib.knurl_loop_destroy)
        self._uses = (scene, device)

    def start(self) -> None:
        check(lib.knurl_loop_start(self.handle))

    def step(self, ticks: int) -> None:
        check(lib.knurl_loop_step(self.handle, ticks))

    def wait(self, seconds: float) -> bool:
        """Up to so long for its end; True if it has ended. Other Python threads run meanwhile."""
        return bool(lib.knurl_loop_wait(self.handle, seconds))

    def stop(self) -> None:
        """Asks for the end, which comes with a ramp to zero force, and waits for it."""
        lib.knurl_loop_request_stop(self.handle)
        self.wait(5.0)

    def __enter__(self) -> "Loop":
        self.start()
        return self

    def __exit__(self, *_: Any) -> None:
        self.stop()

    @property
    def stats(self) -> Dict[str, Any]:
        """state, ticks and overruns so far."""
        stats = described("knurl_loop_stats")
        check(lib.knurl_loop_get_stats(self.handle, stats))
        return {"state": _STATES[stats.state], "ticks": stats.ticks, "overruns": stats.overruns}
