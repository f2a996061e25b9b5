#!/usr/bin/python3
"""The list of contents of a release (packages/sbom.py) names each file and each library of others, with valid ids.
usage: contents.py SOURCE FOLDER     SPDX-License-Identifier: MIT"""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

SOURCE, FOLDER = sys.argv[1:]
FILES = {"knurl_0.3.0-1_amd64.deb": b"a", "knurl-0.3.0+x.tar.gz": b"b"}


def expect(what, found, expected):
    if found != expected:
        sys.exit(f"contents: {what}: expected {expected}, found {found}")


shutil.rmtree(FOLDER, ignore_errors=True)
os.makedirs(os.path.join(FOLDER, "files"))
for name, data in FILES.items():
    with open(os.path.join(FOLDER, "files", name), "wb") as file:
        file.write(data)
out = os.path.join(FOLDER, "out.json")
subprocess.run([sys.executable, "-B", os.path.join(SOURCE, "packages/sbom.py"), os.path.join(FOLDER, "files"), "0.3.0", out],
               check=True, env={**os.environ, "SOURCE_DATE_EPOCH": "0"})
with open(out, encoding="utf-8") as file:
    told = json.load(file)
with open(os.path.join(SOURCE, "bindings/godot/addons/knurl/THIRD_PARTY.md"), encoding="utf-8") as file:
    rows = re.findall(r"^\| (.*?)(?:,? \d[\d.]*)? \| .* \|$", file.read().replace("`", ""), re.M)[1:]

elements = [*told["packages"], *told["files"]]
ids = [element["SPDXID"] for element in elements]
expect("invalid ids", [each for each in ids if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", each)], [])
expect("ids twice", len(ids) - len(set(ids)), 0)
expect("unknown ids", {relation["relatedSpdxElement"] for relation in told["relationships"]} - set(ids), set())
expect("files", {each["fileName"][2:]: each["checksums"][1]["checksumValue"] for each in told["files"]},
       {name: hashlib.sha256(data).hexdigest() for name, data in FILES.items()})
expect("packages", [each["name"] for each in told["packages"]], ["knurl", *rows, "KissFFT", "libusb", "hidapi"])
expect("date", told["creationInfo"]["created"], "1970-01-01T00:00:00Z")
print(f"contents: {len(told['packages'])} packages, {len(told['files'])} files")
