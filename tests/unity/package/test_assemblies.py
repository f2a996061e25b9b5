#!/usr/bin/env python3
"""The manifest and the assembly definitions meet Unity's rules."""
import json
import os
import re
import unittest

import package

ASSEMBLIES = {  # folder: the assembly, and allowed references
    "Runtime": ("Knurl.Haptics", ["Unity.InputSystem"]),  # if the project has it
    "Editor": ("Knurl.Haptics.Editor", ["Knurl.Haptics"]),
    "Importers/UnityGLTF": ("Knurl.Haptics.UnityGLTF", ["Knurl.Haptics", "UnityGLTFScripts", "GLTFSerialization"]),
    "Importers/glTFast": ("Knurl.Haptics.glTFast", ["Knurl.Haptics", "glTFast", "glTFast.Newtonsoft"]),
    "Tests/Runtime": ("Knurl.Haptics.Tests", ["Knurl.Haptics"]),
    "Tests/Editor": ("Knurl.Haptics.Editor.Tests", ["Knurl.Haptics", "Knurl.Haptics.Editor"]),
}
MODULES = {  # of Unity's own that a project may have switched off: a type that only that module has
    "audio": "AudioSource",
    "imgui": "GUI",
    "jsonserialize": "JsonUtility",
    "physics": "Rigidbody",
}
RUNNERS = {"UnityEngine.TestRunner", "UnityEditor.TestRunner"}


def scripts():
    """Relative paths of the scripts, those of the samples too."""
    for folder, _, names in os.walk(package.PACKAGE):
        for name in names:
            if name.endswith(".cs"):
                yield os.path.relpath(os.path.join(folder, name), package.PACKAGE).replace(os.sep, "/")


class Manifest(unittest.TestCase):
    def setUp(self):
        self.manifest = json.loads(package.read(package.PACKAGE, "package.json"))

    def test_names_the_package_as_unity_wants_it(self):
        self.assertEqual(self.manifest["name"], "com.knurl.haptics")
        self.assertRegex(self.manifest["name"], r"^[a-z0-9._-]{1,50}$")

    def test_has_the_version_of_the_sdk(self):
        self.assertEqual(self.manifest["version"], package.version())
        self.assertIn(f"\n## [{package.version()}]", package.read(package.PACKAGE, "CHANGELOG.md"))

    def test_depends_on_the_modules_whose_types_are_used(self):
        text = "".join(package.read(package.PACKAGE, path) for path in scripts())
        used = {f"com.unity.modules.{name}" for name, word in MODULES.items() if re.search(rf"\b{word}\b", text)}
        self.assertEqual(set(self.manifest["dependencies"]), used)

    def test_says_what_people_read(self):
        for key in ("displayName", "description"):
            self.assertTrue(self.manifest[key].strip(), key)
        self.assertEqual(self.manifest["unity"], "2021.3")
        self.assertEqual(self.manifest["license"], "MIT")
        self.assertTrue(self.manifest["author"]["name"])
        self.assertGreater(len(self.manifest["keywords"]), 3)

    def test_promises_no_address_that_the_project_does_not_have(self):
        text = package.read(package.PACKAGE, "package.json")
        self.assertNotRegex(text, r"https?://")

    def test_samples_are_where_it_says(self):
        listed = [sample["path"] for sample in self.manifest["samples"]]
        found = ["Samples~/" + name for name in os.listdir(os.path.join(package.PACKAGE, "Samples~"))]
        self.assertEqual(sorted(listed), sorted(found))
        for sample in self.manifest["samples"]:
            self.assertTrue(sample["displayName"] and sample["description"])
            self.assertTrue(os.path.isfile(os.path.join(package.PACKAGE, sample["path"], "README.md")))


