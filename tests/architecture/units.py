"""Which files depend on which, read off the sources' includes and the objects' symbols. SPDX-License-Identifier: MIT

A unit is X.c and X.h together (and X_posix.c, X_windows.c). It depends on another whose header it includes, or in which
something that it calls is defined: symbols for the linker, and names in its header's inline functions and macros,
which the compiler puts into other units' objects. Units are named by their paths without an ending, from sdk/src for the
library ("contact/mesh") and from the repository elsewhere ("bindings/godot/src/device")."""
import collections
import os
import re
import subprocess

LIBRARY = "sdk/src"
PUBLIC = "sdk/include/knurl"
DECLARES = {"query": "scene"}  # public header: its module, if that has another name
FOLDERS = (LIBRARY, "bindings", "samples")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<knurl/(\w+)\.h>)', re.MULTILINE)
NO_CODE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\\\n', re.DOTALL)  # comments, strings, lines that go on
DEFINE = re.compile(r"^\s*#\s*define\s+(\w+(?:\([^)]*\))?)(.*)$", re.MULTILINE)
NAME = re.compile(r"(?<!\.)(?<!->)\b[A-Za-z_]\w*")  # of no member
OBJECT = re.compile(r"^(.*?)/?CMakeFiles/[^/]+\.dir/(.*)\.(?:o|obj)$")


def unit_of(path):
    """path: of a source or header, from the repository."""
    inside = os.path.relpath(path, LIBRARY) if path.startswith(LIBRARY + "/") else path
    return re.sub(r"(_posix|_windows)?\.(c|h|cpp|hpp)$", "", inside)


def source_of(object_path, build):
    """The source of one of CMake's objects, from the repository; None if it has none there."""
    match = OBJECT.match(os.path.relpath(object_path, build))
    return os.path.normpath(os.path.join(match[1], match[2].replace("__/", "../"))) if match else None


def named_in_header(text):
    """The names in a header's macros, function bodies and initialisers; not those in its declarations and structs."""
    text = NO_CODE.sub(" ", text)
    names = {name for _, body in DEFINE.findall(text) for name in NAME.findall(body)}
    text = re.sub(r"^\s*#.*$", "", text, flags=re.MULTILINE)
    depth, head = 0, ""  # of braces in a body; the text before the next brace outside one
    for part in re.findall(r"[^{};]+|[{};]", text):
        if depth:
            depth += {"{": 1, "}": -1}.get(part, 0)
            names.update(NAME.findall(part))
        elif part == "{" and ("(" in head or "=" in head):
            depth = 1
        head = part
    return names


class Code:
    def __init__(self, root):
        self.root = root
        self.files = sorted(self._find(FOLDERS) + self._find([PUBLIC]))  # from the repository
        self.uses = {unit_of(path): set() for path in self.files}  # unit: units
        self.headers = collections.defaultdict(set)  # file: files of FOLDERS that it includes
        self.named = {}  # header: names in its inline code
        self.public = collections.defaultdict(set)  # file: modules whose public headers it includes
        self.lines = {}  # file: how many
        self.nonblocking = set()  # units with something that may run in a tick
        self.stray = []  # (file, include) of library headers that are included from elsewhere
        for path in self.files:
            self._read(path)

    def _find(self, folders):
        found = []
        for folder in folders:
            for parent, children, names in os.walk(os.path.join(self.root, folder)):
                children[:] = [name for name in children if name not in ("third_party", "build")]
                found += [os.path.relpath(os.path.join(parent, name), self.root) for name in names
                          if re.search(r"\.(c|h|cpp|hpp)$", name)]
        return found

    def _read(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            text = file.read()
        self.lines[path] = text.count("\n")
        if "KNURL_NONBLOCKING" in text:
            self.nonblocking.add(unit_of(path))
        if path.endswith((".h", ".hpp")):
            self.named[path] = named_in_header(text)
        for quoted, public in INCLUDE.findall(text):
            if public:
                self.public[path].add(DECLARES.get(public, public))
                continue
            for folder in (os.path.dirname(path), *self._roots(path), LIBRARY):
                there = os.path.normpath(os.path.join(folder, quoted))
                if os.path.exists(os.path.join(self.root, there)):
                    self.headers[path].add(there)
                    self._depend(unit_of(path), unit_of(there))
                    if there.startswith(LIBRARY + "/") and not path.startswith(LIBRARY + "/"):
                        self.stray.append((path, quoted))
                    break

    @staticmethod
    def _roots(path):
        """Folders above a file: its includes start from one of them."""
        parent = os.path.dirname(path)
        while parent:
            parent = os.path.dirname(parent)
            yield parent

    def _depend(self, unit, other):
        if unit != other and {unit, other} <= self.uses.keys():
            self.uses[unit].add(other)

    def add_objects(self, objects, build, nm):
        """One program's or library's objects: calls from one of them, or from inline code of a header, to a definition
        in another. Inline C++ is seen if it calls C."""
        sources = {path: source for path in objects if (source := source_of(path, build))}
        units = {path: unit_of(source) for path, source in sources.items()}
        out = subprocess.run([nm, "-A", "-P", *units], capture_output=True, text=True, check=True).stdout
        defined, called = {}, []
        for line in out.splitlines():
            path, symbol, kind = re.match(r"(.*): (\S+) (\S)", line).groups()
            if kind == "U":
                called.append((units[path], symbol))
            elif kind.isupper():
                defined[symbol] = units[path]
        if not defined:
            raise SystemExit(f"architecture: {nm} finds no symbols in {len(objects)} objects")
        for unit, symbol in called:
            if symbol in defined:
                self._depend(unit, defined[symbol])
        for header in self._included(sources.values()):
            for name in self.named.get(header, set()) & defined.keys():
                self._depend(unit_of(header), defined[name])

    def _included(self, paths):
        """The headers of FOLDERS that files include, and those that these include."""
        found, left = set(), list(paths)
        while left:
            new = self.headers[left.pop()] - found
            found |= new
            left += new
        return found

    def module(self, unit):
        """The library's module of a unit; else the unit's folder."""
        return unit.split("/")[0] if os.path.isdir(os.path.join(self.root, LIBRARY, unit.split("/")[0])) \
            else os.path.dirname(unit)

    def units_of(self, module):
        return sorted(unit for unit in self.uses if self.module(unit) == module)

    def circles(self):
        """Sets of units that all depend on one another (Tarjan 1972), sorted."""
        index, low, stack, found = {}, {}, [], []

        def visit(unit):
            index[unit] = low[unit] = len(index)
            stack.append(unit)
            for other in sorted(self.uses[unit]):
                if other not in index:
                    visit(other)
                    low[unit] = min(low[unit], low[other])
                elif other in stack:
                    low[unit] = min(low[unit], index[other])
            if low[unit] == index[unit]:
                at = stack.index(unit)
                if len(stack) - at > 1:
                    found.append(sorted(stack[at:]))
                del stack[at:]

        for unit in sorted(self.uses):
            if unit not in index:
                visit(unit)
        return sorted(found)
