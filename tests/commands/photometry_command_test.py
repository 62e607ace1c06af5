#!/usr/bin/env python3
"""Holds `laterna probe` and false colours to what they promise: JSON, CSV, exit codes, messages.

    photometry_command_test.py LATERNA SCENES
"""

import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LATERNA, SCENES = sys.argv[1], Path(sys.argv[2])
FOLDER = tempfile.TemporaryDirectory()
ROAD = [str(SCENES / "road.glb"), "--rig", str(SCENES / "headlights.json")]
BELOW = ["--probe", "-3,0.2,-25,0,0,1"]


def run(command, *arguments):
    return subprocess.run([LATERNA, command, *arguments], capture_output=True, text=True, check=False)


class Probe(unittest.TestCase):
    def test_json_has_each_light_and_their_sum(self):
        done = run("probe", *ROAD, *BELOW, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        read = json.loads(done.stdout)
        self.assertEqual(read["lights"], ["left low beam", "right low beam"])
        probe = read["probes"][0]
        self.assertEqual(probe["position"], [-3, 0.2, -25])
        self.assertAlmostEqual(probe["lux"], sum(light["lux"] for light in probe["lights"].values()))
        self.assertGreater(probe["lux"], 5)

    def test_csv_has_a_line_for_each_probe_of_a_grid(self):
        file = Path(FOLDER.name) / "grid.csv"
        done = run("probe", *ROAD, "--rectangle", "-3,0.05,-25,6,0,0,0,1,0", "--grid", "12x4", "-o", str(file))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("48 probes", done.stdout)
        with file.open(encoding="utf-8", newline="") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual(len(rows), 48)
        self.assertEqual({row["nz"] for row in rows}, {"1"})
        self.assertAlmostEqual(sum(float(row["area_m2"]) for row in rows), 6)
        for row in rows:
            lamps = float(row["lux.left low beam"]) + float(row["lux.right low beam"])
            self.assertAlmostEqual(float(row["lux"]), lamps)

    def test_an_object_is_covered(self):
        done = run("probe", *ROAD, "--object", "wall", "--spacing", "0.5", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)["summary"]
        self.assertEqual(summary["probes"], 800)
        self.assertGreater(summary["lumens"], 100)
        self.assertEqual(summary["uniformity"], summary["least_lux"] / summary["mean_lux"])

    def test_faults_are_told(self):
        for arguments, code, message in [
                ([], 2, "where? Give --probe"),
                (["--probe", "1,2"], 2, '--probe: expected x,y,z or x,y,z,nx,ny,nz in metres, got "1,2"'),
                (["--probe", "1,2,3,0,0,0"], 2, "probes[0]: expected a normal of some length"),
                (["--object", "wall"], 2, "--object needs --spacing"),
                (["--object", "wal", "--spacing", "1"], 2, 'the scene has no object "wal": it has "road"'),
                (["--object", "posts", "--spacing", "50"], 2, "is too small for a grid of 50 m"),
                (["--rectangle", "0,0,0,1,0,0"], 2, "--rectangle: expected nine numbers"),
                ([*BELOW, "-o", "probes.txt"], 2, "are written to .csv or .json files"),
                ([*BELOW, "--json", "-o", "-"], 2, "would both write to standard output")]:
            done = run("probe", *ROAD, *arguments)
            self.assertEqual(done.returncode, code, (arguments, done.stderr))
            self.assertIn(message, done.stderr)


class FalseColour(unittest.TestCase):
    def test_a_layer_of_a_file_looks_as_it_does_when_rendered(self):
        folder = Path(FOLDER.name)
        size = ["--camera", "driver", "--size", "96x54"]
        for arguments in (["render", *ROAD, *size, "--false-colour", "lux:50", "-o", str(folder / "a.png")],
                          ["render", *ROAD, *size, "--layers", "lux", "-o", str(folder / "layers.exr")],
                          ["false-colour", str(folder / "layers.exr"), "--max", "50", "-o", str(folder / "b.png")]):
            done = run(*arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run("diff", str(folder / "a.png"), str(folder / "b.png")).returncode, 0)

    def test_faults_are_told(self):
        for choice, message in [("lumen", "expected lux, luminance or pixel_density[.LIGHT]"),
                                ("lux:much", 'expected a maximum greater than 0 after the colon, got "much"'),
                                ("lux:0", "expected a maximum greater than 0"),
                                ("pixel_density.lantern", 'there is no projector "lantern"; there are "left low beam"')]:
            done = run("render", *ROAD, "--false-colour", choice, "-o", "x.png")
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)
        done = run("render", *ROAD, "--false-colour", "lux", "--layers", "lux", "-o", "x.exr")
        self.assertEqual(done.returncode, 2)
        self.assertIn("takes the picture's place", done.stderr)


class Gels(unittest.TestCase):
    def test_they_are_listed(self):
        listed = run("render", "--list-gels").stdout
        self.assertIn("full_ctb", listed)
        self.assertIn("nd_0.3       0.501 0.501 0.501", listed)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
