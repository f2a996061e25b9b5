#!/usr/bin/env python3
"""Writes the C# side of Knurl's C interface from the headers themselves, as libclang reads them.

Reads sdk/include/knurl/, bindings/common/session.h and knurl_unity.h beside this file; writes NativeMethods.g.cs (the
C# declarations), layout.g.h (the offset of each field in C#) and exports.g.def (the plugin's exports). With --check it
writes nothing and fails if the files are out of date.

Declarations without an exact equivalent in C#, on Linux and on Windows, are errors with file and line.
Needs the package in requirements.txt and a C compiler's stddef.h and stdint.h.
"""
import argparse
import difflib
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import textwrap

from clang.cindex import Cursor, CursorKind, Index, TranslationUnit, TypeKind

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
HEADERS = [ROOT / "sdk/include/knurl", ROOT / "bindings/common", HERE]
INCLUDED_FROM = [ROOT / "sdk/include", *HEADERS[1:]]
ENTRY = "#include <knurl/knurl.h>\n#include <session.h>\n#include <knurl_unity.h>\n"
TARGETS = ["x86_64-linux-gnu", "x86_64-w64-windows-gnu"]
OUTPUTS = {
    "cs": ROOT / "bindings/unity/package/Runtime/NativeMethods.g.cs",
    "layout": HERE / "layout.g.h",
    "exports": HERE / "exports.g.def",
}
NOTE = "Generated from Knurl's headers by bindings/unity/native/mirror.py, which makes it anew; do not edit."
WIDTH = 120
DIFFERENCES = 16  # lines of a difference that are printed

NAMED = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "size_t": "UIntPtr"}
BUILT_IN = {
    TypeKind.INT: "int",
    TypeKind.UINT: "uint",
    TypeKind.FLOAT: "float",
    TypeKind.DOUBLE: "double",
    TypeKind.CHAR_S: "byte",
    TypeKind.VOID: "void",
}
SIZES = {"int": 4, "uint": 4, "long": 8, "ulong": 8, "float": 4, "double": 8, "byte": 1, "IntPtr": 8, "UIntPtr": 8}
FUNCTIONS = (TypeKind.FUNCTIONPROTO, TypeKind.FUNCTIONNOPROTO)
KEYWORDS = set(
    "abstract as base bool break byte case catch char checked class const continue decimal default delegate do double "
    "else enum event explicit extern false finally fixed float for foreach goto if implicit in int interface internal "
    "is lock long namespace new null object operator out override params private protected public readonly ref return "
    "sbyte sealed short sizeof stackalloc static string struct switch this throw true try typeof uint ulong unchecked "
    "unsafe ushort using virtual void volatile while".split()
)
SESSION = "knurl_session*"
IMPORT = "[DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]"
TOGETHER = "\N{NO-BREAK SPACE}"


class Refused(Exception):
    """A construct that cannot be mirrored."""


def refuse(cursor, why):
    place = cursor.location
    raise Refused(f"{os.path.relpath(place.file.name, ROOT)}:{place.line}: {cursor.spelling or 'this'}: {why}")


def name(text):
    return "@" + text if text in KEYWORDS else text


def spell(cursor, kind):
    """The C# name of a C type."""
    if kind.kind == TypeKind.TYPEDEF and kind.get_declaration().spelling in NAMED:
        return NAMED[kind.get_declaration().spelling]
    if kind.kind == TypeKind.TYPEDEF:
        return spell(cursor, kind.get_declaration().underlying_typedef_type)
    if kind.kind == TypeKind.ELABORATED:
        return spell(cursor, kind.get_named_type())
    if kind.kind == TypeKind.RECORD:
        return kind.get_declaration().spelling
    if kind.kind in (TypeKind.CONSTANTARRAY, TypeKind.INCOMPLETEARRAY):  # of a parameter: a pointer
        return spell(cursor, kind.element_type) + "*"
    if kind.kind == TypeKind.POINTER:
        pointee = kind.get_pointee()
        if pointee.get_canonical().kind in (TypeKind.VOID, *FUNCTIONS):
            return "IntPtr"
        return spell(cursor, pointee) + "*"
    if kind.kind in BUILT_IN:
        return BUILT_IN[kind.kind]
    refuse(cursor, f"the type '{kind.spelling}' has no C# type that is the same on every system")


def by_value(cursor, kind):
    """The C# name of a parameter's or result's type."""
    if kind.get_canonical().kind == TypeKind.RECORD:
        refuse(cursor, f"'{kind.spelling}' goes by value, which compilers do differently")
    return spell(cursor, kind)


