#!/usr/bin/env python3
"""Holds `laterna accuracy`, `laterna bench` and `laterna render --debug pairs` to what they promise: JSON, exit codes, messages.

    accuracy_command_test.py LATERNA SCENES
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LATERNA, SCENES = sys.argv[1], Path(sys.argv[2])
FOLDER = tempfile.TemporaryDirectory()
SUN = Path(FOLDER.name) / "sun.json"
SUN.write_text('{"lights": [{"name": "sun", "type": "directional", "position": [2, 5, 3], "target": [0, 0, 0]}]}',
               encoding="utf-8")
STAGE = [str(SCENES / "stage.glb"), "--rig", str(SUN), "--rig", str(SCENES / "stage.json"), "--size", "96x72"]
KEYS = ["technique", "light", "false_lit", "false_dark", "acne", "gap_texels", "edge_px_median", "edge_px_p99", "ms",
        "mb"]
QUICK = ["--frames", "1", "--threads", "2"]


def run(command, *arguments):
    return subprocess.run([LATERNA, command, *arguments], capture_output=True, text=True, check=False)


class Accuracy(unittest.TestCase):
    def measure(self, *arguments):
        done = run("accuracy", *arguments, *QUICK, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_json_has_an_entry_for_each_technique_and_light(self):
        entries = self.measure(*STAGE, "--techniques", "map,raytraced")
        self.assertEqual([(e["light"], e["technique"]) for e in entries],
                         [("sun", "map"), ("sun", "raytraced"), ("magic lantern", "map"),
                          ("magic lantern", "raytraced")])
        for entry in entries:
            self.assertEqual(list(entry)[:len(KEYS)], KEYS)
            for key in KEYS[2:]:
                self.assertIsInstance(entry[key], (int, float))
            self.assertGreater(entry["pixels"], 500)
            self.assertTrue(0 <= entry["acne"] <= entry["false_dark"] <= 1)

    def test_all_techniques_are_measured_or_said_to_be_skipped(self):
        done = run("accuracy", *STAGE, "--lights", "sun", *QUICK)
        self.assertEqual(done.returncode, 0, done.stderr)
        listed = run("render", "--list-techniques").stdout
        for technique in [line.split()[0] for line in listed.splitlines() if line.strip()]:
            is_measured = any(line.split()[:2] == [technique, "sun"] for line in done.stdout.splitlines())
            is_skipped = f'skipped technique "{technique}", light "sun"' in done.stderr
            self.assertTrue(is_measured != is_skipped, technique + done.stdout + done.stderr)

    def test_lights_can_be_chosen(self):
        entries = self.measure(*STAGE, "--techniques", "map", "--lights", "sun")
        self.assertEqual([e["light"] for e in entries], ["sun"])

    def test_auto_lights_where_there_are_none_and_where_they_are_asked_for(self):
        room = [str(SCENES / "room.glb"), "--size", "64x48", "--techniques", "map"]
        auto = ["auto sun", "auto spot", "auto point"]
        bare = run("accuracy", *room, *QUICK, "--json")
        self.assertEqual([e["light"] for e in json.loads(bare.stdout)], auto)
        self.assertIn("the scene has no light: it is measured with --lights auto", bare.stderr)
        self.assertEqual([e["light"] for e in self.measure(*STAGE, "--techniques", "map", "--lights", "auto")], auto)

    def test_a_limit_that_is_broken_is_named_and_gives_exit_code_1(self):
        done = run("accuracy", *STAGE, *QUICK, "--techniques", "none", "--lights", "sun", "--fail",
                   "acne>0, false_lit>0.001")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr,
                         r'laterna: error: technique "none", light "sun": false_lit is 0\.\d+, which fails false_lit>0\.001')
        self.assertNotIn("acne", done.stderr)

    def test_a_limit_that_holds_gives_exit_code_0(self):
        done = run("accuracy", *STAGE, *QUICK, "--techniques", "map,raytraced", "--fail", "acne>0,false_lit>=0.1,ms<0")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_none_is_held_to_limits_only_where_it_is_named(self):
        done = run("accuracy", *STAGE, *QUICK, "--lights", "sun", "--fail", "edge_px_median>=32")
        self.assertNotIn('"none"', done.stderr)

    def test_a_check_of_what_no_pixel_sees_fails_unless_that_is_allowed(self):
        with tempfile.TemporaryDirectory() as folder:
            rig = Path(folder) / "away.json"
            rig.write_text('{"lights": [{"name": "away", "type": "spot", "position": [0, 3, 0], "target": [0, 9, 0]}]}',
                           encoding="utf-8")
            away = [str(SCENES / "table.glb"), "--rig", str(rig), "--size", "96x72", "--techniques", "map", *QUICK]
            fail = ["--fail", "acne>0"]
            done = run("accuracy", *away, *fail)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn('laterna: error: --fail: light "away" falls on nothing that the picture shows, so its shadows are '
                          'not checked', done.stderr)
            self.assertEqual(run("accuracy", *away, *fail, "--allow-unseen").returncode, 0)
            self.assertEqual(run("accuracy", *away).returncode, 0, "without limits it is a note")

    def test_a_technique_asked_for_that_serves_no_light_fails_the_check(self):
        lantern = [*STAGE, *QUICK, "--lights", "magic lantern", "--techniques", "map,cascades", "--fail", "acne>0"]
        done = run("accuracy", *lantern)
        self.assertEqual(done.returncode, 1)
        self.assertIn('--fail: technique "cascades" could be measured with no light: cascades serve directional lights '
                      'only', done.stderr)
        self.assertEqual(run("accuracy", *lantern, "--allow-unseen").returncode, 0)
        with_sun = [*STAGE, *QUICK, "--techniques", "map,cascades", "--fail", "acne>0"]
        self.assertEqual(run("accuracy", *with_sun).returncode, 0, "it serves the sun")

    def test_the_difference_picture_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "wrong.png"
            done = run("accuracy", *STAGE, *QUICK, "--techniques", "none,map", "--difference", str(picture))
            self.assertEqual(done.returncode, 0, done.stderr)
            header = picture.read_bytes()[16:24]
            width, height = int.from_bytes(header[:4], "big"), int.from_bytes(header[4:], "big")
            self.assertTrue(2 * 96 < width < 2 * 96 + 20, width)
            self.assertGreater(height, 2 * 72 + 4 * 7, "names and a legend beside the pictures")

    def test_bad_arguments_are_refused_with_a_message(self):
        measures = ("false_lit, false_dark, acne, gap_texels, edge_px_median, edge_px_p99, ms, mb, edge_px_mean, "
                    "mean_error")
        for arguments, message in [
                ([], "accuracy needs a SCENE or --workload"),
                ([*STAGE, "--techniques", "blurry"], '--techniques: there is no technique "blurry"; there are all, none, '),
                ([*STAGE, "--techniques", ","], "--techniques: expected names; there are all, none, "),
                ([*STAGE, "--fail", "beauty>1"], f'--fail: there is no measure "beauty"; there are {measures}'),
                ([*STAGE, "--fail", "acne"], '--fail: expected a measure, one of > >= < <=, and a number, such as '
                                             'acne>0, got "acne"'),
                ([*STAGE, "--fail", "acne>x"], 'such as acne>0, got "acne>x"'),
                ([*STAGE, "--lights", "moon"], 'the scene has no light "moon" that is on: it has "sun", "magic lantern"'),
                ([*STAGE, "--subpixels", "0"], "subpixels must be 1 to 8, not 0"),
                ([*STAGE, "--frames", "0"], "at least one frame must be timed"),
                ([*STAGE, "--resolution", "-5"], "a shadow map's resolution cannot be negative"),
                ([*STAGE, "--difference", "-"], "accuracy prints to standard output: give --difference a file"),
        ]:
            done = run("accuracy", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stdout, "")

    def test_a_folder_that_cannot_be_written_is_said_before_measuring(self):
        done = run("accuracy", *STAGE, "--difference", "/nowhere/at/all.png")
        self.assertEqual(done.returncode, 4)
        self.assertIn("/nowhere/at/all.png", done.stderr)


class Bench(unittest.TestCase):
    """Rows 107 and 28 of the papers' list."""

    def test_techniques_stand_side_by_side_with_advice(self):
        done = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--techniques", "none,map,raytraced", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual([t["technique"] for t in report["techniques"]], ["none", "map", "raytraced"])
        for technique in report["techniques"]:
            self.assertGreater(technique["frame_ms"], 0)
        none, shadow_map, rays = report["techniques"]
        self.assertGreater(none["wrong"], shadow_map["wrong"])
        self.assertEqual((rays["wrong"], rays["edge_px_p99"]), (0, 0))
        self.assertGreater(shadow_map["mb"], 0)
        self.assertIn("raytraced", report["advice"])
        self.assertNotIn("none", report["advice"])

    def test_errors_are_those_of_accuracy(self):
        done = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--techniques", "none,silhouette,cascades", "--json")
        measured = json.loads(run("accuracy", *STAGE, *QUICK, "--techniques", "none,silhouette,map,cascades", "--json").stdout)
        for entry in json.loads(done.stdout)["techniques"]:
            stand_ins = entry["lights_by_map"]
            self.assertEqual(stand_ins, ["magic lantern"] if entry["technique"] == "cascades" else [])
            same = [m for m in measured
                    if m["technique"] == ("map" if m["light"] in stand_ins else entry["technique"])]
            self.assertEqual(len(same), 2)
            for measure in ("edge_px_median", "edge_px_mean", "edge_px_p99", "acne", "gap_texels"):
                self.assertEqual(entry[measure], max(m[measure] for m in same), (entry["technique"], measure))

    def test_silhouettes_are_counted_with_and_without_culling(self):
        """Row 47."""
        done = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--shadows", "silhouette", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        both = json.loads(done.stdout)["silhouettes"]
        for culled, unculled in zip(both["culled"]["lights"], both["unculled"]["lights"], strict=True):
            self.assertEqual(culled["light"], unculled["light"])
            self.assertEqual(culled["objects"], unculled["objects"])
            self.assertLess(culled["pairs"], unculled["pairs"])
            self.assertLessEqual(culled["silhouettes_drawn"], culled["silhouettes"])
            self.assertLessEqual(culled["silhouettes"], unculled["silhouettes"])
            self.assertEqual(unculled["silhouettes_drawn"], unculled["silhouettes"])
        self.assertGreater(both["unculled"]["frame_ms"], 0)
        table = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--shadows", "silhouette").stdout
        self.assertRegex(table, r"\nculled +\d+ +\d+ +\d+ +\d+   sun\n")
        self.assertRegex(table, r"\nunculled +\d+ +\d+ +\d+ +\d+   sun\n")
        self.assertNotIn("unculled", run("bench", *STAGE, *QUICK, "--warm-up", "0").stdout)

    def test_projecting_stands_beside_texturing(self):
        done = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--techniques", "none", "--json")
        report = json.loads(done.stdout)
        for use in ("textured", "projected"):
            rate = report[use]
            self.assertAlmostEqual(rate["mpix_per_s"] * rate["ms"], 96 * 72 / 1e3, places=6)
            self.assertGreater(rate["mtri_per_s"], 0)
        self.assertAlmostEqual(report["projected_over_textured"],
                               report["projected"]["ms"] / report["textured"]["ms"], places=9)

    def test_the_table_ends_with_advice(self):
        done = run("bench", *STAGE, *QUICK, "--warm-up", "0", "--techniques", "all")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("\nadvice: ", done.stdout)
        self.assertIn("\nprojected ", done.stdout)

    def test_options_that_exclude_each_other_are_refused(self):
        for other in (["--cached"], ["--pose"], ["--png", "a.png"]):
            done = run("bench", *STAGE, "--techniques", "all", *other)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--techniques excludes --cached, --pose and --png", done.stderr)


