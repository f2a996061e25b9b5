"""Scenes of surfaces, and their ticks. SPDX-License-Identifier: MIT"""
import os
from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import arrays_of, check, described, ffi, lib

_INPUTS = arrays_of("knurl_tick_input")
_OUTPUTS = arrays_of("knurl_tick_output")
_COUNTS = arrays_of("knurl_hip_counts")


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


@dataclass
class Material:
    """What a surface feels like; knurl_material_desc in knurl/scene.h. method: "S1", "S2", "bandlimited", or None."""

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
        if self.method is not None:
            method = ffi.new("int32_t *")
            check(lib.knurl_method_from_name(self.method.encode(), method))
            desc.method = method[0]
        return desc


class Surface:
    """A surface of a scene, by its id (`id`), which tick outputs name in "surface"."""

    def __init__(self, scene: "Scene", surface_id: int) -> None:
        self._scene = scene
        self.id = surface_id

    @property
    def name(self) -> str:
        name = ffi.new("const char **")
        check(lib.knurl_scene_get_surface_name(self._scene.handle, self.id, name))
        return ffi.string(name[0]).decode()

    def set_material(self, material: Material) -> None:
        check(lib.knurl_scene_set_material(self._scene.handle, self.id, material._desc()))

    def move(self, position: ArrayLike, rotation: ArrayLike = (0, 0, 0, 1), seconds: float = 0.0) -> None:
        """As knurl_scene_set_transform()."""
        check(lib.knurl_scene_set_transform(self._scene.handle, self.id, _tuple_of(position, 3, "position"),
                                            _tuple_of(rotation, 4, "rotation"), seconds))

    def remove(self) -> None:
        check(lib.knurl_scene_remove_surface(self._scene.handle, self.id))


