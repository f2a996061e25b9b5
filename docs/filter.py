#!/usr/bin/python3
"""Doxygen's filter for Markdown (docs/Doxyfile): gives each page a name, turns links between pages into references, and
replaces other links within the repository by their text. Keeps the light variant of a <picture>.

SPDX-License-Identifier: MIT
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
INPUT = re.search(r"^INPUT\s*=\s*(.*)$", (ROOT / "docs/Doxyfile").read_text(encoding="utf-8"), re.M).group(1).split()


def page_name(page):
    if page == ROOT / "README.md":
        return "mainpage"
    return "page_" + re.sub(r"\W", "_", str(page.relative_to(ROOT).with_suffix("")))


def is_page(page):
    return page.suffix == ".md" and any(page == ROOT / part or ROOT / part in page.parents for part in INPUT)


def rewrite(page, text):
    def link(match):
        words, target = match.group(1), match.group(2)
        if re.match("[a-z]+:", target):
            return match.group(0)
        file = (page.parent / target.partition("#")[0]).resolve() if target[0] != "#" else page
        name = page_name(file).replace("mainpage", "index")
        return f'@ref {name} "{words}"' if is_page(file) else words

    text = re.sub(r'<picture>.*?<img src="([^"]*)"[^>]* alt="([^"]*)">.*?</picture>', r"![\2](\1)", text, flags=re.S)
    text = re.sub(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)", link, text)
    text = re.sub(r"(!\[[^\]]*\]\()[^)]*/([^)/]+\))", r"\1\2", text)  # pictures by name, from IMAGE_PATH
    return re.sub(r"^# (.+)$", rf"# \1 {{#{page_name(page)}}}", text, count=1, flags=re.M)


page = pathlib.Path(sys.argv[1]).resolve()
sys.stdout.write(rewrite(page, page.read_text(encoding="utf-8")))
