#!/usr/bin/python3
"""Each public function of the library checks the mark of threads in its comment (sdk/src/base/rule.h), if it has a rule.
knurl_gltf's are left out: each calls the library's. usage: thread_marks.py SOURCE    SPDX-License-Identifier: MIT"""
import pathlib
import re
import sys

SDK = pathlib.Path(sys.argv[1]) / "sdk"


def rule_of(mark):
    """The rule of a mark; None for a function that may be called at any time."""
    if mark in ("any thread", "any thread; allowed in a tick"):
        return None
    if "or any while no other thread uses" in mark:
        return "END"
    if mark.startswith("game thread, while"):
        return "CONFIGURE"
    if mark.startswith("game thread") or "one at a time" in mark:
        return "GAME"
    if mark.startswith("haptic thread"):
        return "HAPTIC"
    if mark.startswith(("audio thread", "any thread, but only one")):
        return "ONE"
    if mark in ("any thread but the haptic", "any thread, never from a tick"):
        return "NOT_HAPTIC"
    sys.exit(f"thread_marks: unknown mark [{mark}]: name it here, and its rule in sdk/src/base/rule.h")


def marks():
    """(function, mark) of each public function; functions on lines in a row share the comment above them."""
    for header in sorted((SDK / "include/knurl").glob("*.h")):
        mark = None
        pattern = r"/\*\*((?:[^*]|\*(?!/))*)\*/|^KNURL_API[^;]*?\b(knurl_\w+)\("
        for found in re.finditer(pattern, header.read_text(), re.M):
            if found[2] is None:
                text = " ".join(re.sub(r"\n\s*\*", " ", found[1]).split())
                mark = re.search(r"\[([^\]]*thread[^\]]*)\]", text)
            elif header.name != "gltf.h":
                yield found[2], mark[1] if mark else sys.exit(f"thread_marks: {found[2]}: no mark of its thread")


def rules():
    """The rule that each function in the sources checks first."""
    body = re.compile(r"^\w[^\n;{}]*?\b(knurl_\w+)\([^{};]*\)(?:\s+KNURL_NONBLOCKING)? \{\n(?:\s*KNURL_RULE(?:_OF_HIP)?\((\w+))?", re.M)
    return {name: rule or None for path in SDK.glob("src/**/*.c") for name, rule in body.findall(path.read_text())}


found, wrong, count = rules(), [], 0
for function, mark in marks():
    expected = rule_of(mark)
    count += expected is not None
    if function in found and found[function] != expected:
        wrong.append(f"{function}: marked [{mark}]: expected KNURL_RULE({expected}, ...) as its first line, found {found[function]}")
    elif function not in found and expected is not None:
        wrong.append(f"{function}: marked [{mark}], but its definition was not found")
print("\n".join(wrong) or f"thread_marks: {count} functions check their marks")
sys.exit(bool(wrong))
