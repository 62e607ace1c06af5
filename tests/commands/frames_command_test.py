#!/usr/bin/env python3
"""Holds `laterna render --time` and `--frames` to what they promise: numbered pictures, each the still of its time.

    frames_command_test.py LATERNA SCENES
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

LATERNA, SCENES = sys.argv[1], Path(sys.argv[2])

RIG = {
    "cameras": [{"name": "main", "position": [-1.5, 1.6, 4.6], "target": [0, 0.9, -0.6], "yfov_deg": 34}],
    "lights": [{"name": "cinema", "type": "projector", "position": [1.1, 1.45, 4.3], "target": [0, 1.1, -1.2],
                "yfov_deg": 26, "candela": 190, "film": "f.##.ppm", "fps": 10, "at_end": "ping_pong",
                "shadow": {"resolution": 256}}],
}


class Frames(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.at = Path(self.folder.name)
        for k in range(5):
            pixels = bytes(value for i in range(5) for value in ((255, 255, 255) if i == k else (20, 40 * k, 60)))
            (self.at / f"f.{k + 7:02}.ppm").write_bytes(b"P6 5 1 255\n" + pixels)
        (self.at / "rig.json").write_text(json.dumps(RIG), encoding="utf-8")

    def tearDown(self):
        self.folder.cleanup()

    def render(self, *arguments):
        size = [] if "--size" in arguments else ["--size", "64x48"]
        return subprocess.run(
            [LATERNA, "render", str(SCENES / "stage.glb"), "--rig", str(self.at / "rig.json"), *size, *arguments],
            capture_output=True, text=True, check=False)

    def names(self, ending):
        return sorted(p.name for p in self.at.iterdir() if p.name.endswith(ending))

    def test_each_frame_is_the_still_of_its_time(self):
        done = self.render("--frames", "8:12", "--fps", "10", "-o", str(self.at / "out.###.exr"), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.names(".exr"), [f"out.{k:03}.exr" for k in range(8, 13)])
        pictures = json.loads(done.stdout)
        self.assertEqual([p["time_s"] for p in pictures], [k / 10 for k in range(8, 13)])
        # Slides 8 to 12 of 0 1 2 3 4 3 2 1 0 1 2 3 4 3 …: each another one, and the shadow map is drawn once.
        self.assertEqual([p["films_changed"] for p in pictures], [0, 1, 1, 1, 1])
        self.assertEqual([p["maps_drawn"] for p in pictures], [1, 0, 0, 0, 0])
        seen = set()
        for k in range(8, 13):
            still = self.at / "still.exr"
            self.assertEqual(self.render("--time", str(k / 10), "-o", str(still)).returncode, 0)
            picture = (self.at / f"out.{k:03}.exr").read_bytes()
            self.assertEqual(picture, still.read_bytes(), k)
            seen.add(picture)
        self.assertEqual(len(seen), 5)

    def ask(self, command, *arguments):
        done = subprocess.run([LATERNA, command, str(SCENES / "stage.glb"), "--rig", str(self.at / "rig.json"), *arguments],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_info_tells_the_frame_of_a_time(self):
        for time, frame in (("0", 0), ("0.25", 2), ("0.5", 3), ("0.8", 0)):
            film = json.loads(self.ask("info", "--time", time, "--json").stdout)["pictures"][-1]
            self.assertEqual((film["format"], film["size"], film["frames"]), ("numbered PNM", [5, 1], 5))
            self.assertEqual((film["duration_s"], film["frame"]), (0.5, frame))
        self.assertIn("5 frames, 0.500 s, now frame 2", self.ask("info", "--time", "0.25").stdout)

    def test_every_command_takes_a_time(self):
        probe = ("--probe", "0,1.1,-1.5,0,0,1", "--json")
        at = [json.loads(self.ask("probe", "--time", t, *probe).stdout)["probes"][0]["lux"] for t in ("0", "0.2", "0.4")]
        self.assertEqual(len(set(at)), 3)
        self.ask("inspect", "--time", "0.2", "--light", "cinema", "--point", "0,1,-1")
        self.ask("depthmap", "--time", "0.2", "--light", "cinema", "-o", str(self.at / "depth.png"))
        self.ask("accuracy", "--time", "0.2", "--techniques", "map", "--size", "32x24", "--frames", "1")
        self.ask("bench", "--time", "0.2", "--size", "32x24", "--frames", "1")

    def test_where_the_picture_lands(self):
        told = json.loads(self.ask("inspect", "--light", "cinema", "--json").stdout)
        self.assertEqual(told["light"], "cinema")
        self.assertEqual(told["pixels"], [5, 1])
        self.assertAlmostEqual(told["pixel_pitch_mm"][0], 1000 * told["width_m"] / 5)
        info = json.loads(self.ask("info", "--json").stdout)["lights"][-1]
        self.assertEqual(info["picture"], told)
        self.assertIn(f"at {told['throw_m']:.3f} m", self.ask("info").stdout)

    def test_a_projector_that_meets_nothing_is_remarked(self):
        self.assertNotIn("meets nothing", self.render("-o", str(self.at / "a.png")).stderr)
        rig = json.loads(json.dumps(RIG))
        rig["lights"][0]["target"] = [1.1, 1.45, 9]
        (self.at / "rig.json").write_text(json.dumps(rig), encoding="utf-8")
        done = self.render("-o", str(self.at / "b.png"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('note: the light of projector "cinema" meets nothing', done.stderr)
        self.assertEqual(json.loads(self.ask("inspect", "--light", "cinema", "--json").stdout), None)

    def test_rates_are_fractions(self):
        done = self.render("--frames", "1001:1001", "--fps", "30000/1001", "-o", str(self.at / "x#.png"), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)[0]["time_s"], 1001 * 1001 / 30000)
        self.assertEqual(self.names(".png"), ["x1001.png"])

    def test_what_is_kept_between_frames_is_told_and_limited(self):
        frames = ("--frames", "0:2", "--fps", "10", "-o", str(self.at / "k#.exr"), "--json")
        kept, none = (json.loads(self.render(*frames, "--cache-memory", megabytes).stdout) for megabytes in ("64", "0"))
        self.assertEqual([p["maps_drawn"] for p in kept], [1, 0, 0])
        self.assertEqual([p["maps_drawn"] for p in none], [1, 1, 1])
        # 256 × 256 texels of 8 bytes.
        self.assertTrue(all(256 * 256 * 8 <= p["map_reuse"]["bytes"] <= 64 << 20 for p in kept))
        self.assertEqual([p["map_reuse"]["bytes"] for p in none], [0, 0, 0])
        self.assertGreater(kept[0]["map_reuse"]["tiles_drawn"], 0)
        self.assertGreater(kept[0]["map_reuse"]["triangles"], 0)
        self.assertEqual([p["map_reuse"]["tiles_drawn"] for p in kept[1:]], [0, 0])
        self.assertEqual({p["map_reuse"]["tiles_kept"] for p in kept[1:]}, {kept[0]["map_reuse"]["tiles_drawn"]})
        for wrong in ("-1", "1048577", "much", "2GB"):
            done = self.render(*frames, "--cache-memory", wrong)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--cache-memory", done.stderr)
            self.assertIn("expected a whole number of megabytes from 0 to 1048576, without a unit", done.stderr)
            self.assertIn(wrong, done.stderr)

    def test_paths_clips_and_turntables(self):
        """Cameras move along their paths; frames of either are the stills of their times."""
        rig = json.loads(json.dumps(RIG))
        rig["cameras"][0]["path"] = {"keys": [{"time": 0, "position": [-1.5, 1.6, 4.6]},
                                              {"time": 0.2, "position": [1.5, 1.6, 4.6]}]}
        (self.at / "rig.json").write_text(json.dumps(rig), encoding="utf-8")
        done = self.render("--frames", "0:2", "--fps", "10", "-o", str(self.at / "p#.exr"), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([p["maps_drawn"] for p in json.loads(done.stdout)], [1, 0, 0])
        pictures = {(self.at / f"p{k}.exr").read_bytes() for k in range(3)}
        self.assertEqual(len(pictures), 3)
        self.assertEqual(self.render("--time", "0.1", "-o", str(self.at / "still.exr")).returncode, 0)
        self.assertEqual((self.at / "still.exr").read_bytes(), (self.at / "p1.exr").read_bytes())
        told = subprocess.run([LATERNA, "info", str(SCENES / "stage.glb"), "--rig", str(self.at / "rig.json"), "--json"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(json.loads(told.stdout)["clips"],
                         [{"name": "path of main", "duration_s": 0.2, "channels": 1, "plays": True, "path": True}])
        self.assertEqual(self.render("--frames", "0:1", "--fps", "0.001", "--turntable",
                                     "-o", str(self.at / "t#.exr")).returncode, 0)
        self.assertNotEqual((self.at / "t0.exr").read_bytes(), (self.at / "t1.exr").read_bytes())

    def test_what_makes_no_sense_is_refused(self):
        out = str(self.at / "out.##.png")
        for arguments, message in [
            (["--frames", "0:3", "--accumulate", "4", "--progressive", "-o", str(self.at / "out.##.png")], "--progressive is for one picture"),
            (["--shutter", "1/48", "-o", str(self.at / "out.png")], "--shutter needs --accumulate"),
            (["--shutter", "1/0", "--accumulate", "4", "-o", str(self.at / "out.png")], "--shutter: expected seconds greater than 0"),
            (["--frames", "0:3", "-o", str(self.at / "out.png")], "the output needs # where the frame's number goes"),
            (["--frames", "0:3", "-o", str(self.at / "out.avi")], "or a film's ending (.mp4, .mkv, .webm or .gif), got"),
            (["--frames", "0:3", "-o", str(self.at / "a#b#.png")], "expected one run of # in the name of the output"),
            (["--frames", "3:0", "-o", out], "--frames: expected FIRST:LAST"),
            (["--frames", "-1:2", "-o", out], "--frames: expected FIRST:LAST"),
            (["--frames", "0:x", "-o", out], "--frames: expected FIRST:LAST"),
            (["--frames", "0:9999999", "-o", out], "at most 1000000 pictures"),
            (["--frames", "0:3", "--fps", "0", "-o", out], "--fps: expected frames per second greater than 0"),
            (["--frames", "0:3", "--fps", "25/0", "-o", out], "--fps: expected frames per second greater than 0"),
            (["--frames", "0:3", "--fps", "nan", "-o", out], "--fps: expected frames per second greater than 0"),
            (["--frames", "0:3", "--fps", "1e-7", "-o", out], "would be at 1e+07 s"),
            (["--frames", "0:3", "--time", "1", "-o", out], "excludes"),
            (["--fps", "25", "-o", out], "requires --frames"),
            (["--time", "2e6", "-o", out], "a time must be from -1000000 to 1000000 seconds"),
            (["--turntable", "-o", out], "--turntable needs --frames"),
            (["--clip", "run", "-o", out], "--clip: the scene has no clip \"run\": it has none"),
            (["--frames", "0:3", "--layer-pictures", str(self.at), "-o", out], "--layer-pictures"),
            (["-o", str(self.at / "out.gif")], "a film needs --frames"),
            (["--frames", "0:3", "--resume", "-o", str(self.at / "out.gif")], "--resume goes on with numbered pictures"),
            (["--resume", "-o", str(self.at / "out.png")], "--resume goes on with numbered pictures"),
            (["--frames", "0:3", "--codec", "h264", "-o", out], "--codec and --quality are for films"),
            (["--frames", "0:3", "--background", "transparent", "-o", str(self.at / "out.gif")], "films are opaque"),
            (["--frames", "0:3", "--depth", "16", "-o", str(self.at / "out.gif")], "films have 8 bits"),
            (["--frames", "0:3", "--layers", "depth", "-o", str(self.at / "out.gif")], "--layers: only OpenEXR"),
            (["--frames", "0:3", "--fps", "60", "-o", str(self.at / "out.gif")], "at most 50 frames per second"),
            (["--frames", "0:3", "--fps", "12.3456789", "-o", str(self.at / "out.gif")], "a ratio of whole numbers"),
            (["--frames", "0:3", "--codec", "theora", "-o", str(self.at / "out.mp4")], 'there is no codec "theora"'),
            (["--frames", "0:3", "--size", "65x48", "-o", str(self.at / "out.mp4")], "must be even, got 65 x 48"),
        ]:
            with self.subTest(arguments=arguments):
                done = self.render(*arguments)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(message, done.stderr)
        self.assertEqual(self.names(".png"), [])

    def test_resume_draws_what_is_missing(self):
        out = str(self.at / "out.##.png")
        self.assertEqual(self.render("--frames", "0:5", "-o", out).returncode, 0)
        whole = {name: (self.at / name).read_bytes() for name in self.names(".png")}
        for k in (1, 4, 5):
            (self.at / f"out.{k:02}.png").unlink()
        done = self.render("--frames", "0:5", "-o", out, "--resume", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 of 6 frames are there already", done.stderr)
        self.assertEqual([p.get("skipped", False) for p in json.loads(done.stdout)],
                         [True, False, True, True, False, False])
        self.assertEqual({name: (self.at / name).read_bytes() for name in self.names(".png")}, whole)
        # Nothing to draw, whatever the settings; and then something, with others.
        self.assertEqual(self.render("--frames", "0:5", "-o", out, "--resume", "--samples", "2").returncode, 0)
        done = self.render("--frames", "0:6", "-o", out, "--resume", "--samples", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("out.05.png: --resume: this frame is not what is drawn now", done.stderr)
        self.assertEqual({name: (self.at / name).read_bytes() for name in self.names(".png")}, whole)

    def bytes_written(self):
        total = 0
        for path in self.at.iterdir():
            try:
                total += path.stat().st_size
            except FileNotFoundError:  # renamed meanwhile
                pass
        return total

    def interrupt(self, output):
        """Ctrl-C once some frames are in files, whole ones or parts."""
        before = self.bytes_written()
        with subprocess.Popen(
                [LATERNA, "render", str(SCENES / "stage.glb"), "--rig", str(self.at / "rig.json"), "--size", "640x480",
                 "--frames", "0:9999", "-o", str(self.at / output)], stderr=subprocess.PIPE, text=True) as process:
            until = time.monotonic() + 60
            while time.monotonic() < until and self.bytes_written() < before + 500_000:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            _, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT, told)
        return told

    def test_ctrl_c_keeps_whole_pictures(self):
        told = self.interrupt("out.####.png")
        self.assertIn("of 10000 frames are still to be drawn: --resume goes on", told)
        names = self.names(".png")
        self.assertEqual(names, [f"out.{k:04}.png" for k in range(len(names))])
        self.assertEqual([p for p in os.listdir(self.at) if p.startswith(".")], [])
        still = self.at / "still.png"
        self.assertEqual(self.render("--time", str((len(names) - 1) / 24), "--size", "640x480", "-o",
                                     str(still)).returncode, 0)
        self.assertEqual((self.at / names[-1]).read_bytes(), still.read_bytes())

    def test_ctrl_c_keeps_the_beginning_of_a_film(self):
        told = self.interrupt("out.gif")
        self.assertIn("out.incomplete.gif holds the film as far as it got", told)
        self.assertEqual(self.names(".gif"), ["out.incomplete.gif"])
        film = (self.at / "out.incomplete.gif").read_bytes()
        self.assertEqual((film[:6], film[-1:]), (b"GIF89a", b";"))

    def kill(self, output, enough):
        """SIGKILL once what is written is `enough`; nothing may go on after it."""
        with subprocess.Popen(
                [LATERNA, "render", str(SCENES / "stage.glb"), "--rig", str(self.at / "rig.json"), "--size", "160x120",
                 "--frames", "0:9999", "-o", str(self.at / output)], stderr=subprocess.DEVNULL) as process:
            until = time.monotonic() + 60
            while time.monotonic() < until and not enough():
                time.sleep(0.003)
            process.kill()
        self.assertEqual(process.returncode, -signal.SIGKILL)

    def test_a_kill_leaves_whole_pictures(self):
        for k in range(1, 6):
            self.kill("k.####.png", lambda k=k: len(self.names(".png")) >= 3 * k)
            names = self.names(".png")
            self.assertEqual(names, [f"k.{i:04}.png" for i in range(len(names))])
            for name in names:
                self.assertEqual((self.at / name).read_bytes()[-8:-4], b"IEND", name)
            # What was at work leaves at most one hidden file.
            parts = self.names(".part")
            self.assertLessEqual(len(parts), 1)
            for part in parts:
                (self.at / part).unlink()
        last = len(self.names(".png")) - 1
        done = self.render("--frames", f"0:{last + 1}", "--size", "160x120", "-o", str(self.at / "k.####.png"), "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{last + 1} of {last + 2} frames are there already", done.stderr)

    def test_a_kill_leaves_a_film_that_can_be_played(self):
        for output in ("a.gif", "a.mkv", "a.mp4", "a.webm"):
            done = self.render("--frames", "0:1", "-o", str(self.at / f"probe-{output}"))
            if done.returncode == 2 and "FFmpeg" in done.stderr:
                continue
            for frames in (2, 5):
                self.kill(output, lambda k=frames: self.bytes_written_to(output) > 2000 * k)
                (part,) = [p for p in self.names(".part") if output in p]
                (self.at / part).rename(self.at / output)
                rig = json.loads(json.dumps(RIG))
                rig["lights"][0]["film"] = output
                rig["lights"][0].pop("fps")
                (self.at / "film.json").write_text(json.dumps(rig), encoding="utf-8")
                told = subprocess.run([LATERNA, "info", str(SCENES / "stage.glb"), "--rig", str(self.at / "film.json"),
                                       "--json"], capture_output=True, text=True, check=False)
                self.assertEqual(told.returncode, 0, told.stderr)
                self.assertGreater(json.loads(told.stdout)["pictures"][-1]["frames"], 0)
                (self.at / output).unlink()

    def bytes_written_to(self, output):
        return sum(p.stat().st_size for p in self.at.iterdir() if p.name.startswith("." + output))

    def test_a_film_is_its_pictures(self):
        """Thrown as slides, a film's frames and the numbered pictures light the scene alike."""
        done = subprocess.run([LATERNA, "render", "--list-codecs"], capture_output=True, text=True, check=True)
        self.assertIn("gif", done.stdout)
        if "ffv1   .mkv" not in done.stdout or "not here: FFmpeg lacks ffv1" in done.stdout:
            self.skipTest("FFmpeg's libraries are not there")
        self.assertEqual(self.render("--frames", "0:3", "-o", str(self.at / "p.##.png")).returncode, 0)
        done = self.render("--frames", "0:3", "-o", str(self.at / "p.mkv"), "--codec", "ffv1")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, out in (("p.##.png", "a.#.exr"), ("p.mkv", "b.#.exr")):
            rig = json.loads((self.at / "rig.json").read_text(encoding="utf-8"))
            rig["lights"][0]["film"] = name
            rig["lights"][0].pop("fps", None)
            (self.at / "rig.json").write_text(json.dumps(rig), encoding="utf-8")
            done = self.render("--frames", "0:3", "-o", str(self.at / out))
            self.assertEqual(done.returncode, 0, done.stderr)
        for k in range(4):
            self.assertEqual((self.at / f"a.{k}.exr").read_bytes(), (self.at / f"b.{k}.exr").read_bytes(), k)

    def test_a_film_that_is_not_there(self):
        (self.at / "f.09.ppm").unlink()
        done = self.render("-o", str(self.at / "out.png"))
        self.assertEqual(done.returncode, 3)
        self.assertIn("f.##.ppm: number 9 is missing: there are 7 to 11", done.stderr)

    def test_doctor_tells_of_video(self):
        done = subprocess.run([LATERNA, "doctor", "--json"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        video = json.loads(done.stdout)["video"]
        self.assertIn("libavcodec" if video["available"] else "install", video["detail"])
        self.assertIn("gif", video["codecs"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
