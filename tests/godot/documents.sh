#!/usr/bin/env bash
# Compares the class reference with the engine's view of the classes: exactly their properties, methods and signals are
# described; and the scripts that stand in for the classes with the reference. usage: documents.sh LIBRARY FOLDER
# Exit 77: there is no engine, see run.sh.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
library=$1 folder=$2
engine=${KNURL_GODOT_ROOT:-$root/build/godot-engine}
if [ ! -x "$engine/root/usr/bin/godot" ]; then
    echo "skipped: no Godot in $engine; bindings/godot/engine/fetch.sh $engine brings it"
    exit 77
fi
/usr/bin/python3 -B "$root/bindings/godot/standins.py" --check
rm -rf "$folder"
mkdir -p "$folder/.godot"
cd "$folder"
cp "$here"/project.godot "$here"/knurl.gdextension "$library" .
echo 'res://knurl.gdextension' >.godot/extension_list.cfg
timeout 60 "$root/bindings/godot/engine/run.sh" "$engine" \
    godot --headless --path . --doctool . --gdextension-docs </dev/null >log 2>&1 || { cat log; exit 1; }
/usr/bin/python3 - "$root/bindings/godot/doc_classes" doc_classes <<'PYTHON'
import pathlib
import sys
import xml.etree.ElementTree as tree

# An element's attributes; compared with the engine's.
KEYS = {"member": ("name", "type", "setter", "getter", "default"), "method": ("name",), "signal": ("name",),
        "param": ("name", "type"), "return": ("type",)}


def facts(path):
    found = set()
    def walk(element, above):
        here = above
        if element.tag in KEYS:
            here = above + tuple([element.tag] + [f"{key}={element.get(key)}" for key in KEYS[element.tag] if element.get(key)])
            if element.tag != "return" or element.get("type") != "void":
                found.add(here)
        for child in element:
            walk(child, here)
    walk(tree.parse(path).getroot(), ())
    return found


ours, theirs = map(pathlib.Path, sys.argv[1:])
names = sorted(path.name for path in theirs.glob("*.xml"))
failed = names != sorted(path.name for path in ours.glob("*.xml"))
for name in names:
    written, real = facts(ours / name), facts(theirs / name)
    failed = failed or written != real
    for fact in sorted(written ^ real):
        print(f"{name}: {'only written' if fact in written else 'not written'}: {' '.join(fact)}")
    empty = [e.get("name") for e in tree.parse(ours / name).getroot().iter() if e.tag == "member" and not (e.text or "").strip()]
    failed = failed or bool(empty)
print(f"documents: {', '.join(names)}: {'differ' if failed else 'complete'}")
sys.exit(failed)
PYTHON
