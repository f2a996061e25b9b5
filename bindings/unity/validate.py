#!/usr/bin/env python3
"""Checks a package as Unity's package validation does, except its metas (metas.py): manifest, changelog, documents,
samples, paths.

usage: validate.py [--published] [FOLDER]    prints one line per error; exit 1 if there are any. --published: also
requires the addresses that package.sh writes
"""
import argparse
import datetime
import json
import os
import re
import sys

import metas

LONGEST_PATH = 140  # characters, below the package
DOCUMENTS = ("README.md", "CHANGELOG.md", "LICENSE.md", "Third Party Notices.md")
ADDRESSES = ("documentationUrl", "changelogUrl", "licensesUrl")
RESTRICTED = re.compile(r"\.(bat|bin|com|csh|dmg|exe|gz|jse|lib|msi|pkg|ps1|rar|sh|tar|tgz|vbs|zip|unitypackage)$", re.I)
VERSION = r"\d+\.\d+\.\d+(-[a-z]+(\.\d+)?)?"


def read(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return file.read()


def check_manifest(manifest, is_published):
    wrong = []

    def expect(key, is_right, what):
        if not is_right(manifest.get(key)):
            wrong.append(f"package.json: {key}: expected {what}, found {manifest.get(key)!r}")

    def is_text(pattern, least=1, most=1000):
        return lambda value: isinstance(value, str) and least <= len(value) <= most and re.fullmatch(pattern, value, re.S)

    expect("name", is_text(r"[a-z0-9][a-z0-9-._]*", most=214), "lower-case letters, digits, '-', '.' and '_'")
    expect("version", is_text(VERSION), "MAJOR.MINOR.PATCH")
    expect("displayName", is_text(r"[A-Za-z0-9 .\-]+", most=50), "at most 50 letters, digits and spaces")
    expect("description", is_text(r".+", least=50), "50 to 1000 characters")
    expect("unity", is_text(r"\d{4}\.\d"), "YEAR.MINOR")
    expect("license", is_text(r".+"), "a licence's name")
    expect("author", lambda value: isinstance(value, dict) and bool(value.get("name")), "an object with a name")
    expect("dependencies", lambda value: isinstance(value, dict) and all(re.fullmatch(VERSION, each)
           for each in value.values()), "exact versions by name")
    for key in ADDRESSES + ("repository",):
        address = manifest.get(key, {}).get("url") if key == "repository" and key in manifest else manifest.get(key)
        if (address is None and is_published) or (address is not None and not re.fullmatch(r"https://\S+", address)):
            wrong.append(f"package.json: {key}: expected an https address, found {address!r}")
    return wrong


def check_changelog(text, version):
    first = re.search(r"^## (.*)$", text, re.MULTILINE)
    entry = re.fullmatch(r"\[(" + VERSION + r")\] - (\d{4}-\d{2}-\d{2})", first.group(1)) if first else None
    try:
        _ = entry and datetime.date.fromisoformat(entry.group(4))
    except ValueError:
        entry = None
    if entry is None or entry.group(1) != version:
        found = first.group(1) if first else "none"
        return [f"CHANGELOG.md: expected '[{version}] - YYYY-MM-DD' as its first entry, found '{found}'"]
    return []


def check_samples(package, manifest):
    wrong = []
    listed = manifest.get("samples", [])
    for sample in listed:
        path = sample.get("path", "")
        if not sample.get("displayName") or not sample.get("description"):
            wrong.append(f"package.json: samples: '{path}': expected a displayName and a description")
        if not os.path.isdir(os.path.join(package, path)):
            wrong.append(f"package.json: samples: expected a folder, found no '{path}'")
    folder = os.path.join(package, "Samples~")
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else ():
        if "Samples~/" + name not in [sample.get("path") for sample in listed]:
            wrong.append(f"Samples~/{name}: expected to be listed in package.json")
    return wrong


def check_files(package):
    wrong = [f"{name}: missing" for name in DOCUMENTS if not os.path.isfile(os.path.join(package, name))]
    documents = os.path.join(package, "Documentation~")
    if not os.path.isdir(documents) or not any(name.endswith(".md") for name in os.listdir(documents)):
        wrong.append("Documentation~: expected a .md file in it")
    for folder, inner, names in os.walk(package):
        below = os.path.relpath(folder, package).replace(os.sep, "/")
        if not inner and not names:
            wrong.append(f"{below}: expected files, found an empty folder")
        for name in names:
            path = name if below == "." else f"{below}/{name}"
            if len(path) > LONGEST_PATH:
                wrong.append(f"{path}: expected at most {LONGEST_PATH} characters, found {len(path)}")
            if RESTRICTED.search(name):
                wrong.append(f"{path}: files of this kind are not allowed in packages")
            if os.path.islink(os.path.join(folder, name)):
                wrong.append(f"{path}: expected a file, found a link")
    return wrong


def check(package, is_published):
    """All errors, one line each."""
    try:
        manifest = json.loads(read(package, "package.json"))
    except ValueError as error:
        return [f"package.json: expected JSON: {error}"]
    wrong = check_manifest(manifest, is_published) + check_samples(package, manifest) + check_files(package)
    if os.path.isfile(os.path.join(package, "CHANGELOG.md")):
        wrong += check_changelog(read(package, "CHANGELOG.md"), manifest.get("version"))
    return sorted(wrong)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--published", action="store_true")
    parser.add_argument("folder", nargs="?", default=metas.PACKAGE)
    arguments = parser.parse_args()
    faults = check(arguments.folder, arguments.published)
    for fault in faults:
        print(f"validate: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
