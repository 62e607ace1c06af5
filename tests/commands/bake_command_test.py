#!/usr/bin/env python3
"""Holds `laterna bake` to what it promises to scripts.

    bake_command_test.py LATERNA SCENES
"""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LATERNA, SCENES = sys.argv[1], Path(sys.argv[2])


def run(*arguments):
    return subprocess.run([LATERNA, *map(str, arguments)], capture_output=True, text=True, check=False)


def gltf_of(glb):
    data = glb.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


class Bake(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.place = Path(self.folder.name)
        self.baked = self.place / "baked.glb"

    def tearDown(self):
        self.folder.cleanup()

    def bake(self, *options):
        return run("bake", SCENES / "room.glb", "--rig", SCENES / "lamps.json", "-o", self.baked, "--density", "2",
                   "--accumulate", "1", *options)

    def test_help_is_had_either_way(self):
        asked = run("help", "bake")
        self.assertEqual(asked.returncode, 0, asked.stderr)
        self.assertEqual(asked.stdout, run("bake", "--help").stdout)
        self.assertEqual(run("help").stdout, run("--help").stdout)
        wrong = run("bake", "room.glb", "-o", "out.glb", "--into", "lightmaps")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("laterna: error: --into: lightmaps not in {light-maps,emissive}", wrong.stderr)

    def test_the_environment_goes_along(self):
        sky = self.place / "sky.pfm"
        sky.write_bytes(b"PF\n32 16\n-1\n" + struct.pack("<3f", 0.2, 0.4, 0.8) * 512)
        for into in ("light-maps", "emissive"):
            done = self.bake("--environment", sky, "--environment-size", "32", "--into", into, "--no-cache")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("environment", done.stderr)
            document = gltf_of(self.baked)
            self.assertEqual(document["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImageSize"], 32)

    def test_emission_takes_stops_and_keeps_no_lights(self):
        done = self.bake("--into", "emissive", "--exposure", "-1.5", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(json.loads(done.stdout)["exposure"], 2 ** -1.5, places=6)
        for material in gltf_of(self.baked)["materials"]:
            self.assertEqual(material["extensions"]["KHR_materials_specular"]["specularFactor"], 0)
        refused = self.bake("--into", "emissive", "--keep-lights")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("emissive", refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
