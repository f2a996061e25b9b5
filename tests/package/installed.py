#!/usr/bin/python3
"""Installs Knurl as others do, moves the tree, and builds consumers against it: C and C++, by find_package() and by
pkg-config; shared, static, and the core alone without a C++ compiler.
usage: installed.py SOURCE BUILD FOLDER C_COMPILER CXX_COMPILER C_FLAGS CXX_FLAGS
BUILD: of the static libraries; C_FLAGS, CXX_FLAGS: its compile flags, so that ccache has the others' objects, too;
they are built beside it, for with CCACHE_BASEDIR ccache compares paths as seen from the folder of the build; FOLDER: kept
for the next time.
SPDX-License-Identifier: MIT"""
import os
import re
import shutil
import subprocess
import sys

SOURCE, BUILD, FOLDER, CC, CXX, C_FLAGS, CXX_FLAGS = sys.argv[1:]
CONSUMER = os.path.join(SOURCE, "tests/package/consumer")
SCENE = os.path.join(SOURCE, "assets/plate_1d.glb")


def run(*command, env=None, fails=False):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=FOLDER,
                          env={**os.environ, **(env or {})})
    if (done.returncode != 0) != fails:
        sys.exit(f"installed: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def check(what, good):
    print(f"installed: {'ok  ' if good else 'FAIL'} {what}")
    if not good:
        sys.exit(1)


def build(name, targets, *options):
    """Configures and builds; returns the folder."""
    folder = f"{BUILD}-{name}"
    run("cmake", "-G", "Ninja", "-S", SOURCE, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_C_COMPILER={CC}",
        f"-DCMAKE_C_FLAGS_RELEASE={C_FLAGS}", f"-DCMAKE_CXX_FLAGS_RELEASE={CXX_FLAGS}", "-DBUILD_TESTING=OFF",
        "-DKNURL_GODOT=OFF", "-DKNURL_UNITY=OFF", "-DCMAKE_INSTALL_LIBDIR=lib",
        f"-DKNURL_WARNINGS_AS_ERRORS={os.environ['KNURL_WARNINGS_AS_ERRORS']}", *options)
    run("cmake", "--build", folder, "--target", *targets)
    return folder


def install(name, folder, *components):
    """Installs from a build folder, then moves the installation; returns its folder."""
    first, prefix = (os.path.join(FOLDER, name + part) for part in (".first", ""))
    for path in (first, prefix):
        shutil.rmtree(path, ignore_errors=True)
    for component in ("runtime", "dev", *components):
        run("cmake", "--install", folder, "--component", component, "--prefix", first)
    os.rename(first, prefix)
    return prefix


def configure_consumer(prefix, *options, fails=False):
    shutil.rmtree(prefix + ".consumer", ignore_errors=True)
    return run("cmake", "-G", "Ninja", "-S", CONSUMER, "-B", prefix + ".consumer", f"-DCMAKE_PREFIX_PATH={prefix}",
               f"-DCMAKE_C_COMPILER={CC}", *options, fails=fails)


def check_programs(prefix, folder, programs, kind, version):
    env = {"LD_LIBRARY_PATH": os.path.join(prefix, "lib") if kind == "pkg-config" else ""}
    output = run(os.path.join(folder, "plate"), env=env)
    check(f"{os.path.basename(prefix)}, {kind}, C: {output.strip()}", output == f"0.400000 N, knurl {version}\n")
    if "scene" in programs:
        output = run(os.path.join(folder, "scene"), SCENE, env=env)
        check(f"{os.path.basename(prefix)}, {kind}, C++: {output.strip()}", output.startswith("3 surfaces, "))


def check_pkg_config(prefix, programs, version):
    env = {"PKG_CONFIG_PATH": os.path.join(prefix, "lib/pkgconfig")}
    folder = prefix + ".pkg-config"
    os.makedirs(folder, exist_ok=True)
    for program in programs:
        package, compiler, source = (("knurl", CC, "plate.c"), ("knurl_gltf", CXX, "scene.cpp"))[program == "scene"]
        flags = run("pkg-config", "--cflags", "--libs", package, env=env).split()
        run(compiler, os.path.join(CONSUMER, source), "-o", os.path.join(folder, program), *flags, "-lm")
    check_programs(prefix, folder, programs, "pkg-config", version)


def check_tree(prefix, programs, version, *options):
    configure_consumer(prefix, f"-DWANTED={version}", *options)
    run("cmake", "--build", prefix + ".consumer")
    check_programs(prefix, prefix + ".consumer", programs, "find_package", version)
    check_pkg_config(prefix, programs, version)
    said = configure_consumer(prefix, "-DWANTED=99.0", *options, fails=True)
    check(f"{os.path.basename(prefix)}: another version is not found", "99.0" in said)


def check_exports(prefix):
    """Only symbols that the headers declare are exported."""
    folder = os.path.join(prefix, "lib")
    for library in ("libknurl.so", "libknurl_gltf.so"):
        path = os.path.join(folder, library)
        names = [line.split()[-1] for line in run("nm", "--dynamic", "--defined-only", path).splitlines()]
        strangers = [name for name in names if not name.startswith("knurl_")]
        check(f"{library} exports {len(names)} functions of ours, and {strangers}", names and not strangers)
        soname = re.search(r"SONAME.*\[(.*)\]", run("readelf", "--dynamic", path)).group(1)
        check(f"{library} is {soname}", os.path.exists(os.path.join(folder, soname)))


def check_links(prefix):
    """Installed pages have no links to files of the repository."""
    folder = os.path.join(prefix, "share/doc/knurl")
    pages = [name for name in sorted(os.listdir(folder)) if name.endswith(".md")]
    for name in pages:
        with open(os.path.join(folder, name), encoding="utf-8") as page:
            dead = [link for link in re.findall(r"\]\(([^)]*)\)", page.read()) if not link.startswith("https:")]
        check(f"{name} has dead links: {dead}" if dead else f"{name} has no dead links", not dead)
    check(f"pages: {', '.join(pages)}", pages == ["CHANGELOG.md", "THIRD_PARTY.md"])


def check_shown(prefix):
    """The pages' CMake builds a game against the installation, and configures with the sources in a subfolder."""
    shown = run(sys.executable, "-B", os.path.join(SOURCE, "tests/docs/snippets.py"), "write", "cmake", FOLDER).split()
    seen = set()
    for path in shown:
        with open(path, encoding="utf-8") as file:
            code = re.sub(r"\s*#.*", "", file.read())
        if code in seen: # two pages show the same but for comments
            continue
        seen.add(code)
        game, inside = path[:-len(".txt")], re.sub(r"find_package\(knurl.*?\)", f"add_subdirectory({SOURCE} knurl)", code)
        for folder, text in ((game, code), (game + "_inside", inside)):
            os.makedirs(folder, exist_ok=True)
            shutil.copy(os.path.join(SOURCE, "samples/feel_scene.c"), os.path.join(folder, "game.c"))
            with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
                file.write(text)
            run("cmake", "-G", "Ninja", "-S", folder, "-B", folder + ".build", f"-DCMAKE_PREFIX_PATH={prefix}",
                f"-DCMAKE_C_COMPILER={CC}", f"-DCMAKE_CXX_COMPILER={CXX}", "-DBUILD_TESTING=OFF")
        run("cmake", "--build", game + ".build")
        check(f"{os.path.basename(game)} builds, and configures by add_subdirectory()", True)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    with open(os.path.join(SOURCE, "sdk/include/knurl/base.h"), encoding="utf-8") as header:
        version = ".".join(re.findall(r"#define KNURL_VERSION_[A-Z]+ (\d+)", header.read()))
    both = ("plate", "scene")
    with_gltf = ("-DGLTF=ON", f"-DCMAKE_CXX_COMPILER={CXX}")

    prefix = install("shared", build("shared", ("knurl", "knurl_gltf", "knurl_tool"), "-DBUILD_SHARED_LIBS=ON",
                                     f"-DCMAKE_CXX_COMPILER={CXX}"), "tool")
    check_exports(prefix)
    check_links(prefix)
    check_tree(prefix, both, version, *with_gltf)
    check_shown(prefix)
    said = run(os.path.join(prefix, "bin/knurl"), "--version", env={"LD_LIBRARY_PATH": ""})
    check(f"the tool runs where it was moved to: {said.strip()}", said == f"knurl {version}\n")

    prefix = install("static", BUILD)
    check_tree(prefix, both, version, *with_gltf)
    configure_consumer(prefix, f"-DWANTED={version}", "-DGLTF_FROM_C=ON", "-DCMAKE_CXX_COMPILER=/bin/false")
    run("cmake", "--build", prefix + ".consumer")
    check_programs(prefix, prefix + ".consumer", both[:1], "the loader from C alone", version)

    prefix = install("core", build("core", ("knurl",), "-DKNURL_GLTF=OFF", "-DCMAKE_CXX_COMPILER=/bin/false"))
    check_tree(prefix, both[:1], version, "-DCMAKE_CXX_COMPILER=/bin/false")
    said = configure_consumer(prefix, f"-DWANTED={version}", *with_gltf, fails=True)
    check("core: the loader, which is not there, is told to be missing", "without its component gltf" in said)


main()