class Assemblies(unittest.TestCase):
    def setUp(self):
        self.definitions = {}
        for folder, (name, _) in ASSEMBLIES.items():
            self.definitions[folder] = json.loads(package.read(package.PACKAGE, folder, name + ".asmdef"))

    def test_are_those_that_are_listed_here(self):
        found = set()
        for folder, _, names in os.walk(package.PACKAGE):
            found |= {os.path.relpath(folder, package.PACKAGE) for name in names if name.endswith(".asmdef")}
        self.assertEqual(found, set(ASSEMBLIES))

    def test_are_named_as_their_files(self):
        for folder, (name, _) in ASSEMBLIES.items():
            self.assertEqual(self.definitions[folder]["name"], name)

    def test_refer_to_what_is_there(self):
        for folder, (name, allowed) in ASSEMBLIES.items():
            references = set(self.definitions[folder].get("references", []))
            known = set(allowed) | (RUNNERS if folder.startswith("Tests") else set())
            self.assertEqual(references - known, set(), name)

    def test_of_the_editor_stay_in_the_editor(self):
        for folder, definition in self.definitions.items():
            expected = ["Editor"] if folder.endswith("Editor") else []
            self.assertEqual(definition.get("includePlatforms", []), expected, folder)

    def test_may_hold_the_pointers_that_are_in_them(self):
        for path in scripts():
            folder = next((name for name in ASSEMBLIES if path.startswith(name + "/")), None)
            code = re.sub(r"//.*", "", package.read(package.PACKAGE, path))
            if re.search(r"\bunsafe\b", code):
                self.assertIsNotNone(folder, path)
                self.assertTrue(self.definitions[folder].get("allowUnsafeCode"), path)

    def test_of_tests_are_left_out_of_games(self):
        for folder in ("Tests/Runtime", "Tests/Editor"):
            definition = self.definitions[folder]
            self.assertEqual(definition["defineConstraints"], ["UNITY_INCLUDE_TESTS"])
            self.assertEqual(definition["precompiledReferences"], ["nunit.framework.dll"])
            self.assertTrue(definition["overrideReferences"])
            self.assertFalse(definition["autoReferenced"])
            self.assertLessEqual(RUNNERS, set(definition["references"]))

    def test_for_importers_are_compiled_only_if_the_project_has_them(self):
        for folder, package_name in (("UnityGLTF", "org.khronos.unitygltf"), ("glTFast", "com.unity.cloud.gltfast")):
            definition = self.definitions["Importers/" + folder]
            defines = {define["name"]: define["define"] for define in definition["versionDefines"]}
            self.assertEqual(definition["defineConstraints"], [defines[package_name]])
            mine = [define for define in definition["versionDefines"] if define["name"] == package_name]
            self.assertIn(mine[0], self.definitions["Editor"]["versionDefines"])  # files are imported again when it appears

    def test_of_the_package_are_seen_by_games_and_samples(self):
        for folder in ("Runtime", "Editor"):
            self.assertTrue(self.definitions[folder].get("autoReferenced", True), folder)

    def test_take_in_every_script(self):
        for path in scripts():
            self.assertTrue(path.startswith(tuple(name + "/" for name in ASSEMBLIES) + ("Samples~/",)), path)


class Scripts(unittest.TestCase):
    def test_components_and_assets_stand_in_files_of_their_names(self):
        """Unity finds them by it."""
        for path in scripts():
            code = package.read(package.PACKAGE, path)
            for name in re.findall(r"class (\w+)\s*:\s*(?:MonoBehaviour|ScriptableObject)\b", code):
                self.assertEqual(os.path.basename(path), name + ".cs")

    def test_components_and_assets_have_icons(self):
        icons = os.path.join(package.PACKAGE, "Editor", "Icons")
        guids = {re.search(r"guid: (\w+)", package.read(icons, name)).group(1)
                 for name in os.listdir(icons) if name.endswith(".png.meta")}
        for path in scripts():
            if re.search(r"^    public sealed (?:partial )?class \w+\s*:\s*(?:MonoBehaviour|ScriptableObject)\b",
                         package.read(package.PACKAGE, path), re.MULTILINE) and path.startswith("Runtime/"):
                meta = package.read(package.PACKAGE, path + ".meta")
                found = re.search(r"^  icon: \{fileID: 2800000, guid: (\w+), type: 3\}$", meta, re.MULTILINE)
                self.assertTrue(found and found.group(1) in guids, path)

    def test_of_the_runtime_ask_for_no_type_by_its_name(self):
        """IL2CPP strips unreferenced types, and Marshal.SizeOf(Type) fails for types that are not marshalled."""
        for path in scripts():
            if path.startswith("Runtime/"):
                found = re.findall(r"Marshal\.SizeOf|using System\.Reflection|\bType\.GetType|Activator\.",
                                   package.read(package.PACKAGE, path))
                self.assertEqual(found, [], path)

    def test_of_the_runtime_leave_the_editor_alone(self):
        for path in scripts():
            if not path.startswith(("Editor/", "Tests/Editor/")):
                lines = re.sub(r"#if UNITY_EDITOR\n.*?#endif", "", package.read(package.PACKAGE, path), flags=re.DOTALL)
                self.assertNotIn("UnityEditor", re.sub(r"//.*", "", lines), path)


if __name__ == "__main__":
    unittest.main()
