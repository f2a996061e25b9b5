"""Scenes of surfaces, and their ticks. SPDX-License-Identifier: MIT"""
import os
import threading
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import Owner, arrays_of, check, described, ffi, fill, lib, refuse, to_python
from .callbacks import in_callback
from .effects import Effect
from .methods import raise_error
from .ticks import OUTPUTS, Ticks, as_ticks, copy_fields, packed

_INPUTS = arrays_of("knurl_tick_input")
_COUNTS = arrays_of("knurl_hip_counts")
_CONTACTS = arrays_of("knurl_hip_contact")
_POINTS = arrays_of("knurl_surface_point")
_CHUNK = 1024 # ticks per call: enough to hide the cost of a call, few enough to stay in the cache


def _tuple_of(values: ArrayLike, count: int, what: str) -> List[float]:
    array = np.asarray(values, dtype=float)
    if array.shape != (count,):
        raise ValueError(f"{what}: expected {count} numbers, found an array of shape {array.shape}")
    return array.tolist()


def _rows(values: ArrayLike, columns: int, kind: str, what: str) -> np.ndarray:
    array = np.ascontiguousarray(values, dtype=kind)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what}: expected an array of shape (n, {columns}), found {array.shape}")
    return array


def _method(name: Optional[str]) -> int:
    method = ffi.new("int32_t *")
    if name is not None:
        check(lib.knurl_method_from_name(name.encode(), method))
    return int(method[0]) # 0: the default


@dataclass
class Material:
    """What a surface feels like; knurl_material_desc in knurl/scene.h. method: "S1", "S2", "bandlimited", or None.
    A method of your own by its name, too: add_method()."""

    stiffness: float = 400.0
    spatial_frequency: Tuple[float, float] = (0.0, 0.0)
    amplitude: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    orientation: float = 0.0
    method: Optional[str] = None

    def _desc(self) -> Any:
        desc = described("knurl_material_desc")
        for name in ("stiffness", "amplitude", "damping", "friction", "orientation"):
            setattr(desc, name, getattr(self, name))
        desc.spatial_frequency = _tuple_of(self.spatial_frequency, 2, "spatial_frequency")
        desc.method = _method(self.method)
        return desc

    @classmethod
    def _of(cls, desc: Any) -> "Material":
        values = to_python(desc)
        values["method"] = ffi.string(lib.knurl_method_name(values["method"])).decode()
        return cls(**values)


class Surface:
    """A surface of a scene; `id` is the value in the field "surface" of tick outputs."""

    def __init__(self, scene: "Scene", surface_id: int) -> None:
        self._scene = scene
        self.id = surface_id

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Surface) and (self._scene, self.id) == (other._scene, other.id)

    def __hash__(self) -> int:
        return hash(self.id)

    def __repr__(self) -> str:
        exists = not self._scene.closed and lib.knurl_scene_has_surface(self._scene.handle, self.id)
        return f"<knurl.Surface {self.name!r}, id {self.id}>" if exists else f"<knurl.Surface, id {self.id}: no longer there>"

    @property
    def name(self) -> str:
        name = ffi.new("char[]", lib.KNURL_NAME_SIZE)
        check(lib.knurl_scene_get_surface_name(self._scene.handle, self.id, name))
        return ffi.string(name).decode()

    @property
    def material(self) -> Material:
        """The material as rendered, with the default method resolved."""
        desc = described("knurl_material_desc")
        check(lib.knurl_scene_get_material(self._scene.handle, self.id, desc))
        return Material._of(desc)

    @material.setter
    def material(self, material: Material) -> None:
        self.set_material(material)

    @property
    def info(self) -> Dict[str, Any]:
        """As built by the scene: the fields of knurl_surface_info."""
        info = described("knurl_surface_info")
        check(lib.knurl_scene_get_surface_info(self._scene.handle, self.id, info))
        return dict(to_python(info))

    def limits(self, hip: int = 0) -> str:
        """The limits of the HIP's device that it exceeds, a sentence each; "" if it exceeds no limit."""
        found = described("knurl_surface_check")
        check(lib.knurl_scene_check_surface(self._scene.handle, hip, self.id, found))
        return str(to_python(found.message))

    def set_material(self, material: Material) -> None:
        check(lib.knurl_scene_set_material(self._scene.handle, self.id, material._desc()))

    def move(self, position: ArrayLike, rotation: ArrayLike = (0, 0, 0, 1), seconds: float = 0.0) -> None:
        """Moves it; see knurl_scene_set_transform(). position: m; seconds: how long it takes."""
        check(lib.knurl_scene_set_transform(self._scene.handle, self.id, _tuple_of(position, 3, "position"),
                                            _tuple_of(rotation, 4, "rotation"), seconds))

    def remove(self) -> None:
        check(lib.knurl_scene_remove_surface(self._scene.handle, self.id))


