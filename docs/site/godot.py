"""The page of the Godot add-on's classes, from its class reference. SPDX-License-Identifier: MIT"""
import os
import re
import xml.etree.ElementTree as ElementTree

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../bindings/godot/doc_classes")
CLASSES = ("KnurlGrating", "KnurlSurface", "KnurlDevice", "KnurlEffect")
ENGINE = "https://docs.godotengine.org/en/stable/classes/class_{}.html"


def anchor(*names):
    return "-".join(("godot",) + names).lower().replace("_", "-")


def class_link(name):
    """Packed arrays and other classes of the engine are in its own reference."""
    if name in CLASSES:
        return f"[{name}](#{anchor(name)})"
    return f"[{name}]({ENGINE.format(name.lower())})"


def text_of(element, of):
    """BBCode to Markdown. of: the class that it belongs to."""
    def member(match):
        owner, _, name = match.group(2).rpartition(".")
        if owner and owner not in CLASSES:
            return f"`{match.group(2).removeprefix('@GlobalScope.')}`"
        if match.group(1) in ("enum", "constant") or (not owner and match.group(2) not in MEMBERS[of]):
            return f"`{name}`"
        return f"[`{name}`](#{anchor(owner or of, name)})"

    text = " ".join((element.text or "").split())
    text = re.sub(r"\[param (\w+)\]", r"`\1`", text)
    text = re.sub(r"\[code\](.*?)\[/code\]", r"`\1`", text)
    text = re.sub(r"\[(member|method|signal|enum|constant) ([\w.@]+)\]", member, text)
    return re.sub(r"\[([A-Z]\w+)\](?!\()", lambda m: class_link(m.group(1)), text)


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
    lines = [f"({anchor(name)})=", f"## {name}", "", f"Inherits {class_link(root.get('inherits'))}.",
             text_of(root.find("brief_description"), name), "", text_of(root.find("description"), name), ""]
    for title, path in (("Properties", "members/member"), ("Methods", "methods/method"), ("Signals", "signals/signal")):
        for number, element in enumerate(sorted(root.iterfind(path), key=lambda e: e.get("name"))):
            lines += [f"### {title} of {name}", ""] if number == 0 else []
            body = element if element.tag == "member" else element.find("description")
            lines += [f"({anchor(name, element.get('name'))})=", f"#### {element.get('name')}", "",
                      f"`{signature(element)}`", "", text_of(body, name), ""]
    constants = root.findall("constants/constant")
    if constants:
        lines += [f"### Constants of {name}", "", "| constant | value | meaning |", "|---|---|---|"]
        lines += [f"| `{c.get('name')}` | {c.get('value')} | {text_of(c, name)} |" for c in constants]
    return "\n".join(lines) + "\n"


def page():
    roots = {name: ElementTree.parse(os.path.join(FOLDER, name + ".xml")).getroot() for name in CLASSES}
    for name, root in roots.items():
        MEMBERS[name] = {e.get("name") for kind in ("member", "method", "signal") for e in root.iter(kind)}
    return ("# Godot's classes\n\nThe classes of the add-on, as the editor's help (F1) has them.\n\n" +
            "\n".join(write_class(name, root) for name, root in roots.items()))
