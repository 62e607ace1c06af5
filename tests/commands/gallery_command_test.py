#!/usr/bin/env python3
"""Holds `laterna gallery` to what it promises: a page of every figure that needs nothing but what lies beside it.

    gallery_command_test.py LATERNA
"""

import re
import struct
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

LATERNA = sys.argv[1]
VOID = {"meta", "img", "br"}


def gallery(*arguments):
    return subprocess.run([LATERNA, "gallery", *arguments], capture_output=True, text=True, check=False)


class Page(HTMLParser):
    """What stands on a page; `faults` are elements that are not closed in the order of their opening."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.elements = [], [], []
        self.feed(text)
        self.faults += self.open

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)

    def values(self, tag, attribute):
        return [attributes[attribute] for name, attributes in self.elements if name == tag and attribute in attributes]


def listed_figures():
    return re.findall(r"^  (\S+) ", gallery("--list").stdout, re.MULTILINE)


def techniques():
    listed = subprocess.run([LATERNA, "render", "--list-techniques"], capture_output=True, text=True, check=True)
    return [line.split()[0] for line in listed.stdout.splitlines()]


class Gallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = Path(cls.folder.name) / "new" / "gallery"
        cls.done = gallery("--scale", "0.05", "-o", str(cls.place))
        cls.text = (cls.place / "index.html").read_text(encoding="utf-8")
        cls.page = Page(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_page_is_well_formed_and_says_where_it_is(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertIn(str(self.place / "index.html"), self.done.stderr)
        self.assertEqual(self.done.stdout, "")
        self.assertTrue(self.text.startswith("<!DOCTYPE html>"))
        self.assertEqual(self.page.faults, [])

    def test_it_needs_neither_a_network_nor_scripts(self):
        tags = {tag for tag, _ in self.page.elements}
        self.assertFalse(tags & {"script", "link", "iframe"}, tags)
        self.assertNotIn("://", self.text)
        self.assertNotIn("@import", self.text)
        self.assertNotIn("url(", self.text)

    def test_every_figure_is_on_it_and_in_its_contents(self):
        figures = self.page.values("article", "id")
        self.assertGreater(len(figures), 30)
        self.assertEqual(figures, listed_figures())
        self.assertEqual([link[1:] for link in self.page.values("a", "href") if link.startswith("#")], figures)
        for figure in figures:
            self.assertIn(f"--only {figure}\n", self.text)

    def test_every_picture_is_there_and_nothing_else(self):
        pictures = self.page.values("img", "src")
        self.assertEqual(sorted([*pictures, "index.html"]), sorted(f.name for f in self.place.iterdir()))
        self.assertEqual(len(self.page.values("img", "alt")), len(pictures))
        for picture, width, height in zip(pictures, self.page.values("img", "width"), self.page.values("img", "height")):
            content = (self.place / picture).read_bytes()
            if picture.endswith(".svg"):
                sides = re.search(rb'^<svg [^>]*width="(\d+)" height="(\d+)"', content)
                self.assertEqual((int(sides[1]), int(sides[2])), (int(width), int(height)), picture)
                continue
            self.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
            columns, rows = struct.unpack(">II", content[16:24])
            self.assertEqual(int(width) * rows, int(height) * columns, picture)
        self.assertEqual(self.text.count("cannot draw"), 0 if len(techniques()) == 10 else self.text.count("absent\">"))

    def test_only_what_is_asked_for_is_drawn_and_the_same_each_time(self):
        with tempfile.TemporaryDirectory() as folder:
            contents = []
            for name, machine in (("a", ["--threads", "1"]), ("b", ["--threads", "2", "--isa", "scalar"])):
                place = Path(folder) / name
                done = gallery("--scale", "0.1", "--only", "steps", "--only", "slide", "-o", str(place), *machine)
                self.assertEqual(done.returncode, 0, done.stderr)
                contents.append({f.name: f.read_bytes() for f in place.iterdir()})
            self.assertEqual(Page(contents[0]["index.html"].decode()).values("article", "id"), ["slide", "steps"])
            self.assertEqual(contents[0].keys(), contents[1].keys())
            for name, content in contents[0].items():
                self.assertEqual(content, contents[1][name], name)

    def test_captions_tell_what_was_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            figures = ["throw", "lux", "headlights", "aircraft"]
            done = gallery("--scale", "0.05", "-o", folder, *[x for f in figures for x in ("--only", f)])
            self.assertEqual(done.returncode, 0, done.stderr)
            text = (Path(folder) / "index.html").read_text(encoding="utf-8")
        # Whatever the pictures' size: throw ratio 1.5 at 3 m; 3,000 lm on 2.25 m²; 1 % of 25 m; 30 m · tan −15° and 25°.
        self.assertIn("2.00 m wide, from 0.96 to 2.08 m above the floor", text)
        self.assertIn("gives 1333 to 1333 lx at 16 × 9 meters", text)
        cut_off = float(re.search(r"find it ([\d.]+) cm below them", text)[1])
        self.assertAlmostEqual(cut_off, 25, delta=0.75)
        lightest = [float(x) for x in dict.fromkeys(re.findall(r"lightest (-?[\d.]+) m from", text))]
        for found, expected in zip(lightest, [-8.04, 0, 13.99], strict=True):
            self.assertAlmostEqual(found, expected, delta=0.05)

    def test_an_older_gallery_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "index.html").write_text("old", encoding="utf-8")
            self.assertEqual(gallery("--scale", "0.05", "--only", "slide", "-o", folder).returncode, 0)
            self.assertIn('id="slide"', (Path(folder) / "index.html").read_text(encoding="utf-8"))


class Refusals(unittest.TestCase):
    def test_folders_that_cannot_be_made_or_written(self):
        with tempfile.NamedTemporaryFile() as file:
            place = f"{file.name}/gallery"
            done = gallery("--only", "slide", "-o", place)
            self.assertEqual(done.returncode, 4)
            self.assertIn(f"laterna: error: {place}: cannot make this folder: ", done.stderr)
        done = gallery("--only", "slide", "-o", "/proc")
        self.assertEqual(done.returncode, 4)
        self.assertIn("/proc", done.stderr)

    def test_a_page_that_cannot_be_written(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "index.html").mkdir()
            done = gallery("--scale", "0.05", "--only", "slide", "-o", folder)
            self.assertEqual(done.returncode, 4)
            self.assertIn("index.html: cannot write this file", done.stderr)
            self.assertNotIn("index.html.part", [f.name for f in Path(folder).iterdir()])

    def test_bad_arguments(self):
        with tempfile.TemporaryDirectory() as folder:
            for arguments, message in [
                    ([], "-o DIR: expected the folder that the page is written to"),
                    (["-o", folder, "--only", "nothing"], '--only: there is no figure "nothing"; there are slide, '),
                    (["-o", folder, "--scale", "9"], "--scale"),
                    (["-o", folder, "--isa", "mmx"], "mmx"),
            ]:
                done = gallery(*arguments)
                self.assertEqual(done.returncode, 2, arguments)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stdout, "")
            self.assertEqual(list(Path(folder).iterdir()), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