class _Hip:
    """A HIP's tick buffers, used by one thread at a time: while one is in a `with`, another's raises."""

    def __init__(self, number: int) -> None:
        self.number, self.rate = number, 1000.0
        self.has_more = False # True if `inputs` has velocities or absences
        self.loop: Any = None # a weak reference to the loop that ticks it on a haptic thread
        self._lock = threading.Lock()
        self.inputs: np.ndarray = np.zeros(0, _INPUTS)

    def __enter__(self) -> "_Hip":
        if not self._lock.acquire(blocking=False):
            refuse(f"hip {self.number}: expected one thread at a time, found a call while another thread ticks it")
        if len(self.inputs) == 0:
            self.inputs, self.outputs = np.zeros(_CHUNK, _INPUTS), np.zeros(_CHUNK, OUTPUTS)
            self.position, self.velocity, self.has_velocity, self.absent = (
                self.inputs[name] for name in ("position", "velocity", "has_velocity", "absent"))
            self.input = ffi.from_buffer("knurl_tick_input[]", self.inputs)
            self.output = ffi.from_buffer("knurl_tick_output[]", self.outputs)
        return self

    def __exit__(self, *_: Any) -> None:
        self._lock.release()

    def fill(self, positions: np.ndarray, velocities: Optional[np.ndarray], absent: Optional[np.ndarray]) -> None:
        count = len(positions)
        self.position[:count] = positions
        if self.has_more: # from an earlier call
            self.has_velocity[:], self.absent[:], self.has_more = 0, 0, False
        if velocities is not None:
            self.velocity[:count], self.has_velocity[:count], self.has_more = velocities, 1, True
        if absent is not None:
            self.absent[:count], self.has_more = absent, True