class PictureTechnique(unittest.TestCase):
    def test_lights_that_it_cannot_serve_keep_map_and_that_is_said(self):
        note = 'laterna: note: light "magic lantern" keeps shadow technique "map": cascades serve directional lights only\n'
        for command, more in (("render", ["-o", str(Path(FOLDER.name) / "cascades.png")]),
                              ("bench", [*QUICK, "--warm-up", "0"])):
            done = run(command, *STAGE, "--shadows", "cascades", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(note, done.stderr)
            self.assertNotIn("keeps", run(command, *STAGE, "--shadows", "exact", *more).stderr)


class DebugPairs(unittest.TestCase):
    def draw(self, *arguments):
        return run("render", *STAGE, "-o", str(Path(FOLDER.name) / "pairs.png"), *arguments)

    def test_the_pairs_of_the_first_light_or_of_the_one_that_is_named_are_listed(self):
        for choice in ["pairs", "pairs:sun"]:
            done = self.draw("--shadows", "silhouette", "--debug", choice)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, r'laterna: \d+ pairs of 8 objects; ')
            self.assertRegex(done.stderr, r'laterna: "ball" \(\w+\) may shade "floor" \(\w+\)')

    def test_what_cannot_be_shown_is_refused(self):
        for arguments, message in [
                (["--debug", "pairs"], "--debug pairs: no light has projected silhouettes"),
                (["--shadows", "silhouette", "--debug", "pairs:moon"], 'the scene has no light "moon"'),
                (["--debug", "pears"], 'texel-density or pairs, the last four with or without :LIGHT, got "pears"'),
        ]:
            done = self.draw(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
