#!/usr/bin/python3
"""The lint of output finds every call that bypasses say(). SPDX-License-Identifier: MIT"""
import unittest

import printing


class Printing(unittest.TestCase):
    def refused(self, line, path="samples/study/new.c"):
        return bool(printing.check(path, f"void f(void) {{\n    {line}\n}}\n"))

    def test_a_name_on_a_terminal_is_found(self):
        for line in ('printf("%s\\n", name);', 'printf("%-20s", name);', 'printf("%.*s", 3, name);', 'fprintf(stderr, "%s", name);',
                     'fprintf(stdout, "a"\n        "%s", name);', "puts(name);", "fputs(name, stderr);", "fputs(found ? name : \"\", stdout);",
                     "perror(name);", "printf(format, 1);", "fwrite(name, 1, 3, stdout);", "write(2, name, 3);",
                     "write(STDERR_FILENO, name, 3);", "vfprintf(stderr, format, list);", "dprintf(2, \"%s\", name);",
                     "fputs_unlocked(name, stdout);"):
            self.assertTrue(self.refused(line), line)

    def test_numbers_files_and_other_calls_are_not(self):
        for line in ('printf("%5.1f %d %%s\\n", 1.0, 2);', 'fputs("t,x\\n", csv);', 'fprintf(csv, "%s,", name);', 'say(stdout, "%s", name);',
                     'snprintf(text, sizeof text, "%s", name);', '/* printf("%s", name) */', "reader.write(2, name, 3);",
                     'puts("a sentence");', "fputc(10, stderr);", 'fputs("printf(name)", csv);'):
            self.assertFalse(self.refused(line), line)

    def test_the_tool_prints_by_its_writers_alone(self):
        for line in ('printf("%d", 1);', 'puts("a sentence");', 'fprintf(csv, "%g", x);', "fputc(10, stream);"):
            self.assertTrue(self.refused(line, "samples/knurl/new.c"), line)
            self.assertFalse(self.refused(line, "samples/common/csv.c"), line)
        self.assertFalse(self.refused('say(stdout, "%s", name);', "samples/knurl/new.c"))

    def test_the_line_is_named(self):
        found = printing.check("samples/knurl/new.c", "\n\n  puts(name);\n")
        self.assertEqual([line.split(": ")[0] for line in found], ["samples/knurl/new.c:3"])

    def test_python_prints_by_one_line(self):
        wrong = ("print(name)", "sys.exit(f'{path}: no')", "print('a', name)", "sys.stderr.write(name)")
        right = ("print(one_line(name))", "print(__doc__)", "sys.exit(0 if good else 2)", "print('a sentence')",
                 "try:\n    pass\nexcept BadInput as error:\n    sys.exit(f'plot.py: {error}')")
        for text in wrong:
            self.assertTrue(printing.check_python("samples/draw_run.py", text), text)
        for text in right:
            self.assertFalse(printing.check_python("samples/draw_run.py", text), text)


if __name__ == "__main__":
    unittest.main()