class Scene(Owner):
    """Surfaces and HIPs. Add surfaces, commit, tick. Threads may share a scene; a HIP is ticked by one at a time."""

    _order = 2

    def __init__(self, hips: int = 1, max_surfaces: int = 4096) -> None:
        desc = described("knurl_scene_desc")
        desc.hip_count, desc.max_surfaces = hips, max_surfaces
        scene = ffi.new("knurl_scene **")
        check(lib.knurl_scene_create(desc, scene))
        self._own(scene[0], lib.knurl_scene_destroy)
        self._hips = [_Hip(hip) for hip in range(hips)]

    def __repr__(self) -> str:
        if self.closed:
            return "<knurl.Scene: closed>"
        count = lib.knurl_scene_get_surface_count(self.handle)
        return f"<knurl.Scene: {count} surface{'s' if count != 1 else ''}, {len(self._hips)} HIP{'s' if len(self._hips) > 1 else ''}>"

    def _hip(self, hip: int) -> _Hip:
        if not 0 <= hip < len(self._hips):
            raise ValueError(f"hip: expected 0 to {len(self._hips) - 1}, found {hip}")
        return self._hips[hip]

    def add_plane(self, half_extents: ArrayLike = (0.05, 0.05), material: Optional[Material] = None,
                  **pose: Any) -> Surface:
        """A rectangle with its front towards its z. pose: name, position, rotation or normal, axis,
        double_sided."""
        plane = described("knurl_plane_desc")
        plane.half_extents = _tuple_of(half_extents, 2, "half_extents")
        return self._add("plane", plane, material, **pose)

    def add_mesh(self, positions: ArrayLike, indices: Optional[ArrayLike] = None, uvs: Optional[ArrayLike] = None,
                 tangents: Optional[ArrayLike] = None, normals: Optional[ArrayLike] = None,
                 material: Optional[Material] = None, smooth: Optional[bool] = None, **pose: Any) -> Surface:
        """A triangle mesh: positions (n, 3), indices (m, 3) of them, uvs (n, 2), tangents (n, 4). Arrays are copied.
        normals (n, 3): makes it feel as smooth as they describe. smooth: False: felt as its triangles; True: smooth, with
        computed normals if there are none; None: smooth if there are normals. pose: as for add_plane(), and box:
        ridges follow positions instead of uvs."""
        mesh = described("knurl_mesh_desc")
        arrays = [_rows(positions, 3, "f4", "positions")]
        mesh.positions = ffi.from_buffer("float[]", arrays[0])
        mesh.vertex_count = len(arrays[0])
        for name, values, columns in (("uvs", uvs, 2), ("tangents", tangents, 4), ("normals", normals, 3)):
            if values is not None:
                arrays.append(_rows(values, columns, "f4", name))
                if len(arrays[-1]) != mesh.vertex_count:
                    raise ValueError(f"{name}: expected {mesh.vertex_count} rows as of positions, found {len(arrays[-1])}")
                setattr(mesh, name, ffi.from_buffer("float[]", arrays[-1]))
        if indices is not None:
            arrays.append(_rows(indices, 3, "u4", "indices"))
            mesh.indices = ffi.from_buffer("uint32_t[]", arrays[-1])
            mesh.index_count = arrays[-1].size
        how = lib.KNURL_SMOOTH_AUTO if smooth is None else lib.KNURL_SMOOTH_ON if smooth else lib.KNURL_SMOOTH_OFF
        return self._add("mesh", mesh, material, how, **pose)

    def _add(self, kind: str, shape: Any, material: Optional[Material], smooth: int = 0, name: str = "", position: ArrayLike = (0, 0, 0),
             rotation: ArrayLike = (0, 0, 0, 1), normal: ArrayLike = (0, 0, 0), axis: ArrayLike = (0, 0, 0),
             double_sided: bool = False, box: bool = False) -> Surface:
        desc = described("knurl_surface_desc")
        text, felt = ffi.new("char[]", name.encode()), (material or Material())._desc()
        desc.name, desc.material, desc.double_sided = text, felt, double_sided
        setattr(desc, kind, shape)
        desc.position = _tuple_of(position, 3, "position")
        desc.rotation = _tuple_of(rotation, 4, "rotation")
        desc.normal = _tuple_of(normal, 3, "normal")
        desc.axis = _tuple_of(axis, 3, "axis")
        desc.smooth = smooth
        desc.coordinates = lib.KNURL_COORDINATES_BOX if box else lib.KNURL_COORDINATES_AUTO
        surface = ffi.new("knurl_surface_id *")
        check(lib.knurl_scene_add_surface(self.handle, desc, surface))
        return Surface(self, surface[0])

    def load(self, path: Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]) -> List[Surface]:
        """Loads a glTF file; returns its tagged surfaces, as knurl_gltf_load_file()."""
        before = lib.knurl_scene_get_surface_count(self.handle)
        check(lib.knurl_gltf_load_file(self.handle, os.fsencode(path), ffi.NULL, ffi.NULL))
        return self.surfaces[before:]

    @property
    def surfaces(self) -> List[Surface]:
        count = lib.knurl_scene_get_surface_count(self.handle)
        return [Surface(self, lib.knurl_scene_get_surface(self.handle, i)) for i in range(count)]

    def configure_hip(self, hip: int = 0, workspace: Optional[Sequence[ArrayLike]] = None, **values: float) -> None:
        """Sets a HIP up anew. workspace: (origin, rotation matrix, scale), device to scene; None: the scene
        chooses it. values: other fields of knurl_hip_desc, such as update_rate_hz, resolution, max_force,
        protections."""
        desc = described("knurl_hip_desc")
        fill(desc, values)
        if workspace is not None:
            origin, rotation, scale = workspace
            place = ffi.new("knurl_workspace *")
            place.origin, place.scale = _tuple_of(origin, 3, "origin"), float(scale) # type: ignore[arg-type]
            place.rotation = _tuple_of(np.asarray(rotation, dtype=float).ravel(), 9, "rotation")
            desc.workspace = place
        with self._hip(hip) as own:
            check(lib.knurl_scene_configure_hip(self.handle, hip, desc))
            own.rate = desc.update_rate_hz if desc.update_rate_hz > 0.0 else 1000.0 # KNURL_DEFAULT

    def set_even(self, response: Union[None, str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"] = None, *,
                 mass: float = 0.045, viscous: float = 0.5, rate: float = 1000.0, on: bool = True, hip: int = 0) -> None:
        """Even sensation: ridges equally strong from 25 to 300 Hz, by the response file `response`, else by a model of a
        device in a hand: mass, kg, and viscous friction, N s/m (Device.info), and the update rate, Hz. on=False: off. Not while a
        loop has the HIP."""
        gains = ffi.new("knurl_gain[]", lib.KNURL_GAINS)
        if on and response is not None:
            with open(response, "rb") as file:
                text = file.read(65537) # one byte more than the library takes
            check(lib.knurl_gains_from_response(text, len(text), gains))
        elif on:
            check(lib.knurl_gains_from_plant(mass, viscous, rate, gains))
        check(lib.knurl_scene_set_gains(self.handle, hip, gains, lib.KNURL_GAINS if on else 0))

    def set_effects(self, effects: Sequence[Effect] = (), seconds: float = 0.0, hip: int = 0) -> None:
        """Replaces a HIP's effects, also while a loop ticks it; the anchors of those whose kind was at the same place
        before move over `seconds`. As knurl_scene_set_effects()."""
        array = ffi.new("knurl_effect[]", len(effects))
        for i, effect in enumerate(effects):
            effect._fill(ffi.addressof(array, i))
        check(lib.knurl_scene_set_effects(self.handle, hip, array, len(effects), seconds))

    def commit(self) -> None:
        """Makes the scene ready to tick. Call it once, after the first surfaces."""
        check(lib.knurl_scene_commit(self.handle))

    def tick(self, positions: ArrayLike, velocities: Optional[ArrayLike] = None, hip: int = 0,
             fields: Optional[Sequence[str]] = None) -> Ticks:
        """A tick a row of positions (n, 3), device axes, m; velocities (n, 3), m/s, if they are known. In rows that a
        masked array masks the HIP is absent: no force, and contacts end. Returns n rows of knurl_tick_output, with its
        names: "force" (n, 3), "depth" (n), "surface" (n) ...; fields: only these, which saves memory (all are 288
        bytes)."""
        rows = _rows(positions, 3, "f8", "positions")
        given = None if velocities is None else np.broadcast_to(_rows(velocities, 3, "f8", "velocities"), rows.shape)
        absent = np.ma.getmaskarray(positions).any(axis=1) if isinstance(positions, np.ma.MaskedArray) else None
        results = np.empty(len(rows), OUTPUTS if fields is None else packed(fields))
        handle = self.handle
        with self._hip(hip) as own:
            whole = ffi.from_buffer("knurl_tick_output[]", results) if fields is None else None
            for begin in range(0, len(rows), _CHUNK) or (0,):
                end = min(len(rows), begin + _CHUNK)
                own.fill(rows[begin:end], None if given is None else given[begin:end],
                         None if absent is None else absent[begin:end])
                check(lib.knurl_scene_tick_batch(handle, hip, own.input, end - begin, own.output if whole is None else whole + begin))
                raise_error()
                if whole is None:
                    copy_fields(own.outputs[:end - begin], results[begin:end])
            return as_ticks(results, own.rate)

    def chunks(self, positions: Union[ArrayLike, Iterable[ArrayLike]], rows: int = 65536, hip: int = 0,
               fields: Optional[Sequence[str]] = None) -> Iterator[Ticks]:
        """The same in parts of `rows` rows, for more ticks than fit into memory. positions: an array, such as
        a np.memmap, or an iterator of arrays, each of which is a part."""
        parts = (iter(positions) if isinstance(positions, Iterator) else
                 (positions[begin:begin + rows] for begin in range(0, len(positions), rows))) # type: ignore
        for part in parts:
            yield self.tick(part, hip=hip, fields=fields)

    def closest(self, positions: ArrayLike, radius: float = 1.0) -> np.ndarray:
        """The closest point of all surfaces to each of positions (n, 3), scene axes, m, up to radius (m) away: rows of
        knurl_surface_point, "surface", "distance", "position", "normal"; surface 0: no point is so near."""
        rows = _rows(positions, 3, "f8", "positions")
        found = np.zeros(len(rows), _POINTS)
        found["struct_size"] = _POINTS.itemsize
        check(lib.knurl_scene_find_closest_batch(self.handle, ffi.from_buffer("double[]", rows), len(rows), radius,
                                                 ffi.from_buffer("knurl_surface_point[]", found)))
        return found

    def latest(self, hip: int = 0) -> Tuple[np.ndarray, np.ndarray]:
        """The last tick and the counts so far, also while a loop ticks the scene: a row of knurl_tick_output and one of
        knurl_hip_counts."""
        output, counts = np.zeros(1, OUTPUTS), np.zeros(1, _COUNTS)
        check(lib.knurl_scene_get_tick(self.handle, hip, ffi.from_buffer("knurl_tick_output[]", output),
                                       ffi.from_buffer("knurl_hip_counts[]", counts)))
        return output[0], counts[0]

    def contacts(self, hip: int = 0) -> np.ndarray:
        """All contacts of the HIP's last tick, rows of knurl_hip_contact: "surface", "proxy", "normal", "depth". While
        a loop ticks the HIP, only within its tick_callback."""
        found = np.zeros(lib.KNURL_CONTACTS_MAX, _CONTACTS)
        pointer = ffi.from_buffer("knurl_hip_contact[]", found)
        own, inside = self._hip(hip), in_callback()
        if inside and inside.hip is own: # on the thread that ticks the HIP
            return found[:lib.knurl_scene_get_contacts(self.handle, hip, pointer, len(found))]
        loop = own.loop and own.loop()
        if loop and not loop.closed:
            refuse(f"hip {hip}: expected a call within the loop's tick_callback, because its thread ticks the HIP")
        with own:
            return found[:lib.knurl_scene_get_contacts(self.handle, hip, pointer, len(found))]
