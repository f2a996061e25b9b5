#!/usr/bin/env python3
"""Writes api.json: everything that the public headers declare, for makers of bindings. Sizes and offsets are those of
64-bit Linux and Windows, which are the same. Units, ranges, defaults, threads and errors are extracted from the
docstrings, which are included; they also describe the ownership of memory. Needs
bindings/unity/native/requirements.txt.

    api.py FILE    SPDX-License-Identifier: MIT"""
import json
import pathlib
import re
import subprocess
import sys

from clang.cindex import CursorKind, Index, TranslationUnit, TypeKind

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEADERS = ROOT / "sdk/include"
UNITS = r"cycles per metre|samples per second|cycles/m|cycles|ticks|bytes|m/s|N s/m|N/m|N/s|N\^2|N|Hz|kg|rad|ns|m|s"
NUMBER = r"-?(?:\d[\d.e^,-]*\d|\d)|KNURL_\w+|INFINITY"


def plain(comment):
    """A docstring's text on one line."""
    text = re.sub(r"^/\*\*<?|\*/$", "", comment or "")
    return " ".join(re.sub(r"(?m)^\s*\* ?", "", text).split())


def first(pattern, text):
    found = re.search(pattern, text)
    return found[1] if found else None


def facts(doc):
    """The facts in a docstring, from the headers' fixed phrases; missing ones are left out."""
    unit = first(rf"(?:^|[,:] |\d )({UNITS})(?=[\s,:;.)]|$)", doc)
    told = {"doc": doc, "unit": unit, "range": first(rf"((?:{NUMBER}) to (?:{NUMBER})|>=? 0\b)", doc),
            "default": first(r"(?<!by )\bdefault:? ((?:[^;.,:)]|\.(?=\d)|, (?=[\d-]))+)", doc) or first(r"\[([^\]]*)\]$", doc)}
    return {key: value for key, value in told.items() if value}


def spell(kind):
    return re.sub(r"\b(?:struct|enum) ", "", kind.spelling)


def parameters(cursor, doc):
    for parameter in cursor.get_children():
        if parameter.kind == CursorKind.PARM_DECL:
            said = first(rf"(?:^|[.;:] |@param ){parameter.spelling}:? ((?:[^.;]|\.(?=\d))+)[.;]", doc) or ""
            yield {"name": parameter.spelling, "type": spell(parameter.type), **facts(said)}


def function(cursor, doc):
    told = {"header": pathlib.Path(cursor.location.file.name).name, "returns": spell(cursor.result_type),
            "parameters": list(parameters(cursor, doc)), "variadic": cursor.type.is_function_variadic(),
            "doc": doc, "thread": first(r"\[([^\]]*)\](?:[^\[]*)$", doc), "errors": re.findall(r"KNURL_ERROR_\w+", doc)}
    return {key: value for key, value in told.items() if value or key == "parameters"}


def struct(cursor, doc):
    fields = []
    for field in cursor.get_children():
        if field.kind == CursorKind.FIELD_DECL:
            fields.append({"name": field.spelling, "type": spell(field.type), "size": field.type.get_size(),
                           "offset": cursor.type.get_offset(field.spelling) // 8, **facts(plain(field.raw_comment))})
    return {"size": cursor.type.get_size(), "align": cursor.type.get_align(), "doc": doc, "fields": fields}


def number(cursor):
    """The number of a macro; None for other macros."""
    tokens = "".join(token.spelling for token in list(cursor.get_tokens())[1:]).strip("()")
    try:
        return json.loads(tokens)
    except ValueError:
        return None


def parse():
    include = subprocess.run(["cc", "-print-file-name=include"], capture_output=True, text=True, check=True).stdout.strip()
    arguments = ["-xc", "-std=c99", "-ffreestanding", "-nostdinc", "-target", "x86_64-linux-gnu", "-isystem", include,
                 f"-I{HEADERS}"]
    unit = Index.create().parse("api.c", arguments, [("api.c", "#include <knurl/knurl.h>\n")],
                                TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
    wrong = [str(diagnostic) for diagnostic in unit.diagnostics if diagnostic.severity >= diagnostic.Warning]
    if wrong:
        sys.exit("\n".join(wrong))
    return [cursor for cursor in unit.cursor.get_children()
            if cursor.location.file and str(HEADERS) in cursor.location.file.name]


def read():
    api = {"constants": {}, "structs": {}, "opaque": [], "types": {}, "functions": {}}
    last_line, doc = 0, ""
    for cursor in sorted(parse(), key=lambda c: c.kind == CursorKind.FUNCTION_DECL):
        own = plain(cursor.raw_comment)
        if cursor.kind == CursorKind.MACRO_DEFINITION and number(cursor) is not None:
            api["constants"][cursor.spelling] = {"value": number(cursor)}
        elif cursor.kind == CursorKind.ENUM_DECL:
            for constant in cursor.get_children():
                api["constants"][constant.spelling] = {"value": constant.enum_value, **facts(plain(constant.raw_comment))}
        elif cursor.kind == CursorKind.STRUCT_DECL and cursor.is_definition():
            api["structs"][cursor.spelling] = struct(cursor, own)
        elif cursor.kind == CursorKind.STRUCT_DECL:
            api["opaque"].append(cursor.spelling)
        elif cursor.kind == CursorKind.TYPEDEF_DECL and cursor.underlying_typedef_type.get_canonical().kind != TypeKind.RECORD:
            api["types"][cursor.spelling] = {"type": spell(cursor.underlying_typedef_type), "doc": own}
        elif cursor.kind == CursorKind.FUNCTION_DECL:
            doc = own or (doc if cursor.extent.start.line == last_line + 1 else "")  # one docstring for several lines
            last_line = cursor.extent.end.line
            api["functions"][cursor.spelling] = function(cursor, doc)
    api["opaque"] = sorted(set(api["opaque"]) - api["structs"].keys())
    parts = (api["constants"][f"KNURL_VERSION_{part}"]["value"] for part in ("MAJOR", "MINOR", "PATCH"))
    return {"version": ".".join(map(str, parts)), **api}


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(read(), file, indent=1)
        file.write("\n")
