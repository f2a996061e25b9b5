"""A tag as custom properties (docs/tagging.md). It is stored nowhere else, so it works with undo, linked libraries and other
exporters, such as FBX. SPDX-License-Identifier: MIT"""
import json
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
    """The tag in the nested form, or None. A nested tag, as an importer leaves it, counts if there is no flat one."""
    tag = {key: _plain(owner[PREFIX + key]) for key in KEYS if PREFIX + key in owner}
    if not tag and hasattr(owner.get("knurl"), "to_dict"):
        nested = owner["knurl"].to_dict()
        tag = {key: nested[key] for key in KEYS if key in nested}
    if not tag:
        return None
    if "smooth" in tag:
        tag["smooth"] = bool(tag["smooth"])
    return {"version": 1, **tag}


def write(owner, tag):
    """Replaces the tag; None removes it."""
    for key in list(owner.keys()):
        if key == "knurl" or key.startswith(PREFIX):
            del owner[key]
    for key in KEYS:
        if tag and key in tag:
            owner[PREFIX + key] = tag[key]


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


def frequencies(owner):
    """Cycles per metre along x and y."""
    value = get(owner, "spatial_frequency", 0.0)
    return list(value) if isinstance(value, list) else [float(value), 0.0]


def materials():
    """The everyday materials that come with the add-on: [{name, title, period, depth, tag}]."""
    folder = os.path.dirname(os.path.abspath(__file__))
    for path in (os.path.join(folder, "materials.json"), os.path.join(folder, "../../../assets/materials.json")):
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                return json.load(file)["materials"]
    return []
