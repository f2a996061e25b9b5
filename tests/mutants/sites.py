"""Finds possible changes of C and C++ sources, with libclang. SPDX-License-Identifier: MIT"""

import pathlib
import re
import subprocess
from dataclasses import dataclass

from clang.cindex import CursorKind as K, Index, StorageClass, TypeKind as T

RELATIONS = {"<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",)}
OTHERS = {
    "+": ("-",),
    "-": ("+",),
    "*": ("/",),
    "/": ("*",),
    "%": ("*",),
    "&": ("|",),
    "|": ("&",),
    "^": ("&",),
    "<<": (">>",),
    ">>": ("<<",),
    "+=": ("-=",),
    "-=": ("+=",),
    "*=": ("/=",),
    "/=": ("*=",),
    "|=": ("&=",),
    "&=": ("|=",),
    "<<=": (">>=",),
    ">>=": ("<<=",),
}
NAMES = {"fmin": "fmax", "fmax": "fmin", "std::min": "std::max", "std::max": "std::min"}
FLOATS = (T.DOUBLE, T.FLOAT)
INTEGERS = (T.INT, T.UINT, T.LONG, T.ULONG, T.LONGLONG, T.ULONGLONG, T.SHORT, T.USHORT, T.UCHAR, T.SCHAR, T.CHAR_S)
FUNCTIONS = (K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR, K.FUNCTION_TEMPLATE, K.CONVERSION_FUNCTION)
CONSTANT = (K.CXX_UNARY_EXPR, K.ENUM_DECL, K.STRUCT_DECL, K.CLASS_DECL, K.TYPE_REF, K.STATIC_ASSERT, K.TEMPLATE_REF)
BRANCHES = (K.IF_STMT, K.FOR_STMT, K.WHILE_STMT, K.DO_STMT)
LITERALS = (K.INTEGER_LITERAL, K.FLOATING_LITERAL)


@dataclass(frozen=True)
class Change:
    """Text that may take the place of file[begin:end]. A statement is left out instead, and `after` is empty."""

    file: str
    function: str
    line: int
    begin: int
    end: int
    kind: str
    before: str
    after: str

    def key(self):
        return f"{self.file} | {self.function} | {self.before} -> {self.after or 'left out'}"


