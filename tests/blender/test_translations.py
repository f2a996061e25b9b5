"""The panel in other languages. SPDX-License-Identifier: MIT"""
import ast
import inspect
import re
import sys

import installed
from installed import NAME, bpy


class Translations(installed.Case):
    def setUp(self):
        super().setUp()
        self.languages = sys.modules[NAME + ".translations"].LANGUAGES

    def test_every_word_of_the_panel_is_in_every_language(self):
        shown = {prop.name for prop in self.material.bl_rna.properties if prop.identifier.startswith("knurl_")}
        shown |= {prop.description for prop in self.material.bl_rna.properties if prop.identifier.startswith("knurl_")}
        self.assertGreater(len(shown), 20)
        panel = sys.modules[NAME + ".panel"]
        for call in ast.walk(ast.parse(inspect.getsource(panel))):
            if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "translated":
                shown |= {node.value for node in ast.walk(call.args[0]) if isinstance(node, ast.Constant)}
        shown |= {"Show Ridges", "Feel", "Copy to Selected", "Everyday Material", "Ridges from Texture"}
        for words in self.languages.values():
            self.assertEqual({word for word in shown - set(words) if word != "Knurl"}, set())

    def test_formats_keep_their_fields(self):
        for words in self.languages.values():
            for english, other in words.items():
                self.assertEqual(sorted(re.findall(r"{[^}]*}", english)), sorted(re.findall(r"{[^}]*}", other)))

    def test_a_warning_is_in_the_language_of_the_interface(self):
        view = bpy.context.preferences.view
        try:
            view.language = "de_DE"
        except TypeError as why:  # bpy as a module brings no languages
            self.skipTest(str(why))
        view.use_translate_interface = True
        self.addCleanup(setattr, view, "language", "en_US")
        self.material.knurl_on = True
        self.material.knurl_hardness = 900.0
        self.assertEqual(sys.modules[NAME + ".panel"].warnings_of(self.material), ["Steifer, als ein Touch halten kann (800 N/m)"])
