"""Every public function is called with memory that runs out: its name is in one of the tests in this folder.

usage: all_called.py REPOSITORY
"""

import pathlib
import re
import sys

# Functions that fill in a struct. A tick's (KNURL_NONBLOCKING) are left out too: tests/scene/test_no_heap.c has those.
EXEMPT = re.compile(r"_init$")


def functions(header):
    for declaration in re.findall(r"^KNURL_API\s[^;]*;", header.read_text(), re.M):
        if "KNURL_NONBLOCKING" not in declaration:
            yield re.search(r"(knurl_\w+)\(", declaration)[1]


def main():
    root = pathlib.Path(sys.argv[1])
    tests = "".join(path.read_text() for path in (root / "tests/memory").glob("test_*.c"))
    headers = [*(root / "sdk/include/knurl").glob("*.h"), root / "bindings/common/session.h"]
    names = sorted({name for header in headers for name in functions(header) if not EXEMPT.search(name)})
    missing = [name for name in names if not re.search(rf"\b{name}\(", tests)]
    print(f"{len(names)} functions, of which {len(missing)} are not called: {', '.join(missing)}")
    sys.exit(bool(missing))


main()
