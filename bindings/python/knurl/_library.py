"""The libraries, loaded, and their structs as numpy types. SPDX-License-Identifier: MIT"""
import glob
import os
from typing import Any, Dict, NoReturn

import cffi
import numpy as np

_FOLDER = os.path.dirname(os.path.abspath(__file__))

ffi = cffi.FFI()
with open(os.path.join(_FOLDER, "interface.h"), encoding="utf-8") as _file:
    ffi.cdef(_file.read())


class _Library:
    """Both libraries' functions and constants under one name."""

    def __init__(self) -> None:
        self._parts = [ffi.dlopen(glob.glob(os.path.join(_FOLDER, f"lib{name}.so.*"))[0]) for name in ("knurl", "knurl_gltf")]

    def __getattr__(self, name: str) -> Any:
        part = self._parts[name.startswith("knurl_gltf_")]
        value = getattr(part, name)
        setattr(self, name, value)
        return value


lib = _Library()


class KnurlError(Exception):
    """What went wrong, in the library's words. code: KNURL_ERROR_, as `knurl.lib` has them."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


def _fail(code: int) -> NoReturn:
    raise KnurlError(code, ffi.string(lib.knurl_error_message()).decode())


def check(result: int) -> None:
    """Raises KnurlError unless the result of a call is KNURL_OK."""
    if result != 0:
        _fail(result)


def version() -> str:
    """The library's, "major.minor.patch"."""
    return ffi.string(lib.knurl_version_string()).decode()


_KINDS = {"double": "f8", "float": "f4", "uint64_t": "u8", "int64_t": "i8", "uint32_t": "u4", "int32_t": "i4"}


def arrays_of(struct: str) -> np.dtype:
    """The numpy type of a struct of numbers, such as "knurl_tick_output"."""
    fields: Dict[str, Any] = {"names": [], "formats": [], "offsets": [], "itemsize": ffi.sizeof(struct)}
    for name, field in ffi.typeof(struct).fields:
        shape, kind = [], field.type
        while kind.kind == "array":
            shape.append(kind.length)
            kind = kind.item
        fields["names"].append(name)
        fields["formats"].append((_KINDS[kind.cname], tuple(shape)))
        fields["offsets"].append(field.offset)
    return np.dtype(fields)


def described(struct: str) -> Any:
    """A struct that begins with struct_size, with its defaults."""
    desc = ffi.new(struct + " *")
    getattr(lib, struct + "_init")(desc, ffi.sizeof(struct))
    return desc
