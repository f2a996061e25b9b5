"""A tag as custom properties (docs/tagging.md). It is stored nowhere else, so it works with undo, linked libraries and other
exporters, such as FBX. SPDX-License-Identifier: MIT"""
import json
import math
import os

PREFIX = "knurl_"
KEYS = ("spatial_frequency", "amplitude", "stiffness", "damping", "friction", "orientation", "axis", "coordinates", "method",
        "smooth")
DEFAULT = {"spatial_frequency": [1000.0, 0.0], "amplitude": 0.0002, "stiffness": 400.0}


def _plain(value):
    """A custom property's value in JSON's types."""
    if hasattr(value, "to_dict"):
        return value.to_dict()
    return list(value) if hasattr(value, "to_list") else value


def read(owner):
    """The tag in the nested form, or None. A nested tag, as an importer leaves it, counts if there is no flat one. Keys that
    this version does not know are kept."""
    tag = {key[len(PREFIX):]: _plain(owner[key]) for key in owner.keys() if key.startswith(PREFIX)}
    if not tag and hasattr(owner.get("knurl"), "to_dict"):
        tag = owner["knurl"].to_dict()
    if not tag:
        return None
    if "smooth" in tag:
        tag["smooth"] = bool(tag["smooth"])
    known = {key: tag.pop(key) for key in ("version", *KEYS) if key in tag}
    return {"version": 1, **known, **tag}


def write(owner, tag):
    """Replaces the tag; None removes it."""
    for key in list(owner.keys()):
        if key == "knurl" or key.startswith(PREFIX):
            del owner[key]
    for key, value in (tag or {}).items():
        if (key, value) != ("version", 1):
            try:
                owner[PREFIX + key] = value
            except TypeError:
                pass  # null, or a mixed list: no custom property can hold it, and no version of Knurl has such a key


def get(owner, key, default):
    return (read(owner) or {}).get(key, default)


def put(owner, key, value):
    """Sets a key; None removes it. A nested tag is made flat first, and an object without a tag gets the default one."""
    if not any(PREFIX + each in owner for each in KEYS):
        write(owner, read(owner) or DEFAULT)
    if value is None:
        owner.pop(PREFIX + key, None)
    else:
        owner[PREFIX + key] = value


def merged(*owners):
    """The tag that counts for a mesh: its material's, the mesh's and the object's, later ones first; {} if there is none."""
    found = {}
    for owner in owners:
        found.update((owner and read(owner)) or {})
    return found


def _is_number(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


def number(tag, key, default):
    """A key's number; the default if the value typed by hand is not a number, see faults()."""
    value = tag.get(key, default)
    return float(value) if _is_number(value) else default


def frequencies(tag):
    """Cycles per metre along x and y."""
    value = tag.get("spatial_frequency", 0.0)
    both = (value if isinstance(value, list) else [value]) + [0.0]
    return [float(each) if _is_number(each) and each > 0.0 else 0.0 for each in both[:2]]


def axis(tag):
    """In glTF's axes; zeros: no axis."""
    value = tag.get("axis")
    return list(value) if isinstance(value, list) and len(value) == 3 and all(map(_is_number, value)) else [0.0, 0.0, 0.0]


def faults(tag):
    """A sentence for each key that the loader would refuse: custom properties can be typed by hand."""
    for key, value in tag.items():
        if key not in ("version", *KEYS):
            yield f"knurl_{key}: unknown"
        elif key == "spatial_frequency":
            both = value if isinstance(value, list) else [value]
            if len(both) > 2 or not both or not all(_is_number(each) and each >= 0.0 for each in both):
                yield f"knurl_{key}: expected one or two numbers of 0 or more, found {value!r:.40}"
        elif key == "axis":
            if not any(axis(tag)):
                yield f"knurl_{key}: expected three numbers that are not all 0, found {value!r:.40}"
        elif key in ("amplitude", "stiffness", "damping", "friction", "orientation"):
            least = {"orientation": "", "stiffness": " above 0"}.get(key, " of 0 or more")
            if not _is_number(value) or (least and value < 0.0) or (key == "stiffness" and value == 0.0):
                yield f"knurl_{key}: expected a number{least}, found {value!r:.40}"


def turned(axis, to_gltf):
    """A direction from glTF's axes, in which it is stored, to Blender's; to_gltf: back."""
    x, y, z = axis
    return [x, z, -y] if to_gltf else [x, -z, y]


def materials():
    """The everyday materials that come with the add-on: [{name, title, period, depth, tag}]."""
    folder = os.path.dirname(os.path.abspath(__file__))
    for path in (os.path.join(folder, "materials.json"), os.path.join(folder, "../../../assets/materials.json")):
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                return json.load(file)["materials"]
    return []
