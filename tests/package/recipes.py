#!/usr/bin/python3
"""The recipes for other package managers. With their tools: Conan builds its package and a consumer, with and without the
loader; vcpkg's port is run by CMake, with stand-ins for vcpkg's functions, and a consumer is built with what it installs; Nix
evaluates its expression, with stand-ins for nixpkgs; Ruby reads Homebrew's. Without: the versions alone.
usage: recipes.py SOURCE FOLDER [CONAN]     CONAN: the program     SPDX-License-Identifier: MIT"""
import json
import os
import re
import shutil
import subprocess
import sys

SOURCE, FOLDER, *CONAN = map(os.path.abspath, sys.argv[1:])
RECIPES = os.path.join(SOURCE, "packages/recipes")
CONSUMER = os.path.join(SOURCE, "tests/package/consumer")
# Fields of a port's manifest and of a feature, by vcpkg's reference.
PORT = {"name", "version", "port-version", "description", "homepage", "license", "supports", "dependencies", "default-features",
        "features"}
NAME = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
NIXPKGS = """
{ lib = { cleanSourceWith = { src, filter }: assert filter "/x/sdk" "directory" && !filter "/x/build" "directory"; src;
          licenses.mit = "MIT"; platforms = { linux = [ "linux" ]; darwin = [ "darwin" ]; }; };
  stdenv.mkDerivation = attributes: attributes;
  cmake = "cmake"; ninja = "ninja"; pkg-config = "pkg-config"; tinygltf = "tinygltf"; nlohmann_json = "nlohmann_json"; glm = "glm";
  libusb1 = "libusb1"; hidapi = "hidapi"; libwebsockets = "libwebsockets"; kissfft = "kissfft"; libpng = "libpng";
  libjpeg = "libjpeg"; }
"""
VCPKG = """
cmake_minimum_required(VERSION 3.16)
set(PACKAGES @FOLDER@/vcpkg)
set(CURRENT_PACKAGES_DIR ${PACKAGES}/knurl)
set(FEATURES @FEATURES@)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_QUIET)
  if(code)
    message(FATAL_ERROR "${ARGV}: ${code}")
  endif()
endfunction()
function(vcpkg_check_features)
  cmake_parse_arguments(arg "" OUT_FEATURE_OPTIONS FEATURES ${ARGN})
  set(options)
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature option)
    set(on OFF)
    if(feature IN_LIST FEATURES)
      set(on ON)
    endif()
    list(APPEND options -D${option}=${on})
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(arg "" SOURCE_PATH OPTIONS ${ARGN})
  run(cmake -G Ninja -S ${arg_SOURCE_PATH} -B ${PACKAGES}/build --install-prefix ${CURRENT_PACKAGES_DIR}
    -DCMAKE_BUILD_TYPE=Release ${arg_OPTIONS})
endfunction()
function(vcpkg_cmake_install)
  run(cmake --build ${PACKAGES}/build --target install)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(arg "" CONFIG_PATH "" ${ARGN})
  file(MAKE_DIRECTORY ${CURRENT_PACKAGES_DIR}/share)
  file(RENAME ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH} ${CURRENT_PACKAGES_DIR}/moved)
  file(RENAME ${CURRENT_PACKAGES_DIR}/moved ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH})
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_copy_tools)
  cmake_parse_arguments(arg AUTO_CLEAN "" TOOL_NAMES ${ARGN})
  run(${CURRENT_PACKAGES_DIR}/bin/${arg_TOOL_NAMES} --version)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(arg "" "" FILE_LIST ${ARGN})
  file(COPY ${arg_FILE_LIST} DESTINATION ${PACKAGES}/copyright)
endfunction()
include(@PORT@)
"""


