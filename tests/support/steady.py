#!/usr/bin/env python3
"""Runs a test that keeps real time, again where the machine did not keep it.

usage: steady.py COMMAND...

Shared machines stand still for tens of milliseconds now and then. Drivers let go of the motors after 10 ms without a
sign of life, as they should, and a test that expected a force then fails for no fault of theirs. While the command runs,
a process on each CPU watches for how long it is kept waiting. A command that fails is run again, up to ATTEMPTS times,
where some CPU stood still for NOTICED seconds or more; without that it has failed. Where every attempt met a halt of
FATAL seconds, nothing can be said here, and that is a skip (77). Crashes and what sanitizers report are never tried
again. SPDX-License-Identifier: MIT
"""
import mmap
import os
import signal
import struct
import subprocess
import sys
import time

ATTEMPTS = 5
NOTICED = 0.003  # s: the shortest limit in a driver, 5 ms, less the 2 ms that a thread may be late by itself
FATAL = 0.010  # s: KNURL_LINK_PATIENCE, after which every driver has to let go
PAUSE = 3.0  # s before the second attempt; twice as long before each further one
NAP = 0.001
REPORTED = 66  # ThreadSanitizer's exit code; the others are told to use it too
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


def attempt(command, environment):
    """The command's exit code, and the longest halt (s) while it ran."""
    cpus = sorted(os.sched_getaffinity(0))
    page = mmap.mmap(-1, 8 * len(cpus))
    watchers = []
    for place, cpu in enumerate(cpus):
        child = os.fork()
        if child == 0:
            watch(cpu, page, place)
        watchers.append(child)
    try:
        code = subprocess.call(command, env=environment)
    finally:
        for child in watchers:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    return code, max(struct.unpack(f"{len(cpus)}d", page))


def main(command):
    environment = dict(os.environ)
    for name in ("ASAN_OPTIONS", "UBSAN_OPTIONS"):
        environment[name] = ":".join(filter(None, [environment.get(name), f"exitcode={REPORTED}"]))
    halts = []
    for count in range(1, ATTEMPTS + 1):
        code, halt = attempt(command, environment)
        halts.append(halt)
        if code in (0, SKIPPED, REPORTED) or code < 0 or code > 128 or halt < NOTICED:
            return code if code >= 0 else 128 - code
        print(f"steady: failed (exit {code}) while this machine stood still for {1e3 * halt:.1f} ms: "
              f"attempt {count} of {ATTEMPTS}", flush=True)
        if count < ATTEMPTS:
            time.sleep(PAUSE * 2 ** (count - 1))
    if min(halts) < FATAL:
        return code
    print(f"skipped: {os.path.basename(command[-1])} keeps real time, and this machine does not: it stood still for "
          f"{1e3 * min(halts):.0f} ms or more in each of {ATTEMPTS} attempts", flush=True)
    return SKIPPED


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
