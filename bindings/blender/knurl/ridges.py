"""Where ridges are felt: a mesh's coordinates by the library's rules (docs/tagging.md), and the lines along its crests.
numpy only, without bpy. Vectors here are Blender's (z up); the library's rules are glTF's (y up). SPDX-License-Identifier: MIT"""
import numpy as np

LIMIT = 40000  # line segments of a mesh; with more, only every 2nd, 5th, 10th, 20th ... ridge is drawn
TO_GLTF = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
PER_OCTAVE = 8  # bins of lengths, as in the library
# By direction, +x -x +y -y +z -z: u and v of box coordinates
BOX = np.array([[[0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 1, 0]], [[1, 0, 0], [0, 0, -1]],
                [[1, 0, 0], [0, 0, 1]], [[1, 0, 0], [0, 1, 0]], [[-1, 0, 0], [0, 1, 0]]], float)


class Felt:
    """Coordinates of a mesh's triangles. coordinates: (n, 3, 2), m, at their corners, turned by `orientation`.
    source: "axis", "uvs" or "box". stretch: least and greatest of the uvs along u and v. uneven: share of the area on which
    the uvs have no area, or stretch by more than an octave."""

    def __init__(self, coordinates, source, stretch=((1.0, 1.0), (1.0, 1.0)), uneven=0.0):
        self.coordinates, self.source, self.stretch, self.uneven = coordinates, source, stretch, uneven


def _dot(a, b):
    """Dot products of rows."""
    return np.einsum("...i,...i", a, b)


def _unit(rows):
    length = np.sqrt(_dot(rows, rows))
    return rows / np.where(length > 0.0, length, 1.0)[..., None]


def _rest(linear):
    """A transform in glTF's axes without its rotation, as the loader applies it to a mesh."""
    x = _unit(linear[:, 0])
    y = _unit(linear[:, 1] - x * (x @ linear[:, 1]))
    return np.stack([x, y, np.cross(x, y)]) @ linear


