#!/usr/bin/python3
"""The spatial methods are listed wherever a user picks one. The lists are held against the table in methods.c and the
numbers in grating.h. SPDX-License-Identifier: MIT

    methods.py              every list
    methods.py --write      adds the methods that a list lacks, with their sentences in grating.h
    methods.py --self-test  a list that lacks a method, or has one by another name or number, is found"""
import json
import os
import re
import sys
import xml.etree.ElementTree

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def methods():
    """{number: name} and the default's number, from the C sources."""
    numbers = {name: int(number) for name, number in
               re.findall(r"\bKNURL_METHOD_(\w+) = (\d+)", read("sdk/include/knurl/grating.h"))}
    names = dict(re.findall(r'\[KNURL_METHOD_(\w+)\] = \{"(\w+)"', read("sdk/src/grating/methods.c")))
    default = re.search(r"grating->method = KNURL_METHOD_(\w+)", read("sdk/src/grating/grating.c"))[1]
    if numbers.pop("DEFAULT") != 0 or numbers.keys() != names.keys():
        sys.exit(f"methods: grating.h has {sorted(numbers)}, methods.c has {sorted(names)}")
    return {numbers[name]: names[name] for name in sorted(numbers, key=numbers.get)}, numbers[default]


def title(name):
    """As enumerations spell it: Bandlimited."""
    return name[0].upper() + name[1:]


def any_of(names, quote="'"):
    """A sentence's list: 'S1', 'S2' or 'bandlimited'."""
    quoted = [quote + name + quote for name in names]
    return ", ".join(quoted[:-1]) + " or " + quoted[-1]


def pairs(pattern, text):
    """{number: name} of a pattern with groups `name` and `number`."""
    return {int(found["number"]): found["name"] for found in re.finditer(pattern, text)}


def schema(text, known, default):
    entry = json.loads(text)["$defs"]["method"]
    return (entry["enum"], entry["default"]), (list(known.values()), known[default])


def tags_gd(text, known, default):
    row = re.search(r"METHODS: Dictionary = \{(.*)\}", text)[1]
    return (pairs(r'"(?P<name>\w+)": (?P<number>\d+)', row), text.count(any_of(known.values()))), (known, 2)


def grating_c(text, known, default):
    hint = re.search(r'\{"method", [^{}]*?, 0\.0, (\d+)\.0, 1\.0, "([\w,]+)"', text)
    constants = re.findall(r'\{"Method", "METHOD_(\w+)", KNURL_METHOD_(\w+)\}', text)
    upper = ["DEFAULT", *(name.upper() for name in known.values())]
    return (int(hint[1]), hint[2].split(","), constants), \
        (max(known), ["Default", *map(title, known.values())], [(name, name) for name in upper])


def grating_xml(text, known, default):
    rows = [row for row in xml.etree.ElementTree.fromstring(text).iter("constant") if row.get("enum") == "Method"]
    return ({int(row.get("value")): row.get("name") for row in rows}, rows[0].text), \
        ({0: "METHOD_DEFAULT", **{n: "METHOD_" + name.upper() for n, name in known.items()}},
         f"As METHOD_{known[default].upper()}.")


def knurl_cs(text, known, default):
    body = re.search(r"enum KnurlGratingMethod : long\s*\{(.*?)\}", text, re.DOTALL)[1]
    return pairs(r"(?m)^\s*(?P<name>\w+) = (?P<number>\d+)", body), {0: "Default", **{n: title(m) for n, m in known.items()}}


def method_cs(text, known, default):
    found = pairs(r"(?m)^\s*(?P<name>\w+) = (?P<number>\d+)", text)
    return (found, re.search(r'default: <see cref="(\w+)"/>', text)[1]), \
        ({0: "Default", **{n: title(m) for n, m in known.items()}}, title(known[default]))


def settings_js(text, known, default):
    found = json.loads(re.search(r"const METHODS = (\[.*\]);", text)[1])
    chosen = int(re.search(r'setMethod\(feel\[5\] \|\| (\d+)\)', text)[1])
    return (found, chosen), ([known[default], *known.values()], default)


def index_html(text, known, default):
    return pairs(r'name="method" form="controls" value="(?P<number>\d+)"[^>]*><span>(?P<name>\w+)</span>', text), known


def scene_py(text, known, default):
    return re.search(r"method: ([^.]*), or None\.", text)[1], ", ".join(f'"{name}"' for name in known.values())


def properties_py(text, known, default):
    return re.findall(r'\n        \("(\w+)", "\1", ', text), list(known.values())


def assets(text, known, default):
    names = list(known.values())
    return re.search(r"`knurl_method` \(String: ([^)]*)\)", text)[1], any_of(names, "")


def tagging(text, known, default):
    names = [f"`{name}`" + (" (default)" if number == default else "") for number, name in known.items()]
    return re.search(r"\| `knurl_method` \| \| optional\. (.*?):", text)[1], any_of(names, "")


