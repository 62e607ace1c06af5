#!/usr/bin/env python3
"""scripts/check_includes.py names each kind of fault: one is planted in a copy of the sources at a time."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("src", "include", "apps", "examples", "tests", "bench", "fuzz"):
            shutil.copytree(ROOT / name, self.root / name, ignore=lambda _, names: [
                n for n in names if "." in n and not n.endswith((".h", ".cc", ".cpp"))])
        shutil.copy(ROOT / "CMakeLists.txt", self.root)

    def run_check(self):
        script = ROOT / "scripts" / "check_includes.py"
        done = subprocess.run([sys.executable, script, self.root], capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.splitlines()

    def plant(self, name, line):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(line + "\n", encoding="utf-8")

    def expect(self, *messages):
        status, lines = self.run_check()
        self.assertEqual(status, 1)
        self.assertEqual(lines, list(messages))

    def test_sources_as_they_are_have_no_fault(self):
        self.assertEqual(self.run_check(), (0, []))

    def test_a_room_that_comes_later(self):
        self.plant("src/raster/bad.cc", '#include "frame/frame.h"')
        self.expect('src/raster/bad.cc:1: includes "frame/frame.h"; raster may include base, raster')

    def test_a_public_header_of_a_later_room(self):
        self.plant("src/base/bad.h", '// first line\n#  include "laterna/scene.h"')
        self.expect('src/base/bad.h:2: includes "laterna/scene.h", which belongs to scene; base may include base')

    def test_a_path_that_is_no_room(self):
        self.plant("src/image/bad.h", '#include "mip_chain.h"')
        self.expect('src/image/bad.h:1: includes "mip_chain.h"; expected a path from src/: one of the rooms base, image, '
                    "scene, frame, light, raster, trace, shadow, shade, render, measure, bake")

    def test_a_folder_that_is_no_room(self):
        self.plant("src/utils/bad.h", "")
        self.expect("src/utils/bad.h: lies in no room of the table; expected one of base, image, scene, frame, light, "
                    "raster, trace, shadow, shade, render, measure, bake")

    def test_a_library_of_another_room(self):
        self.plant("src/shade/bad.cc", "#include <embree3/rtcore.h>")
        self.expect("src/shade/bad.cc:1: includes <embree3/rtcore.h>; expected only in trace")

    def test_vectors_outside_kernels(self):
        self.plant("src/shade/bad.h", "#include <hwy/highway.h>")
        self.expect("src/shade/bad.h:1: includes <hwy/highway.h>; expected only in files that end in .simd.cc or -inl.h")

    def test_a_public_header_with_a_private_include_or_library(self):
        path = self.root / "include/laterna/output.h"
        path.write_text('#include <fmt/format.h>\n#include "base/view.h"\n', encoding="utf-8")
        self.expect("include/laterna/output.h:1: includes <fmt/format.h>; callers have only the standard library, GLM and "
                    "tl::expected",
                    'include/laterna/output.h:2: includes "base/view.h"; expected only "laterna/..." in public headers')

    def test_a_public_header_without_a_room(self):
        self.plant("include/laterna/bad.h", "")
        self.expect("include/laterna/bad.h: is a public header of no room; name it in the table of public headers")

    def test_programs_that_reach_inside(self):
        self.plant("apps/laterna/bad.cc", '#include "base/task_pool.h"')
        self.plant("examples/bad.cpp", '#include "laterna/no_such.h"')
        self.expect('apps/laterna/bad.cc:1: includes "base/task_pool.h"; expected only "laterna/..." or a file beside it',
                    'examples/bad.cpp:1: includes "laterna/no_such.h"; expected only "laterna/..." or a file beside it')

    def test_a_circle(self):
        self.plant("src/base/a.h", '#include "base/b.h"')
        self.plant("src/base/b.h", '#include "base/a.h"')
        self.expect("src/base/a.h: includes itself through others: src/base/a.h > src/base/b.h > src/base/a.h")

    def test_links_that_are_not_the_table(self):
        path = self.root / "CMakeLists.txt"
        text = path.read_text(encoding="utf-8")
        before = "laterna_room(raster LINK room_base)"
        self.assertIn(before, text)
        path.write_text(text.replace(before, "laterna_room(raster LINK room_image)"), encoding="utf-8")
        line = text.count("\n", 0, text.index(before)) + 1
        self.expect(f"CMakeLists.txt:{line}: links raster with base, image; expected base")


if __name__ == "__main__":
    unittest.main()
