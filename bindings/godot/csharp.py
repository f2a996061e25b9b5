"""Writes addons/knurl/csharp/Knurl*.cs, C# wrappers of the extension's classes, from the class reference in
doc_classes/. Godot generates no C# classes for extensions. SPDX-License-Identifier: MIT

usage: csharp.py [--check]     --check: writes nothing; exit 1 if a file is out of date
"""
import os
import re
import sys
import textwrap
import xml.etree.ElementTree as ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "addons", "knurl", "csharp")
CLASSES = ("KnurlGrating", "KnurlSurface", "KnurlDevice", "KnurlEffect")

# Type in the class reference: type in C#, and the call that extracts it from a Variant.
TYPES = {"bool": ("bool", "AsBool()"), "int": ("long", "AsInt64()"), "float": ("double", "AsDouble()"),
         "String": ("string", "AsString()"), "Vector2": ("Vector2", "AsVector2()"), "Vector3": ("Vector3", "AsVector3()"),
         "Quaternion": ("Quaternion", "AsQuaternion()"), "Array": ("Godot.Collections.Array", "AsGodotArray()"),
         "Dictionary": ("Godot.Collections.Dictionary", "AsGodotDictionary()"),
         "PackedFloat32Array": ("float[]", "AsFloat32Array()"), "PackedFloat64Array": ("double[]", "AsFloat64Array()"),
         "PackedStringArray": ("string[]", "AsStringArray()"), "Object": ("GodotObject", "AsGodotObject()")}


def pascal(name):
    return "".join(part[0].upper() + part[1:] for part in name.split("_"))


def camel(name):
    return pascal(name)[0].lower() + pascal(name)[1:]


def comment(text, indent):
    """BBCode to a summary."""
    text = re.sub(r"\[(?:param|method|member|signal|enum|constant) (?:Knurl\w+\.|@GlobalScope\.)?([\w@.]+)\]", lambda m: pascal(m.group(1)), text)
    text = re.sub(r"\[/?code\]", "", text)
    text = re.sub(r"\[(\w+)\]", r"\1", text)
    text = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    lines = textwrap.wrap(f"<summary>{text}</summary>", 116 - indent)
    return "".join(f"{' ' * indent}/// {line}\n" for line in lines)


def type_of(name):
    return name if name in CLASSES else TYPES[name][0]


def unwrapped(value, name):
    """The expression that extracts a value from a Variant."""
    return f"{name}.Of({value}.AsGodotObject())" if name in CLASSES else f"{value}.{TYPES[name][1]}"


def wrapped(value, name):
    """The expression that goes into a Variant."""
    return f"{value}?.Object" if name in CLASSES else value


def write_property(member):
    name, kind = member.get("name"), member.get("type")
    body = f"get {{ return {unwrapped(f'Object.Get({quoted(name)})', kind)}; }}"
    if member.get("setter"):
        body += f" set {{ Object.Set({quoted(name)}, {wrapped('value', kind)}); }}"
    return comment(member.text, 8) + f"        public {type_of(kind)} {pascal(name)} {{ {body} }}\n"


def write_method(method):
    name, kind = method.get("name"), method.find("return").get("type")
    parameters = [(camel(p.get("name")), p.get("type")) for p in method.findall("param")]
    call = ", ".join([quoted(name)] + [wrapped(word, of) for word, of in parameters])
    body = f"Object.Call({call})"
    body = f"{body};" if kind == "void" else f"return {unwrapped(body, kind)};"
    takes = ", ".join(f"{type_of(of)} {word}" for word, of in parameters)
    returned = "void" if kind == "void" else type_of(kind)
    return comment(method.find("description").text, 8) + f"        public {returned} {pascal(name)}({takes}) {{ {body} }}\n"


def write_signal(signal):
    """A method that connects a handler, which gets the signal's arguments as C# types."""
    parameters = [(camel(p.get("name")), p.get("type")) for p in signal.findall("param")]
    handler = ", ".join(type_of(of) for _, of in parameters)
    raw = ", ".join(f"{'GodotObject' if of in CLASSES else type_of(of)} {word}" for word, of in parameters)
    given = ", ".join(f"{of}.Of({word})" if of in CLASSES else word for word, of in parameters)
    return (comment(signal.find("description").text, 8) +
            f"        public void On{pascal(signal.get('name'))}(Action<{handler}> handler)\n        {{\n"
            f"            Object.Connect({quoted(signal.get('name'))}, Callable.From(({raw}) => handler({given})));\n"
            "        }\n")


def write_enums(of, constants):
    found = {}
    for constant in constants:
        found.setdefault(constant.get("enum"), []).append(constant)
    made = []
    for name, values in found.items():
        prefix = name.upper() + "_"
        rows = [comment(v.text, 8) + f"        {pascal(v.get('name')[len(prefix):].lower())} = {v.get('value')},\n"
                for v in values]
        made.append(f"\n    /// <summary>{name} of {of}.</summary>\n    public enum {of}{name} : long\n    {{\n" +
                    "\n".join(rows) + "    }\n")
    return "".join(made)


def quoted(name):
    return f'"{name}"'


def write_class(name):
    root = ElementTree.parse(os.path.join(HERE, "doc_classes", name + ".xml")).getroot()
    base = "Resource" if root.get("inherits") == "Resource" else "Node3D"
    members = [write_property(m) for m in root.iterfind("members/member")]
    members += [write_method(m) for m in root.iterfind("methods/method")]
    members += [write_signal(s) for s in root.iterfind("signals/signal")]
    return f"""// The engine's {name} in C#: {name}.Of(object). Generated by csharp.py from the class reference: do not edit.
// SPDX-License-Identifier: MIT
using System;
using Godot;

namespace Knurl
{{
{comment(root.find("brief_description").text, 4)}    public sealed class {name}
    {{
        /// <summary>The engine's object.</summary>
        public readonly {base} Object;

        {name}({base} of) {{ Object = of; }}

        /// <summary>Creates a new object.</summary>
        public static {name} Create() {{ return Of(ClassDB.Instantiate({quoted(name)}).AsGodotObject()); }}

        /// <summary>Wraps an object; null if it is not of this class.</summary>
        public static {name} Of(GodotObject of)
        {{
            return of != null && of.IsClass({quoted(name)}) ? new {name}(({base})of) : null;
        }}

{chr(10).join(members)}    }}
{write_enums(name, root.findall("constants/constant"))}}}
"""


def main():
    stale = 0
    for name in CLASSES:
        path = os.path.join(OUT, name + ".cs")
        text = write_class(name)
        if "--check" not in sys.argv[1:]:
            with open(path, "w", encoding="utf-8", newline="\n") as file:
                file.write(text)
            continue
        with open(path, encoding="utf-8") as file:
            if file.read() != text:
                print(f"csharp.py: {name}.cs is not what the class reference says: run bindings/godot/csharp.py")
                stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())
