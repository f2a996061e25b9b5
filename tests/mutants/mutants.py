#!/usr/bin/env python3
"""Changes the library at a sample of places, one at a time, and counts after how many of the changes a test fails.

usage: mutants.py [ROOM] [COUNT] [--seed SEED] [--again] [--jobs JOBS] [--list]

All changes of the sample are compiled at once, each beside the original code; KNURL_MUTANT chooses one at run
time. For each, the programs that reach it run, those of its room first, until one fails, crashes or takes much longer
than without it. The sample is the same each time: a change elsewhere in the sources does not alter it. --again runs
those that survived the last time, after tests were added; --list only prints the sample.

Writes build/mutants/mutants.json and prints a table. equivalent.txt names changes that no test can distinguish from
the original, with the reason. SPDX-License-Identifier: MIT
"""

import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess
import sys
import threading
import time

from sites import Finder

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WORK = ROOT / "build/mutants"
TREE, BUILD = WORK / "tree", WORK / "tree/build/release"
ROOMS = ("vibration", "grating", "motion", "contact", "surface", "proxy", "guard", "hip", "scene", "loop", "gltf")
LABELS = {
    "surface": ["scene"],
    "proxy": ["scene"],
    "guard": ["scene", "stability"],
    "hip": ["scene"],
    "contact": ["contact", "scene"],
    "grating": ["grating", "fidelity"],
}  # of a room's tests, if not its own name alone
COUNT = 440
LEAST = 20  # of a room
MET = 65536
PATIENCE, SLOWER = 5.0, 6.0  # s, and times as long as without a mutant: a hang
SLOW, SLOW_ELSEWHERE = 20.0, 2.0  # s: programs that take longer are left out, those of other rooms sooner
MEMORY = 8 << 30


def commands():
    """The options that each source is compiled with; knurl_gltf is compiled as one file."""
    with open(ROOT / "build/release/compile_commands.json", encoding="utf-8") as file:
        for entry in json.load(file):
            words = shlex.split(entry["command"])
            source = pathlib.Path(entry["file"])
            first = next(i for i, word in enumerate(words) if word.startswith("-"))
            options = [
                word for word in words[first : words.index("-o")] if not word.startswith(("-W", "-fno-tree", "-falign"))
            ]
            if "knurl_gltf.dir/Unity" in str(source):
                for part in sorted((ROOT / "sdk/src/gltf").rglob("*.cpp")):
                    yield part, options
            elif (ROOT / "sdk/src") in source.parents and source.suffix == ".c":
                yield source, options


def find(rooms):
    folders = {f"sdk/src/{room}" for room in rooms}
    finder = Finder(ROOT, folders)
    for source, options in commands():
        if source.relative_to(ROOT).parent.as_posix() in folders:
            finder.read(source, options)
    return sorted(finder.changes.values(), key=lambda change: (change.file, change.begin, -change.end, change.after))


def room_of(change):
    return change.file.split("/")[2]


def sample(changes, rooms, count, seed):
    """So many places of each room as its share of all, and one change of each place."""

    def order(*parts):
        return hashlib.sha256("|".join((seed, *parts)).encode()).digest()

    places = collections.defaultdict(list)
    for change in changes:
        places[(room_of(change), change.file, change.function, change.before, change.begin)].append(change)
    by_room = {room: [place for place in places if place[0] == room] for room in rooms}
    taken = []
    for room in rooms:
        share = max(LEAST, round(count * len(by_room[room]) / len(places)))
        repeats = collections.Counter()
        named = []
        for place in sorted(by_room[room], key=lambda place: (place[1], place[4])):
            repeats[place[1:4]] += 1  # the same text again in the same function
            named.append((order(*place[:4], str(repeats[place[1:4]])), place))
        for _, place in sorted(named)[:share]:
            taken.append(min(places[place], key=lambda change: order(change.key())))
    return sorted(taken, key=lambda change: (change.file, change.begin, -change.end)), len(changes), by_room


def render(text, begin, end, changes):
    """text[begin:end] with each change beside the original; changes are (number, change), outer ones first."""
    out = []
    while changes:
        number, change = changes[0]
        inside = [other for other in changes[1:] if other[1].end <= change.end]
        out.append(text[begin : change.begin].decode())
        original = render(text, change.begin, change.end, inside)
        lines = text.count(b"\n", change.begin, change.end)
        if change.after:
            out.append(f"(KNURL_MUTANT({number}) ? ({change.after}) : ({original}))")
        else:
            out.append(f"{{ if (!KNURL_MUTANT({number})) {original} }}")
        assert original.count("\n") == lines
        begin = change.end
        changes = changes[1 + len(inside) :]
    return "".join(out) + text[begin:end].decode()