class Finder:
    """Collects the changes of one file after the other, those of a header once."""

    def __init__(self, root, folders):
        self.root, self.folders, self.changes, self.texts = root, folders, {}, {}
        found = subprocess.run(["cc", "-print-file-name=include"], capture_output=True, text=True, check=True)
        self.headers = ["-ferror-limit=0", "-isystem", found.stdout.strip()]

    def read(self, source, options):
        unit = Index.create().parse(str(source), [*self.headers, *options])
        errors = [
            str(found)
            for found in unit.diagnostics
            if found.severity >= 4 or (found.severity == 3 and str(self.root) in str(found.location.file))
        ]
        if errors:
            raise SystemExit(f"mutants: {source} could not be read: {errors[0]}")
        self.declarations(unit.cursor)

    def text(self, file):
        if file not in self.texts:
            self.texts[file] = (self.root / file).read_bytes()
        return self.texts[file]

    def declarations(self, cursor):
        for child in cursor.get_children():
            file = child.location.file
            if file is None:
                continue
            path = pathlib.Path(file.name).resolve()
            if self.root not in path.parents or path.relative_to(self.root).parent.as_posix() not in self.folders:
                continue
            if child.kind in FUNCTIONS and child.is_definition() and not self.is_constant(child):
                self.file, self.function = path.relative_to(self.root).as_posix(), child.spelling
                for part in child.get_children():
                    if part.kind == K.COMPOUND_STMT:
                        self.statement(part)
            elif child.kind in (K.NAMESPACE, K.LINKAGE_SPEC, K.UNEXPOSED_DECL, K.CLASS_DECL, K.STRUCT_DECL):
                self.declarations(child)

    def is_constant(self, cursor):
        return b"constexpr" in self.span(cursor, cursor, cursor.location.file.name)[:40]

    def span(self, first, last, file=None):
        name = file or first.extent.start.file.name
        text = self.text(pathlib.Path(name).resolve().relative_to(self.root).as_posix())
        return text[first.extent.start.offset : last.extent.end.offset]

    def add(self, begin, end, kind, after):
        before = self.text(self.file)[begin:end].decode()
        line = self.text(self.file).count(b"\n", 0, begin) + 1
        change = Change(
            self.file, self.function, line, begin, end, kind, " ".join(before.split()), " ".join(after.split())
        )
        if change.before != change.after and all(before.count(a) == before.count(b) for a, b in ("()", "[]", "{}")):
            self.changes[(self.file, begin, end, change.after)] = change

    def replace(self, cursor, kind, *texts):
        for text in texts:
            self.add(cursor.extent.start.offset, cursor.extent.end.offset, kind, text)

    def source(self, cursor):
        return self.text(self.file)[cursor.extent.start.offset : cursor.extent.end.offset].decode()

    def statement(self, cursor):
        children = list(cursor.get_children())
        for i, child in enumerate(children):
            alone = cursor.kind == K.COMPOUND_STMT or (cursor.kind in BRANCHES and self.is_body(cursor, children, i))
            if alone and (child.kind in (K.CALL_EXPR, K.COMPOUND_ASSIGNMENT_OPERATOR) or self.assigns(child)):
                end = child.extent.end.offset
                if self.text(self.file)[end : end + 1] == b";":
                    self.add(child.extent.start.offset, end + 1, "statement", "")
            self.visit(child, cursor, i)

    @staticmethod
    def is_body(cursor, children, i):
        if cursor.kind == K.IF_STMT:
            return i > 0
        return i == (0 if cursor.kind == K.DO_STMT else len(children) - 1)

    def assigns(self, cursor):
        return cursor.kind == K.BINARY_OPERATOR and self.operator(cursor) == "="

    def operator(self, cursor):
        left, right = cursor.get_children()
        between = self.text(self.file)[left.extent.end.offset : right.extent.start.offset].decode().strip()
        return between if re.fullmatch(r"[-+*/%&|^<>=!]+", between) else None

    def visit(self, cursor, parent, place):
        kind = cursor.kind
        if (
            kind in CONSTANT
            or (parent.kind == K.CASE_STMT and place == 0)
            or (
                parent.kind == K.CSTYLE_CAST_EXPR
                and kind in LITERALS
                and place == 0
                and len(list(parent.get_children())) > 1
            )
        ):
            return  # the sizes in a type are literals too
        if kind == K.VAR_DECL:
            if cursor.storage_class != StorageClass.STATIC and b"constexpr" not in self.span(cursor, cursor):
                start = self.source(cursor).find("=")
                for i, child in enumerate(cursor.get_children()):
                    if start >= 0 and child.extent.start.offset > cursor.extent.start.offset + start:
                        self.visit(child, cursor, i)
            return
        self.expression(cursor, parent, place)
        self.statement(cursor)

    def expression(self, cursor, parent, place):
        kind, children = cursor.kind, list(cursor.get_children())
        if kind in (K.BINARY_OPERATOR, K.COMPOUND_ASSIGNMENT_OPERATOR) and len(children) == 2:
            self.binary(cursor, parent, *children)
        elif kind == K.UNARY_OPERATOR and re.match(r"-[^-]|!", self.source(cursor)):
            self.replace(cursor, "sign" if self.source(cursor)[0] == "-" else "logic", self.source(children[0]))
        elif kind in LITERALS and parent.kind != K.UNARY_OPERATOR:
            self.literal(cursor, parent, place)
        elif kind == K.CONDITIONAL_OPERATOR and "?" in self.source(cursor) and cursor.type.kind != T.VOID:
            condition, yes, no = (self.source(child) for child in children)
            self.replace(cursor, "choice", f"{condition} ? {no} : {yes}")
        elif kind == K.CALL_EXPR and cursor.spelling in ("fmin", "fmax", "min", "max"):
            for name, other in NAMES.items():
                if self.source(cursor).startswith(name + "("):
                    self.replace(cursor, "choice", other + self.source(cursor)[len(name) :])
        elif kind == K.RETURN_STMT and children:
            self.returned(children[0])
        if (
            kind in (K.IF_STMT, K.WHILE_STMT)
            and children
            and children[0].kind not in (K.BINARY_OPERATOR, K.DECL_STMT, K.VAR_DECL)
        ):
            self.replace(children[0], "condition", f"!({self.source(children[0])})")

    def binary(self, cursor, parent, left, right):
        operator = self.operator(cursor)
        a, b = self.source(left), self.source(right)
        if operator in ("&&", "||"):
            self.replace(cursor, "logic", f"{a} {'||' if operator == '&&' else '&&'} {b}", a, b)
        elif operator in RELATIONS:
            others = RELATIONS[operator]
            if parent.kind == K.CONDITIONAL_OPERATOR and {a, b} == {
                self.source(c) for c in list(parent.get_children())[1:]
            }:
                others = others[1:]  # a minimum or maximum: which of two equal ones is taken makes no difference
            self.replace(cursor, "relation", *(f"{a} {other} {b}" for other in others))
        elif operator in OTHERS and right.type.get_canonical().kind != T.POINTER:
            self.replace(cursor, "arithmetic", *(f"{a} {other} {b}" for other in OTHERS[operator]))
        elif (
            operator == "="
            and right.kind not in (*LITERALS, K.BINARY_OPERATOR)
            and cursor.type.get_canonical().kind in FLOATS
        ):
            self.replace(right, "sign", f"-({b})")

    def literal(self, cursor, parent, place):
        text, kind = self.source(cursor), cursor.type.get_canonical().kind
        value = re.fullmatch(r"([0-9.]+)([uUlLfF]*)", text)
        if text == "NULL" or text.startswith("__ATOMIC") or not re.fullmatch(r"[\w.]+(e[-+]?\d+)?", text):
            return
        if cursor.kind == K.FLOATING_LITERAL:
            texts = ("1.0",) if value and float(value[1]) == 0.0 else (f"2.0 * {text}", f"0.5 * {text}")
        elif kind not in INTEGERS:
            return
        elif not value:
            texts = (f"2 * {text}", f"{text} - 1") if re.fullmatch(r"\w+", text) and not text.startswith("0") else ()
        elif int(value[1], 0 if value[1] == "0" else 10) == 0:
            texts = ("1" + value[2],)
        else:
            texts = (f"{int(value[1]) - 1}{value[2]}",)
            if value[1] != "1" and not (parent.kind == K.ARRAY_SUBSCRIPT_EXPR and place == 1):
                texts += (f"{int(value[1]) * 2}{value[2]}",)
        self.replace(cursor, "constant", *texts)

    def returned(self, value):
        kind = value.type.get_canonical().kind
        if value.kind in LITERALS or self.source(value) == "KNURL_OK":  # which is 0
            return
        if kind in FLOATS:
            self.replace(value, "return", f"-({self.source(value)})", "0.0")
        elif kind in INTEGERS or kind == T.POINTER:
            self.replace(value, "return", "0")
        elif kind == T.BOOL and value.kind != K.CXX_BOOL_LITERAL_EXPR:
            self.replace(value, "return", f"!({self.source(value)})")
        elif kind == T.BOOL:
            self.replace(value, "return", "false" if self.source(value) == "true" else "true")