def _by_axis(corners, unit, axis):
    """Positions along the axis, and across it on each triangle."""
    along = axis - unit * (unit @ axis)[:, None]
    lost = _dot(along, along) <= 1e-18 * (axis @ axis)
    any_axis = np.where((np.abs(unit[:, :1]) < 0.9), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    along = np.where(lost[:, None], any_axis - unit * _dot(any_axis, unit)[:, None], along)
    across = np.cross(unit, _unit(along))
    return np.stack([corners @ axis, np.einsum("nki,ni->nk", corners, across)], axis=2)


def _by_box(corners, normal):
    size = np.abs(normal) * (1.0, 1.01, 1.02)
    axis = np.where((size[:, 2] >= size[:, 0]) & (size[:, 2] >= size[:, 1]), 2, np.where(size[:, 1] >= size[:, 0], 1, 0))
    side = 2 * axis + (np.take_along_axis(normal, axis[:, None], 1)[:, 0] < 0.0)
    return np.einsum("nki,nci->nkc", corners, BOX[side])


def _scale(lengths, area):
    """m per unit of u or v: the mean by area over the two octaves of lengths that hold the most area."""
    mantissa, exponent = np.frexp(lengths)
    bins = PER_OCTAVE * exponent + ((2.0 * mantissa - 1.0) * PER_OCTAVE).astype(int)
    bins -= bins.min()
    areas = np.bincount(bins, area)
    held = np.cumsum(areas)
    window = 2 * PER_OCTAVE
    held[window:] -= held[:-window].copy()
    last = int(np.argmax(held >= held.max() * (1.0 - 1e-9)))
    kept = (bins <= last) & (bins > last - window)
    return area[kept] @ lengths[kept] / area[kept].sum()


def _by_uvs(corners, normal, uvs):
    """As Felt, or None if the uvs have an area on less than half of the mesh."""
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    (u1, v1), (u2, v2) = (uvs[:, 1] - uvs[:, 0]).T, (uvs[:, 2] - uvs[:, 0]).T
    det = u1 * v2 - u2 * v1
    mapped = np.abs(det) > 1e-9 * (np.abs(u1) + np.abs(u2) + np.abs(v1) + np.abs(v2)) ** 2
    area = np.sqrt(_dot(normal, normal))
    if not area[mapped].sum() >= 0.5 * area.sum():
        return None
    safe = np.where(mapped, det, 1.0)[:, None]
    du = (v2[:, None] * e1 - v1[:, None] * e2) / safe
    dv = (u1[:, None] * e2 - u2[:, None] * e1) / safe
    lengths = [np.sqrt(_dot(d, d)) for d in (du, dv)]
    mapped &= (lengths[0] > 0.0) & (lengths[1] > 0.0)
    scale = np.array([_scale(length[mapped], area[mapped]) for length in lengths])
    felt = uvs * scale
    felt[det < 0.0, :, 1] *= -1.0  # seen from the front, y is a quarter turn counter-clockwise from x
    felt[~mapped] = np.nan
    ratios = np.stack([scale[k] / lengths[k][mapped] for k in (0, 1)])
    even = np.all((ratios <= 2.0) & (ratios >= 0.5), axis=0)
    return Felt(felt, "uvs", tuple((r.min(), r.max()) for r in ratios), 1.0 - area[mapped][even].sum() / area.sum())


def measure(corners, uvs, linear, axis=(0.0, 0.0, 0.0), is_box=False, turn=0.0):
    """Felt coordinates. corners: (n, 3, 3), the object's space; uvs: (n, 3, 2), Blender's, or None; linear: 3x3 of the object's
    world matrix; axis: glTF's, 0: none; turn: the orientation, rad. The coordinates' rows are those of `corners`; NaN: no
    area."""
    rest = _rest(TO_GLTF @ linear @ TO_GLTF.T)
    order = slice(None, None, -1 if np.linalg.det(rest) < 0.0 else 1)  # the loader turns a mirrored mesh's triangles over
    placed = (corners @ (rest @ TO_GLTF).T)[:, order]
    edges = placed[:, [1, 2, 2]] - placed[:, [0, 0, 1]]
    normal = np.cross(edges[:, 0], edges[:, 1])
    felt = None
    if any(axis):
        felt = Felt(_by_axis(placed, _unit(normal), _unit(rest @ np.array(axis, float))), "axis")
    elif uvs is not None and not is_box:
        felt = _by_uvs(placed, normal, uvs[:, order] * (1.0, -1.0) + (0.0, 1.0))
    felt = felt or Felt(_by_box(placed, normal), "box")
    if turn != 0.0:
        felt.coordinates = felt.coordinates @ np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    felt.coordinates[_dot(normal, normal) <= 1e-12 * _dot(edges, edges).max(axis=1) ** 2] = np.nan  # thinner than a float
    felt.coordinates = felt.coordinates[:, order]
    return felt


def _cut(corners, values):
    """The segments on which `values` (n, 3), linear on each triangle, are whole numbers: (m, 2, 3)."""
    order = np.argsort(values, axis=1)
    v = np.take_along_axis(values, order, 1)
    first = np.ceil(v[:, 0])
    count = np.where(v[:, 2] > v[:, 0], np.floor(v[:, 2]) - first + 1.0, 0.0).astype(int)
    triangle = np.repeat(np.arange(len(v)), count)
    level = first[triangle] + np.arange(len(triangle)) - np.repeat(np.cumsum(count) - count, count)
    low, middle, high = v[triangle].T
    at = [corners[triangle, order[triangle, k]] for k in range(3)]
    below = ((level <= middle) & (middle > low))[:, None]  # the segment ends between low and middle, or middle and high
    begin, end = np.where(below, at[0], at[1]), np.where(below, at[1], at[2])
    begins, ends = np.where(below[:, 0], low, middle), np.where(below[:, 0], middle, high)
    gap = np.where(ends > begins, ends - begins, 1.0)
    return np.stack([at[0] + ((level - low) / (high - low))[:, None] * (at[2] - at[0]),
                     begin + ((level - begins) / gap)[:, None] * (end - begin)], axis=1)


def _count(values):
    """How many segments _cut() returns."""
    low, high = values.min(axis=1), values.max(axis=1)
    return np.where(high > low, np.floor(high) - np.ceil(low) + 1.0, 0.0).sum()


def lines(corners, felt, frequencies, limit=LIMIT):
    """The crests: (segments across x, segments across y, step), segments (m, 2, 3) in the object's space. Every step-th
    crest is there, counted from the coordinates' origin: of 1, 2, 5, 10, 20 ... the first step with at most `limit`
    segments. frequencies: cycles per metre along x and y."""
    has_area = ~np.isnan(felt.coordinates).any(axis=(1, 2))
    corners, cycles = corners[has_area], felt.coordinates[has_area] * np.asarray(frequencies, float)
    steps = (digit * 10 ** power for power in range(308) for digit in (1, 2, 5))
    step = next(each for each in steps if not sum(_count(cycles[:, :, k] / float(each)) for k in (0, 1)) > limit)
    return [_cut(corners, cycles[:, :, k] / float(step)) for k in (0, 1)] + [step]
