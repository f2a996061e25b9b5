"""Writes small .glb files by hand: meshes with positions, normals and UVs, materials with extras, textures as PNG.

The same input gives the same bytes. SPDX-License-Identifier: MIT
"""
import json
import struct
import zlib

import numpy as np

FLOAT, UINT16 = 5126, 5123
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LINEAR, LINEAR_MIPMAP_LINEAR, REPEAT = 9729, 9987, 10497


def png(pixels):
    """An RGB image (height x width x 3, uint8) as PNG bytes, stored uncompressed so that no zlib changes them."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b"")


class Glb:
    """Collects nodes, meshes and materials; save() writes them. Returned indices are glTF's."""

    def __init__(self):
        self.binary = bytearray()
        self.json = {
            "asset": {"version": "2.0", "generator": "Knurl assets/make",
                      "copyright": "Knurl contributors, MIT licence"},
            "scene": 0,
            "scenes": [{"nodes": []}],
        }

    def _add(self, kind, item):
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def _view(self, data, target=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.binary += data
        return self._add("bufferViews", {**view, "target": target} if target else view)

    def _vectors(self, values, bounds=False):
        values = np.ascontiguousarray(values, "<f4")
        item = {"bufferView": self._view(values.tobytes(), ARRAY_BUFFER), "componentType": FLOAT, "count": len(values),
                "type": f"VEC{values.shape[1]}"}
        if bounds:
            item["min"] = [float(v) for v in values.min(axis=0)]
            item["max"] = [float(v) for v in values.max(axis=0)]
        return self._add("accessors", item)

    def _indices(self, triangles):
        flat = np.ascontiguousarray(triangles, "<u2").ravel()
        view = self._view(flat.tobytes(), ELEMENT_ARRAY_BUFFER)
        item = {"bufferView": view, "componentType": UINT16, "count": len(flat), "type": "SCALAR"}
        return self._add("accessors", item)

    def material(self, name, *, roughness, metallic, colour=None, tile=None, knurl=None):
        """A single-sided material; tile: pixels that repeat with every unit of u and v; knurl: its tag."""
        look = {"metallicFactor": metallic, "roughnessFactor": roughness}
        if colour:
            look["baseColorFactor"] = [*colour, 1.0]
        if tile is not None:
            image = self._add("images", {"bufferView": self._view(png(tile)), "mimeType": "image/png", "name": name})
            sampler = self._add("samplers", {"magFilter": LINEAR, "minFilter": LINEAR_MIPMAP_LINEAR, "wrapS": REPEAT,
                                             "wrapT": REPEAT})
            look["baseColorTexture"] = {"index": self._add("textures", {"sampler": sampler, "source": image})}
        item = {"name": name, "pbrMetallicRoughness": look}
        if knurl:
            item["extras"] = {"knurl": {"version": 1, **knurl}}
        return self._add("materials", item)

    def node(self, name, material, positions, normals, triangles, uvs=None):
        """One mesh under a node of the same name. positions, normals: n x 3, uvs: n x 2, triangles: m x 3, CCW."""
        attributes = {"POSITION": self._vectors(positions, bounds=True), "NORMAL": self._vectors(normals)}
        if uvs is not None:
            attributes["TEXCOORD_0"] = self._vectors(uvs)
        primitive = {"attributes": attributes, "indices": self._indices(triangles), "material": material}
        mesh = self._add("meshes", {"name": name, "primitives": [primitive]})
        self.json["scenes"][0]["nodes"].append(self._add("nodes", {"name": name, "mesh": mesh}))

    def save(self, path):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(self.binary)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, size))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)
