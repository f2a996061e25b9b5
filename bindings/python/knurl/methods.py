"""Methods of the caller's own, for studies. SPDX-License-Identifier: MIT"""
from typing import Any, Callable, Dict, Optional

from ._library import check, ffi, lib


class _Own:
    """A function, and the first exception that it raised and that no call has raised yet."""

    def __init__(self, function: Callable[[Any, Any], float], crest: float) -> None:
        self.function, self.crest = function, crest
        self.error: Optional[BaseException] = None


_own: Dict[str, _Own] = {}
_users: Dict[str, Any] = {} # the library calls them until the process ends


@ffi.callback("double(const knurl_method_input *, double *, void *)", error=float("nan"))
def _height(tick: Any, memory: Any, user: Any) -> float:
    own = ffi.from_handle(user)
    if own.error is None:
        try:
            return float(own.function(tick, memory))
        except BaseException as error: # pylint: disable=broad-except
            own.error = error
    return float("nan") # plays 0


def add_method(name: str, function: Callable[[Any, Any], float], crest: float = 1.0) -> None:
    """Adds a method of your own: Material and Grating then take its name. function(tick, memory) returns the height of a tick
    in units of A; it is clamped to `crest`, and 0 if it is NaN or infinite. tick: `cycles` (the phase) and `velocity` (m/s)
    along x and y, `spatial_frequency`, `temporal_frequency` (f_t, Hz) and `period` (s); not valid after the call. memory: four
    numbers that are kept until the next tick, zeros when a contact begins. An exception is raised by the call that ticks;
    the heights from there on are 0. See knurl_method_add() in knurl/grating.h.

    A method stays until Python ends, and there is room for 16; to add one by the same name and with the same crest again
    replaces its function, so that a notebook's cell can be run again. For studies: a loop waits for it at each tick."""
    if name in _own:
        if crest != _own[name].crest:
            raise ValueError(f"crest: expected {_own[name].crest:g}, because there is a method {name!r}, found {crest:g}")
        _own[name].function, _own[name].error = function, None
        return
    own = _Own(function, crest)
    user = ffi.new_handle(own)
    check(lib.knurl_method_add(name.encode(), crest, _height, user, ffi.new("int32_t *")))
    _own[name], _users[name] = own, user


def raise_error() -> None:
    """Raises the exception of an own method, once."""
    for own in _own.values():
        if own.error is not None:
            error, own.error = own.error, None
            raise error