class Scene:
    """Surfaces and HIPs. Add surfaces, commit, tick. It is freed when nobody refers to it any more."""

    def __init__(self, hips: int = 1, max_surfaces: int = 4096) -> None:
        desc = described("knurl_scene_desc")
        desc.hip_count, desc.max_surfaces = hips, max_surfaces
        scene = ffi.new("knurl_scene **")
        check(lib.knurl_scene_create(desc, scene))
        self.handle = ffi.gc(scene[0], lib.knurl_scene_destroy)

    def add_plane(self, half_extents: ArrayLike = (0.05, 0.05), material: Optional[Material] = None,
                  **pose: Any) -> Surface:
        """A rectangle whose front looks along its z. pose: name, position, rotation or
        normal, axis, double_sided."""
        plane = described("knurl_plane_desc")
        plane.half_extents = _tuple_of(half_extents, 2, "half_extents")
        return self._add("plane", plane, material, **pose)

    def add_mesh(self, positions: ArrayLike, indices: Optional[ArrayLike] = None, uvs: Optional[ArrayLike] = None,
                 tangents: Optional[ArrayLike] = None, material: Optional[Material] = None, **pose: Any) -> Surface:
        """A triangle mesh: positions (n, 3), indices (m, 3) of them, uvs (n, 2), tangents (n, 4). Arrays are copied."""
        mesh = described("knurl_mesh_desc")
        arrays = [_rows(positions, 3, "f4", "positions")]
        mesh.positions = ffi.from_buffer("float[]", arrays[0])
        mesh.vertex_count = len(arrays[0])
        for name, values, columns in (("uvs", uvs, 2), ("tangents", tangents, 4)):
            if values is not None:
                arrays.append(_rows(values, columns, "f4", name))
                if len(arrays[-1]) != mesh.vertex_count:
                    raise ValueError(f"{name}: expected {mesh.vertex_count} rows as of positions, found {len(arrays[-1])}")
                setattr(mesh, name, ffi.from_buffer("float[]", arrays[-1]))
        if indices is not None:
            arrays.append(_rows(indices, 3, "u4", "indices"))
            mesh.indices = ffi.from_buffer("uint32_t[]", arrays[-1])
            mesh.index_count = arrays[-1].size
        return self._add("mesh", mesh, material, **pose)

    def _add(self, kind: str, shape: Any, material: Optional[Material], name: str = "", position: ArrayLike = (0, 0, 0),
             rotation: ArrayLike = (0, 0, 0, 1), normal: ArrayLike = (0, 0, 0), axis: ArrayLike = (0, 0, 0),
             double_sided: bool = False) -> Surface:
        desc = described("knurl_surface_desc")
        text, felt = ffi.new("char[]", name.encode()), (material or Material())._desc()
        desc.name, desc.material, desc.double_sided = text, felt, double_sided
        setattr(desc, kind, shape)
        desc.position = _tuple_of(position, 3, "position")
        desc.rotation = _tuple_of(rotation, 4, "rotation")
        desc.normal = _tuple_of(normal, 3, "normal")
        desc.axis = _tuple_of(axis, 3, "axis")
        surface = ffi.new("knurl_surface_id *")
        check(lib.knurl_scene_add_surface(self.handle, desc, surface))
        return Surface(self, surface[0])

    def load(self, path: Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]) -> List[Surface]:
        """Loads a glTF file; returns its tagged surfaces."""
        before = lib.knurl_scene_get_surface_count(self.handle)
        check(lib.knurl_gltf_load_file(self.handle, os.fsencode(path), ffi.NULL, ffi.NULL))
        return self.surfaces[before:]

    @property
    def surfaces(self) -> List[Surface]:
        count = lib.knurl_scene_get_surface_count(self.handle)
        return [Surface(self, lib.knurl_scene_get_surface(self.handle, i)) for i in range(count)]

    def configure_hip(self, hip: int = 0, workspace: Optional[Sequence[ArrayLike]] = None, **values: float) -> None:
        """Sets a HIP up anew. workspace: (origin, rotation matrix, scale), device to scene, where the scene is not to
        choose it. values: other fields of knurl_hip_desc, such as update_rate_hz, resolution, max_force, protections."""
        desc = described("knurl_hip_desc")
        for name, value in values.items():
            setattr(desc, name, value)
        if workspace is not None:
            origin, rotation, scale = workspace
            place = ffi.new("knurl_workspace *")
            place.origin, place.scale = _tuple_of(origin, 3, "origin"), float(scale) # type: ignore[arg-type]
            place.rotation = _tuple_of(np.asarray(rotation, dtype=float).ravel(), 9, "rotation")
            desc.workspace = place
        check(lib.knurl_scene_configure_hip(self.handle, hip, desc))

    def commit(self) -> None:
        """Once, after the first surfaces: from then on the scene ticks."""
        check(lib.knurl_scene_commit(self.handle))

    def tick(self, positions: ArrayLike, velocities: Optional[ArrayLike] = None, hip: int = 0) -> np.ndarray:
        """A tick a row of positions (n, 3), device axes, m; velocities (n, 3), m/s, where they are known. Returns n rows
        of knurl_tick_output, with its names: "force" (n, 3), "depth" (n), "surface" (n) ... All in one call."""
        rows = _rows(positions, 3, "f8", "positions")
        inputs, outputs = np.zeros(len(rows), _INPUTS), np.zeros(len(rows), _OUTPUTS)
        inputs["position"] = rows
        if velocities is not None:
            inputs["velocity"] = np.broadcast_to(_rows(velocities, 3, "f8", "velocities"), rows.shape)
            inputs["has_velocity"] = 1
        check(lib.knurl_scene_tick_batch(self.handle, hip, ffi.from_buffer("knurl_tick_input[]", inputs), len(rows),
                                         ffi.from_buffer("knurl_tick_output[]", outputs)))
        return outputs

    def latest(self, hip: int = 0) -> Tuple[np.ndarray, np.ndarray]:
        """The latest tick and the counts so far, also while a loop ticks the scene: a row of knurl_tick_output and one of
        knurl_hip_counts."""
        output, counts = np.zeros(1, _OUTPUTS), np.zeros(1, _COUNTS)
        check(lib.knurl_scene_get_tick(self.handle, hip, ffi.from_buffer("knurl_tick_output[]", output),
                                       ffi.from_buffer("knurl_hip_counts[]", counts)))
        return output[0], counts[0]