def text(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
        return file.read()


def expect(what, found, expected):
    if found != expected:
        sys.exit(f"recipes: {what}: expected {expected}, found {found}")


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"recipes: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def write(name, content):
    with open(os.path.join(FOLDER, name), "w", encoding="utf-8") as file:
        file.write(content)
    return os.path.join(FOLDER, name)


def check_manifest(version):
    manifest = json.loads(text("packages/recipes/vcpkg/knurl/vcpkg.json"))
    expect("vcpkg.json's version", manifest["version"], version)
    expect("unknown fields of vcpkg.json", set(manifest) - PORT, set())
    features = manifest["features"].values()
    expect("fields of features", {field for each in features for field in each}, {"description", "dependencies"})
    needed = [*manifest["dependencies"], *(each for feature in features for each in feature["dependencies"])]
    names = [each if isinstance(each, str) else each["name"] for each in needed]
    expect("names", [name for name in ["knurl", *names, *manifest["features"]] if not NAME.fullmatch(name)], [])
    expect("default features that there are not", set(manifest["default-features"]) - set(manifest["features"]), set())


def try_consumer(prefix, version):
    """Builds and runs tests/package/consumer with an installed tree."""
    built = os.path.join(FOLDER, "consumer")
    shutil.rmtree(built, ignore_errors=True)
    run("cmake", "-G", "Ninja", "-S", CONSUMER, "-B", built, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DWANTED={version}",
        "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", built)
    expect("the consumer", run(os.path.join(built, "plate")).strip(), f"0.400000 N, knurl {version}")


def try_vcpkg(version):
    for features in ("core", "core;gltf"):
        shutil.rmtree(os.path.join(FOLDER, "vcpkg"), ignore_errors=True)
        script = VCPKG.replace("@FOLDER@", FOLDER).replace("@FEATURES@", features)
        run("cmake", "-P", write("vcpkg.cmake", script.replace("@PORT@", os.path.join(RECIPES, "vcpkg/knurl/portfile.cmake"))))
        try_consumer(os.path.join(FOLDER, "vcpkg/knurl"), version)
    print("recipes: vcpkg: the port runs, with stand-ins for vcpkg's functions")


def try_conan(conan, version):
    environment = {**os.environ, "CONAN_HOME": os.path.join(FOLDER, "conan")}
    run(conan, "profile", "detect", "--force", env=environment)
    profile = write("profile", "include(default)\n[conf]\ntools.cmake.cmaketoolchain:generator=Ninja\n"
                    f"tools.cmake.cmake_layout:test_folder={FOLDER}/conan-test\n"
                    "[platform_requires]\ntinygltf/2.9.7\nnlohmann_json/3.12.0\nglm/1.0.1\n")
    for loader in ("True", "False"):
        told = run(conan, "create", os.path.join(RECIPES, "conan"), "--profile:all", profile, "--no-remote", "-o",
                   f"knurl/*:gltf={loader}", env=environment)
        expect(f"the consumer's force (gltf={loader})", told.count(f"0.400000 N, knurl {version}"), 1)
    print("recipes: conan: package and consumer are built, with Debian's headers for the loader")


def try_nix(version):
    folder = os.path.join(FOLDER, "nix")
    environment = {**os.environ, **{f"NIX_{name}_DIR": os.path.join(folder, name.lower()) for name in ("STORE", "STATE", "LOG", "CONF")},
                   "HOME": folder}
    os.makedirs(folder, exist_ok=True)
    recipe = os.path.join(RECIPES, "nix/default.nix")
    found = run("nix-instantiate", "--eval", "--strict", "--json", "-E",
                f"let it = import {recipe} {{ pkgs = {NIXPKGS}; }}; in [ it.version (toString it.src) (builtins.length it.buildInputs) it.meta ]",
                env=environment)
    found = json.loads(found.strip().splitlines()[-1])
    expect("nix's version, sources, libraries", found[:3], [version, SOURCE, 9])
    print("recipes: nix: evaluated, with stand-ins for nixpkgs")


def main():
    os.makedirs(FOLDER, exist_ok=True)
    version = ".".join(re.findall(r"#define KNURL_VERSION_[A-Z]+ (\d+)", text("sdk/include/knurl/base.h")))
    formula = text("packages/recipes/homebrew/knurl.rb")
    expect("knurl.rb's versions", set(re.findall(r"(?:version \"|release-|knurl-)(\d[\d.]*\d)", formula)), {version})
    check_manifest(version)
    if CONAN:
        print("recipes: homebrew:", run("ruby", "-c", os.path.join(RECIPES, "homebrew/knurl.rb")).strip())
        try_nix(version)
        try_vcpkg(version)
        try_conan(CONAN[0], version)
    else:
        print("recipes: versions and manifest agree; nothing was built or evaluated: no path of conan was given")


main()
