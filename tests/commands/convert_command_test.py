#!/usr/bin/env python3
"""`laterna convert`: the same pictures from what is written, files that the schemas accept, and schemas that name every key.

    convert_command_test.py LATERNA SCENES SCHEMAS
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import jsonschema

LATERNA = SCENES = SCHEMAS = None
OK, BAD_USAGE, BAD_INPUT, CANNOT_WRITE = 0, 2, 3, 4


def run(*arguments):
    return subprocess.run([LATERNA, *map(str, arguments)], capture_output=True, text=True, check=False)


def load(schema):
    return json.loads((SCHEMAS / f"{schema}.schema.json").read_text())


def check(schema, instance):
    with warnings.catch_warnings():  # its successor is not in Debian 12
        warnings.simplefilter("ignore", DeprecationWarning)
        known = {f"{name}.schema.json": load(name) for name in ("definitions", schema)}
        resolver = jsonschema.RefResolver("", {}, store=known)
        jsonschema.Draft202012Validator(known[f"{schema}.schema.json"], resolver=resolver).validate(instance)


def extensions(value, name):
    """Every object of that name below `value`, with the member that holds its owner."""
    if isinstance(value, list):
        for each in value:
            yield from extensions(each, name)
    elif isinstance(value, dict):
        if name in value.get("extensions", {}):
            yield value["extensions"][name]
        for each in value.values():
            yield from extensions(each, name)


class Convert(unittest.TestCase):
    def setUp(self):
        self.folder_ = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder_.cleanup)
        self.folder = Path(self.folder_.name)

    def convert(self, scene, rig, name):
        done = run("convert", SCENES / scene, "--rig", SCENES / rig, "-o", self.folder / name)
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        return self.folder / name

    def test_the_picture_is_the_same(self):
        for scene, rig in [("stage.glb", "stage.json"), ("room.glb", "lamps.json"), ("road.glb", "headlights.json"),
                           ("apron.glb", "taxi_light.json"), ("room.glb", "focus.json")]:
            with self.subTest(rig=rig):
                pictures = []
                converted = self.convert(scene, rig, "a.gltf")
                for i, source in enumerate([[SCENES / scene, "--rig", SCENES / rig], [converted]]):
                    picture = self.folder / f"{i}.exr"
                    done = run("render", *source, "-o", picture, "--size", "96x64", "--samples", "1")
                    self.assertEqual(done.returncode, OK, done.stderr)
                    pictures.append(picture.read_bytes())
                self.assertEqual(pictures[0], pictures[1])

    def test_a_path_is_written_as_it_is_at_a_time(self):
        rig = self.folder / "rig.json"
        rig.write_text(json.dumps({"cameras": [{"name": "main", "position": [0, 2, 6], "target": [0, 1, 0], "yfov_deg": 40,
            "path": {"keys": [{"time": 0, "position": [0, 2, 6]}, {"time": 2, "position": [4, 2, 5]}]}}],
            "lights": [{"name": "lamp", "type": "point", "position": [0, 2, 2], "candela": 50}]}))
        written = self.folder / "a.glb"
        done = run("convert", SCENES / "stage.glb", "--rig", rig, "--time", "1", "-o", written)
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn("animation is left out: the file shows the scene at 1 s", done.stderr)
        pictures = []
        for i, source in enumerate([[SCENES / "stage.glb", "--rig", rig, "--time", "1"], [written]]):
            picture = self.folder / f"{i}.pfm"
            done = run("render", *source, "-o", picture, "--size", "48x32")
            self.assertEqual(done.returncode, OK, done.stderr)
            pictures.append(picture.read_bytes())
        self.assertEqual(pictures[0], pictures[1])

    def test_water_and_films_stand_still_at_a_time(self):
        for k in range(4):
            pixels = bytes(value for i in range(5) for value in ((255, 255, 255) if i == k else (20, 60 * k, 60)))
            (self.folder / f"f.{k}.ppm").write_bytes(b"P6 5 1 255\n" + pixels)
        (self.folder / "still").mkdir()
        rig, written = self.folder / "rig.json", self.folder / "still" / "a.gltf"
        # The last one's phase would leave its limit, were it not brought back by a turn.
        waves = [{"direction": [1, 0, 0.3], "length": 0.5, "amplitude": 0.01},
                 {"direction": [0, 0, 1], "length": 0.31, "amplitude": 0.006, "speed": -0.7, "phase_deg": 36000},
                 {"direction": [-1, 0, 1], "length": 0.77, "amplitude": 0.01, "speed": 0.9, "phase_deg": -35999}]
        for at_end, time in (("hold", "0.17"), ("ping_pong", "1234.56"), ("black", "12")):
            rig.write_text(json.dumps({
                "surfaces": [{"material": "boards", "mirror": {"ior": 1.333, "waves": waves}}],
                "lights": [{"name": "cinema", "type": "projector", "position": [0, 1.6, 1.5], "target": [0, 1, -2],
                            "yfov_deg": 40, "candela": 300, "film": "f.#.ppm", "fps": 10, "at_end": at_end}]}))
            with self.subTest(at_end=at_end):
                source = [SCENES / "room.glb", "--rig", rig]
                done = run("convert", *source, "--time", time, "-o", written)
                self.assertEqual(done.returncode, OK, done.stderr)
                self.assertEqual(done.stderr, "laterna: note: animation is left out: the file shows the scene at "
                                              f"{time} s, as --time asks\n")
                gltf = json.loads(written.read_text())
                self.assertEqual([p["film"] for p in extensions(gltf["extensions"], "LATERNA_projector") if "film" in p], [])
                told = [wave for m in extensions(gltf["materials"], "LATERNA_mirror") for wave in m["waves"]]
                self.assertEqual([wave["speed"] for wave in told], [0, 0, 0])
                self.assertLess(max(abs(wave["phase"]) for wave in told), 628.32)
                pictures = []
                for what in ([*source, "--time", time], [written], [written, "--time", "7.7"], source):
                    picture = self.folder / "picture.exr"
                    done = run("render", *what, "-o", picture, "--size", "96x64", "--samples", "1")
                    self.assertEqual(done.returncode, OK, done.stderr)
                    pictures.append(picture.read_bytes())
                self.assertEqual(pictures[1:3], [pictures[0]] * 2)
                self.assertNotEqual(pictures[3], pictures[0])

    def test_a_frame_that_cannot_be_read_is_told(self):
        for k in range(2):
            (self.folder / f"f.{k}.ppm").write_bytes(b"P6 1 1 255\n" + bytes(3))
        (self.folder / "f.1.ppm").write_bytes(b"P6 1 1 255\n")
        rig, written = self.folder / "rig.json", self.folder / "a.gltf"
        rig.write_text(json.dumps({"lights": [{"name": "cinema", "type": "projector", "position": [0, 1, 1],
                                               "target": [0, 1, 0], "yfov_deg": 40, "candela": 300, "film": "f.#.ppm"}]}))
        done = run("convert", SCENES / "room.glb", "--rig", rig, "--time", "1", "-o", written)
        self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
        self.assertIn("f.1.ppm", done.stderr)
        self.assertFalse(written.exists())

    def test_paths_go_along(self):
        rig = self.folder / "rig.json"
        rig.write_text(json.dumps({"cameras": [{"name": "main", "position": [0, 2, 6], "target": [0, 1, 0], "yfov_deg": 40,
            "path": {"at_end": "ping_pong", "keys": [{"time": 0, "position": [0, 2, 6]}, {"time": 2, "position": [4, 2, 5]}]}}],
            "lights": [{"name": "lamp", "type": "projector", "position": [0, 2, 4], "target": [0, 1, 0], "yfov_deg": 30, "candela": 50,
                        "path": {"keys": [{"time": 0, "candela": 50}, {"time": 2, "candela": 200}]}}]}))
        written = self.folder / "a.gltf"
        done = run("convert", SCENES / "stage.glb", "--rig", rig, "-o", written)
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        gltf = json.loads(written.read_text())
        self.assertEqual([a["name"] for a in gltf["animations"]], ["path of main", "path of lamp"])
        for animation in gltf["animations"]:
            check("animation.LATERNA_lighting", animation["extensions"]["LATERNA_lighting"])
        for time in ("0.5", "3"):
            pictures = []
            for i, source in enumerate([[SCENES / "stage.glb", "--rig", rig], [written]]):
                picture = self.folder / f"{i}.exr"
                done = run("render", *source, "--time", time, "-o", picture, "--size", "96x64", "--depth", "float")
                self.assertEqual(done.returncode, OK, done.stderr)
                pictures.append(picture)
            # Keys are in single precision: a hundred-thousandth, but for pixels on an edge.
            told = json.loads(run("diff", *pictures, "--json").stdout)
            self.assertLess(told["rms_error"], 1e-4, told)

    def test_the_schemas_accept_what_is_written(self):
        for scene, rig in [("stage.glb", "stage.json"), ("table.glb", "table.json"), ("room.glb", "lamp.json"),
                           ("room.glb", "lamps.json"), ("room.glb", "focus.json"), ("stage.glb", "ground.json")]:
            with self.subTest(rig=rig):
                gltf = json.loads(self.convert(scene, rig, "a.gltf").read_text())
                lights = gltf["extensions"].get("KHR_lights_punctual", {})
                for light in extensions(lights, "LATERNA_projector"):
                    check("light.LATERNA_projector", light)
                for light in extensions(lights, "LATERNA_lighting"):
                    check("light.LATERNA_lighting", light)
                for place in ["scene", "camera"]:
                    for owner in gltf.get(place + "s", []):
                        if "LATERNA_lighting" in owner.get("extensions", {}):
                            check(place + ".LATERNA_lighting", owner["extensions"]["LATERNA_lighting"])

    def test_mirrors_are_carried(self):
        rig = self.folder / "mirror.json"
        rig.write_text(json.dumps({"surfaces": [{"material": "boards", "mirror": {
            "reflectance": [0.8, 0.9, 1], "ior": 1.5, "roughness": 0.2,
            "waves": [{"direction": [1, 0, 0.3], "length": 0.5, "amplitude": 0.01, "speed": 1, "phase_deg": 40}]}}]}))
        written = self.folder / "a.gltf"
        done = run("convert", SCENES / "room.glb", "--rig", rig, "-o", written)
        self.assertEqual((done.returncode, done.stderr), (OK, ""))
        mirrors = list(extensions(json.loads(written.read_text())["materials"], "LATERNA_mirror"))
        self.assertEqual(len(mirrors), 1)
        self.assertEqual(mirrors[0]["reflectance"], [0.8, 0.9, 1])
        check("material.LATERNA_mirror", mirrors[0])

    def known_keys(self, place, extension):
        """The keys that the reader names where none of them is right."""
        gltf = {"asset": {"version": "2.0"}, "scenes": [{}], "scene": 0,
                "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}, "camera": 0}],
                "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
                "animations": [{"channels": [], "samplers": []}],
                "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}}}
        gltf["scenes"][0]["nodes"] = [0]
        owners = {"light": gltf["extensions"]["KHR_lights_punctual"]["lights"][0], "camera": gltf["cameras"][0],
                  "node": gltf["nodes"][0], "scene": gltf["scenes"][0], "animation": gltf["animations"][0]}
        keys = list(load(f"{place}.{extension}")["properties"])
        # Not null: a value of another type is no unknown key.
        owners[place].setdefault("extensions", {})[extension] = {key: [{}] for key in keys + ["not_a_key"]}
        file = self.folder / "keys.gltf"
        file.write_text(json.dumps(gltf))
        told = run("info", file).stderr
        return keys, set(re.findall(r'has no key "(\w+)"', told))

    def test_the_reader_knows_the_keys_of_the_schemas(self):
        for place, extension in [("light", "LATERNA_projector"), ("camera", "LATERNA_lighting"),
                                 ("node", "LATERNA_lighting"), ("scene", "LATERNA_lighting"),
                                 ("animation", "LATERNA_lighting")]:
            with self.subTest(place=place, extension=extension):
                _, unknown = self.known_keys(place, extension)
                self.assertEqual(unknown, {"not_a_key"})
        # Of a spot: what is for directional lights alone is told to be unknown there.
        _, unknown = self.known_keys("light", "LATERNA_lighting")
        self.assertEqual(unknown, {"not_a_key", "angularDiameter", "halfWidth", "halfHeight", "frustum", "znear", "zfar"})

    def test_the_schemas_know_every_name(self):
        names = set(re.findall(r'\{"\w+", "(\w+)"\}', (SCHEMAS.parents[1] / "src/scene/setting_names.cc").read_text()))
        text = "".join(file.read_text() for file in SCHEMAS.glob("*.json"))
        self.assertEqual({name for name in names if f'"{name}"' not in text}, set())
        self.assertGreater(len(names), 40)

    def test_what_goes_wrong_is_told(self):
        for arguments, code, message in [
            ([SCENES / "room.glb", "-o", self.folder / "a.obj"], BAD_USAGE, "must end in .glb or .gltf"),
            ([SCENES / "none.glb", "-o", self.folder / "a.glb"], BAD_INPUT, "no such file"),
            ([SCENES / "room.glb", "-o", self.folder / "none" / "a.glb"], CANNOT_WRITE, "cannot create"),
            ([SCENES / "room.glb"], BAD_USAGE, "--output is required"),
            ([SCENES / "room.glb", "-o", self.folder / "a.glb", "--environment-size", "100"], BAD_USAGE,
             "must be a power of two, 32, 64, 128 ... 4096, got 100"),
        ]:
            done = run("convert", *arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    LATERNA, SCENES, SCHEMAS = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    unittest.main(argv=sys.argv[:1])
