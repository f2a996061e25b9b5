"""Which files depend on which, read off the sources' includes and the objects' symbols. SPDX-License-Identifier: MIT

A unit is X.c and X.h together (and X_posix.c, X_windows.c). It depends on another whose header it includes, or in which
something that it calls is defined: what the linker would look for. Units are named by their paths without an ending,
from sdk/src for the library ("contact/mesh") and from the repository elsewhere ("bindings/godot/src/device")."""
import collections
import os
import re
import subprocess

LIBRARY = "sdk/src"
PUBLIC = "sdk/include/knurl"
FOLDERS = (LIBRARY, "bindings", "samples")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<knurl/(\w+)\.h>)', re.MULTILINE)
OBJECT = re.compile(r"^(.*?)/?CMakeFiles/[^/]+\.dir/(.*)\.(?:o|obj)$")


def unit_of(path):
    """path: of a source or header, from the repository."""
    inside = os.path.relpath(path, LIBRARY) if path.startswith(LIBRARY + "/") else path
    return re.sub(r"(_posix|_windows)?\.(c|h|cpp|hpp)$", "", inside)


def source_of(object_path, build):
    """The source of one of CMake's objects, from the repository; None for what has none there."""
    match = OBJECT.match(os.path.relpath(object_path, build))
    return os.path.normpath(os.path.join(match[1], match[2].replace("__/", "../"))) if match else None


class Code:
    def __init__(self, root):
        self.root = root
        self.files = sorted(self._find(FOLDERS) + self._find([PUBLIC]))  # from the repository
        self.uses = {unit_of(path): set() for path in self.files}  # unit: units
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
        for quoted, public in INCLUDE.findall(text):
            if public:
                self.public[path].add(public)
                continue
            for folder in (os.path.dirname(path), *self._roots(path), LIBRARY):
                there = os.path.normpath(os.path.join(folder, quoted))
                if os.path.exists(os.path.join(self.root, there)):
                    self._depend(unit_of(path), unit_of(there))
                    if there.startswith(LIBRARY + "/") and not path.startswith(LIBRARY + "/"):
                        self.stray.append((path, quoted))
                    break

    @staticmethod
    def _roots(path):
        """Folders above a file: one of them is what its includes start from."""
        parent = os.path.dirname(path)
        while parent:
            parent = os.path.dirname(parent)
            yield parent

    def _depend(self, unit, other):
        if unit != other and {unit, other} <= self.uses.keys():
            self.uses[unit].add(other)

    def add_objects(self, objects, build, nm):
        """One program's or library's objects: what one of them calls and another defines."""
        units = {path: unit_of(source) for path in objects if (source := source_of(path, build))}
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
