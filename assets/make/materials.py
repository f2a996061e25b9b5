#!/usr/bin/env python3
"""The everyday materials of assets/materials.json for the tool, the docs, Godot and Unity.

usage: materials.py [--check]    Writes their lists; --check: exits with 1 if one of them differs.
SPDX-License-Identifier: MIT
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read():
    return json.loads((ROOT / "assets/materials.json").read_text(encoding="utf-8"))["materials"]


def for_tool(materials):
    rows = []
    for m in materials:
        tag = json.dumps(m["tag"], separators=(",", ":")).replace('"', '\\"')
        rows.append(f'    {{"{m["name"]}",\n     "{tag}"}}')
    lines = [f'           "  {m["name"]:<17} {m["title"]}\\n"' for m in materials]
    return ("/* Everyday materials. Written by assets/make/materials.py from assets/materials.json.\n"
            " * SPDX-License-Identifier: MIT */\n"
            "/* clang-format off */\n"
            '#include "materials.h"\n\n'
            "const material materials[MATERIAL_COUNT] = {\n" + ",\n".join(rows) + "};\n\n"
            "const char *materials_text(void) {\n    return\n" + "\n".join(lines) + ";\n}\n")


def for_docs(materials):
    rows = [f"| `{m['name']}` | {m['title']} | {m['period']} | {m['depth']} |" for m in materials]
    return ("# Everyday materials\n\n"
            "<!-- Written by assets/make/materials.py from assets/materials.json. -->\n\n"
            "Tags to start from, in [assets/materials.json](../assets/materials.json):\n\n"
            "```sh\n"
            "build/release/knurl tag model.glb --material Grip --preset knurl_diamond --out felt.glb\n"
            "```\n\n"
            "Period is from ridge to ridge, depth from peak to peak. Each has its source, or is a guess, not measured.\n"
            "Stiffness and friction are guesses within what a 3D Systems Touch can render.\n\n"
            "Offered also by Blender's panel, Godot's inspector of a `KnurlGrating`, Unity's *Preset* and the page's swatches.\n\n"
            "| name | material | period | depth |\n|---|---|---|---|\n" + "\n".join(rows) + "\n")


def numbers(m):
    """spatial frequencies (1/m), amplitude (m), stiffness (N/m), friction, orientation (rad)"""
    tag = m["tag"]
    assert set(tag) <= {"spatial_frequency", "amplitude", "stiffness", "friction", "orientation"}, f"{m['name']}: unknown key"
    return [*tag["spatial_frequency"], tag["amplitude"], tag["stiffness"], tag["friction"], tag.get("orientation", 0)]


def for_godot(materials):
    rows = []
    for m in materials:
        fsx, fsy, amplitude, stiffness, friction, orientation = numbers(m)
        small = f"{amplitude:.9f}".rstrip("0")
        rows.append(f'\t{{\n\t\t"title": {quoted(m["title"])},\n\t\t"period": {quoted(m["period"])},\n\t\t"depth": {quoted(m["depth"])},\n'
                    f'\t\t"color": Color("{m["color"]}"),\n\t\t"spatial_frequency": Vector2({fsx}, {fsy}),\n\t\t"amplitude": {small},\n'
                    f'\t\t"stiffness": {float(stiffness)},\n\t\t"friction": {friction},\n\t\t"orientation": {float(orientation)},\n\t}},\n')
    return ("@tool\nextends RefCounted\n"
            "## Everyday materials. Written by assets/make/materials.py from assets/materials.json.\n\n"
            "const LIST: Array[Dictionary] = [\n" + "".join(rows) + "]\n")


def for_unity(materials):
    rows = []
    for m in materials:
        values = ", ".join(f"{value}f" for value in numbers(m)[2:])
        fsx, fsy = numbers(m)[:2]
        rows.append(f"            new EverydayMaterial({quoted(m['title'])}, {quoted(m['period'])},\n"
                    f"                {quoted(m['depth'])}, new Vector2({fsx}f, {fsy}f), {values}),\n")
    return ("// Everyday materials. Written by assets/make/materials.py from assets/materials.json.\n"
            "// SPDX-License-Identifier: MIT\n"
            "using UnityEngine;\n\n"
            "namespace Knurl.Editing\n{\n"
            "    internal sealed partial class EverydayMaterial\n    {\n"
            "        internal static readonly EverydayMaterial[] All =\n        {\n" + "".join(rows) + "        };\n    }\n}\n")


def quoted(text):
    return json.dumps(text, ensure_ascii=False)


LISTS = {
    "bindings/godot/addons/knurl/materials.gd": for_godot,
    "bindings/unity/package/Editor/EverydayMaterial.List.cs": for_unity,
    "docs/materials.md": for_docs,
    "samples/knurl/materials.c": for_tool,
}


def check_rules(materials):
    names = [m["name"] for m in materials]
    assert names == sorted(set(names)), "expected names in order, each once"
    header = (ROOT / "samples/knurl/materials.h").read_text(encoding="utf-8")
    assert f"#define MATERIAL_COUNT {len(names)}\n" in header, f"materials.h: expected MATERIAL_COUNT {len(names)}"


def main():
    materials = read()
    check_rules(materials)
    status = 0
    for path, made in LISTS.items():
        file, text = ROOT / path, made(materials)
        if "--check" not in sys.argv:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text:
            print(f"{path} differs from assets/materials.json: run assets/make/materials.py", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
