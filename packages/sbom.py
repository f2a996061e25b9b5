#!/usr/bin/python3
"""Writes the list of contents (SBOM, SPDX 2.3) of a release: each file with its checksums, and the libraries of others that are
compiled into or packed with them, from THIRD_PARTY.md.
usage: sbom.py FOLDER VERSION OUT.spdx.json     Environment: SOURCE_DATE_EPOCH     SPDX-License-Identifier: MIT"""
import hashlib
import json
import os
import pathlib
import re
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
THIRD_PARTY = ROOT / "bindings/godot/addons/knurl/THIRD_PARTY.md"
LICENCES = {"MIT": "MIT", "as below": "Zlib"}
# Packed with the archives for Linux and Windows, as separate libraries.
BESIDE = [("KissFFT", "BSD-3-Clause"), ("libusb", "LGPL-2.1-or-later"), ("hidapi", "BSD-3-Clause")]


def package(name, version, licence, copyright_text):
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": version or "NOASSERTION",
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": licence, "licenseDeclared": licence,
            "copyrightText": copyright_text}


def contained():
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", THIRD_PARTY.read_text(encoding="utf-8"), re.M)
    for name, licence, copyright_text in rows[1:]:
        name, version = re.fullmatch(r"(.*?)(?:,? (\d[\d.]*))?", name.replace("`", "")).groups()
        yield package(name, version, LICENCES[licence], copyright_text)
    for name, licence in BESIDE:
        yield package(name, None, licence, "NOASSERTION")


def file(path):
    data = path.read_bytes()
    return {"SPDXID": "SPDXRef-File-" + re.sub(r"[^A-Za-z0-9.-]", "-", path.name), "fileName": "./" + path.name,
            "checksums": [{"algorithm": name.upper(), "checksumValue": hashlib.new(name, data).hexdigest()}
                          for name in ("sha1", "sha256")],
            "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"}


def main(folder, version, out):
    files = [file(path) for path in sorted(pathlib.Path(folder).iterdir()) if path.is_file()]
    ours = package("knurl", version, "MIT", "Copyright (c) 2026 The Knurl authors")
    others = list(contained())
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", ours["SPDXID"])]
    relations += [(ours["SPDXID"], "CONTAINS", each["SPDXID"]) for each in others]
    relations += [(each["SPDXID"], "GENERATED_FROM", ours["SPDXID"]) for each in files]
    names = "".join(each["checksums"][1]["checksumValue"] for each in files)
    document = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"knurl-{version}",
                "documentNamespace": f"urn:knurl:{version}:{hashlib.sha256(names.encode()).hexdigest()}",
                "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(int(os.environ["SOURCE_DATE_EPOCH"]))),
                                 "creators": ["Tool: knurl-sbom"]},
                "packages": [ours, *others], "files": files,
                "relationships": [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}
                                  for one, kind, other in relations]}
    pathlib.Path(out).write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


main(*sys.argv[1:])
