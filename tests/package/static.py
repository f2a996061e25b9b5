#!/usr/bin/python3
"""The static libraries link beside anything: they define names of their own alone, and a host with its own tinygltf, nlohmann-json
and a touch_read() links all of both.
usage: static.py SOURCE FOLDER CXX LIBKNURL LIBKNURL_GLTF
SPDX-License-Identifier: MIT"""
import os
import re
import subprocess
import sys

SOURCE, FOLDER, CXX, CORE, GLTF = sys.argv[1:]


def output(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(f"static: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def strangers(library):
    """Names that another library could define, too. The C++ library's templates are anybody's."""
    for line in output("nm", "--extern-only", "--defined-only", "--demangle", library).splitlines():
        match = re.match(r"[0-9a-f]+ (\w) (.*)", line)
        if not match:
            continue
        kind, name = match.groups()
        plain = re.sub(r"^(typeinfo name|typeinfo|vtable|VTT) for ", "", name)
        if not re.match(r"knurl(_|::)", plain) if kind not in "VWu" else re.search(r"\b(tinygltf|nlohmann)::", plain):
            yield name


os.makedirs(FOLDER, exist_ok=True)
for path in (CORE, GLTF):
    found = sorted(strangers(path))
    if found:
        sys.exit(f"static: {os.path.basename(path)}: expected names that begin with knurl, found {len(found)}: "
                 + ", ".join(found[:20]))
host = os.path.join(FOLDER, "host")
output(CXX, "-std=c++17", "-O1", "-I", os.path.join(SOURCE, "sdk/include"), os.path.join(SOURCE, "tests/package/host/host.cpp"),
       "-Wl,--whole-archive", GLTF, CORE, "-Wl,--no-whole-archive", "-lm", "-ldl", "-pthread", "-o", host)
said = output(host, os.path.join(SOURCE, "assets/plate_1d.glb"))
if said != "5 meshes, 3 surfaces, 2\n":
    sys.exit(f"static: expected 5 meshes, 3 surfaces, 2 from the host, found {said}")
print("static: both libraries define their own names alone, and a host with its own tinygltf links them")
