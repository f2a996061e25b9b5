"""api.json agrees with the libraries and with the C compiler: it names every exported function, and its signatures, field
offsets and field types compile beside the headers. SPDX-License-Identifier: MIT
usage: test_api.py API.JSON READELF CC LIBRARY..."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def declared(kind, name):
    """A C declaration of a name from a type as api.json spells it: 'const double[3]', 'int (*)(void *)'. (*) as the name: a
    pointer to the type."""
    if "(*)" in kind:
        return kind.replace("(*)", f"(*{name})", 1)
    found = re.match(r"([^\[]*)((?:\[\d*\])*)$", kind)
    return f"{found[1]} {name}{found[2]}"


def exported(library):
    out = subprocess.run([READELF, "-Ws", library], capture_output=True, text=True, check=True).stdout
    rows = [line.split() for line in out.splitlines()]
    return {row[7] for row in rows if len(row) == 8 and row[3:6] == ["FUNC", "GLOBAL", "DEFAULT"] and row[6] != "UND"}


class ApiTest(unittest.TestCase):
    def compiles(self, lines):
        program = "\n".join(["#include <knurl/knurl.h>", "#include <stddef.h>", *lines, ""])
        made = subprocess.run([CC, "-std=c11", "-Werror", "-fsyntax-only", "-xc", "-", f"-I{ROOT / 'sdk/include'}"],
                              input=program, capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_every_exported_function_is_named_and_no_other(self):
        names = set().union(*map(exported, LIBRARIES))
        self.assertEqual(names, API["functions"].keys())

    def test_signatures_are_those_of_the_headers(self):
        lines = []
        for name, f in API["functions"].items():
            parameters = [declared(p["type"], p["name"]) for p in f["parameters"]] + ["..."] * f.get("variadic", False)
            lines.append(f"{f['returns']} {name}({', '.join(parameters) or 'void'});")
        self.compiles(lines)

    def test_fields_are_where_the_compiler_puts_them(self):
        checks = [f'_Static_assert(sizeof({name}) == {s["size"]} && _Alignof({name}) == {s["align"]}, "{name}");'
                  for name, s in API["structs"].items()]
        for name, s in API["structs"].items():
            self.assertEqual(s["fields"][0]["offset"], 0)
            for f in s["fields"]:
                checks += [f'_Static_assert(offsetof({name}, {f["name"]}) == {f["offset"]}, "{name}.{f["name"]}");',
                           f'_Static_assert(_Generic(&(({name} *)0)->{f["name"]}, {declared(f["type"], "(*)")}: 1, default: 0), '
                           f'"{name}.{f["name"]}: {f["type"]}");']
        self.compiles(checks)

    def test_all_fields_are_named(self):
        layout = (ROOT / "bindings/unity/native/layout.g.h").read_text()
        mirrored = set(re.findall(r"FIELD\((\w+), (\w+)", layout))
        self.assertEqual({(name, f["name"]) for name, s in API["structs"].items() for f in s["fields"]},
                         {pair for pair in mirrored if pair[0] in API["structs"]})

    def test_facts_are_those_of_the_docstrings(self):
        fields = {f["name"]: f for f in API["structs"]["knurl_device_info"]["fields"]}
        self.assertEqual((fields["mass"]["unit"], fields["mass"]["range"]), ("kg", "0.001 to 10"))
        self.assertEqual((fields["viscous"]["unit"], fields["viscous"]["range"]), ("N s/m", "0 to 1000"))
        set_gain = API["functions"]["knurl_loop_set_gain"]
        self.assertEqual((set_gain["thread"], set_gain["errors"]), ("any thread", ["KNURL_ERROR_ARGUMENT"]))
        self.assertEqual(set_gain["parameters"][1]["range"], "0 to 1")
        self.assertEqual(API["constants"]["KNURL_FAULT_GAP"]["value"], 13)

    def test_every_function_says_its_thread(self):
        self.assertEqual([name for name, f in API["functions"].items() if not f.get("doc") or not f.get("thread")], [])


if __name__ == "__main__":
    READELF, CC, *LIBRARIES = sys.argv[2:]
    with open(sys.argv[1], encoding="utf-8") as given:
        API = json.load(given)
    unittest.main(argv=sys.argv[:1])
