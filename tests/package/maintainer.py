#!/usr/bin/python3
"""packages/debian.sh writes the maintainer's name as it is, whatever its characters. dpkg-buildpackage is a stand-in that ends
the script once control and changelog are written.
usage: maintainer.py SOURCE FOLDER     SPDX-License-Identifier: MIT"""
import os
import re
import shutil
import subprocess
import sys

SOURCE, FOLDER = map(os.path.abspath, sys.argv[1:])
NAME = r"A/B & C\D, @MINOR@ 'Ltd'"

shutil.rmtree(FOLDER, ignore_errors=True)
for name in ("bin", "out", "knurl-9.8.7"):
    os.makedirs(os.path.join(FOLDER, name))
with open(os.path.join(FOLDER, "bin/dpkg-buildpackage"), "w", encoding="utf-8") as file:
    file.write("#!/bin/sh\nexit 9\n")
os.chmod(file.name, 0o755)
subprocess.run(["tar", "-C", FOLDER, "-czf", os.path.join(FOLDER, "source.tar.gz"), "knurl-9.8.7"], check=True)
done = subprocess.run([os.path.join(SOURCE, "packages/debian.sh"), os.path.join(FOLDER, "out"), os.path.join(FOLDER, "source.tar.gz"),
                       "9.8.7", os.path.join(FOLDER, "build")], check=False, capture_output=True, text=True,
                      env={**os.environ, "PATH": f"{FOLDER}/bin:{os.environ['PATH']}", "DEBFULLNAME": NAME, "DEBEMAIL": "a@b.example",
                           "SOURCE_DATE_EPOCH": "0"})
if done.returncode != 9:
    sys.exit(f"maintainer: expected the stand-in to end the script, found exit {done.returncode}: {done.stderr}")
for name, pattern in (("control", r"^Maintainer: (.*)$"), ("changelog", r"^ -- (.*)  Thu, 01 Jan 1970")):
    with open(os.path.join(FOLDER, "build/knurl-9.8.7/debian", name), encoding="utf-8") as file:
        content = file.read()
    found = re.search(pattern, content, re.M)
    if not found or found[1] != f"{NAME} <a@b.example>":
        sys.exit(f"maintainer: {name}: expected {NAME}, found {found and found[1]}")
    if name == "control" and ("Package: libknurl9.8\n" not in content or "@MAINTAINER@" in content):
        sys.exit(f"maintainer: control has names that were not filled in:\n{content}")
print("maintainer: control and changelog have it")
