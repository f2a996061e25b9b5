"""The libraries, loaded, and their structs as numpy types. SPDX-License-Identifier: MIT"""
import atexit
import glob
import os
import threading
import weakref
from typing import Any, Dict, Iterable, NoReturn, TypeVar

import cffi
import numpy as np

_FOLDER = os.path.dirname(os.path.abspath(__file__))

ffi = cffi.FFI()
with open(os.path.join(_FOLDER, "interface.h"), encoding="utf-8") as _file:
    ffi.cdef(_file.read())


class _Library:
    """All libraries' functions and constants under one name."""

    def __init__(self) -> None:
        core, gltf, record = (ffi.dlopen(glob.glob(os.path.join(_FOLDER, f"lib{name}.*"))[0])
                              for name in ("knurl", "knurl_gltf", "knurl_record"))
        self._parts = {"knurl_gltf_": gltf, "knurl_record_": record, "": core}

    def __getattr__(self, name: str) -> Any:
        part = next(part for prefix, part in self._parts.items() if name.startswith(prefix))
        value = getattr(part, name)
        setattr(self, name, value)
        return value


lib = _Library()


class KnurlError(Exception):
    """A failed call: `code` (KNURL_ERROR_ in `knurl.lib`), and the library's message as its text."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(code, message) # all arguments: an exception is pickled as its class and its args
        self.code = code

    def __str__(self) -> str:
        return str(self.args[1])


def check(result: int) -> None:
    """Raises KnurlError unless the result of a call is KNURL_OK."""
    if result != 0:
        _fail(result)


def _fail(code: int) -> NoReturn:
    raise KnurlError(code, ffi.string(lib.knurl_error_message()).decode())


def refuse(message: str) -> NoReturn:
    """Raises KnurlError for a call that is not allowed in the object's state."""
    raise KnurlError(lib.KNURL_ERROR_STATE, message)


def version() -> str:
    """The library's, "major.minor.patch"."""
    return str(ffi.string(lib.knurl_version_string()).decode())


_KINDS = {"double": "f8", "float": "f4", "uint64_t": "u8", "int64_t": "i8", "uint32_t": "u4", "int32_t": "i4"}


def arrays_of(struct: str) -> np.dtype:
    """The numpy type of a struct of numbers, such as "knurl_tick_output", without its reserved fields."""
    fields: Any = {"names": [], "formats": [], "offsets": [], "itemsize": ffi.sizeof(struct)}
    for name, field in ffi.typeof(struct).fields:
        shape, kind = [], field.type
        while kind.kind == "array":
            shape.append(kind.length)
            kind = kind.item
        if name != "reserved":
            fields["names"].append(name)
            fields["formats"].append((_KINDS[kind.cname], tuple(shape)))
            fields["offsets"].append(field.offset)
    return np.dtype(fields)


def described(struct: str) -> Any:
    """A struct that begins with struct_size, with its defaults."""
    desc = ffi.new(struct + " *")
    getattr(lib, struct + "_init")(desc, ffi.sizeof(struct))
    return desc


def fill(desc: Any, values: Dict[str, Any]) -> None:
    """Sets a struct's fields by name; an unknown name is a TypeError that lists the known ones."""
    known = [name for name, _ in ffi.typeof(desc).item.fields if name not in ("struct_size", "reserved")]
    for name, value in values.items():
        if name not in known:
            raise TypeError(f"{ffi.typeof(desc).item.cname} has no field {name!r}: expected one of {', '.join(known)}")
        setattr(desc, name, value)


def to_python(value: Any) -> Any:
    """A struct as a dictionary, an array of numbers as a tuple, text as str, and numbers as they are."""
    if not isinstance(value, ffi.CData):
        return value
    kind = ffi.typeof(value)
    if kind.kind == "pointer" and kind.item.kind == "struct":
        value, kind = value[0], kind.item
    if kind.kind == "struct":
        return {name: to_python(getattr(value, name)) for name, _ in kind.fields if name not in ("struct_size", "reserved")}
    if kind.kind == "array" and kind.item.cname != "char":
        return tuple(value)
    return ffi.string(value).decode(errors="replace") if value else ""


Self = TypeVar("Self", bound="Owner")
_open: "weakref.WeakSet[Owner]" = weakref.WeakSet()
_open_lock = threading.RLock() # iterating over a set fails if another thread adds to it


class Owner:
    """An object of the library's. It is released by close(), at the end of a `with`, with its last reference, or when
    Python ends. While another thread is within a call on it, close() takes effect at the end of that call."""

    _order = 0 # of closing when Python ends: loops first, because their threads may call Python
    _handle: Any = None
    _closed_because = "closed"

    def _own(self, pointer: Any, release: Any) -> None:
        # Each call holds its own reference to the pointer, and the last one releases it.
        self._handle = ffi.gc(pointer, release)
        with _open_lock:
            _open.add(self)

    @property
    def handle(self) -> Any:
        """The pointer, for `knurl.lib`."""
        handle = self._handle
        if handle is None:
            refuse(f"{type(self).__name__}: {self._closed_because}")
        return handle

    @property
    def closed(self) -> bool:
        return self._handle is None

    def close(self) -> None:
        """Releases it. May be repeated."""
        self._handle = None

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def open_objects(kind: type) -> Iterable[Any]:
    with _open_lock:
        owners = list(_open)
    return [owner for owner in owners if isinstance(owner, kind) and not owner.closed]


@atexit.register
def _close_all() -> None:
    for owner in sorted(open_objects(Owner), key=lambda owner: int(owner._order)):
        owner.close()


