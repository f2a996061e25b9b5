#!/usr/bin/python3
"""Names from files, devices and arguments may contain terminal escapes or fake another line. The samples print them
only by say() of samples/common/say.h; this check, a part of the lint, finds all other prints.
SPDX-License-Identifier: MIT"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
STRICT = ("samples/common/", "samples/knurl/", "samples/bench/")  # print only by say() and these:
WRITERS = {
    "samples/common/say.c": "it is the way",
    "samples/common/json.c": "escapes all strings",
    "samples/common/csv.c": "cleans all names",
    "samples/common/out.c": "prints numbers",
    "samples/knurl/help.c": "prints its own tables",
    "samples/knurl/help_completion.c": "prints its own tables",
    "samples/knurl/cmd_tag.c": "writes a glTF file's bytes",
    "samples/knurl/sound.c": "writes samples of sound",
    "samples/knurl/texture_draw.c": "draws numbers as SVG, no names",
}
# Small programs for readers: of text they print the library's messages and names, which have passed knurl_text_line().
EXAMPLES = ("samples/hello_grating.c", "samples/feel_scene.c", "samples/slider.c", "samples/coil.c", "samples/gripper.c", "samples/touch_grating.c", "samples/conform/conform.c")

READERS = ("samples/draw_run.py", "samples/study/plot.py")  # of files that others made; they print by one_line() or
CLEAN = {"BadInput", "ImportError"}  # messages of these exceptions

CALL = re.compile(r"(?<![\w.>])((?:v?f?printf|v?dprintf|f?puts|f?put[cs]|putchar|putw?char|fputw[cs]|v?f?wprintf|fwrite|perror|"
                  r"psignal|write|writev|send))(?:_unlocked)?\s*\(")
TEXT = re.compile(r'"(?:\\.|[^"\\])*"')
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|/\*.*?\*/|//[^\n]*', re.S)


def without_comments(source):
    """The same text and lines, with blanks for comments."""
    return COMMENT.sub(lambda found: found[0] if found[0][0] == '"' else re.sub(r"[^\n]", " ", found[0]), source)


def argument_list(source, at):
    """The arguments of the call whose parenthesis opens before `at`, apart at their commas."""
    arguments, depth, begin = [], 0, at
    while at < len(source):
        text = TEXT.match(source, at)
        if text:
            at = text.end()
            continue
        character = source[at]
        if character in ")]}" and depth == 0:
            break
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            arguments.append(source[begin:at].strip())
            begin = at + 1
        at += 1
    return [*arguments, source[begin:at].strip()]


def is_name_printed(function, arguments):
    """Whether a call prints text that does not stand in it, to standard output or standard error."""
    stream = {"fprintf": 0, "vfprintf": 0, "fputs": 1, "fwrite": 3, "write": 0, "dprintf": 0}.get(function)
    if stream is not None and (len(arguments) <= stream or not re.search(r"\b(std(out|err)|STD\w+_FILENO|[12])\b",
                                                                       arguments[stream])):
        return False
    if function in ("putc", "fputc", "putchar", "send"):
        return False
    text = arguments[1 if function in ("fprintf", "vfprintf", "dprintf") else 0]
    literal = "".join(part[1:-1] for part in TEXT.findall(text)).replace("%%", "")
    is_literal = re.sub(r"\s", "", TEXT.sub("", text)) == ""
    return not is_literal or ("printf" in function and re.search(r"%[-+ #0]*(\*|\d+)?(\.(\*|\d+)?)?s", literal) is not None)


def check(path, source):
    """A line for each call that is not allowed in the file `path`, as seen from the root."""
    if path in WRITERS or path in EXAMPLES:
        return []
    source = without_comments(source)
    wrong = []
    for call in CALL.finditer(TEXT.sub(lambda found: '"' + " " * (len(found[0]) - 2) + '"', source)):
        arguments = argument_list(source, call.end())
        if path.startswith(STRICT) or is_name_printed(call[1], arguments):
            line = source.count("\n", 0, call.start()) + 1
            wrong.append(f"{path}:{line}: {call[1]}({', '.join(arguments)[:60]}: text for people goes through say() "
                         f"(samples/common/say.h), JSON and CSV through their writers")
    return wrong


def check_python(path, source):
    """The same for a program in Python."""
    tree = ast.parse(source)
    clean = {id(node) for handler in ast.walk(tree) if isinstance(handler, ast.ExceptHandler)
             if getattr(handler.type, "id", None) in CLEAN for node in ast.walk(handler)}
    return [f"{path}:{call.lineno}: {ast.unparse(call)[:60]}: text for people goes through one_line()"
            for call in ast.walk(tree) if isinstance(call, ast.Call) and id(call) not in clean
            if ast.unparse(call.func) in ("print", "sys.exit", "sys.stdout.write", "sys.stderr.write")
            if not all(isinstance(argument, (ast.Constant, ast.IfExp)) or ast.unparse(argument) == "__doc__" or
                       ast.unparse(argument).startswith("one_line(") for argument in call.args)]


def main():
    paths = [str(path.relative_to(ROOT)) for path in sorted(ROOT.glob("samples/**/*.[ch]"))]
    wrong = [line for path in [*paths, *READERS]
             for line in (check_python if path.endswith(".py") else check)(path, (ROOT / path).read_text(encoding="utf-8"))]
    print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
