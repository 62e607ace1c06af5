#!/usr/bin/env python3
"""Holds `laterna environment`, and `render --environment`, to what they promise to scripts.

    environment_command_test.py LATERNA SCENES
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LATERNA, SCENES = sys.argv[1], Path(sys.argv[2])


def run(*arguments, **environment):
    return subprocess.run([LATERNA, *map(str, arguments)], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})


def write_pfm(path, width, height):
    """A picture whose colour is its column and row; PFM's first row is the lowest."""
    rows = [[(x / width, y / height, 0.5) for x in range(width)] for y in range(height)]
    values = [value for row in reversed(rows) for texel in row for value in texel]
    path.write_bytes(b"PF\n%d %d\n-1\n" % (width, height) + struct.pack(f"<{len(values)}f", *values))


class Environment(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.place = Path(self.folder.name)
        self.sky = self.place / "sky.pfm"
        write_pfm(self.sky, 32, 16)

    def tearDown(self):
        self.folder.cleanup()

    def test_charts_are_listed(self):
        charts = json.loads(run("environment", "--list-charts", "--size", "32", "--json").stdout)
        self.assertEqual([c["name"] for c in charts],
                         ["latlong", "cube", "horizontal_cross", "vertical_cross", "sphere", "dual_paraboloid",
                          "octahedral"])
        self.assertAlmostEqual(charts[2]["unused_share"], 0.5)
        self.assertEqual(len(run("environment", "--list-charts", "--size", "32").stdout.splitlines()), 9)

    def test_any_chart_becomes_any_other(self):
        for chart, shape in (("cube", (48, 8)), ("octahedral", (8, 8)), ("vertical_cross", (24, 32))):
            done = run("environment", self.sky, self.place / "out.exr", "--chart", chart, "--size", "8", "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            told = json.loads(done.stdout)
            self.assertEqual((told["width"], told["height"]), shape)
            self.assertEqual((told["from"], told["chart"]), ("latlong", chart))

    def test_own_chart_and_size_are_a_copy(self):
        for chart in ("latlong", "cube", "sphere"):
            first, second = self.place / f"{chart}.pfm", self.place / f"{chart}2.pfm"
            self.assertEqual(run("environment", self.sky, first, "--chart", chart, "--size", "16").returncode, 0)
            self.assertEqual(run("environment", first, second, "--from", chart, "--chart", chart).returncode, 0)
            self.assertEqual(first.read_bytes(), second.read_bytes(), chart)
        self.assertEqual(run("environment", self.sky, self.place / "same.pfm").returncode, 0)
        texels = 32 * 16 * 12
        self.assertEqual((self.place / "same.pfm").read_bytes()[-texels:], self.sky.read_bytes()[-texels:])

    def test_nothing_that_is_said_is_left_aside(self):
        out, scene = self.place / "out.exr", SCENES / "room.glb"
        for said, told in (
                ((self.sky, out, "--from-scene", scene, "--at", "0,1,0"), "--from-scene is in place of IN"),
                ((self.sky, out, "--at", "0,1,0"), "--at belongs to --from-scene"),
                ((self.sky, out, "--split-sum"), "OUT is of no use with --split-sum"),
                ((self.sky, "--list-charts"), "IN is of no use with --list-charts"),
                ((self.sky, out, "--exposure", "2"), "--exposure belongs to .png")):
            done = run("environment", *said)
            self.assertEqual(done.returncode, 2, said)
            self.assertIn("laterna: error: ", done.stderr)
            self.assertIn(told, done.stderr)
            self.assertFalse(out.exists())

    def test_bad_usage_and_bad_input(self):
        nothing = run("environment", self.sky)
        self.assertEqual(nothing.returncode, 2)
        self.assertIn("laterna environment IN OUT", nothing.stderr)
        self.assertEqual(run("environment", self.sky, self.place / "o.exr", "--chart", "globe").returncode, 2)
        self.assertEqual(run("environment", self.sky, self.place / "o.xyz").returncode, 2)
        wrong = run("environment", self.sky, self.place / "o.exr", "--from", "sphere")
        self.assertEqual(wrong.returncode, 3)
        self.assertIn("sky.pfm: a picture in the chart sphere is 1:1; this one is 32 x 16", wrong.stderr)
        self.assertEqual(run("environment", self.place / "none.hdr", self.place / "o.exr").returncode, 3)

    def test_a_point_of_a_scene(self):
        out = self.place / "room.hdr"
        done = run("environment", "--from-scene", SCENES / "stage.glb", "--rig", SCENES / "stage.json", "--at", "0,1,1",
                   "--samples", "1", "--size", "16", "-o", out, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["width"], 32)
        self.assertTrue(out.exists())
        self.assertEqual(run("environment", "--from-scene", SCENES / "stage.glb", "-o", out).returncode, 2)

    def test_what_was_worked_out_is_kept(self):
        cache = self.place / "cache"
        picture = [self.place / "a.png", self.place / "b.png", self.place / "c.png"]
        render = ("render", SCENES / "stage.glb", "--environment", self.sky, "--size", "40x30", "-o")
        self.assertEqual(run(*render, picture[0], "--no-cache", XDG_CACHE_HOME=str(cache)).returncode, 0)
        self.assertFalse(cache.exists())
        for output in picture[1:]:
            self.assertEqual(run(*render, output, XDG_CACHE_HOME=str(cache)).returncode, 0)
        self.assertEqual(len(list((cache / "laterna" / "environments").iterdir())), 1)
        self.assertEqual(len({p.read_bytes() for p in picture}), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