def is_function_pointer(kind):
    kind = kind.get_canonical()
    return kind.kind == TypeKind.POINTER and kind.get_pointee().kind in FUNCTIONS


def wrapped(text, indent):
    text = textwrap.fill(text, WIDTH, initial_indent=indent, subsequent_indent=indent + "    ",
                         break_long_words=False, break_on_hyphens=False)
    return text.replace(TOGETHER, " ")


class Mirror:
    """All declarations of the headers, as C# text."""

    def __init__(self, target):
        self.constants, self.structs, self.opaque, self.delegates, self.functions = {}, {}, [], [], {}
        arguments = ["-xc", "-std=c99", "-ffreestanding", "-nostdinc", "-target", target,
                     "-isystem", compiler_headers(), *(f"-I{folder}" for folder in INCLUDED_FROM)]
        unit = Index.create().parse("mirror.c", arguments, [("mirror.c", ENTRY)],
                                    TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        wrong = [str(diagnostic) for diagnostic in unit.diagnostics if diagnostic.severity >= diagnostic.Warning]
        if wrong:
            raise Refused("\n".join(wrong))
        folders = {str(folder) for folder in HEADERS}
        for cursor in unit.cursor.get_children():
            place = cursor.location.file
            if place and os.path.dirname(place.name) in folders:
                self.take(cursor)
        for opaque in list(self.opaque):
            if opaque in self.structs:
                self.opaque.remove(opaque)

    def take(self, cursor):
        takers = {
            CursorKind.MACRO_DEFINITION: self.take_macro,
            CursorKind.ENUM_DECL: self.take_enum,
            CursorKind.STRUCT_DECL: self.take_struct,
            CursorKind.TYPEDEF_DECL: self.take_typedef,
            CursorKind.FUNCTION_DECL: self.take_function,
        }
        if cursor.kind in takers:
            takers[cursor.kind](cursor)
        elif cursor.kind not in (CursorKind.MACRO_INSTANTIATION, CursorKind.INCLUSION_DIRECTIVE):
            refuse(cursor, f"a {cursor.kind.name.lower().replace('_', ' ')} cannot be mirrored")

    def take_macro(self, cursor):
        tokens = [token.spelling for token in cursor.get_tokens()][1:]
        if not tokens or is_function_like(cursor) or tokens[0] in ("__attribute__", "__declspec"):
            return
        text = "".join(token for token in tokens if token not in "()")
        if re.fullmatch(r"-?(0|[1-9][0-9]*)", text):
            self.take_constant(cursor, int(text))
        elif re.fullmatch(r"-?[0-9]+\.[0-9]+(e-?[0-9]+)?", text):
            self.constants[cursor.spelling] = ("double", float(text))
        else:
            refuse(cursor, f"the macro is '{' '.join(tokens)}', and only plain numbers are mirrored")

    def take_constant(self, cursor, value):
        if not -(2**31) <= value < 2**31:
            refuse(cursor, f"{value} is not an int")
        self.constants[cursor.spelling] = ("int", value)

    def take_enum(self, cursor):
        if not cursor.is_anonymous():
            refuse(cursor, "an enum's size is the compiler's: constants belong into an unnamed one")
        for constant in cursor.get_children():
            self.take_constant(constant, constant.enum_value)

    def take_typedef(self, cursor):
        kind = cursor.underlying_typedef_type
        if is_function_pointer(kind):
            self.take_callback(cursor, cursor.spelling, kind)
        elif kind.get_canonical().kind == TypeKind.RECORD and spell(cursor, kind) != cursor.spelling:
            refuse(cursor, f"a second name for '{kind.spelling}'")
        else:
            spell(cursor, kind)

    def take_callback(self, cursor, called, kind):
        kind = kind.get_pointee()
        if kind.kind != TypeKind.FUNCTIONPROTO or kind.is_function_variadic():
            refuse(cursor, "a callback without a prototype of its own")
        self.delegates.append(f"{by_value(cursor, kind.get_result())} {called}({parameters(cursor, kind)})")

    def take_struct(self, cursor):
        if not cursor.is_definition():
            if cursor.spelling not in self.opaque:
                self.opaque.append(cursor.spelling)
            return
        if cursor.is_anonymous() or not cursor.spelling:
            refuse(cursor, "a struct without a name")
        rows, end, align = [], 0, 1
        for field in cursor.get_children():
            if field.kind.is_attribute():
                continue  # its effect on the layout is checked below
            if field.kind != CursorKind.FIELD_DECL or field.is_bitfield():
                refuse(field, "only plain fields can be mirrored")
            if is_function_pointer(field.type) and field.type.kind == TypeKind.POINTER:
                self.take_callback(field, f"{cursor.spelling}_{field.spelling}", field.type)
            for row in self.field_rows(field):
                end = -(-end // row["align"]) * row["align"]
                row["offset"] = end
                end += row["size"]
                align = max(align, row["align"])
                rows.append(row)
            first = next(row for row in rows if row["of"] == field.spelling)
            if first["offset"] * 8 != cursor.type.get_offset(field.spelling):
                refuse(field, "C lays it out elsewhere than C# does")
        size = -(-end // align) * align
        if size != cursor.type.get_size() or align != cursor.type.get_align():
            refuse(cursor, f"C gives it {cursor.type.get_size()} bytes, C# {size}, or another alignment")
        self.structs[cursor.spelling] = {"size": size, "align": align, "rows": rows}

    def field_rows(self, field):
        """A field in C#: one row, or one per element for an array of structs."""
        kind, count = field.type, 1
        while kind.get_canonical().kind == TypeKind.CONSTANTARRAY:
            kind = kind.get_canonical() if kind.kind != TypeKind.CONSTANTARRAY else kind
            count *= kind.element_count
            kind = kind.element_type
        is_array = field.type.get_canonical().kind == TypeKind.CONSTANTARRAY
        if kind.get_canonical().kind == TypeKind.INCOMPLETEARRAY:
            refuse(field, "an array without a length")
        text = spell(field, kind)
        if text in self.structs:
            size, align = self.structs[text]["size"], self.structs[text]["align"]
        else:
            size = align = 8 if text.endswith("*") else SIZES[text] if text in SIZES else refuse(field, f"a '{text}'")
        row = {"of": field.spelling, "c": field.spelling, "name": field.spelling, "type": text, "count": 0,
               "size": size, "align": align}
        if not is_array:
            return [row]
        if text in SIZES and text not in ("IntPtr", "UIntPtr"):
            return [{**row, "count": count, "size": size * count}]
        if field.type.get_canonical().element_type.kind == TypeKind.CONSTANTARRAY:
            refuse(field, f"an array of arrays of '{text}'")
        return [{**row, "c": f"{row['c']}[{at}]", "name": f"{row['name']}_{at}"} for at in range(count)]

    def take_function(self, cursor):
        if cursor.is_definition():
            refuse(cursor, "a function with a body is not the library's")
        if cursor.type.kind != TypeKind.FUNCTIONPROTO:
            refuse(cursor, "a function without a prototype")
        if cursor.type.is_function_variadic():
            return  # C# cannot call it
        values = parameters(cursor, cursor.type)
        if cursor.spelling == "knurl_session_destroy":
            values = values.replace(SESSION, "IntPtr")
        elif cursor.spelling == "knurl_session_create":
            values = values.replace(SESSION + "*", "IntPtr*")
        else:
            values = values.replace(SESSION, "SessionHandle")
        self.functions[cursor.spelling] = f"{by_value(cursor, cursor.result_type)} {cursor.spelling}({values})"


def is_function_like(cursor):
    first, second = list(cursor.get_tokens())[:2]
    return second.spelling == "(" and second.extent.start.offset == first.extent.end.offset


def parameters(cursor, kind):
    values = [child for child in cursor.get_children() if child.kind == CursorKind.PARM_DECL]
    if len(values) != len(list(kind.argument_types())):
        refuse(cursor, "its parameters could not be told")
    for value in values:
        if not value.spelling:
            refuse(cursor, "a parameter without a name")
    return ", ".join(f"{by_value(value, value.type)}{TOGETHER}{name(value.spelling)}" for value in values)


def compiler_headers():
    found = subprocess.run(["cc", "-print-file-name=include"], capture_output=True, text=True, check=True)
    return found.stdout.strip()


def version(mirror):
    return ".".join(str(mirror.constants[f"KNURL_VERSION_{part}"][1]) for part in ("MAJOR", "MINOR", "PATCH"))


def struct_lines(called, struct):
    yield "    [StructLayout(LayoutKind.Sequential)]"
    yield f"    internal unsafe struct {called}"
    yield "    {"
    for row in struct["rows"]:
        if row["count"]:
            yield f"        public fixed {row['type']} {name(row['name'])}[{row['count']}];"
        else:
            yield f"        public {row['type']} {name(row['name'])};"
    yield "    }"
    yield ""


def cs_body(mirror):
    """The C# declarations, from which the interface's hash is computed."""
    types = []
    for opaque in mirror.opaque:
        types += [f"    internal struct {opaque} {{ }}", ""]
    for called, struct in mirror.structs.items():
        types += struct_lines(called, struct)
    for delegate in mirror.delegates:
        types += ["    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
                  wrapped(f"internal unsafe delegate {delegate};", "    "), ""]
    members = []
    for called, (kind, value) in mirror.constants.items():
        members.append(f"        internal const {kind} {called} = {value!r};")
    for function in mirror.functions.values():
        members += ["", f"        {IMPORT}", wrapped(f"internal static extern {function};", "        ")]
    return "\n".join(types), "\n".join(members)


def cs_sizes(mirror):
    """The size of each struct by its name, without reflection, which ahead-of-time compilers partly remove."""
    return "\n".join(f'                case "{called}": return sizeof({called});' for called in mirror.structs)


def cs_file(mirror, digits):
    types, members = cs_body(mirror)
    return f"""// {NOTE}
// Names are C's, so that they can be searched for; the headers document them.
#pragma warning disable 0649 // fields that only C fills in
using System;
using System.Runtime.InteropServices;

namespace Knurl
{{
{types}
    internal static unsafe class NativeMethods
    {{
        internal const string Library = "knurl_unity";

        /// <summary>The result of knurl_unity_interface() of the library that this file was generated for.</summary>
        internal const string Interface = "{digits}";

        internal const string Version = "{version(mirror)}";

        /// <summary>The bytes of the struct of that name in C#; 0 if there is none.</summary>
        internal static int SizeOf(string type)
        {{
            switch (type)
            {{
{cs_sizes(mirror)}
                default: return 0;
            }}
        }}

{members}
    }}
}}
"""


def layout_file(mirror, digits):
    lines = []
    for called, struct in mirror.structs.items():
        lines.append(f"STRUCT({called}, {struct['size']})")
        for row in struct["rows"]:
            lines.append(f"FIELD({called}, {row['c']}, \"{row['name']}\", {row['offset']}, {row['size']})")
    rows = " \\\n    ".join(lines)
    return f"""/* {NOTE}
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_UNITY_LAYOUT_H
#define KNURL_UNITY_LAYOUT_H
/* clang-format off */

#define KNURL_UNITY_INTERFACE "{digits}"

/** The mirrored structs, as C# lays them out: STRUCT(type, bytes), FIELD(type, field, name in C#, offset, bytes). */
#define KNURL_UNITY_LAYOUT(STRUCT, FIELD) \\
    {rows}

#endif
"""


def exports_file(mirror):
    names = ["UnityPluginLoad", "UnityPluginUnload", *mirror.functions]
    return f"; {NOTE}\nEXPORTS\n" + "".join(f"    {exported}\n" for exported in names)


def generate():
    mirrors = [Mirror(target) for target in TARGETS]
    texts = ["\n".join(cs_body(mirror)) for mirror in mirrors]
    if texts[0] != texts[1]:
        raise Refused("the headers differ by target:\n" + differences(texts[0], texts[1]))
    digits = hashlib.sha256(texts[0].encode()).hexdigest()[:16]
    return {"cs": cs_file(mirrors[0], digits), "layout": layout_file(mirrors[0], digits),
            "exports": exports_file(mirrors[0])}


def differences(found, expected):
    """The first lines in which two texts differ."""
    lines = difflib.unified_diff(found.splitlines(), expected.splitlines(), "found", "expected", "", "", 0, "")
    return "\n".join(f"  {line}" for line in list(lines)[:DIFFERENCES])


def check(texts):
    wrong = 0
    for key, path in OUTPUTS.items():
        found = path.read_text() if path.exists() else ""
        if found != texts[key]:
            wrong = 1
            print(f"mirror.py: {path.relative_to(ROOT)} is not what the headers say:", file=sys.stderr)
            print(differences(found, texts[key]), file=sys.stderr)
    if wrong:
        print("mirror.py: `./run mirror` makes them anew; commit what it writes", file=sys.stderr)
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where the files are out of date")
    arguments = parser.parse_args()
    try:
        texts = generate()
    except Refused as refused:
        print(f"mirror.py: {refused}", file=sys.stderr)
        return 1
    if arguments.check:
        return check(texts)
    for key, path in OUTPUTS.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(texts[key])
    return 0


if __name__ == "__main__":
    sys.exit(main())
