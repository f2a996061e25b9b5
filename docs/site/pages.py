"""Stages the pages of the site (nav.yml) and those of the headers in a folder, with links as the site needs them.
usage: pages.py FOLDER     SPDX-License-Identifier: MIT"""
import pathlib
import posixpath
import re
import shutil
import sys

import yaml

import godot
import headers

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
INCLUDE = "sdk/include/knurl"


def name_of(page):
    """The page's name in the site."""
    return "index.md" if page == "README.md" else page


def rewrite(page, text, staged, pictures):
    """Links to other pages stay, links to headers go to their pages, and others become plain text; a <picture> becomes its
    light and its dark variant. Adds the names of the page's pictures to `pictures`."""
    where = posixpath.dirname(page)

    def target_of(target):
        path = posixpath.normpath(posixpath.join(where, target.partition("#")[0]))
        anchor = target[len(target.partition("#")[0]):]
        if path.startswith(INCLUDE):
            path = "reference/" + (posixpath.basename(path)[:-2] if path.endswith(".h") else "index") + ".md"
        elif (ROOT / path).is_dir() and path + "/README.md" in staged:
            path += "/README.md"
        return posixpath.relpath(name_of(path), where or ".") + anchor if path in staged else None

    def link(match):
        words, target = match[1], match[2]
        if re.match("[a-z]+:", target) or target.startswith("#"):
            return match[0]
        return f"[{words}]({target_of(target)})" if target_of(target) else words

    def picture(match):
        pictures.add(posixpath.normpath(posixpath.join(where, match[2])))
        return match[0]

    def both(match):
        dark = re.search(r'srcset="([^"]+)"', match[0])[1]
        light, alt = (re.search(rf'<img [^>]*?{name}="([^"]*)"', match[0])[1] for name in ("src", "alt"))
        width = re.search(r'width="(\d+)"', match[0])
        size = f" width={width[1]}px" if width else ""
        return f"![{alt}]({light}){{.only-light{size}}}\n![{alt}]({dark}){{.only-dark{size}}}"

    parts = re.split(r"(```.*?```)", text, flags=re.S)  # code stays as it is
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(r"<picture>.*?</picture>", both, parts[i], flags=re.S)
        parts[i] = re.sub(r"(?<!!)\[([^\[\]]+)\]\(([^)\s]+)\)", link, parts[i])
        parts[i] = re.sub(r"!\[([^\]]*)\]\(([^)\s]+)\)", picture, parts[i])
    return "".join(parts)


def main(folder):
    shutil.rmtree(folder, ignore_errors=True)
    nav = yaml.safe_load((HERE / "nav.yml").read_text(encoding="utf-8"))
    found = headers.pages({path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / INCLUDE).glob("*.h"))
                           if path.stem != "knurl"})
    reference = {f"reference/{name}.md": text for name, text in found.items()}
    reference["reference/godot.md"] = godot.page()
    listed = [page for entries in nav.values() for entry in entries for page in entry.values()]
    nav["Reference"][1:1] = [{f"{name}.h": f"reference/{name}.md"} for name in found if name != "index"]
    pictures, staged = set(), {*listed, *reference}
    for page in sorted(staged):
        text = reference.get(page) or rewrite(page, (ROOT / page).read_text(encoding="utf-8"), staged, pictures)
        if page == "README.md":
            for caption, entries in nav.items():
                lines = [f"{title} <{name_of(path)}>" for entry in entries for title, path in entry.items() if path != page]
                text += "\n".join(["\n```{toctree}\n:hidden:", f":caption: {caption}\n", *lines, "```\n"])
        to = folder / name_of(page)
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_text(text, encoding="utf-8")
    for name in pictures:
        to = folder / name
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, to)


main(pathlib.Path(sys.argv[1]))
