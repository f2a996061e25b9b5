"""All tests of this folder, in one Blender. usage: see installed.py; SPDX-License-Identifier: MIT"""
import os
import sys
import unittest

import bpy  # pylint: disable=unused-import  # before addon_utils, whose folder it adds

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.discover(HERE))
sys.stderr.flush()
sys.stdout.flush()
os._exit(0 if result.wasSuccessful() else 1)  # bpy 4.2 as a module crashes when Python ends