def write(path, content):
    """Leaves a file alone that is the same, so that it is not compiled again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_bytes() != content:
        path.write_bytes(content)


def plant(numbered):
    """The tree again in build/mutants, with the changes."""
    by_file = collections.defaultdict(list)
    for number, change in numbered.items():
        by_file[change.file].append((number, change))
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    for name in listed.stdout.splitlines():
        source = ROOT / name
        if not source.is_file():
            continue
        content = source.read_bytes()
        if name in by_file:
            changes = sorted(by_file[name], key=lambda pair: (pair[1].begin, -pair[1].end))
            top = f'#include "{HERE}/mutant.h"\n#line 1\n'
            content = (top + render(content, 0, len(content), changes)).encode()
        elif name == "sdk/src/base/error.c":
            content += f'\n#include "{HERE}/mutant.c"\n'.encode()
        write(TREE / name, content)
        if os.access(source, os.X_OK):
            (TREE / name).chmod(0o755)


def build(numbered):
    """Builds the tests; a change that is no C or C++ is taken out."""
    environment = {**os.environ, "CCACHE_BASEDIR": str(TREE), "CCACHE_NOHASHDIR": "1"}
    refused = []
    plant(numbered)
    options = subprocess.run(
        [sys.executable, "-B", "scripts/preset.py", "release"], cwd=TREE, capture_output=True, text=True, check=True
    )
    if not (BUILD / "build.ninja").exists():
        with open(WORK / "configure.log", "wb") as log:
            subprocess.run(
                [
                    "cmake",
                    *options.stdout.split("\n")[:-1],
                    "-DBUILD_TESTING=ON",
                    "-DKNURL_WARNINGS_AS_ERRORS=OFF",
                    "-DCMAKE_C_FLAGS=-w",
                    "-DCMAKE_CXX_FLAGS=-w",
                    f"-DKNURL_CORPUS={ROOT}/../shared/corpus",
                ],
                cwd=TREE,
                env=environment,
                stdout=log,
                stderr=log,
                check=True,
            )
    while True:
        print(f"mutants: building with {len(numbered)} changes", flush=True)
        made = subprocess.run(["ninja", "-C", str(BUILD), "-k", "0"], env=environment, capture_output=True, text=True)
        if made.returncode == 0:
            return refused
        wrong = set(
            re.findall(  # an error in a header is told with the place it was inlined at
                r"(sdk/src/\w+/[\w.]+):(\d+):\d+:(?: (?:fatal error|error|note: in expansion)|$)", made.stdout, re.M
            )
        )
        bad = [
            number
            for number, change in numbered.items()
            if any(
                change.file == file and change.line <= int(line) <= change.line + change.before.count("\n")
                for file, line in wrong
            )
        ]
        if not bad:
            raise SystemExit(f"mutants: the changed sources do not compile:\n{made.stdout[-4000:]}")
        refused += [numbered.pop(number) for number in bad]
        plant(numbered)


def programs():
    """The test programs that need no real time and are not extended."""
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=BUILD, capture_output=True, text=True, check=True)
    for test in json.loads(shown.stdout)["tests"]:
        settings = {item["name"]: item["value"] for item in test.get("properties", ())}
        labels = settings.get("LABELS", [])
        command = test.get("command", [])
        if not any(pathlib.Path(word).name.startswith("test_") and str(BUILD) in word for word in command):
            continue
        if {"realtime", "extended", "clock"} & set(labels):
            continue
        extra = dict(item.split("=", 1) for item in settings.get("ENVIRONMENT", []))
        yield {
            "name": test["name"],
            "command": command,
            "labels": labels,
            "environment": extra,
            "folder": settings.get("WORKING_DIRECTORY", str(BUILD)),
        }


def run(program, number, timeout, met=None):
    """A program's exit code, None if it takes too long, and its time."""
    environment = {**os.environ, **program["environment"], "KNURL_MUTANT": str(number)}
    if met:
        environment["KNURL_MUTANT_MET"] = str(met)

    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))

    begin = time.monotonic()
    child = subprocess.Popen(
        program["command"],
        cwd=program["folder"],
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        preexec_fn=limit,
    )
    try:
        code = child.wait(timeout)
    except subprocess.TimeoutExpired:
        code = None
    try:
        os.killpg(child.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    child.wait()
    return code, time.monotonic() - begin


def measure(jobs):
    """Each program that passes without a mutant, with its time and the changes that it reaches."""

    def one(program):
        met = WORK / f"met.{program['name']}"
        met.write_bytes(bytes(MET))
        code, seconds = run(program, 0, 300, met)
        program["time"] = seconds
        program["met"] = {i for i, mark in enumerate(met.read_bytes()) if mark}
        met.unlink()
        if code not in (0, 77):
            print(f"mutants: {program['name']} fails without a mutant ({code}) and is left out", flush=True)
        return program if code == 0 and program["met"] else None

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return [program for program in pool.map(one, list(programs())) if program]


class Hunt:
    """Runs programs for several changes at once, but no program twice at once: their files have fixed names."""

    def __init__(self, found):
        self.programs = found
        self.locks = {program["name"]: threading.Lock() for program in found}
        self.done = 0

    def judge(self, number, change):
        labels = set(LABELS.get(room_of(change), [room_of(change)]))
        reached = [
            program
            for program in self.programs
            if number in program["met"]
            and program["time"] < (SLOW if labels & set(program["labels"]) else SLOW_ELSEWHERE)
        ]
        reached.sort(
            key=lambda program: (not labels & set(program["labels"]) and program["time"] > 0.5, program["time"])
        )
        result = {"state": "survived" if reached else "not reached", "ran": 0}
        waiting = list(reached)
        while waiting:
            program = next((each for each in waiting if self.locks[each["name"]].acquire(blocking=False)), None)
            if program is None:
                program = waiting[0]
                self.locks[program["name"]].acquire()
            waiting.remove(program)
            try:
                code, seconds = run(program, number, PATIENCE + SLOWER * program["time"])
            finally:
                self.locks[program["name"]].release()
            result["ran"] += 1
            if code != 0:
                how = "hang" if code is None else "crash" if code < 0 else "fails"
                result = {
                    "state": "killed",
                    "by": program["name"],
                    "how": how,
                    "ran": result["ran"],
                    "seconds": round(seconds, 2),
                }
                break
        self.done += 1
        if result["state"] != "killed":
            print(
                f"mutants: {self.done}: {result['state']}: line {change.line}: {change.key()}",
                flush=True,
            )
        elif self.done % 20 == 0:
            print(f"mutants: {self.done} done", flush=True)
        return result


def equivalents():
    """Key: reason."""
    found = {}
    for line in (HERE / "equivalent.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            key, _, reason = line.rpartition(" | ")
            found[key] = reason
    return found


def table(results):
    print("\n| room | mutants | killed | survived | equivalent | score |\n|---|---|---|---|---|---|")
    rows = collections.defaultdict(collections.Counter)
    for result in results:
        for room in (result["room"], "all"):
            rows[room][result["state"] if result["state"] in ("killed", "equivalent") else "survived"] += 1
    for room in (*ROOMS, "all"):
        row = rows[room]
        if row:
            judged = row["killed"] + row["survived"]
            print(
                f"| {room} | {sum(row.values())} | {row['killed']} | {row['survived']} | {row['equivalent']} | "
                f"{100.0 * row['killed'] / max(judged, 1):.1f} % |"
            )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("room", nargs="?", choices=("all", *ROOMS), default="all")
    parser.add_argument("count", nargs="?", type=int, default=COUNT)
    parser.add_argument("--seed", default="knurl")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="only the sample")
    arguments = parser.parse_args()
    rooms = ROOMS if arguments.room == "all" else (arguments.room,)
    WORK.mkdir(parents=True, exist_ok=True)
    taken, total, by_room = sample(find(rooms), rooms, arguments.count, arguments.seed)
    known = equivalents()
    before = {}
    if arguments.again:
        before = {result["key"]: result for result in json.loads((WORK / "mutants.json").read_text(encoding="utf-8"))}
    print(f"mutants: {len(taken)} of {total} possible changes, at {sum(map(len, by_room.values()))} places", flush=True)
    if arguments.list:
        for change in taken:
            print(f"{change.file}:{change.line} {change.kind}: {change.key().split(' | ', 1)[1]}")
        return
    numbered = dict(enumerate(taken, 1))
    for change in build(numbered):
        print(f"mutants: does not compile: {change.file}:{change.line} {change.key()}")
    hunt = Hunt(measure(arguments.jobs))
    print(
        f"mutants: {len(hunt.programs)} programs, {sum(program['time'] for program in hunt.programs):.0f} s", flush=True
    )

    def judge(pair):
        number, change = pair
        if change.key() in known:
            result = {"state": "equivalent", "reason": known[change.key()]}
        elif before.get(change.key(), {}).get("state") == "killed":
            result = before[change.key()]
        else:
            result = hunt.judge(number, change)
        results.append(
            {**result, "key": change.key(), "room": room_of(change), "line": change.line, "kind": change.kind}
        )
        if len(results) % 20 == 0:
            save()

    results = []

    def save():
        (WORK / "mutants.json").write_text(
            json.dumps(sorted(results, key=lambda result: result["key"]), indent=1), encoding="utf-8"
        )

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(judge, numbered.items()))
    save()
    table(results)


main()