# File: a function that returns its list and the expected one, as a pair.
LISTS = {
    "assets/knurl_extras.schema.json": schema,
    "assets/README.md": assets,
    "bindings/blender/knurl/properties.py": properties_py,
    "bindings/godot/addons/knurl/csharp/KnurlGrating.cs": knurl_cs,
    "bindings/godot/addons/knurl/tags.gd": tags_gd,
    "bindings/godot/doc_classes/KnurlGrating.xml": grating_xml,
    "bindings/godot/src/grating.c": grating_c,
    "bindings/python/knurl/scene.py": scene_py,
    "bindings/unity/package/Runtime/GratingMethod.cs": method_cs,
    "docs/tagging.md": tagging,
    "samples/web/index.html": index_html,
    "samples/web/settings.js": settings_js,
}


def sentences():
    """{name in capitals: its description in grating.h}."""
    comment = re.search(r"/\*\* The spatial methods\.(.*?)\*/", read("sdk/include/knurl/grating.h"), re.DOTALL)[1]
    found = re.findall(r"- (\w+)[^:]*: (.*?)(?= - |$)", " ".join(re.sub(r"\n \*", "", comment).split()))
    return {name: text[0].upper() + text[1:] for name, text in found}


def after_last(pattern, text, lines):
    """Puts lines behind the last match of a pattern."""
    at = list(re.finditer(pattern, text))[-1].end()
    return text[:at] + "".join(lines) + text[at:]


def completed(path, text, known, fresh, default):
    """A list's text with the methods of `fresh`, {number: name}, behind those that it has."""
    says, names = sentences(), list(known.values())
    last, former = max(known), [name for number, name in known.items() if number not in fresh]
    marked = [[f"`{n}`" + (" (default)" if n == known[default] else "") for n in some] for some in (former, names)]
    text = text.replace(any_of(marked[0], ""), any_of(marked[1], ""))
    for quote in ("'", "", "`"):
        text = text.replace(any_of(former, quote), any_of(names, quote))
    text = text.replace(", ".join(f'"{n}"' for n in former), ", ".join(f'"{n}"' for n in names))
    text = text.replace(",".join(map(title, former)) + '"', ",".join(map(title, names)) + '"')
    rows = {
        "bindings/blender/knurl/properties.py": (r'\n        \("(\w+)", "\1", [^\n]*', lambda n, m:
            f'\n        ("{m}", "{m}", "{says[m.upper()]}"),'),
        "bindings/godot/addons/knurl/tags.gd": (r'"\w+": \d+(?=\})', lambda n, m: f', "{m}": {n}'),
        "bindings/godot/doc_classes/KnurlGrating.xml": (r'\n\t\t<constant [^\n]*enum="Method">[^\n]*', lambda n, m:
            f'\n\t\t<constant name="METHOD_{m.upper()}" value="{n}" enum="Method">{says[m.upper()]}</constant>'),
        "bindings/godot/src/grating.c": (r'\n    \{"Method", [^\n]*', lambda n, m:
            f'\n    {{"Method", "METHOD_{m.upper()}", KNURL_METHOD_{m.upper()}}},'),
        "bindings/unity/package/Runtime/GratingMethod.cs": (r" = \d+(?=\n)", lambda n, m:
            f",\n\n        /// <summary>{says[m.upper()]}</summary>\n        {title(m)} = {n}"),
        "samples/web/index.html": (r'<label><input type="radio" name="method".*(?=\n  </fieldset>)', lambda n, m:
            f'\n    <label><input type="radio" name="method" form="controls" value="{n}"><span>{m}</span><canvas></canvas>'
            '<output></output></label>'),
    }
    if path in rows:
        text = after_last(rows[path][0], text, [rows[path][1](n, m) for n, m in fresh.items()])
    return re.sub(r'(\{"method", [^{}]*?, 0\.0, )\d+(\.0, 1\.0, ")', rf"\g<1>{last}\g<2>", text)


def write(known, default):
    """Completes every list that lacks methods at its end."""
    for path in LISTS:
        for count in range(1, len(known)):
            fresh = dict(list(known.items())[-count:])
            if check(path, known, default):
                text = completed(path, read(path), known, fresh, default)
                if LISTS[path](text, known, default)[0] == LISTS[path](text, known, default)[1]:
                    with open(os.path.join(ROOT, path), "w", encoding="utf-8") as file:
                        file.write(text)


def check(path, known, default):
    """The error of a file's list, or None."""
    try:
        found, expected = LISTS[path](read(path), known, default)
    except (TypeError, KeyError, AttributeError, IndexError):
        return f"{path}: its list of methods is not where this test looks for it"
    return None if found == expected else f"{path}: expected {expected}, found {found}"


def self_test():
    known, default = methods()
    last = max(known)
    others = {"a new method": ({**known, last + 1: "other"}, default), "another name": ({**known, last: "other"}, default),
              "other numbers": ({n + 1: name for n, name in known.items()}, default + 1)}
    by_name_only = {"assets/knurl_extras.schema.json", "assets/README.md", "bindings/blender/knurl/properties.py",
                    "bindings/python/knurl/scene.py", "docs/tagging.md"}
    return [f"{path}: {what} is not noticed" for what, (table, chosen) in others.items() for path in LISTS
            if not check(path, table, chosen) and not (what == "other numbers" and path in by_name_only)]


def main(arguments):
    if "--write" in arguments:
        write(*methods())
    wrong = self_test() if "--self-test" in arguments else [line for path in LISTS if (line := check(path, *methods()))]
    for line in wrong:
        print("methods:", line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
