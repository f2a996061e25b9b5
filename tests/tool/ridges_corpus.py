#!/usr/bin/python3
"""Ridges in photographs and scans, by `knurl tag --from-picture`, against periods that were counted by eye in the opened
pictures, before the tool saw them. The pictures come from packages of fixed versions; without a network this is skipped.

usage: ridges_corpus.py KNURL FOLDER     FOLDER: of the packages, kept

SPDX-License-Identifier: MIT
"""
import hashlib
import json
import pathlib
import subprocess
import sys
import zipfile

# Pictures of scikit-image are CC0 or in the public domain, Krita's CC0 or GPL, UFO: Alien Invasion's GPL or CC.
PACKAGES = {
    "scikit_image-0.18.3-cp39-cp39-manylinux_2_12_x86_64.manylinux2010_x86_64.whl":
        ("pip", "scikit-image==0.18.3", "bfa6eb04dc0b8773043f9994eccd8c517d713cd0f9e960dcb6754e19c1abceb1"),
    "krita-data_1%3a5.1.5+dfsg-2+deb12u1_all.deb": ("apt", "krita-data=1:5.1.5+dfsg-2+deb12u1", "fa4092f3214e406c9354982b45709dc6e4696b940592177e1ea4414357053b47"),
    "ufoai-textures_2.5-2_all.deb": ("apt", "ufoai-textures=2.5-2", "51c9c6a778249a3fa432c81c8c30ac5675ae5a1e675a33b0ce04545753d3218c"),
}

# Pixels from ridge to ridge, and the direction across them in degrees; any one of them is right.
PATTERNED = {
    "krita/01_canvas.png": [(3.7, 0), (2.95, 90)],
    "krita/02_rough-canvas.png": [(5.05, 0)],  # dashes 10.1 apart, each row shifted by half
    "krita/02b_WoofTissue.png": [(16.1, 0), (16.2, 90)],
    "ufo/tex_furniture/textil003.png": [(16.5, 0), (15.9, 90)],
    "ufo/tex_buildings/roof006.png": [(128, 0)],
    "ufo/tex_buildings/roof12.png": [(7.9, 0)],  # rusty corrugated iron, bent: 7.4 to 8
    "ufo/tex_buildings/roof008.png": [(22.6, 45), (22.6, -45)],
    "ufo/tex_buildings/tile02.png": [(36.4, 0), (36.3, 90)],
    "ufo/tex_buildings/tile03.png": [(42.6, 0), (42.6, 90)],
    "ufo/tex_buildings/wall_tab001.png": [(28.3, 0)],
    "ufo/tex_buildings/met_panel01.png": [(64, 0), (64, 90)],
    "ufo/tex_buildings/9gratefloor02.jpg": [(9.14, 90), (8.18, 26.6), (8.18, -26.6)],
    "ufo/tex_buildings/streetbricks14.jpg": [(11.65, 90)],
    "ufo/tex_buildings/solar.jpg": [(56, 0), (51.2, 90)],
    "ufo/tex_buildings/sp_stairs.jpg": [(8, 90)],
    "ufo/tex_buildings/roof10.jpg": [(42.5, 90)],
    "ufo/tex_buildings/stripes.jpg": [(45.3, -45)],
    "ufo/tex_trak/trak4_brick1.png": [(64, 90)],
    "ufo/tex_trak/grate1a.png": [(16, 90)],
    "ufo/tex_base/wall5.jpg": [(64, 90)],
    "skimage/brick.png": [(35.8, 0)],
}

UNPATTERNED = (
    [f"krita/{name}.png" for name in (
        "03_default-paper 14_texture-rock 15_texture-rockB 16_texture-woody 17_texture-melt 18_texture-bark "
        "19_texture-crackle 20_texture-vegetal 22_texture-reptile Sand_fine Rough_Wall_With_Impasto").split()]
    + [f"skimage/{name}" for name in (
        "grass.png gravel.png camera.png moon.png chelsea.png astronaut.png coffee.png coins.png retina.jpg "
        "hubble_deep_field.jpg rocket.jpg").split()]
    + [f"ufo/tex_nature/{name}" for name in (
        "desert001.png desert002.png desert003.png desert004.png desert005.png dirt001.png dirt002.png dirt003.png "
        "drymud.jpg grass.jpg grass_lush.png grass_mowed_dry_a.jpg grass_mowed_green_a.jpg grass_tall_dry_a.jpg "
        "grass_tall_green_a.jpg hedge001.jpg ice001.jpg ice002.png ice003.png jungle001.png jungle002.png leaves1.png "
        "leaves2.png leaves3.png leaves4.png railway.png rockyground01.png rockyground02.png sand.jpg snow001.png "
        "snow002.png snow003.png soil001.jpg stone001.png").split()]
    + [f"ufo/tex_nature/rock{number:03}.png" for number in range(1, 19)]
    + ["ufo/tex_misc/straw.png", "ufo/tex_furniture/textil004.png", "ufo/tex_buildings/paving001.png",
       "ufo/tex_buildings/concrete001.jpg", "ufo/tex_buildings/wall012.png", "ufo/tex_buildings/floor025.png"])

