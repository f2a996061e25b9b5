#!/usr/bin/python3
"""Follows every link of the site that ./run docs makes: to files, headings, functions and pictures.
usage: site.py FOLDER
SPDX-License-Identifier: MIT"""
import pathlib
import re
import sys
import urllib.parse


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    texts = {page: page.read_text(encoding="utf-8") for page in sorted(site.rglob("*.html"))}
    anchors = {page: set(re.findall(r'\b(?:id|name)="([^"]+)"', text)) for page, text in texts.items()}
    count, broken = 0, []
    for page, text in texts.items():
        for target in re.findall(r'\b(?:href|src)="([^"]+)"', text):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = map(urllib.parse.unquote, target.partition("#"))
            file = (page.parent / path.partition("?")[0]).resolve() if path else page
            count += 1
            is_place = anchor and "=" not in anchor  # the page's settings are not
            if not file.exists() or (is_place and file.suffix == ".html" and anchor not in anchors[file]):
                broken.append(f"{page.relative_to(site)}: expected a file or heading, found none: {target}")
    print("\n".join(broken) if broken else f"{len(texts)} pages of the site, {count} links inside, all good")
    return 1 if broken or not texts else 0


sys.exit(main())
