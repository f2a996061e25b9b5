#!/usr/bin/env python3
"""Runs a test in real time, and repeats it if the machine stalled.

usage: steady.py COMMAND...

Shared machines sometimes stall for tens of milliseconds. Drivers zero the force after 10 ms without a new one,
as they should, and a test that expected a force then fails for no fault of theirs. While the command runs, a process on
each CPU measures its stalls. A command that fails is run again, up to ATTEMPTS times, if some CPU
stood still for NOTICED seconds or more; without that it has failed.

A failure that repeats is a failure, even if the machine stalled: stalls happen at any time, so they fail different
checks. If the same check has failed in each of REPEATS attempts (the same line of the same test), the command has
failed. Only if the attempts have no failing check in common, and each had a stall of FATAL seconds, the result is
unknown, and that is a skip (77). Crashes and sanitizers' reports are never repeated. SPDX-License-Identifier: MIT
"""
import mmap
import os
import re
import signal
import struct
import subprocess
import sys
import threading
import time

ATTEMPTS = 5
NOTICED = 0.003  # s: the shortest limit in a driver, 5 ms, less the 2 ms that a thread may be late by itself
FATAL = 0.010  # s: KNURL_LINK_PATIENCE, after which every driver has to zero the force
REPEATS = 3  # attempts that fail at the same check: a failure
PAUSE = 3.0  # s before the second attempt; twice as long before each further one
NAP = 0.001
REPORTED = 66  # ThreadSanitizer's exit code; the other sanitizers are set to use it, too
SKIPPED = 77


def watch(cpu, page, place):
    """Never returns: keeps the longest wait on one CPU in the page."""
    os.sched_setaffinity(0, [cpu])
    parent = os.getppid()
    longest = 0.0
    while os.getppid() == parent:
        begin = time.monotonic()
        time.sleep(NAP)
        late = time.monotonic() - begin - NAP
        if late > longest:
            longest = late
            struct.pack_into("d", page, 8 * place, longest)
    os._exit(0)


def failing_checks(code, output):
    """The failures, as a set that can be compared between attempts: cmocka's file:line of each failed test; if there is
    none (a script's test), the first line with a failure, otherwise the last one, without its numbers; without output,
    the exit code."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    found = {match[1] for line in lines if (match := re.match(r"\[\s*LINE\s*\] --- (\S+:\d+): error", line))}
    if found:
        return found
    if not lines:
        return {f"exit {code}"}
    told = [line for line in lines if re.search(r"fail|error|expected", line, re.IGNORECASE)]
    return {re.sub(r"[\d.]+", "#", (told or lines[-1:])[0])}


def run(command, environment):
    """The command's exit code and its output, which is passed on as it comes."""
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    output = []

    def copy():
        for line in process.stdout:
            output.append(line)
            sys.stdout.buffer.write(line)
            sys.stdout.flush()

    copier = threading.Thread(target=copy, daemon=True)
    copier.start()
    code = process.wait()
    copier.join(timeout=5)  # a child that the test left behind may hold the pipe open
    return code, b"".join(output).decode(errors="replace")


def attempt(command, environment):
    """The command's exit code, the longest halt (s) while it ran, and its output."""
    cpus = sorted(os.sched_getaffinity(0))
    page = mmap.mmap(-1, 8 * len(cpus))
    watchers = []
    for place, cpu in enumerate(cpus):
        child = os.fork()
        if child == 0:
            watch(cpu, page, place)
        watchers.append(child)
    try:
        code, output = run(command, environment)
    finally:
        for child in watchers:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    return code, max(struct.unpack(f"{len(cpus)}d", page)), output


def main(command):
    environment = dict(os.environ)
    for name in ("ASAN_OPTIONS", "UBSAN_OPTIONS"):
        environment[name] = ":".join(filter(None, [environment.get(name), f"exitcode={REPORTED}"]))
    halts = []
    common = None  # the checks that failed in every attempt
    for count in range(1, ATTEMPTS + 1):
        code, halt, output = attempt(command, environment)
        halts.append(halt)
        if code in (0, SKIPPED, REPORTED) or code < 0 or code > 128 or halt < NOTICED:
            return code if code >= 0 else 128 - code
        print(f"steady: failed (exit {code}) while this machine stood still for {1e3 * halt:.1f} ms: "
              f"attempt {count} of {ATTEMPTS}", flush=True)
        failed = failing_checks(code, output)
        common = failed if common is None else common & failed
        if count >= REPEATS and common:
            print(f"steady: the same failure in {count} of {count} attempts is no fault of the machine: "
                  f"{', '.join(sorted(common))}", flush=True)
            return code
        if count < ATTEMPTS:
            time.sleep(PAUSE * 2 ** (count - 1))
    if min(halts) < FATAL:
        return code
    print(f"skipped: {os.path.basename(command[-1])} keeps real time, and this machine does not: it stood still for "
          f"{1e3 * min(halts):.0f} ms or more in each of {ATTEMPTS} attempts, which failed at different checks", flush=True)
    return SKIPPED


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
