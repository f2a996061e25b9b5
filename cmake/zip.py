#!/usr/bin/python3
"""Packs a folder into a zip; reproducible: sorted, with one time (SOURCE_DATE_EPOCH, or 1980).
usage: zip.py OUT.zip FOLDER     The folder's own name comes first in every path. SPDX-License-Identifier: MIT"""
import os
import pathlib
import sys
import time
import zipfile

EARLIEST = 315532800  # 1980: the earliest time in a zip

out, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
moment = time.gmtime(max(EARLIEST, int(os.environ.get("SOURCE_DATE_EPOCH", "0"))))[:6]
out.unlink(missing_ok=True)
with zipfile.ZipFile(out, "w") as archive:
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        info = zipfile.ZipInfo(path.relative_to(folder.parent).as_posix(), moment)
        info.external_attr = (0o755 if os.access(path, os.X_OK) else 0o644) << 16
        archive.writestr(info, path.read_bytes(), zipfile.ZIP_DEFLATED, 9)
