"""Writes Rust's declarations of the whole C interface from api.json (./run mirror, or share/knurl/api.json).
usage: rust.py API.json OUT.rs     SPDX-License-Identifier: MIT"""
import json
import re
import sys

PLAIN = {"void": "c_void", "char": "c_char", "double": "f64", "float": "f32", "size_t": "usize", "int32_t": "i32", "uint32_t": "u32",
         "int64_t": "i64", "uint64_t": "u64"}
KEYWORDS = ("loop", "type", "match", "move", "ref", "use", "where", "box")


def escaped(name):
    return f"r#{name}" if name in KEYWORDS else name


def rust(kind, parameter=False):
    function = re.fullmatch(r"(.*?)\s*\(\*\)\((.*)\)", kind)
    if function:
        result = "" if function[1] == "void" else f" -> {rust(function[1])}"
        return f"Option<unsafe extern \"C\" fn({', '.join(rust(each, True) for each in function[2].split(', '))}){result}>"
    array = re.fullmatch(r"(const )?(.*)\[(\d+)\]", kind)
    if array:  # as a parameter: a pointer to the first element
        return (f"*{'const' if array[1] else 'mut'} " if parameter else "[") + rust(array[2]) + ("" if parameter else f"; {array[3]}]")
    if kind.endswith("*"):
        return f"*{'const' if kind.startswith('const ') else 'mut'} " + rust(kind[:-1].removeprefix("const ").strip())
    return PLAIN.get(kind, kind)


def main(path, out):
    with open(path, encoding="utf-8") as file:
        api = json.load(file)
    lines = ["#![allow(dead_code, non_camel_case_types)]", "use std::os::raw::{c_char, c_void};"]
    lines += [f"pub const {name}: {'i32' if isinstance(each['value'], int) else 'f64'} = {each['value']};"
              for name, each in api["constants"].items()]
    lines += [f"pub type {name} = {rust(each['type'])};" for name, each in api["types"].items()]
    lines += [f"#[repr(C)] pub struct {name} {{ _private: [u8; 0] }}" for name in api["opaque"]]
    for name, each in api["structs"].items():
        fields = ", ".join(f"pub {escaped(field['name'])}: {rust(field['type'])}" for field in each["fields"])
        lines.append(f"#[repr(C)] #[derive(Clone, Copy)] pub struct {name} {{ {fields} }}")
    lines.append('#[link(name = "knurl")] extern "C" {')
    for name, each in api["functions"].items():
        parameters = [f"{escaped(parameter['name'])}: {rust(parameter['type'], True)}" for parameter in each["parameters"]]
        result = "" if each["returns"] == "void" else f" -> {rust(each['returns'])}"
        lines.append(f"    pub fn {name}({', '.join(parameters + ['...'] * each.get('variadic', False))}){result};")
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["}", ""]))


main(*sys.argv[1:])
