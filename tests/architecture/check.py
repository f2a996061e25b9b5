#!/usr/bin/env python3
"""Holds the sources to the architecture: which module may use which, no circles of files, short headers, and a picture that
agrees with the code. SPDX-License-Identifier: MIT

    check.py --build DIR [--nm NM] --objects FILE... [--objects FILE...]     the test `architecture`
    check.py --draw ...                                                      draws the picture (target `picture`)"""
import argparse
import os
import sys

import picture
from units import LIBRARY, PUBLIC, Code, unit_of

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

# Module: the modules that it may use. Others, bindings and samples, use public headers only.
MODULES = {
    "base": set(),
    "vibration": {"base"},
    "grating": {"base", "vibration"},
    "motion": {"base"},
    "contact": {"base"},
    "device": {"base"},
    "surface": {"base", "contact", "grating"},  # of a method: the values that a material needs
    "proxy": {"base", "contact", "surface", "grating", "guard"},  # of gratings and walls their state
    "guard": {"base", "grating"},
    "hip": {"base", "grating", "motion", "contact", "surface", "proxy", "guard"},
    "scene": {"base", "grating", "motion", "contact", "surface", "proxy", "guard", "hip"},
    "stroke": {"base", "contact", "surface", "proxy", "hip", "scene", "device", "motion"},
    "audio": {"base", "scene"},  # of the scene: a tick's output
    "loop": {"base", "scene", "hip", "guard", "device", "motion", "vibration"},  # workspaces are motion's; games add vibrations
    "gltf": {"scene", "grating", "contact"},
}
# Public headers that a room may use beside its own modules': the scene's rooms are declared in two.
DECLARED_IN = {room: {"scene", "hip"} for room in ("surface", "proxy", "guard", "hip")}
DECLARED_IN["stroke"] = {"scene", "fake"}
DECLARED_IN["device"] = {"device_functions", "fake"}
DECLARED_IN["hip"] = {"scene", "hip", "effect"}
DECLARED_IN["audio"] = {"hip"}
# Headers without anything to link, for targets that link only the library's public functions: gltf, bindings and
# samples.
HEADER_ONLY = {"base/atomic", "base/finite", "base/handle", "base/regular_file", "base/seqlock"}

SHORT_HEADERS = ("surface", "proxy", "guard", "hip", "scene", "contact")
HEADER_LINES = 120

# Present failures, to be removed. An entry that no longer fails is also an error.
KNOWN_CIRCLES = []
KNOWN_LONG_HEADERS = []


def check_modules(code):
    wrong = []
    for unit, others in code.uses.items():
        module = code.module(unit)
        for other in sorted(others):
            to = code.module(other)
            if module in MODULES and to != module and to not in MODULES[module] and not (module == "gltf" and other in HEADER_ONLY):
                wrong.append(f"{module} may use {', '.join(sorted(MODULES[module])) or 'no other module'}: {unit} uses {other}")
    for path, modules in code.public.items():
        module = os.path.basename(path)[:-2] if path.startswith(PUBLIC) else code.module(unit_of(path))
        for to in sorted(modules):
            if module in MODULES and to not in MODULES[module] | DECLARED_IN.get(module, set()) | {module, "base"}:
                wrong.append(f"{path}: {module} may not use <knurl/{to}.h>")
    wrong += [f'{path}: only public headers, <knurl/...>, are for bindings and samples, found "{name}"'
              for path, name in code.stray if name[:-2] not in HEADER_ONLY]
    return wrong


def check_circles(code, known):
    found = code.circles()
    wrong = [f"a circle: {', '.join(circle)} all depend on one another" for circle in found
             if not any(set(circle) <= set(other) for other in known)]
    return wrong + [f"no circle any more: take {', '.join(other)} out of KNOWN_CIRCLES" for other in known
                    if not any(set(circle) <= set(other) for circle in found)]


def check_headers(code, known):
    long = {path: lines for path, lines in code.lines.items() if path.endswith(".h") and lines > HEADER_LINES
            and path.startswith(tuple(f"{LIBRARY}/{module}/" for module in SHORT_HEADERS))}
    wrong = [f"{path}: {lines} lines, at most {HEADER_LINES}" for path, lines in long.items() if path not in known]
    return wrong + [f"{path} is short: take it out of KNOWN_LONG_HEADERS" for path in known if path not in long]


def same(path, text):
    with open(path, encoding="utf-8") as file:
        return file.read() == text


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--objects", nargs="+", action="append", default=[], help="of one library or program")
    parser.add_argument("--draw", action="store_true")
    given = parser.parse_args(arguments)
    code = Code(ROOT)
    for objects in given.objects:
        code.add_objects(objects, given.build, given.nm)
    wrong = check_modules(code) + check_circles(code, KNOWN_CIRCLES) + check_headers(code, KNOWN_LONG_HEADERS)
    drawn, missing = picture.draw(code)
    path = os.path.join(ROOT, picture.PATH)
    if given.draw and drawn:
        with open(path, "w", encoding="utf-8") as file:
            file.write(drawn)
    elif drawn and not (os.path.exists(path) and same(path, drawn)):
        missing.append(f"{picture.PATH} is not what the code says: cmake --build build/release --target picture")
    for line in wrong + missing:
        print("architecture:", line, file=sys.stderr)
    return 1 if wrong or missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
