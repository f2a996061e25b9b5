#!/usr/bin/env python3
"""The .meta files of the Unity package: one beside each file and folder, with a guid that scenes refer to.

usage: metas.py --write [FOLDER]            writes missing ones; existing ones are not changed
       metas.py --check [--packed] [FOLDER]  prints one line per error; exit 1 if there are any

A guid comes from the file's path in the package when its meta is made, and moves with the meta afterwards. Without
--packed, the metas of native libraries may stand alone: the libraries themselves are put beside them by package.sh.
"""
import argparse
import hashlib
import os
import re
import sys

PACKAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "package")
NAME = "com.knurl.haptics"

# The native libraries: their folders, and the editor's words for their system, player and processor.
LIBRARIES = {
    "Plugins/Linux/x86_64/libknurl_unity.so": ("Linux", "Linux64", "x86_64"),
    "Plugins/macOS/libknurl_unity.dylib": ("OSX", "OSXUniversal", "AnyCPU"),
    "Plugins/Windows/x86_64/knurl_unity.dll": ("Windows", "Win64", "x86_64"),
}
PLAYERS = ("Linux64", "OSXUniversal", "Win", "Win64")

IMPORTERS = {
    ".cs": "MonoImporter",
    ".asmdef": "AssemblyDefinitionImporter",
    ".md": "TextScriptImporter",
    ".asset": "NativeFormatImporter",
    ".so": "PluginImporter",
    ".dll": "PluginImporter",
    ".dylib": "PluginImporter",
    ".unity": "DefaultImporter",
    ".shader": "ShaderImporter",
    ".hlsl": "ShaderIncludeImporter",
    ".png": "TextureImporter",
}
BODIES = {
    "MonoImporter": "  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n"
    "  icon: {instanceID: 0}\n",
    "TextureImporter": "  serializedVersion: 12\n  mipmaps:\n    mipMapMode: 0\n    enableMipMap: 0\n    sRGBTexture: 1\n"
    "  alphaIsTransparency: 1\n  textureType: 2\n  textureShape: 1\n", # 2: of the editor's interface
    "ShaderImporter": "  externalObjects: {}\n  defaultTextures: []\n  nonModifiableTextures: []\n"
    "  preprocessorOverride: 0\n",
    "NativeFormatImporter": "  externalObjects: {}\n  mainObjectFileID: 11400000\n",
}
# The scripts whose components and assets have an icon, which icons.py draws.
ICONS = {
    "device": ("KnurlDevice", "KnurlCursor", "KnurlMouse", "KnurlRumble", "KnurlSound"),
    "effect": ("KnurlEffect",),
    "grating": ("KnurlGrating",),
    "surface": ("KnurlSurface", "KnurlStripes", "KnurlGeometry"),
}
NO_ICON = "icon: {instanceID: 0}"
PLAIN_BODY = "  externalObjects: {}\n"
TAIL = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"


SAMPLES = "Samples~"  # its folders are copied into projects, with their metas


def is_ignored(name):
    """True for names that Unity ignores: hidden files, and folders and files that end in ~."""
    return name.startswith(".") or (name.endswith("~") and name != SAMPLES) or name.lower().endswith(".tmp")


def walk(package):
    """Relative paths, with /, of the folders, files and metas that Unity imports."""
    folders, files, metas = set(), set(), set()
    for folder, inner, names in os.walk(package):
        inner[:] = sorted(name for name in inner if not is_ignored(name))
        below = os.path.relpath(folder, package).replace(os.sep, "/")
        below = "" if below == "." else below + "/"
        folders.update(below + name for name in inner if name != SAMPLES and below != SAMPLES + "/")
        for name in names:
            if not is_ignored(name):
                (metas if name.endswith(".meta") else files).add(below + name)
    return folders, files, metas


def importer_of(path, is_folder):
    """The importer that a meta must name, or None for an unknown kind of file."""
    if is_folder:
        return "DefaultImporter"
    if path == "package.json":
        return "PackageManifestImporter"
    return IMPORTERS.get(os.path.splitext(path)[1])


def guid_of(path):
    return hashlib.md5(f"{NAME}/{path}".encode()).hexdigest()


def plugin_body(path):
    """The settings of a native library: only for the editor and player of its own system and processor."""
    system, player, cpu = LIBRARIES[path]
    lines = [
        "  externalObjects: {}",
        "  serializedVersion: 2",
        "  iconMap: {}",
        "  executionOrder: {}",
        "  defineConstraints: []",
        "  isPreloaded: 0",
        "  isOverridable: 0",
        "  isExplicitlyReferenced: 0",
        "  validateReferences: 1",
        "  platformData:",
        "  - first:",
        "      : Any",
        "    second:",
        "      enabled: 0",
        "      settings:",
        "        Exclude Editor: 0",
    ]
    lines += [f"        Exclude {name}: {int(name != player)}" for name in PLAYERS]
    lines += ["  - first:", "      Any: ", "    second:", "      enabled: 0", "      settings: {}"]
    lines += ["  - first:", "      Editor: Editor", "    second:", "      enabled: 1", "      settings:"]
    lines += [f"        CPU: {cpu}", "        DefaultValueInitialized: true", f"        OS: {system}"]
    for name in PLAYERS:
        on = name == player
        lines += ["  - first:", f"      Standalone: {name}", "    second:", f"      enabled: {int(on)}"]
        lines += ["      settings:", f"        CPU: {cpu if on else 'None'}"]
    return "\n".join(lines) + "\n"


