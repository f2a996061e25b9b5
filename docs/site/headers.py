"""Pages of the public headers: of each documented declaration a heading, its code as it is in the header, and its comment
with links. SPDX-License-Identifier: MIT"""
import re

# A comment, if any, and what it documents: macros, or code up to a blank line or the next comment at the line's beginning.
ITEM = re.compile(r"/\*\*(?P<doc>[\s\S]*?)\*/\n(?P<code>(?:#define(?:.*\\\n)*.*\n)+|(?:(?!\n/\*|\n\n(?! ))[\s\S])+\n?)")
NAME = re.compile(r"`[^`\n]*`|\b(?:knurl_\w+(?:\(\))?|KNURL_[A-Z0-9_]*[A-Z0-9]\b(?!_))")
WIDTH = 88  # columns of code on a page


def comment(text):
    """The paragraphs of a comment, as Markdown."""
    lines = [re.sub(r"^ ?\* ?|^ {1,3}(?! )", "", line).rstrip() for line in text.strip().splitlines()]
    text = re.sub(r"\n(?=- )", "\n\n", "\n".join(lines), count=1)
    return re.sub(r"([<>|*]|_(?=\s|$))", r"\\\1", text) if "- " != text[:2] else text


def titles(code):
    """The names that a piece of code declares: the heading's, and those inside an enumeration."""
    functions = re.findall(r"^KNURL_API [^;(]*?\b(knurl_\w+)\(", code, re.M)
    if functions:
        return [name + "()" for name in functions], functions
    structs = re.findall(r"^typedef struct (knurl_\w+)", code, re.M)
    if structs:
        return structs, structs
    constants = []
    if "enum {" in code:
        constants = re.findall(r"\b(KNURL_[A-Z0-9_]+)\b(?= =|,)", re.sub(r"/\*.*?\*/", "", code, flags=re.S))
        common = re.match(r"(KNURL_[A-Z0-9]+_)", constants[0])[1] if constants else "KNURL_RESULTS"
        return [common + "..."] if len(constants) > 1 else constants, constants
    types = re.findall(r"^typedef [^;]*?\(?\*?\b(knurl_\w+)\)?[^;]*;", code, re.M)
    macros = list(dict.fromkeys(re.findall(r"^#define (KNURL_\w+)", code, re.M)))
    return (types or macros), (types or macros) + re.findall(r"X\((KNURL_\w+)", code)


def folded(code):
    """A declaration with a parameter or constant a line if it is longer than a page is wide."""
    if re.fullmatch(r"enum \{ [^\n]* \};", code) and len(code) > WIDTH:
        return code.replace("{ ", "{\n    ").replace(", ", ",\n    ").replace(" }", "\n}")
    if not re.match(r"[^{]*\(", code) or max(map(len, code.splitlines())) <= WIDTH:
        return code
    head, _, rest = " ".join(code.split()).partition("(")
    return f"{head}(\n    " + rest.replace(", ", ",\n    ") if code.count(";") == 1 else code


MEMBER = re.compile(r"\s*(?:(?P<type>(?:const )?\w+(?: \w+)*[ *]+))?(?P<name>\w+(?:\[\w+\])*|KNURL_\w+ = [^,;/]+?)"
                    r"\s*[;,]?[ \t]*(?:/\*\*<(?P<doc>[\s\S]*?)\*/)?[;,]?(?=\s)")


def members(code):
    """A table of a struct's fields or an enumeration's constants, in place of its code; None if it is of another shape, or
    has no comments."""
    body = re.fullmatch(r"(?:typedef struct \w+|enum) \{([\s\S]*\n)\}[^}]*;", code)
    if not body or "/**<" not in code:
        return None
    is_enum, rows, at = code.startswith("enum"), [], 0
    while body[1][at:].strip():
        found = MEMBER.match(body[1], at)
        if not found or (not is_enum and not found["type"]):
            return None
        at = found.end()
        kind = "" if is_enum else f" `{found['type'].strip()}` |"
        rows.append(f"| `{found['name']}` |{kind} {' '.join(comment(found['doc'] or '').split())} |")
    head = ["| constant | |", "|---|---|"] if is_enum else ["| field | type | |", "|---|---|---|"]
    return "\n".join(head + rows) + "\n"


def items(header):
    """(titles, declared names, code, documentation) of each documented declaration of a header."""
    body = re.sub(r"(?m)^#(?:if|else|elif|endif|ifdef|ifndef|undef|include).*\n", "", header)
    body = body.replace('extern "C" {\n', "")
    for found in ITEM.finditer(body):
        code = re.sub(r"\bKNURL_API |\s+KNURL_NONBLOCKING(?=;)", "", found["code"]).strip()
        heading, declared = titles(found["code"])
        if declared:
            yield heading, declared, folded(code), comment(found["doc"])


def pages(headers):
    """{name of a header: Markdown}. headers: {name: text}. Names link to the headings of their declarations."""
    read = {name: list(items(text)) for name, text in headers.items()}
    places = {}
    for found in read.values():
        for _, declared, _, _ in found:
            places.update({each: "#" + declared[0].lower() for each in declared})
    missing = {each for text in headers.values() for each in re.findall(r"^KNURL_API [^;(]*?\b(knurl_\w+)\(", text, re.M)} - places.keys()
    if missing:
        raise SystemExit(f"headers: expected each function on a page, found none for {', '.join(sorted(missing))}")

    def link(match, own):
        if match[0].startswith("`"):
            return match[0]
        name = match[0].rstrip("()")
        target = places.get(name)
        return f"[`{match[0]}`]({target})" if target and name not in own else f"`{match[0]}`"

    result = {}
    for name, found in read.items():
        intro = re.match(r"/\*(.*?)\*/", headers[name], re.S)[1].replace("SPDX-License-Identifier: MIT", "")
        text = [f"# {name}.h\n", NAME.sub(lambda m: link(m, ()), comment(intro)), ""]
        for heading, declared, code, doc in found:
            table = members(code)
            text += [f"({declared[0].lower()})=\n## {', '.join(f'`{each}`' for each in heading)}\n",
                     NAME.sub(lambda m, own=declared: link(m, own), f"{doc}\n\n{table}") if table else
                     f"```c\n{code}\n```\n\n" + NAME.sub(lambda m, own=declared: link(m, own), doc), ""]
        result[name] = "\n".join(text)
    index = ["# Headers\n", "The manual of all functions. `#include <knurl/knurl.h>` includes them all but `gltf.h`.\n",
             "| header | declares |", "|---|---|"]
    for name, found in read.items():
        first = " ".join(comment(re.match(r"/\*(.*?)\*/", headers[name], re.S)[1]).split()).replace("SPDX-License-Identifier: MIT", "")
        sentence = re.match(r"(?:Knurl: )?(.*?\.)(?= |$)", first)[1]
        index.append(f"| [{name}.h]({name}.md) | {sentence} |")
    index += ["", "## All functions", ""]
    for each in sorted(each for each in places if each.startswith("knurl_") and f"{each}()" in
                       {title for found in read.values() for heading, *_ in found for title in heading}):
        index.append(f"- [`{each}()`]({places[each]})")
    result["index"] = "\n".join(index) + "\n"
    return result
