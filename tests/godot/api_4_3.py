#!/usr/bin/env python3
"""Checks that the add-on, its library and the sample use nothing of the engine that 4.3 does not have. api_4_3.txt lists
what they use and 4.3 has: names, and methods with the hash of their signature. The binding is compiled with 4.3's own C
header, which covers its interface functions. SPDX-License-Identifier: MIT

usage: api_4_3.py [--write EXTENSION_API.json]     --write: writes api_4_3.txt again, from the description of its classes
that Godot 4.3 dumps (godot --dump-extension-api; the crate gdextension-api has it, too)"""
import glob
import json
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
LIST = os.path.join(HERE, "api_4_3.txt")
GODOT = os.path.join(ROOT, "bindings", "godot")
SCRIPTS = ("bindings/godot/addons/**/*.gd", "samples/godot/**/*.gd")
STRINGS = r'''"(\\.|[^"\\])*"|'(\\.|[^'\\])*'|#.*|[$%][\w/]+''' # and comments, and paths of nodes
# Words of GDScript, which are in no class.
LANGUAGE = set("preload load range len new assert if elif while for in match return and or not func await print_debug "
               "Color8 char convert get_stack inst_to_dict is_instance_of ord print_stack type_exists "
               "false true null free Variant warning_ignore".split())


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def scripts():
    for pattern in SCRIPTS:
        for path in sorted(glob.glob(os.path.join(ROOT, pattern), recursive=True)):
            yield os.path.relpath(path, ROOT), re.sub(STRINGS, '""', read(path))


def own_names():
    """What scripts and class reference declare."""
    names = set()
    for _, text in scripts():
        names.update(re.findall(r"\b(?:func|var|const|signal|enum|class_name|class)\s+(\w+)", text))
        for body in re.findall(r"\benum\b[^{]*{([^}]*)}", text):
            names.update(re.findall(r"\w+", body))
    for path in glob.glob(os.path.join(GODOT, "doc_classes", "*.xml")):
        names.update(re.findall(r'<(?:class|method|member|signal|constant) name="(\w+)"', read(path)))
        names.update(re.findall(r"\[code\](\w+)\[/code\]", read(path))) # keys of dictionaries
    for path in glob.glob(os.path.join(GODOT, "src", "*.c")):
        names.update(re.findall(r'^    {"(\w+)", GDEXTENSION_', read(path), re.M)) # methods
    return names


def used_by_scripts():
    """Names of members, functions and classes, each with a file that uses it."""
    own, used = own_names(), {}
    for path, text in scripts():
        names = re.findall(r"\.([A-Za-z_]\w*)|\b([A-Za-z_]\w*)(?=\s*\()|\b([A-Z]\w*[a-z]\w*)\b|^(?:func) (_\w+)", text, re.M)
        for name in {name for row in names for name in row if name} - own - LANGUAGE:
            used.setdefault(name, path)
    return used


def used_by_library():
    """Methods with hashes, and names of methods, signals and classes in calls."""
    used = {}
    table = read(os.path.join(GODOT, "src", "api.h"))
    for kind, method, number in re.findall(r"X\((\w+), (\w+), (\d+)\)", table):
        used[f"{kind}.{method} {number}"] = "bindings/godot/src/api.h"
    own = own_names()
    for path in sorted(glob.glob(os.path.join(GODOT, "src", "*.c"))):
        calls = re.findall(r'gd_(?:call_named|connect|disconnect|cast|emit|name_new)\([^"()]*(?:\([^()]*\))?[^"()]*"(\w+)"',
                           read(path))
        for name in set(calls) - own:
            used[name] = os.path.relpath(path, ROOT)
    return used


def known_of(api):
    """Everything that a description of the engine's classes names, and its methods with their hashes."""
    known = set()
    for group in api["classes"] + api["builtin_classes"]:
        known.add(group["name"])
        for key in ("methods", "properties", "signals", "constants", "members", "enums"):
            for member in group.get(key) or []:
                known.add(member["name"])
                known.update(value["name"] for value in member.get("values", []))
                for number in [member.get("hash"), *member.get("hash_compatibility", [])]:
                    known.add(f"{group['name']}.{member['name']} {number}")
                    spelled = re.sub(r"(?<!^)(?=[A-Z])", "_", group["name"]).upper()  # PACKED_INT32_ARRAY
                    known.add(f"{spelled}.{member['name']} {number}")
    known.update(function["name"] for function in api["utility_functions"])
    for group in api["global_enums"]:
        known.update([group["name"], *(value["name"] for value in group["values"])])
    return known


def main(arguments):
    used = {**used_by_scripts(), **used_by_library()}
    if arguments[:1] == ["--write"]:
        api = json.loads(read(arguments[1]))
        version = api["header"]["version_major"], api["header"]["version_minor"]
        if version != (4, 3):
            sys.exit(f"api_4_3: {arguments[1]}: expected Godot 4.3's, found {'.'.join(map(str, version))}'s")
        lines = sorted(set(used) & known_of(api))
        with open(LIST, "w", encoding="utf-8", newline="\n") as file:
            file.write("\n".join(lines) + "\n")
    missing = sorted(set(used) - set(read(LIST).split("\n")))
    for name in missing:
        print(f"api_4_3: {used[name]}: {name}: not known in Godot 4.3: use another, or, if 4.3 has it, run "
              "tests/godot/api_4_3.py --write EXTENSION_API.json")
    print(f"api_4_3: {len(used)} names of the engine are used, {len(missing)} of them unknown to 4.3")
    return bool(missing)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
