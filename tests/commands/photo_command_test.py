#!/usr/bin/env python3
"""What `laterna photo` promises: pictures from photographs, numbered frames, JSON, exit codes and messages.

    photo_command_test.py LATERNA
"""

import json
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

LATERNA = sys.argv.pop(1)
WIDTH, HEIGHT = 64, 48


def write_png(path, pixel):
    """8-bit RGB; pixel(x, y) gives three codes."""
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(WIDTH)) for y in range(HEIGHT))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks))


def camera(name, x):
    return {"image": name, "rvec": [0, 0, 0], "tvec": [-x, 0, 4]}


class PhotoCommand(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        # A wall that fills every picture, seen along +Z by cameras whose +Y points down.
        (self.folder / "wall.obj").write_text("v -9 -9 0\nv -9 9 0\nv 9 9 0\nv 9 -9 0\nf 1 2 3 4\n")
        (self.folder / "photos").mkdir()
        for number, name in enumerate(("a.png", "b.png")):
            write_png(self.folder / "photos" / name, lambda x, y, n=number: (3 * x, 4 * y, 60 + 90 * n))
        self.write_cameras([camera("a.png", -0.5), camera("b.png", 0.5)])

    def tearDown(self):
        self.scratch.cleanup()

    def write_cameras(self, cameras):
        shared = {"fx": 60, "fy": 60, "cx": 31.5, "cy": 23.5, "image_width": WIDTH, "image_height": HEIGHT, "cameras": cameras}
        (self.folder / "cameras.json").write_text(json.dumps(shared))

    def run_photo(self, *arguments):
        command = [LATERNA, "photo", "wall.obj", "--cameras", "cameras.json", "--photos", "photos", *arguments]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)

    def test_from_its_own_camera_the_picture_is_the_photograph(self):
        done = self.run_photo("-o", "own.png", "--from", "b.png", "--only", "b", "--mask", "mask.png", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual(told["size"], [WIDTH, HEIGHT])
        self.assertEqual([p["name"] for p in told["photographs"]], ["b.png"])
        self.assertEqual(told["unseen_percent"], 0)
        same = subprocess.run([LATERNA, "diff", "own.png", "photos/b.png", "--fail", "0.005"], cwd=self.folder, check=False)
        self.assertEqual(same.returncode, 0)
        self.assertTrue((self.folder / "mask.png").exists())

    def test_a_flight_writes_numbered_frames(self):
        done = self.run_photo("-o", "frame.###.png", "--fly", "all", "--count", "3", "--size", "32x24")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in self.folder.glob("frame.*")), ["frame.000.png", "frame.001.png", "frame.002.png"])

    def test_layers_are_in_the_file(self):
        done = self.run_photo("-o", "view.exr", "--from", "a", "--layers", "photographs", "--size", "32x24")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"photo.weight.b.png", (self.folder / "view.exr").read_bytes())

    def test_bad_requests_and_bad_files_are_told_apart(self):
        for arguments, code, message in (
            (["-o", "x.png", "--fly", "all"], 2, "--fly: the output needs # where the frame's number goes, such as"),
            (["-o", "x.png", "--from", "c"], 2, '--from: there is no photograph "c"; there are "a.png", "b.png"'),
            (["-o", "x.png", "--unseen", "red"], 2, '--unseen: expected R,G,B in linear light, got "red"'),
            (["-o", "nowhere/x.png", "--from", "a"], 4, "nowhere"),
        ):
            done = self.run_photo(*arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)
        self.write_cameras([camera("a.png", 0), camera("gone.png", 1)])
        done = self.run_photo("-o", "x.png", "--from", "a")
        self.assertEqual(done.returncode, 3)
        self.assertIn('cameras[1].image: there is no photograph "gone.png" in "photos"', done.stderr)
        self.assertIn("photos/b.png: has no camera", done.stderr)
        self.assertFalse((self.folder / "x.png").exists())
        done = self.run_photo("-o", "x.png", "--from", "a", "--skip-missing")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("left out", done.stderr)


if __name__ == "__main__":
    unittest.main()
