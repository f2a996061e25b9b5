#!/usr/bin/env python3
"""The check finds each fault in a tree with one fault. SPDX-License-Identifier: MIT"""
import os
import stat
import tempfile
import unittest

import check
import picture
import units


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = self.folder.name
        for module in check.MODULES:
            os.makedirs(os.path.join(self.root, "sdk/src", module))

    def write(self, path, text=""):
        path = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def code(self):
        return units.Code(self.root)

    def fake_nm(self, lines):
        """A program that prints the output of nm -A -P."""
        path = self.write("nm", "#!/bin/sh\ncat <<'END'\n" + "\n".join(lines) + "\nEND\n")
        os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return path

    def test_a_source_and_its_header_are_one_unit_whatever_the_system(self):
        for name in ("base/system.h", "base/system_posix.c", "base/system_windows.c"):
            self.write("sdk/src/" + name)
        self.assertEqual(list(self.code().uses), ["base/system"])

    def test_a_module_that_may_use_another_does(self):
        self.write("sdk/src/scene/tick.c", '#include "contact/mesh.h"\n')
        self.write("sdk/src/contact/mesh.h")
        self.assertEqual(check.check_modules(self.code()), [])

    def test_a_module_that_points_back_is_reported(self):
        self.write("sdk/src/contact/mesh.c", '#include "surface/surface.h"\n')
        self.write("sdk/src/surface/surface.h")
        self.assertEqual(check.check_modules(self.code()), ["contact may use base: contact/mesh uses surface/surface"])

    def test_a_public_header_points_back_no_more_than_a_private_one(self):
        self.write("sdk/src/contact/mesh.c", "#include <knurl/scene.h>\n")
        self.write("sdk/include/knurl/motion.h", "#include <knurl/scene.h>\n")
        self.assertEqual(sorted(check.check_modules(self.code())),
                         ["sdk/include/knurl/motion.h: motion may not use <knurl/scene.h>",
                          "sdk/src/contact/mesh.c: contact may not use <knurl/scene.h>"])

    def test_a_sample_sees_public_headers_only(self):
        self.write("samples/hello.c", '#include <knurl/scene.h>\n#include "scene/scene.h"\n#include "base/finite.h"\n')
        self.write("sdk/src/scene/scene.h")
        self.write("sdk/src/base/finite.h")
        self.assertEqual(check.check_modules(self.code()),
                         ['samples/hello.c: only public headers, <knurl/...>, are for bindings and samples, found '
                          '"scene/scene.h"'])

    def test_includes_make_a_circle(self):
        self.write("sdk/src/scene/a.c", '#include "scene/b.h"\n')
        self.write("sdk/src/scene/b.h", '#include "scene/c.h"\n')
        self.write("sdk/src/scene/c.c", '#include "scene/a.h"\n')
        self.write("sdk/src/scene/c.h")
        self.write("sdk/src/scene/a.h")
        self.assertEqual(self.code().circles(), [["scene/a", "scene/b", "scene/c"]])

    def test_what_one_calls_and_another_defines_makes_one_too(self):
        self.write("sdk/src/scene/a.c", '#include "scene/b.h"\n')
        self.write("sdk/src/scene/b.c", '#include "scene/b.h"\nvoid a(void);\n')  # declared by itself
        self.write("sdk/src/scene/b.h")
        code = self.code()
        self.assertEqual(code.circles(), [])
        objects = [f"build/sdk/CMakeFiles/knurl.dir/src/scene/{name}.c.o" for name in "ab"]
        code.add_objects(objects, "build", self.fake_nm([f"{objects[0]}: a T 0 10", f"{objects[1]}: a U",
                                                         f"{objects[1]}: malloc U"]))
        self.assertEqual(code.circles(), [["scene/a", "scene/b"]])

    def header_circle(self, body):
        """The cycles if b.c includes a.h, with that body, and defines b()."""
        self.write("sdk/src/scene/a.h", body)
        self.write("sdk/src/scene/b.c", '#include "scene/a.h"\n')
        code = self.code()
        objects = ["build/sdk/CMakeFiles/knurl.dir/src/scene/b.c.o"]
        code.add_objects(objects, "build", self.fake_nm([f"{objects[0]}: b T 0 10", f"{objects[0]}: rows D 0 10"]))
        return code.circles()

    def test_inline_code_and_macros_of_a_header_make_one_as_a_source_would(self):
        for body in ("static inline int a(void) {\n    return b();\n}\n", "#define A(x) \\\n    b(x)\n",
                     "static inline int a(void) {\n    if (1) {\n    }\n    return rows[1];\n}\n",
                     'extern "C" {\nstatic inline int a(void) { return b(); }\n}\n',
                     "static int (*const a[])(void) = {b};\n"):
            self.assertEqual(self.header_circle(body), [["scene/a", "scene/b"]], body)

    def test_what_a_header_only_declares_or_mentions_makes_none(self):
        for body in ("int b(void);\nextern int rows[];\n", "/* { b() } */ // { b()\n", "typedef struct a {\n    int b;\n} a;\n",
                     "static inline int a(struct x *x) {\n    return x->b + x->y.b;\n}\nint b(void);\n",
                     'static inline const char *a(void) {\n    return "b";\n}\n', "enum { A = 1 };\nint b(void);\n"):
            self.assertEqual(self.header_circle(body), [], body)

    def test_a_header_that_a_program_does_not_include_has_no_part_in_it(self):
        self.write("samples/a.h", "static inline int a(void) { return b(); }\n")
        self.write("samples/b.c", "#include <knurl/knurl.h>\n")
        code = self.code()
        objects = ["build/samples/CMakeFiles/sample.dir/b.c.o"]
        code.add_objects(objects, "build", self.fake_nm([f"{objects[0]}: b T 0 10"]))
        self.assertEqual(code.uses["samples/a"], set())

    def test_calls_among_the_files_of_a_binding_make_a_circle_too(self):
        self.write("bindings/common/force.c")
        self.write("bindings/common/run.c")
        self.write("bindings/common/sound.c")
        code = self.code()
        objects = [f"build/bindings/common/CMakeFiles/knurl_session.dir/{name}.c.o" for name in ("force", "run", "sound")]
        lines = [f"{path}: {symbol} {kind}" for path, symbol, kind in
                 ((objects[0], "check_run", "T 0 10"), (objects[0], "pause", "U"), (objects[1], "pause", "T 0 10"),
                  (objects[1], "take", "U"), (objects[2], "take", "T 0 10"), (objects[2], "check_run", "U"))]
        code.add_objects(objects, "build", self.fake_nm(lines))
        self.assertEqual(code.circles(), [["bindings/common/force", "bindings/common/run", "bindings/common/sound"]])

    def test_a_function_of_one_file_is_no_other_files(self):
        self.write("sdk/src/scene/a.c")
        self.write("sdk/src/scene/b.c")
        code = self.code()
        objects = [f"build/sdk/CMakeFiles/knurl.dir/src/scene/{name}.c.o" for name in "ab"]
        code.add_objects(objects, "build", self.fake_nm([f"{objects[0]}: grow t 0 10", f"{objects[0]}: a T 0 10",
                                                         f"{objects[1]}: grow t 0 10"]))
        self.assertEqual(code.uses, {"scene/a": set(), "scene/b": set()})

    def test_a_circle_that_is_known_is_let_through_and_one_that_is_gone_is_told(self):
        self.write("sdk/src/scene/a.h", '#include "scene/b.h"\n')
        self.write("sdk/src/scene/b.h", '#include "scene/a.h"\n')
        self.assertEqual(len(check.check_circles(self.code(), [])), 1)
        self.assertEqual(check.check_circles(self.code(), [["scene/a", "scene/b", "scene/c"]]), [])
        self.write("sdk/src/scene/b.h")
        self.assertEqual(check.check_circles(self.code(), [["scene/a", "scene/b"]]),
                         ["no circle any more: take scene/a, scene/b out of KNOWN_CIRCLES"])

    def test_a_long_header_is_told_where_headers_are_short(self):
        self.write("sdk/src/scene/long.h", "\n" * 121)
        self.write("sdk/src/scene/fits.h", "\n" * 120)
        self.write("sdk/src/loop/long.h", "\n" * 121)
        self.assertEqual(check.check_headers(self.code(), []), ["sdk/src/scene/long.h: 121 lines, at most 120"])

    def test_a_unit_without_a_place_in_the_picture_is_told(self):
        for box in picture.BOXES.values():
            for unit in box[5]:
                self.write(f"sdk/src/{unit}.c")
        self.assertEqual(picture.draw(self.code())[1], [])
        self.write("sdk/src/scene/new.c")
        self.assertEqual(picture.draw(self.code())[1], ["picture.py: scene/new has no box"])

    def test_another_arrow_is_another_picture(self):
        for box in picture.BOXES.values():
            for unit in box[5]:
                self.write(f"sdk/src/{unit}.c")
        before = picture.draw(self.code())[0]
        self.write("sdk/src/guard/guard.h")
        self.write("sdk/src/hip/snapshot.c", '#include "guard/guard.h"\n')
        self.assertNotEqual(picture.draw(self.code())[0], before)


if __name__ == "__main__":
    unittest.main()
