#!/usr/bin/env python3
"""What `laterna ies` and rigs with measured lamps promise to scripts. Usage: ies_command_test.py LATERNA"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

LATERNA = ""


def run(*arguments):
    return subprocess.run([LATERNA, *map(str, arguments)], capture_output=True, text=True, check=False)


def tent(vertical):
    """Falls evenly from 1000 cd on the axis to 0 at 50 degrees."""
    return max(0, 1000 - 20 * vertical)


def ies_text(candela=tent):
    vertical = range(0, 91)
    return ("IESNA:LM-63-2002\n[MANUFAC] A & B\n[LUMINAIRE] <Lamp>\nTILT=NONE\n"
            f"1 -1 1 {len(vertical)} 1 1 2 0 0 0\n1 1 10\n"
            f"{' '.join(map(str, vertical))}\n0\n{' '.join(str(candela(v)) for v in vertical)}\n")


class IesCommand(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.lamp = self.path / "lamp.ies"
        self.lamp.write_text(ies_text(), encoding="utf-8")

    def test_json(self):
        done = run("ies", self.lamp, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        j = json.loads(done.stdout)
        # 2 pi times the integral of (1000 - 20 g) sin g, g in degrees, from 0 to 50.
        edge = math.radians(50)
        flux = 2 * math.pi * 1000 * (1 - math.sin(edge) / edge)
        self.assertAlmostEqual(j["flux_lm"] / flux, 1, delta=1e-3)
        self.assertAlmostEqual(j["peak_cd"], 1000)
        self.assertAlmostEqual(j["beam_angle_deg"], 50, delta=1e-4)
        self.assertAlmostEqual(j["field_angle_deg"], 90, delta=1e-4)
        self.assertAlmostEqual(j["beam_angle_c90_deg"], 50, delta=1e-4)
        self.assertEqual([s["name"] for s in j["sections"]], ["C0-C180", "C90-C270"])
        self.assertIsNone(j["rated_lm"])

    def test_table(self):
        done = run("ies", self.lamp)
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("A & B, <Lamp>", "IESNA:LM-63-2002, type C", "1000.0 cd", "50.0°", "90.0°"):
            self.assertIn(word, done.stdout)

    def test_polar_plot(self):
        svg = self.path / "polar.svg"
        done = run("ies", self.lamp, "--polar", svg)
        self.assertEqual(done.returncode, 0, done.stderr)
        root = xml.etree.ElementTree.parse(svg).getroot()
        text = "".join(root.itertext())
        for word in ("A & B, <Lamp>", "1000 cd", "C90–C270", "beam angle 50.0°"):
            self.assertIn(word, text)
        self.assertEqual(run("ies", self.lamp, "--polar", self.path / "no" / "polar.svg").returncode, 4)

    def test_bad_files(self):
        bad = self.path / "bad.ies"
        bad.write_text(ies_text(lambda v: -1), encoding="utf-8")
        done = run("ies", bad)
        self.assertEqual(done.returncode, 3)
        self.assertIn("bad.ies: line 9: expected candela value 1 of 91", done.stderr)
        self.assertEqual(run("ies", self.path / "none.ies").returncode, 3)
        self.assertEqual(run("ies").returncode, 2)

    def test_info_tells_what_a_lamp_comes_to(self):
        rig = self.path / "rig.json"
        rig.write_text(json.dumps({"lights": [{"type": "point", "position": [0, 3, 0], "ies": "lamp.ies", "scale": 2}]}),
                       encoding="utf-8")
        scene = self.path / "scene.gltf"
        scene.write_text(json.dumps({"asset": {"version": "2.0"}}), encoding="utf-8")
        done = run("info", scene, "--rig", rig, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        light = json.loads(done.stdout)["lights"][0]
        self.assertAlmostEqual(light["candela"], 2000)
        self.assertTrue(light["ies"].endswith("lamp.ies"))


if __name__ == "__main__":
    LATERNA = sys.argv.pop(1)
    unittest.main()
