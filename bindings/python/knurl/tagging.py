"""Tags in glTF files: listed, set and removed. SPDX-License-Identifier: MIT"""
import json
import os
import secrets
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple, Union

from ._library import KnurlError, check, ffi, lib

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Tagged:
    """An object of a glTF file that can carry a tag."""
    array: str             # "materials", "meshes" or "nodes"
    index: int             # in that array
    name: str              # or ""
    tag: Optional[Dict[str, Any]] # the nested form, or None; not checked


def tags(path: Path) -> List[Tagged]:
    """The materials, meshes and nodes of a .gltf or .glb file, and their tags."""
    with open(path, "rb") as file:
        return _list(file.read(), os.fspath(path))


def tag(path: Path, out: Path, material: Union[str, int, None] = None, mesh: Union[str, int, None] = None,
        node: Union[str, int, None] = None, **keys: Any) -> None:
    """Writes a copy of a glTF file in which one object's tag has these keys (docs/tagging.md, without the prefix).

    The object is named or given by index; without one it is the file's only material. Keys that are not given stay as
    they are; None removes one. All other bytes of the file stay. out: may be path itself; it is replaced when the new
    file is complete. External buffers are not copied. Raises KnurlError for a wrong key or value, and ValueError for
    an object that is not there or not the only one, or an `out` in /dev or /proc: nothing is written then.

    >>> knurl.tag("model.glb", "felt.glb", material="Grip", spatial_frequency=1000, amplitude=2e-4, stiffness=400)
    """
    _write(path, out, (material, mesh, node), json.dumps(keys, allow_nan=False).encode())


def untag(path: Path, out: Path, material: Union[str, int, None] = None, mesh: Union[str, int, None] = None,
          node: Union[str, int, None] = None) -> None:
    """Writes a copy of a glTF file in which one object's tag is removed; the rest as tag()."""
    _write(path, out, (material, mesh, node), ffi.NULL)


def _list(data: bytes, name: str) -> List[Tagged]:
    found: List[Tagged] = []

    @ffi.callback("void(void *, const char *, uint32_t, const char *, const char *)")
    def each(_user: Any, array: Any, index: int, label: Any, text: Any) -> None:
        value = json.loads(ffi.string(text)) if text else None
        found.append(Tagged(ffi.string(array).decode(), index, ffi.string(label).decode(), value))

    check(lib.knurl_gltf_list_tags(ffi.from_buffer(data), len(data), os.fsencode(name), each, ffi.NULL))
    return found


def _choose(objects: List[Tagged], choices: Tuple[Union[str, int, None], ...], path: str) -> Tagged:
    wanted = [(array, choice) for array, choice in zip(("materials", "meshes", "nodes"), choices) if choice is not None]
    if len(wanted) > 1:
        raise ValueError("expected one of material, mesh and node")
    array, choice = wanted[0] if wanted else ("materials", None)
    found = [o for o in objects if o.array == array and choice in (None, o.index if isinstance(choice, int) else o.name)]
    if len(found) != 1:
        raise ValueError(f"{path}: expected one object {choice!r} in {array}, found {len(found)}; knurl.tags() lists all")
    return found[0]


def _write(path: Path, out: Path, choices: Tuple[Union[str, int, None], ...], patch: Any) -> None:
    name = os.fspath(path)
    if os.fspath(out).startswith(("/dev/", "/proc/")):
        raise ValueError(f"{os.fspath(out)}: expected the name of a file: it is replaced, also if it is a link or a device")
    with open(path, "rb") as file:
        data = file.read()
    target = _choose(_list(data, name), choices, name)
    made: List[bytes] = []

    @ffi.callback("void(void *, const void *, uint64_t)")
    def write(_user: Any, content: Any, size: int) -> None:
        made.append(bytes(ffi.buffer(content, size)))

    check(lib.knurl_gltf_set_tag(ffi.from_buffer(data), len(data), os.fsencode(name), target.array.encode(), target.index,
                                 patch, write, ffi.NULL))
    if not made:
        raise KnurlError(lib.KNURL_ERROR_MEMORY, f"{name}: out of memory")
    partial = f"{os.fspath(out)}.{secrets.token_hex(8)}.part"
    try:
        with open(partial, "xb") as new:
            new.write(made[0])
        os.replace(partial, out)
    except BaseException:
        if os.path.exists(partial):
            os.unlink(partial)
        raise
