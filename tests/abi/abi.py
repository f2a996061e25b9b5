#!/usr/bin/python3
"""Checks binary compatibility: compares functions, constants and the layout of structs with the record of a release.
Structs that begin with struct_size may grow at their end, others may use their reserved fields; additions are free
until a release records them.
usage: abi.py SOURCE RECORD LIBRARY...           LIBRARY: static ones, or shared ones
       abi.py --write SOURCE RECORD LIBRARY...   makes the record of a release
SPDX-License-Identifier: MIT"""
import os
import re
import subprocess
import sys

# Versions change; so may numbers that were tuned, which have a decimal point.
FREE = re.compile(r"KNURL_VERSION_\w+ = |\w+ = -?\d+\.")


def read(*parts):
    with open(os.path.join(*parts), encoding="utf-8") as file:
        return file.read()


def functions(libraries):
    """Those that can be called from outside of a library; of static ones, those that shared ones would show."""
    for library in libraries:
        options = ["--dyn-syms"] if ".so" in library else ["--syms"]
        table = subprocess.run(["readelf", "--wide", *options, library], check=True, capture_output=True, text=True).stdout
        yield from re.findall(r" FUNC +GLOBAL DEFAULT +\d+ (knurl_\w+)", table)


def lines(source, libraries):
    """The interface, a line each, as the compiler sees it: the mirror for C# is held against that by other tests."""
    layout = read(source, "bindings/unity/native/layout.g.h")
    known = set(re.findall(r"\b(knurl_\w+)\b", " ".join(
        read(source, "sdk/include/knurl", name) for name in os.listdir(os.path.join(source, "sdk/include/knurl")))))
    found = [f"function {name}" for name in functions(libraries)]
    for kind, name, rest in re.findall(r"(STRUCT|FIELD)\((\w+), (.*)\)", layout):
        if name not in known: # the sessions', which no library exports
            continue
        words = [word.strip(' "') for word in rest.split(",")]
        if kind == "STRUCT":
            found.append(f"struct {name} {words[0]}")
        elif words[0] != "reserved": # which shrinks as later versions use it
            found.append(f"field {name}.{words[0]} at {words[-2]} of {words[-1]}")
    for name, value in re.findall(r"const \w+ (KNURL_\w+) = ([^;]+);",
                                  read(source, "bindings/unity/package/Runtime/NativeMethods.g.cs")):
        if "KNURL_SESSION_" not in name and not FREE.match(f"{name} = {value}"):
            found.append(f"constant {name} = {value}")
    return sorted(set(found))


def faults(record, now):
    growing = {re.match(r"field (\w+)\.struct_size at 0 ", line).group(1) for line in now
               if ".struct_size at 0 " in line}
    sizes = {line.split()[1]: int(line.split()[2]) for line in now if line.startswith("struct ")}
    for line in record:
        kind, name = line.split()[:2]
        if kind == "struct" and name in growing and sizes[name] >= int(line.split()[2]):
            continue
        if line not in now:
            key = f"{kind} {name} "
            yield f"recorded: {line}; now: {next((other for other in now if other.startswith(key)), 'nothing')}"


def main():
    arguments = sys.argv[1:]
    write = arguments[:1] == ["--write"]
    source, path, *libraries = arguments[1:] if write else arguments
    now = lines(source, libraries)
    if write:
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(now) + "\n")
        return 0
    record = read(path).splitlines()
    found = list(faults(record, set(now)))
    print("\n".join(found) or f"abi: {len(record)} recorded lines hold, {len(set(now) - set(record))} are new since")
    return 1 if found or not record else 0


if __name__ == "__main__":
    sys.exit(main())
