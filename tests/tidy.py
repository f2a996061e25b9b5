#!/usr/bin/python3
"""Runs clang-tidy on the files named on stdin, as many at once as there are CPUs, and not again on clean files: a
file is known by the contents of all that it includes, by how it is compiled, and by clang-tidy's own version and settings.
A file of several programs is checked once, with the options of the first.
usage: tidy.py CLANG_TIDY BUILD CACHE     BUILD: has compile_commands.json. Exit 1: something was found.
SPDX-License-Identifier: MIT"""
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

TOOL, BUILD, CACHE = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
GCC_ALONE = ("-fno-keep-inline-dllexport", "-fira-region=one", "-fno-tree-pre", "-frename-registers")
OPTIONS = ["--quiet", *(f"--removed-arg={flag}" for flag in GCC_ALONE)]


@functools.lru_cache(maxsize=None)
def content(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def split(entry):
    """A compilation of several sources in one file (CMake's UNITY_BUILD), as one of each source."""
    if os.path.basename(os.path.dirname(entry["file"])) != "Unity":
        return [entry]
    sources = re.findall(r'#include "(.*)"', pathlib.Path(entry["file"]).read_text(encoding="utf-8"))
    return [{**entry, "file": source, "command": entry["command"].replace(entry["file"], source)} for source in sources]


def included(entry):
    """The files that a compilation reads, itself included; the compiler lists them as a rule of make."""
    words = shlex.split(entry["command"])
    words = words[1:] if os.path.basename(words[0]) == "ccache" else words
    del words[words.index("-o"):words.index("-o") + 2]
    kept = [word for at, word in enumerate(words)
            if word not in ("-MD", "-MT", "-MF", "-c") and words[at - 1] not in ("-MT", "-MF")]
    rule = subprocess.run([*kept, "-M"], cwd=entry["directory"], capture_output=True, text=True, check=True).stdout
    return [os.path.join(entry["directory"], name) for name in rule.split(":", 1)[1].replace("\\\n", " ").split()]


def key(file, version, entry):
    """The key of a file's compilation; None without one, or if the compiler does not list its includes."""
    if not entry:
        return None
    settings = [folder / ".clang-tidy" for folder in pathlib.Path(file).resolve().parents]
    try:
        parts = [f"{name} {content(name)}" for name in included(entry)]
        parts += [f"{name} {content(name)}" for name in settings if name.exists()]
    except (subprocess.CalledProcessError, OSError, ValueError):
        return None
    return hashlib.sha256("\n".join([version, *OPTIONS, entry["command"], *parts]).encode()).hexdigest()


def check(file, version, entry):
    """clang-tidy's findings in a file, "" if there are none."""
    mark = CACHE / (key(file, version, entry) or "none")
    if mark.exists():
        return ""
    done = subprocess.run([TOOL, "-p", CACHE, *OPTIONS, file], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        if mark.name != "none":
            mark.touch()
        return ""
    noise = ("warnings generated", "Suppressed", "Use -")
    return done.stdout + "\n".join(line for line in done.stderr.splitlines() if not any(word in line for word in noise))


def main():
    CACHE.mkdir(parents=True, exist_ok=True)
    version = subprocess.run([TOOL, "--version"], capture_output=True, text=True, check=True).stdout
    commands = [single for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
                for single in split(entry)]
    entries = {}
    for entry in commands:
        entries.setdefault(os.path.realpath(entry["file"]), entry)
    (CACHE / "compile_commands.json").write_text(json.dumps(list(entries.values())), encoding="utf-8")
    files = sys.stdin.read().split()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [words for words in pool.map(lambda file: check(file, version, entries.get(os.path.realpath(file))), files)
                 if words]
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


sys.exit(main())
