#!/usr/bin/env python3
"""The everyday materials of assets/materials.json, for the tool (samples/knurl/materials.c) and for docs/materials.md.

usage: materials.py [--check]    Writes both; --check: exits with 1 if one of them differs.
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
            "| name | material | period | depth |\n|---|---|---|---|\n" + "\n".join(rows) + "\n")


def check_rules(materials):
    names = [m["name"] for m in materials]
    assert names == sorted(set(names)), "expected names in order, each once"
    header = (ROOT / "samples/knurl/materials.h").read_text(encoding="utf-8")
    assert f"#define MATERIAL_COUNT {len(names)}\n" in header, f"materials.h: expected MATERIAL_COUNT {len(names)}"


def main():
    materials = read()
    check_rules(materials)
    status = 0
    for path, text in (("samples/knurl/materials.c", for_tool(materials)), ("docs/materials.md", for_docs(materials))):
        file = ROOT / path
        if "--check" not in sys.argv:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text:
            print(f"{path} differs from assets/materials.json: run assets/make/materials.py", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
