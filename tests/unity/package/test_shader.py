#!/usr/bin/env python3
"""The shader of the stripes: compiled by glslang as HLSL, with stand-ins for Unity's macros; its height run as C++ against
the mean of the sign of cos over a pixel; and the rule by which each pipeline draws it."""
import ctypes
import math
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import package

FOLDER = os.path.join(package.PACKAGE, "Runtime", "Resources")
UNITY = """
#define UNITY_VERTEX_INPUT_INSTANCE_ID
#define UNITY_VERTEX_OUTPUT_STEREO
#define UNITY_SETUP_INSTANCE_ID(input)
#define UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output)
float4x4 unity_MatrixMVP;
float4 UnityObjectToClipPos(float4 position) { return mul(unity_MatrixMVP, position); }
"""
CPP = """
#include <algorithm>
#include <cmath>
struct float2 { float x, y; float2(float a, float b) : x(a), y(b) {} };
static double frac(double a) { return a - std::floor(a); }
static float2 larger(float2 a, float2 b) { return float2(std::max(a.x, b.x), std::max(a.y, b.y)); }
#define abs std::fabs
#define max larger
#include "KnurlStripes.hlsl"
extern "C" float height(float x, float y, float width) { return KnurlHeight(float2(x, y), float2(width, width)); }
"""


def text():
    return re.sub(r"//.*", "", package.read(FOLDER, "KnurlStripes.shader"))


class Shader(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)
        return path

    @unittest.skipUnless(shutil.which("glslangValidator"), "no glslangValidator: apt-get install glslang-tools")
    def test_compiles(self):
        program = re.search(r"HLSLPROGRAM\n(.*?)ENDHLSL", text(), re.DOTALL).group(1)
        self.write("UnityCG.cginc", UNITY)
        shutil.copy(os.path.join(FOLDER, "KnurlStripes.hlsl"), self.folder)
        path = self.write("stripes.hlsl", "#extension GL_GOOGLE_include_directive : enable\n" + program)
        for stage, entry in (("vert", "vert"), ("frag", "frag")):
            done = subprocess.run(["glslangValidator", "-D", "-V", "-S", stage, "-e", entry, "-I" + self.folder, "-o",
                                   os.path.join(self.folder, "out.spv"), path], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @unittest.skipUnless(shutil.which("c++"), "no C++ compiler")
    def test_heights_are_the_means_over_a_pixel(self):
        library = os.path.join(self.folder, "height.so")
        subprocess.run(["c++", "-shared", "-fPIC", "-I" + FOLDER, "-o", library, self.write("height.cpp", CPP)], check=True)
        height = ctypes.CDLL(library).height
        height.restype = ctypes.c_float
        height.argtypes = [ctypes.c_float] * 3
        samples = 1000

        def mean(cycles, width):
            at = (cycles + width * ((i + 0.5) / samples - 0.5) for i in range(samples))
            return sum(math.copysign(1.0, math.cos(2.0 * math.pi * c)) for c in at) / samples

        for x, y, width in ((0.0, 0.0, 0.01), (0.5, 0.0, 0.01), (0.24, 0.1, 0.1), (7.3, -2.6, 0.4), (0.1, 0.2, 3.7)):
            self.assertAlmostEqual(height(x, y, width), mean(x, width) * mean(y, width), delta=0.01)
        self.assertAlmostEqual(height(0.25 - 0.01, 0.0, 1e-9), 1.0, delta=1e-3)  # a ridge's flanks are a quarter off
        self.assertAlmostEqual(height(0.25 + 0.01, 0.0, 1e-9), -1.0, delta=1e-3)

    def test_is_drawn_by_each_pipeline(self):
        """Built-in: passes without LightMode; URP and HDRP: those as SRPDefaultUnlit. No pipeline's own includes."""
        self.assertNotIn("LightMode", text())
        self.assertNotIn("RenderPipeline", text())
        self.assertEqual(re.findall(r'#include "([^"]+)"', text()), ["UnityCG.cginc", "KnurlStripes.hlsl"])
        self.assertEqual(text().count("Pass\n"), 1)


if __name__ == "__main__":
    unittest.main()