def icon_of(path):
    for name, scripts in ICONS.items():
        if path in (f"Runtime/{script}.cs" for script in scripts):
            return f"icon: {{fileID: 2800000, guid: {guid_of(f'Editor/Icons/{name}.png')}, type: 3}}"
    return NO_ICON


def meta_text(path, is_folder, importer):
    body = plugin_body(path) if importer == "PluginImporter" else BODIES.get(importer, PLAIN_BODY)
    body = body.replace(NO_ICON, icon_of(path))
    folder = "folderAsset: yes\n" if is_folder else ""
    return f"fileFormatVersion: 2\nguid: {guid_of(path)}\n{folder}{importer}:\n{body}{TAIL}"


def write(package):
    folders, files, metas = walk(package)
    made = 0
    for path in sorted(folders | files | set(LIBRARIES)):
        importer = importer_of(path, path in folders)
        if importer is None:
            sys.exit(f"metas: {path}: no importer is known for such files; name one in IMPORTERS")
        if path + ".meta" in metas or not os.path.isdir(os.path.dirname(os.path.join(package, path))):
            continue
        with open(os.path.join(package, path + ".meta"), "w", encoding="utf-8", newline="\n") as meta:
            meta.write(meta_text(path, path in folders, importer))
        made += 1
    print(f"metas: {made} made, {len(metas)} were there")


def check_meta(path, text, is_folder):
    """The errors of one meta, one sentence each, and its guid or None."""
    head = re.match(r"fileFormatVersion: 2\nguid: ([^\n]*)\n", text)
    if head is None:
        return ["malformed: expected 'fileFormatVersion: 2' and 'guid: ...' as its first two lines"], None
    wrong = []
    guid = head.group(1)
    if not re.fullmatch(r"[0-9a-f]{32}", guid) or guid == 32 * "0":
        wrong.append(f"malformed guid: expected 32 hexadecimal digits that are not all 0, found '{guid}'")
        guid = None
    expected = importer_of(path, is_folder)
    named = re.findall(r"^(\w+Importer):$", text, re.MULTILINE)
    if named != [expected]:
        wrong.append(f"wrong importer: expected {expected}, found {', '.join(named) or 'none'}")
    if ("\nfolderAsset: yes\n" in text) != is_folder:
        wrong.append("wrong kind: expected 'folderAsset: yes' for folders, and only for folders")
    if path in LIBRARIES and plugin_body(path) not in text:
        system, player, cpu = LIBRARIES[path]
        wrong.append(
            f"wrong platforms: expected Any off, Editor ({system}) and Standalone {player} on, CPU {cpu}, and nothing else"
        )
    return wrong, guid


def check(package, is_packed):
    """All errors, one line each."""
    folders, files, metas = walk(package)
    faults = [f"{path}: missing: it has no .meta" for path in folders | files if path + ".meta" not in metas]
    owners = {}
    for meta in metas:
        path = meta[: -len(".meta")]
        stands_alone = path in LIBRARIES and not is_packed
        if path not in folders | files and not stands_alone:
            faults.append(f"{meta}: orphan: there is no {path}")
        with open(os.path.join(package, meta), encoding="utf-8", newline="") as file:
            wrong, guid = check_meta(path, file.read(), path in folders)
        faults += [f"{meta}: {sentence}" for sentence in wrong]
        if guid is not None:
            owners.setdefault(guid, []).append(meta)
    for guid, names in owners.items():
        if len(names) > 1:
            faults.append(f"{', '.join(sorted(names))}: duplicate guid {guid}")
    return sorted(faults)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--write", action="store_true")
    task.add_argument("--check", action="store_true")
    parser.add_argument("--packed", action="store_true", help="the libraries have to be there")
    parser.add_argument("folder", nargs="?", default=PACKAGE)
    arguments = parser.parse_args()
    if not os.path.isfile(os.path.join(arguments.folder, "package.json")):
        sys.exit(f"metas: {arguments.folder}: expected a Unity package, found no package.json there")
    if arguments.write:
        write(arguments.folder)
        return 0
    faults = check(arguments.folder, arguments.packed)
    for fault in faults:
        print(f"metas: {fault}", file=sys.stderr)
    if not faults:
        print(f"metas: {len(walk(arguments.folder)[2])} are as they should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
