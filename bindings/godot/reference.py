"""Writes the add-on's class reference, doc_classes/, as a page of the site, which ./run docs makes.
SPDX-License-Identifier: MIT

usage: reference.py OUT.md
"""
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
CLASSES = ("KnurlGrating", "KnurlSurface", "KnurlDevice")
ENGINE = "https://docs.godotengine.org/en/stable/classes/class_{}.html"


def anchor(*names):
    return "_".join(("godot",) + names)


def class_link(name):
    """Packed arrays and other classes of the engine are in its own reference."""
    if name in CLASSES:
        return f'@ref {anchor(name)} "{name}"'
    return f"[{name}]({ENGINE.format(name.lower())})"


def text_of(element, of):
    """BBCode to Markdown. of: the class that it belongs to."""
    def member(match):
        owner, _, name = match.group(2).rpartition(".")
        if owner and owner not in CLASSES:
            return f"`{match.group(2).removeprefix('@GlobalScope.')}`"
        if match.group(1) in ("enum", "constant") or (not owner and match.group(2) not in MEMBERS[of]):
            return f"`{name}`"
        return f'@ref {anchor(owner or of, name)} "{name}"'

    text = " ".join((element.text or "").split())
    text = re.sub(r"\[param (\w+)\]", r"`\1`", text)
    text = re.sub(r"\[code\](.*?)\[/code\]", r"`\1`", text)
    text = re.sub(r"\[(member|method|signal|enum|constant) ([\w.@]+)\]", member, text)
    return re.sub(r"\[([A-Z]\w+)\]", lambda m: class_link(m.group(1)), text)


def type_of(element):
    return (element.get("enum") or element.get("type")).removeprefix("@GlobalScope.")


def arguments(element):
    return ", ".join(f"{p.get('name')}: {type_of(p)}" for p in element.findall("param"))


def signature(element):
    name = element.get("name")
    if element.tag == "member":
        default = f" = {element.get('default')}" if element.get("default") else ""
        return f"{name}: {type_of(element)}{default}" + ("" if element.get("setter") else " (read only)")
    if element.tag == "method":
        return f"{name}({arguments(element)}) -> {type_of(element.find('return'))}"
    return f"{name}({arguments(element)})"


MEMBERS = {}


def write_class(name, root):
    lines = [f"## {name} {{#{anchor(name)}}}", "", f"Inherits {class_link(root.get('inherits'))}.",
             text_of(root.find("brief_description"), name), "", text_of(root.find("description"), name), ""]
    for title, path in (("Properties", "members/member"), ("Methods", "methods/method"), ("Signals", "signals/signal")):
        for number, element in enumerate(sorted(root.iterfind(path), key=lambda e: e.get("name"))):
            lines += [f"### {title} of {name}", ""] if number == 0 else []
            body = element if element.tag == "member" else element.find("description")
            lines += [f"#### {element.get('name')} {{#{anchor(name, element.get('name'))}}}", "",
                      f"`{signature(element)}`", "", text_of(body, name), ""]
    constants = root.findall("constants/constant")
    if constants:
        lines += [f"### Constants of {name}", "", "| constant | value | meaning |", "|---|---|---|"]
        lines += [f"| `{c.get('name')}` | {c.get('value')} | {text_of(c, name)} |" for c in constants]
    return "\n".join(lines) + "\n"


def main():
    roots = {name: ElementTree.parse(os.path.join(HERE, "doc_classes", name + ".xml")).getroot() for name in CLASSES}
    for name, root in roots.items():
        MEMBERS[name] = {e.get("name") for kind in ("member", "method", "signal") for e in root.iter(kind)}
    pages = [write_class(name, root) for name, root in roots.items()]
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("# Godot classes\n\nWhat the add-on's classes have, as the editor's help (F1) shows it.\n\n" + "\n".join(pages))


if __name__ == "__main__":
    main()
