"""The mirror of Knurl's headers is up to date, and all sources of errors are detected.
usage: test_mirror.py FOLDER      FOLDER: for changed copies of the headers
"""
import contextlib
import importlib.util
import io
import pathlib
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
MIRROR = "bindings/unity/native/mirror.py"
CS = "bindings/unity/package/Runtime/NativeMethods.g.cs"
LAYOUT = "bindings/unity/native/layout.g.h"
EXPORTS = "bindings/unity/native/exports.g.def"
COPIED = ["sdk/include/knurl/*.h", "bindings/common/*.h", "bindings/unity/native/*", CS]
folder = None


class MirrorTest(unittest.TestCase):
    """Each test has a copy of the headers and of the generated files."""

    def setUp(self):
        shutil.rmtree(folder, ignore_errors=True)
        for pattern in COPIED:
            for source in filter(pathlib.Path.is_file, ROOT.glob(pattern)):
                target = folder / source.relative_to(ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        spec = importlib.util.spec_from_file_location("mirror", folder / MIRROR)
        self.mirror = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.mirror)

    def change(self, header, old, new):
        path = folder / header
        text = path.read_text()
        self.assertEqual(text.count(old), 1, f"'{old}' in {header}")
        path.write_text(text.replace(old, new))

    def declare(self, text):
        """Adds a declaration to scene.h; returns its line's number."""
        self.change("sdk/include/knurl/scene.h", "/** Creates an empty scene.", text + "\n/** Creates an empty scene.")
        lines = (folder / "sdk/include/knurl/scene.h").read_text().splitlines()
        return 1 + lines.index(text.splitlines()[0])

    def check(self):
        """The exit code and output of --check."""
        said = io.StringIO()
        arguments, sys.argv = sys.argv, ["mirror.py", "--check"]
        try:
            with contextlib.redirect_stderr(said):
                return self.mirror.main(), said.getvalue()
        finally:
            sys.argv = arguments

    def expect_stale(self, *said):
        code, text = self.check()
        self.assertEqual(code, 1, text)
        for part in said:
            self.assertIn(part, text)

    def expect_refused(self, declaration, said, line=0):
        at = self.declare(declaration) + line
        code, text = self.check()
        self.assertEqual(code, 1, text)
        self.assertIn(f"sdk/include/knurl/scene.h:{at}: ", text)
        self.assertIn(said, text)

    # --- committed files ---

    def test_made_anew_it_is_the_same_to_the_byte(self):
        before = [(folder / path).read_bytes() for path in (CS, LAYOUT, EXPORTS)]
        for path in (CS, LAYOUT, EXPORTS):
            (folder / path).unlink()
        subprocess.run([sys.executable, "-B", folder / MIRROR], check=True)
        self.assertEqual([(folder / path).read_bytes() for path in (CS, LAYOUT, EXPORTS)], before)

    def test_a_comment_may_change(self):
        self.change("sdk/include/knurl/scene.h", "Creates an empty scene.", "Creates a scene without surfaces.")
        self.assertEqual(self.check(), (0, ""))

    # --- outdated files ---

    def test_a_new_field_is_noticed(self):
        self.change("sdk/include/knurl/gltf.h", "uint32_t skipped;", "uint32_t skipped; uint32_t broken;")
        self.expect_stale(CS, LAYOUT, "+        public uint broken;")

    def test_a_field_of_another_type_and_the_same_size_is_noticed(self):
        self.change("sdk/include/knurl/loop.h", "int32_t state; ", "uint32_t state; ")
        self.expect_stale(CS, LAYOUT, "+        public uint state;", "-        public int state;")

    def test_fields_that_change_places_are_noticed(self):
        self.change("sdk/include/knurl/gltf.h", "uint32_t surfaces;", "uint32_t skipped_;")
        self.change("sdk/include/knurl/gltf.h", "uint32_t skipped;", "uint32_t surfaces;")
        self.expect_stale(CS, LAYOUT)

    def test_an_array_of_another_length_is_noticed(self):
        self.change("bindings/common/session.h", "double hip[3];", "double hip[4];")
        self.expect_stale("public fixed double hip[4];")

    def test_a_further_parameter_is_noticed(self):
        self.change("sdk/include/knurl/loop.h", "loop, uint64_t ticks", "loop, uint64_t ticks, int32_t fast")
        self.expect_stale("knurl_loop_step(knurl_loop* loop, ulong ticks, int fast)")

    def test_a_parameter_of_another_type_is_noticed(self):
        self.change("bindings/common/session.h", "uint32_t count, float *rows", "uint64_t count, float *rows")
        self.expect_stale("knurl_session_get_history(SessionHandle session, ulong count, float* rows)")

    def test_another_result_is_noticed(self):
        self.change("bindings/unity/native/knurl_unity.h", "uint32_t knurl_unity_layout", "uint64_t knurl_unity_layout")
        self.expect_stale("+        internal static extern ulong knurl_unity_layout")

    def test_a_new_function_is_noticed_and_would_be_exported(self):
        self.declare("KNURL_API void knurl_scene_sing(knurl_scene *scene, const char *song);")
        self.expect_stale(CS, EXPORTS, "knurl_scene_sing(knurl_scene* scene, byte* song);")

    def test_another_number_is_noticed(self):
        self.change("bindings/common/session.h", "KNURL_SESSION_HISTORY 8192", "KNURL_SESSION_HISTORY 4096")
        self.expect_stale("+        internal const int KNURL_SESSION_HISTORY = 4096;")

    def test_another_callback_is_noticed(self):
        self.change("sdk/include/knurl/loop.h", "int64_t deadline_ns", "double deadline_ns")
        self.expect_stale("knurl_clock_sleep_until_ns(double deadline_ns, IntPtr user)")

    def test_an_edited_mirror_is_noticed(self):
        self.change(CS, "internal const int KNURL_METHOD_BANDLIMITED = 3;", "internal const int KNURL_METHOD_BANDLIMITED = 2;")
        self.expect_stale("+        internal const int KNURL_METHOD_BANDLIMITED = 3;")

    def test_anything_mirrored_changes_the_interfaces_digits(self):
        digits = self.mirror.generate()["layout"].split('"')[1]
        self.change("sdk/include/knurl/loop.h", "int32_t state; ", "uint32_t state; ")
        self.assertNotEqual(self.mirror.generate()["layout"].split('"')[1], digits)

    # --- declarations that cannot be mirrored ---

    def test_what_is_of_another_size_on_windows_is_refused(self):
        self.expect_refused("struct knurl_odd {\n    long odd;\n};", "'long'", 1)

    def test_long_double_is_refused(self):
        self.expect_refused("KNURL_API void knurl_odd(long double odd);", "'long double'")

    def test_a_bit_field_is_refused(self):
        self.expect_refused("struct knurl_odd {\n    uint32_t odd : 3;\n};", "only plain fields", 1)

    def test_a_union_is_refused(self):
        self.expect_refused("union knurl_odd { int32_t a; double b; };", "a union decl cannot be mirrored")
        self.setUp()
        self.expect_refused("struct knurl_odd {\n    union { int32_t a; double b; } odd;\n};", "only plain fields", 1)

    def test_an_enum_with_a_name_is_refused(self):
        self.expect_refused("enum knurl_odd { KNURL_ODD };", "an enum's size")
        self.setUp()
        self.expect_refused("struct knurl_odd {\n    enum { KNURL_ODD } odd;\n};", "only plain fields", 1)

    def test_a_struct_by_value_is_refused(self):
        self.expect_refused("KNURL_API void knurl_odd(knurl_material_desc odd);", "goes by value")
        self.setUp()
        self.expect_refused("KNURL_API knurl_material_desc knurl_odd(void);", "goes by value")

    def test_a_layout_that_is_not_the_natural_one_is_refused(self):
        packed = "#pragma pack(push, 1)\nstruct knurl_odd {\n    char a;\n    double odd;\n};\n#pragma pack(pop)"
        self.expect_refused(packed, "elsewhere", 3)
        self.setUp()
        self.expect_refused("struct __attribute__((aligned(16))) knurl_odd {\n    double odd;\n};", "another alignment")

    def test_a_number_that_has_to_be_reckoned_is_refused(self):
        self.expect_refused("#define KNURL_ODD (1 << 3)", "only plain numbers")
        self.setUp()
        self.expect_refused("#define KNURL_ODD INFINITY", "only plain numbers")

    def test_a_variable_is_refused(self):
        self.expect_refused("extern int32_t knurl_odd;", "a var decl cannot be mirrored")

    def test_a_header_that_does_not_compile_is_told_with_its_line(self):
        line = self.declare("KNURL_API void knurl_odd(knurl_nothing *nothing);")
        code, text = self.check()
        self.assertEqual(code, 1)
        self.assertIn(f"scene.h:{line}", text.replace(str(folder), ""))
        self.assertIn("knurl_nothing", text)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv.pop()).resolve()
    unittest.main()
