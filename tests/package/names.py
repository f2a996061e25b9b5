"""The output of ./run on systems without apt-get: missing packages by the system's names, as in docs/building.md
them. Their package managers are stood in for. usage: names.py SOURCE FOLDER"""
import os
import shutil
import subprocess
import sys

SOURCE, FOLDER = sys.argv[1:]
INSTALLED = {"glm-devel", "glm"}
ROWS = [  # manager, its query command, its output for g++, ninja-build and libglm-dev (installed)
    ("dnf", "rpm", "sudo dnf install gcc-c++ ninja-build\n"),
    ("pacman", "pacman", "sudo pacman -S gcc ninja\n"),
    ("zypper", "rpm", "sudo zypper install gcc-c++ ninja\n"),
]


def need(folder, *packages):
    done = subprocess.run([shutil.which("bash"), "-euo", "pipefail", "-c", 'source scripts/setup.sh; need_packages "$@"',
                           "bash", *packages], cwd=SOURCE, env={"PATH": folder}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def folder_with(name, programs):
    """A folder with only awk and those programs, which list installed packages."""
    folder = os.path.join(FOLDER, name)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.symlink(shutil.which("awk"), os.path.join(folder, "awk"))
    for program in programs:
        path = os.path.join(folder, program)
        with open(path, "w", encoding="utf-8") as file:
            file.write(f'#!{shutil.which("sh")}\nfor name in {" ".join(sorted(INSTALLED))}; do\n'
                       '[ "$2" != "$name" ] || exit 0\ndone\nexit 1\n')
        os.chmod(path, 0o755)
    return folder


def main():
    wrong = []
    for manager, asked, expected in ROWS:
        folder = folder_with(manager, {manager, asked})
        code, said = need(folder, "g++", "ninja-build", "libglm-dev")
        if code != 3 or not said.endswith(expected) or said.count("\n") != 1:
            wrong.append(f"{manager}: expected exit 3 and {expected!r}, found exit {code} and {said!r}")
        code, said = need(folder, "libglm-dev")
        if code != 0 or said:
            wrong.append(f"{manager}: expected nothing to be missing, found exit {code} and {said!r}")
    code, said = need(folder_with("none", ()), "g++")
    if code != 0 or "g++" not in said:
        wrong.append(f"an unknown system: expected that it goes on and says g++, found exit {code} and {said!r}")
    print("\n".join(wrong) or "names: all good")
    return 1 if wrong else 0


sys.exit(main())
