#!/usr/bin/env python3
"""The result of NUnit 2, as "PASSED FAILED SKIPPED"; exit 1 if it is not a success.

usage: count.py RESULT.xml EXIT-CODE [--one]
No result, an exit code that no failed test explains, and no test at all each count as a failure; the last not with
--one, if the requested name may be in another assembly."""
import sys
import xml.etree.ElementTree as tree

path, code = sys.argv[1], int(sys.argv[2])
try:
    result = tree.parse(path).getroot().attrib
except (OSError, tree.ParseError) as error:
    print(0, 1, 0)
    sys.exit(f"no result (exit {code}): {error}")
total = int(result["total"])
failed = sum(int(result[key]) for key in ("failures", "errors", "inconclusive", "invalid"))
if failed == 0 and (code != 0 or (total == 0 and "--one" not in sys.argv)):
    failed = 1
print(max(0, total - failed), failed, int(result["ignored"]) + int(result["skipped"]))
sys.exit(1 if failed else 0)
