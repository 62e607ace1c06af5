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

    def test_the_scene_is_not_written_over(self):
        scene = self.place / "room.glb"
        scene.write_bytes((SCENES / "room.glb").read_bytes())
        refused = run("bake", scene, "-o", self.place / "." / "room.glb")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("is the scene itself: write to another file", refused.stderr)
        self.assertEqual(scene.read_bytes(), (SCENES / "room.glb").read_bytes())

    def test_what_would_be_left_aside_is_refused(self):
        for option, owner in (("--bounce-rays", "--bounces"), ("--occlusion-distance", "--ambient-occlusion")):
            refused = self.bake(option, "64")
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f"{option} belongs to {owner}", refused.stderr)

    def test_a_scene_of_no_size_is_told_no_density(self):
        soup = self.place / "soup.gltf"
        positions = struct.pack("<9f", *[0.0] * 9)
        (self.place / "soup.bin").write_bytes(positions)
        soup.write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": "soup.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [0, 0, 0]}]}))
        done = run("bake", soup, "-o", self.baked, "--no-cache")
        self.assertNotIn("nan", done.stderr + done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
