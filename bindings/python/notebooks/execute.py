"""Executes the notebooks, cell by cell, and stores each cell's output and figures in it.
usage: execute.py                 stores the outputs in the notebooks
       execute.py --check FOLDER  changes no notebook: writes the pictures into FOLDER, and prints the time of each
SPDX-License-Identifier: MIT"""
import ast
import base64
import contextlib
import glob
import io
import json
import os
import sys
import tempfile
import time

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot # noqa: E402

DPI = 80
HERE = os.path.dirname(os.path.abspath(__file__))


def run_cell(code, names):
    """Returns the cell's outputs, as nbformat has them: text, the last expression, figures."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, outputs = io.StringIO(), []
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "<cell>", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if last else None
    if printed.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": printed.getvalue().splitlines(True)})
    if value is not None and not code.rstrip().endswith(";"):
        data = {"text/plain": repr(value).splitlines(True)}
        if hasattr(value, "_repr_html_"):
            data["text/html"] = value._repr_html_().splitlines(True)
        outputs.append({"data": data, "execution_count": None, "metadata": {}, "output_type": "execute_result"})
    for number in pyplot.get_fignums():
        picture = io.BytesIO()
        pyplot.figure(number).savefig(picture, dpi=DPI, metadata={"Software": None})
        outputs.append({"data": {"image/png": base64.b64encode(picture.getvalue()).decode()}, "metadata": {},
                        "output_type": "display_data"})
    pyplot.close("all")
    return outputs


def execute(path):
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cell for cell in notebook["cells"] if cell["cell_type"] == "code"):
        cell["execution_count"], cell["outputs"] = number + 1, run_cell("".join(cell["source"]), names)
        for output in cell["outputs"]:
            if "execution_count" in output:
                output["execution_count"] = number + 1
    return notebook


def main():
    folder = sys.argv[2] if sys.argv[1:2] == ["--check"] else None
    for path in sorted(glob.glob(os.path.join(HERE, "*.ipynb"))):
        name, start, before = os.path.splitext(os.path.basename(path))[0], time.monotonic(), os.getcwd()
        with tempfile.TemporaryDirectory() as work:
            os.chdir(work)
            notebook = execute(path)
            os.chdir(before)
        pictures = [output["data"]["image/png"] for cell in notebook["cells"] for output in cell.get("outputs", ())
                    if "image/png" in output.get("data", ())]
        if folder is None:
            with open(path, "w", encoding="utf-8") as file:
                json.dump(notebook, file, indent=1)
                file.write("\n")
        for number, picture in enumerate(pictures if folder else ()):
            with open(os.path.join(folder, f"{name}_{number}.png"), "wb") as file:
                file.write(base64.b64decode(picture))
        print(f"{name}: {time.monotonic() - start:.1f} s, {len(pictures)} pictures")


main()
