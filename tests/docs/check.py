"""Checks the documentation: links are valid, functions exist, README's C is in the sample that it names, README is
short, and its pictures suit dark pages too.

SPDX-License-Identifier: MIT
"""
import pathlib
import re
import sys
import urllib.parse
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
README_MOST = 6 * 1024  # bytes
SAMPLE = "samples/feel_scene.c"
SCREENSHOTS = {"web.png", "web_phone.png", "godot.png", "blender.png", "tutorial_blender.png",
               "tutorial_godot.png", "verify.png"} # not drawings: their dark variants are screenshots, too


def pages():
    skipped = {"build", "third_party", ".git", "node_modules"}
    return [page for page in sorted(ROOT.rglob("*.md")) if not skipped & set(page.relative_to(ROOT).parts)]


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.M):
        plain = re.sub(r"[^\w\- ]", "", re.sub(r"[`*]", "", heading).strip().lower())
        found.add(plain.replace(" ", "-"))
    return found


def links(text):
    """(target) of every link and picture outside of code."""
    text = re.sub(r"```.*?```", "", text, flags=re.S)
    text = re.sub(r"`[^`\n]*`", "", text)
    return re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|srcset)="([^"]+)"', text)


def broken_links(page):
    count = 0
    for target in links(page.read_text(encoding="utf-8")):
        if re.match(r"[a-z]+:", target):
            continue
        count += 1
        path, _, anchor = target.partition("#")
        file = (page.parent / urllib.parse.unquote(path)) if path else page
        if not file.exists():
            yield f"{page.relative_to(ROOT)}: expected a file or folder, found none: {target}"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"{page.relative_to(ROOT)}: expected a heading, found none: {target}"
    broken_links.count += count


def pictures_without_dark():
    """Pictures of README and docs/ that are for light pages only, and dark ones made from an older light one."""
    for page in [ROOT / "README.md", *sorted(ROOT.glob("docs/*.md"))]:
        for name in re.findall(r"!\[[^\]]*\]\([^)]*/([^)/]+\.png)\)", page.read_text(encoding="utf-8")):
            if name not in SCREENSHOTS:
                yield f"{page.relative_to(ROOT)}: expected <picture> with a dark variant of {name} (samples/study/dark.py)"
    for dark in sorted(ROOT.glob("assets/pictures/*_dark.png")):
        light = dark.with_name(dark.name.replace("_dark", ""))
        if light.name not in SCREENSHOTS and f"Light\0{zlib.crc32(light.read_bytes()):08x}".encode() not in dark.read_bytes():
            yield f"{dark.relative_to(ROOT)}: made from another {light.name}: samples/study/dark.py makes it again"


def shown_c(text):
    """The snippets of C in a page."""
    return re.findall(r"```c\n(.*?)```", text, re.S)


def unknown_functions():
    """Functions that README or docs/ name and no public header declares."""
    headers = [*ROOT.glob("sdk/include/knurl/*.h"), *ROOT.glob("bindings/common/*.h")]
    declared = set(re.findall(r"\bknurl_\w+(?=\()", "".join(header.read_text(encoding="utf-8") for header in headers)))
    for page in [ROOT / "README.md", *sorted(ROOT.glob("docs/*.md"))]:
        for name in sorted(set(re.findall(r"\bknurl_\w+(?=\()", page.read_text(encoding="utf-8"))) - declared):
            yield f"{page.relative_to(ROOT)}: expected a public function, found {name}()"


def options_without_help():
    """Options that a command of the tool takes and its help does not show; studies likewise."""
    table = "".join((ROOT / f"samples/knurl/help_table.{end}").read_text(encoding="utf-8") for end in "ch")
    for source in [*ROOT.glob("samples/knurl/cmd_*.c"), ROOT / "samples/common/wave_options.c",
                   *ROOT.glob("samples/study/programs/cmd_*.c")]:
        for option in re.findall(r'\{"(--[\w-]+)", TOOL_', source.read_text(encoding="utf-8")):
            if f'"{option}"' not in table:
                yield f"{source.relative_to(ROOT)}: expected {option} in samples/knurl/help_table.c, found none"
    studies = re.findall(r'^    \{"(\w+)",', (ROOT / "samples/study/studies.c").read_text(encoding="utf-8"), re.M)
    for name in studies:
        if not re.search(rf"\b{name}\b", table):
            yield f"samples/study/studies.c: expected {name} in samples/knurl/help_table.c, found none"


def packages_without_names():
    """Packages that ./run demo or ./run test install, without a row of names for systems without apt-get."""
    table = (ROOT / "docs/building.md").read_text(encoding="utf-8")
    setup = (ROOT / "scripts/setup.sh").read_text(encoding="utf-8")
    for names in re.findall(r"^(?:BUILD|DEMO)_PACKAGES=\(([^)]*)\)", setup, re.M):
        for name in names.split():
            if not re.search(rf"^\| `{re.escape(name)}` \|( `[^`]+` \|){{3}}$", table, re.M):
                yield f"docs/building.md: expected a row of names for {name}, found none"


def pages_without_place():
    """Pages of docs/ and of the studies that the site's sidebar lacks."""
    sidebar = (ROOT / "docs/site/nav.yml").read_text(encoding="utf-8")
    for page in sorted([*ROOT.glob("docs/*.md"), *ROOT.glob("samples/study/*.md")]):
        name = str(page.relative_to(ROOT))
        if f": {name}\n" not in sidebar:
            yield f"docs/site/nav.yml: expected {name}, found no such page"


def main():
    broken_links.count = 0
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    problems = [problem for page in pages() for problem in broken_links(page)]
    problems += pictures_without_dark()
    problems += unknown_functions()
    problems += options_without_help()
    problems += packages_without_names()
    problems += pages_without_place()
    if len(readme.encode()) > README_MOST:
        problems.append(f"README.md: expected at most {README_MOST} bytes, found {len(readme.encode())}")
    sample = (ROOT / SAMPLE).read_text(encoding="utf-8").split("README: begin */\n")[1].split("    /* README: end")[0]
    if shown_c(readme) != [sample]:
        problems.append(f"README.md: expected the lines of {SAMPLE} between its marks, found others")
    print("\n".join(problems) if problems else f"{len(pages())} pages, {broken_links.count} links inside, all good")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