PLACES = {"krita": "krita/usr/share/krita/patterns", "skimage": "skimage/skimage/data", "ufo": "ufo/textures"}


def fetch(folder):
    """Downloads what is missing; the reason if it cannot."""
    for name, (kind, package, checksum) in PACKAGES.items():
        path = folder / name
        if not path.exists():
            command = {"pip": ["pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", "--python-version", "3.9",
                               "--platform", "manylinux2010_x86_64", package],
                       "apt": ["apt-get", "download", package]}[kind]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            if done.returncode != 0 or not path.exists():
                return f"{package} cannot be downloaded: {done.stderr.strip().splitlines()[-1:]}"
        if hashlib.sha256(path.read_bytes()).hexdigest() != checksum:
            path.unlink()
            return f"{package}: another checksum than expected"
    return None


def unpack(folder):
    for name in PACKAGES:
        to = folder / {"s": "skimage", "k": "krita", "u": "ufo"}[name[0]]
        if to.exists():
            continue
        if name.endswith(".whl"):
            zipfile.ZipFile(folder / name).extractall(to)
            continue
        subprocess.run(["dpkg-deb", "-x", folder / name, to], check=True)
        for pack in to.glob("usr/share/games/ufoai/base/*.pk3"):
            zipfile.ZipFile(pack).extractall(to)


def look(knurl, path):
    """The tool's JSON, with a millimetre for each pixel."""
    first = json.loads(subprocess.run([knurl, "tag", "--from-picture", path, "--picture-size", "100mm"],
                                      capture_output=True, text=True, check=False).stdout)
    for axis in first["ridges"]:
        axis["pixels"] = axis["apart"] / 0.1 * first["width"]
        axis["degrees"] = axis["direction"] * 57.29577951
    return first


def error(found, truth):
    """The relative error of the period of the first axis found whose direction is within 4 degrees of a counted one."""
    for axis in found["ridges"]:
        for period, degrees in truth:
            if abs((axis["degrees"] - degrees + 90.0) % 180.0 - 90.0) < 4.0:
                return abs(axis["pixels"] / period - 1.0)
    return float("inf")


def main(knurl, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    why = fetch(folder)
    if why:
        print(f"ridges_corpus: SKIPPED: {why}")
        return 0
    unpack(folder)
    misses, errors, alarms = [], [], []
    for name, truth in PATTERNED.items():
        place, rest = name.split("/", 1)
        found = look(knurl, folder / PLACES[place] / rest)
        off = error(found, truth)
        print(f"{name:42} {found['confidence']:.2f} "
              + ", ".join(f"{axis['pixels']:.2f} at {axis['degrees']:.1f}" for axis in found["ridges"])
              + f"; counted {truth}; off by {100 * off:.1f} %")
        (errors if off < 0.1 else misses).append(off if off < 0.1 else name)
    for name in UNPATTERNED:
        place, rest = name.split("/", 1)
        found = look(knurl, folder / PLACES[place] / rest)
        if found["regular"]:
            alarms.append(f"{name} ({found['confidence']:.2f})")
    errors.sort()
    print(f"ridges_corpus: {len(errors)} of {len(PATTERNED)} patterns found, off by {100 * errors[len(errors) // 2]:.1f} % "
          f"in the median and {100 * errors[-1]:.1f} % at most; missed: {misses or 'none'}")
    print(f"ridges_corpus: {len(alarms)} false alarms in {len(UNPATTERNED)} pictures without a pattern: {alarms}")
    return int(len(misses) > 0 or len(alarms) > 2)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
