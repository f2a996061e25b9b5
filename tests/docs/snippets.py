#!/usr/bin/python3
"""The code shown in the documentation compiles.
usage: snippets.py check CC CXX          compiles C (also as C++), checks the syntax of shells and JavaScript,
                                         ./run's commands and knurl's options
       snippets.py write LANGUAGE DIR [BELOW]   writes each block of a language, for the tests that have its compiler, with
                                         the code around it; prints the files' names. BELOW: only pages of a folder

SPDX-License-Identifier: MIT
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from check import ROOT, pages

ENDINGS = {"c": ".c", "sh": ".sh", "cmake": ".txt", "python": ".py", "gdscript": ".gd", "csharp": ".cs",
           "js": ".mjs", "html": ".html"}

# Code around a page's blocks: lines before and after. Without an entry a block compiles alone.
AROUND = {
    ("README.md", "c"): ("#include <knurl/knurl.h>\nint fail(void);\nint feel(const char *file, const char *uri);\n"
                         "int feel(const char *file, const char *uri) {\n"
                         "knurl_scene *scene; knurl_device *device; knurl_loop *loop; knurl_loop_desc desc;\n",
                         "return 0; }\n"),
    ("docs/scenes.md", "c"): ("#include <knurl/knurl.h>\n"
                              "void edit(knurl_scene *scene, knurl_surface_id door, const double position[3],\n"
                              "          const double rotation[4], knurl_surface_id floor, knurl_surface_id crate);\n"
                              "void edit(knurl_scene *scene, knurl_surface_id door, const double position[3],\n"
                              "          const double rotation[4], knurl_surface_id floor, knurl_surface_id crate) {\n"
                              "knurl_material_desc ice; knurl_material_desc_init(&ice, sizeof ice);\n", "}\n"),
    ("docs/devices.md", "c"): ("#include <knurl/knurl.h>\nvoid use(knurl_scene *scene);\n"
                               "void use(knurl_scene *scene) {\n", "}\n"),
    ("docs/effects.md", "c"): ("#include <knurl/knurl.h>\nvoid stick(knurl_scene *scene);\n"
                               "void stick(knurl_scene *scene) {\n", "}\n"),
    ("README.md", "cmake"): ("cmake_minimum_required(VERSION 3.16)\nproject(game LANGUAGES C CXX)\n"
                             "add_executable(game game.c)\n", ""),
    ("bindings/godot/addons/knurl/README.md", "gdscript"): ("extends Node3D\n", ""),
    ("bindings/godot/addons/knurl/README.md", "csharp"): ("using Godot;\nclass Shown : Node { void Ready() {\n", "} }\n"),
}
AROUND["docs/building.md", "cmake"] = AROUND["README.md", "cmake"]


def blocks():
    """(page, line, language, code) of every fenced block."""
    for page in pages():
        name = str(page.relative_to(ROOT))
        text = page.read_text(encoding="utf-8")
        for match in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.S | re.M):
            yield name, text[:match.start()].count("\n") + 1, match.group(1), match.group(2)


def write(language, folder, below=""):
    """Writes the blocks of a language as files; returns [(where, path)]."""
    written = []
    for page, line, name, code in blocks():
        if name == language and page.startswith(below):
            before, after = AROUND.get((page, language), ("", ""))
            if (page, language) == ("bindings/godot/addons/knurl/README.md", "gdscript") and "func " not in code:
                before += "func _shown() -> void:\n\t"
            path = pathlib.Path(folder) / f"{re.sub(r'[^a-zA-Z0-9]', '_', page)}_{line}{ENDINGS[language]}"
            path.write_text(before + code + after, encoding="utf-8")
            written.append((f"{page}:{line}", path))
    return written


def compiler_errors(folder, compilers):
    for where, path in write("c", folder):
        for compiler in compilers:
            done = subprocess.run([*compiler, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I", ROOT / "sdk/include", path],
                                  capture_output=True, text=True, check=False)
            if done.returncode:
                yield f"{where}: does not compile:\n{done.stderr}"


def shell_errors(folder):
    """Syntax, files, commands of ./run, and commands and options of the tool, by its help."""
    run = set(re.findall(r"^([a-z-]+)(?: \| -h.*)?\) ", (ROOT / "run").read_text(encoding="utf-8"), re.M))
    tool_help = (ROOT / "samples/knurl/help_table.c").read_text(encoding="utf-8")
    for where, path in write("sh", folder):
        done = subprocess.run(["bash", "-n", path], capture_output=True, text=True, check=False)
        if done.returncode:
            yield f"{where}: {done.stderr}"
        for line in path.read_text(encoding="utf-8").splitlines():
            line = re.sub(r"\s#.*", "", line)
            for file in re.findall(r"(?<![\w/])(?:samples|bindings|tests|assets)/[\w./-]+", line):
                if not (ROOT / file).exists():
                    yield f"{where}: expected a file, found none: {file}"
            for command in re.findall(r"\./run ([a-z-]+)", line):
                if command not in run:
                    yield f"{where}: ./run has no command '{command}'"
            words = line.split("build/release/knurl ")[1].split() if "build/release/knurl " in line else []
            for word in words:
                if word.startswith("--") and f'"{word}"' not in tool_help and word != "--pretty":
                    yield f"{where}: knurl has no option {word}"
            if words and f'{{"{words[0]}",' not in tool_help:
                yield f"{where}: knurl has no command '{words[0]}'"


def script_errors(folder):
    """JavaScript's syntax, if Node is there; HTML is shown only."""
    for where, path in write("js", folder) if shutil.which("node") else []:
        done = subprocess.run(["node", "--check", path], capture_output=True, text=True, check=False)
        if done.returncode:
            yield f"{where}: {done.stderr}"


def main():
    if sys.argv[1:2] == ["write"] and len(sys.argv) in (4, 5):
        for _, path in write(*sys.argv[2:]):
            print(path)
        return 0
    if sys.argv[1:2] != ["check"] or len(sys.argv) != 4:
        sys.exit(__doc__)
    counts = {}
    problems = []
    for page, line, language, _ in blocks():
        counts[language] = counts.get(language, 0) + 1
        if language not in ENDINGS:
            problems.append(f"{page}:{line}: expected a language of {', '.join(ENDINGS)}, found '{language}'")
    with tempfile.TemporaryDirectory() as folder:
        problems += compiler_errors(folder, [[sys.argv[2], "-std=c99", "-pedantic-errors"], [sys.argv[3], "-x", "c++", "-std=c++17"]])
        problems += shell_errors(folder)
        problems += script_errors(folder)
    if not shutil.which("node"):
        print("snippets: SKIPPED: JavaScript's syntax: there is no node")
    print("\n".join(problems) if problems else "snippets: " + ", ".join(f"{n} {l}" for l, n in sorted(counts.items())))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
