#!/usr/bin/env python3
"""Holds every #include of the project against the table of rooms.

Prints "file:line: what is wrong, what was expected" for each fault and exits with 1 when there is one.
CMakeLists.txt must link the rooms by the same table, so that what compiles and what is allowed are one thing.

    scripts/check_includes.py [ROOT]
"""

import re
import sys
from pathlib import Path, PurePosixPath

# Which rooms of src/ each room may include. What data flows through comes first.
ROOMS = {
    "base": [],
    "image": ["base"],
    "scene": ["base", "image"],
    "frame": ["base", "image", "scene"],
    "light": ["base", "image", "scene", "frame"],
    "raster": ["base"],
    "trace": ["base", "image", "scene", "frame"],
    "shadow": ["base", "image", "scene", "frame", "light", "raster", "trace"],
    "shade": ["base", "image", "scene", "frame", "light", "raster", "trace", "shadow"],
    "render": ["base", "image", "scene", "frame", "light", "raster", "trace", "shadow", "shade"],
    "measure": ["base", "image", "scene", "frame", "light", "raster", "trace", "shadow", "shade", "render"],
    "bake": ["base", "image", "scene", "frame", "light", "raster", "trace", "shadow", "shade", "render"],
}

# The room that implements each header of include/laterna: who may include the room may include the header.
PUBLIC_HEADERS = {
    "accuracy.h": "measure",
    "animation.h": "scene",
    "bake.h": "bake",
    "blend.h": "scene",
    "build_info.h": "measure",
    "environment.h": "image",
    "environment_accuracy.h": "measure",
    "environment_probe.h": "render",
    "false_color.h": "measure",
    "film.h": "image",
    "image.h": "image",
    "image_based_light.h": "render",
    "instruction_set.h": "base",
    "lamps.h": "scene",
    "lens.h": "base",
    "material_lobes.h": "scene",
    "measure.h": "measure",
    "light_color.h": "image",
    "mirrors.h": "scene",
    "output.h": "base",
    "polar_plot.h": "measure",
    "probes.h": "render",
    "quake_surfaces.h": "bake",
    "radiosity.h": "bake",
    "relief.h": "scene",
    "render.h": "render",
    "photograph_files.h": "scene",
    "photographs.h": "scene",
    "result.h": "base",
    "sampler.h": "image",
    "scene.h": "scene",
    "shading.h": "shade",
    "shadows.h": "scene",
    "stages.h": "base",
    "still_scene.h": "scene",
    "technique_choice.h": "scene",
    "terrain.h": "scene",
    "thrown_picture.h": "measure",
    "turntable.h": "base",
    "video.h": "image",
    "view.h": "base",
    "write_scene.h": "scene",
}

# Libraries that belong to one room: nobody else may know that they are there. measure/build_info.cc prints the
# versions of all.
LIBRARIES = {
    "tbb/": ["base"],
    "png.h": ["image"],
    "turbojpeg.h": ["image"],
    "libdeflate.h": ["image"],
    "isa-l": ["image"],
    "Imf": ["image"],
    "half.h": ["image"],
    "OpenEXR/": ["image"],
    "nlohmann/": ["scene"],
    "assimp/": ["scene"],
    "draco/": ["scene"],
    "meshoptimizer.h": ["scene"],
    "embree3/": ["trace"],
    "libav": [],  # plugins/ alone: they are loaded only when a video is opened
}
VERSIONS_OF_ALL = "src/measure/build_info.cc"

# Vectors of Highway appear in kernels and in what only kernels include: elsewhere their size is unknown.
VECTORS = "hwy/"
KERNEL_ENDINGS = (".simd.cc", "-inl.h")

# What callers must have: public headers include nothing else.
PUBLIC_LIBRARIES = ("glm/", "tl/")

SOURCE_ENDINGS = (".h", ".cc", ".cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


class Faults:
    def __init__(self):
        self.count = 0

    def add(self, place, message):
        self.count += 1
        print(f"{place}: {message}")


def sources(root, folder):
    return sorted(p for p in (root / folder).rglob("*") if p.suffix in SOURCE_ENDINGS)


def includes_of(path):
    """(line number, included name, is quoted) of each #include."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) or match.group(2), match.group(1) is not None


def known_rooms():
    return ", ".join(ROOMS)


def check_room_include(room, name, place, faults):
    """One quoted include of src/<room>."""
    folder, _, rest = name.partition("/")
    allowed = [*ROOMS[room], room]
    if folder == "laterna":
        owner = PUBLIC_HEADERS.get(rest)
        if owner is None:
            faults.add(place, f'includes "{name}", which the table of public headers does not name')
        elif owner not in allowed:
            faults.add(place, f'includes "{name}", which belongs to {owner}; {room} may include {", ".join(allowed)}')
    elif folder not in ROOMS or not rest:
        faults.add(place, f'includes "{name}"; expected a path from src/: one of the rooms {known_rooms()}')
    elif folder not in allowed:
        faults.add(place, f'includes "{name}"; {room} may include {", ".join(allowed)}')


def check_library(path, room, name, place, faults):
    """One angled include of src/<room>."""
    if path == VERSIONS_OF_ALL:
        return
    if name.startswith(VECTORS) and not path.endswith(KERNEL_ENDINGS):
        faults.add(place, f"includes <{name}>; expected only in files that end in {' or '.join(KERNEL_ENDINGS)}")
    for prefix, rooms in LIBRARIES.items():
        if name.startswith(prefix) and room not in rooms:
            faults.add(place, f"includes <{name}>; expected only in {', '.join(rooms)}")


def check_src(root, faults):
    for path in sources(root, "src"):
        relative = path.relative_to(root).as_posix()
        room = PurePosixPath(relative).parts[1]
        if room not in ROOMS:
            faults.add(relative, f"lies in no room of the table; expected one of {known_rooms()}")
            continue
        for number, name, quoted in includes_of(path):
            place = f"{relative}:{number}"
            if quoted:
                check_room_include(room, name, place, faults)
            else:
                check_library(relative, room, name, place, faults)


def is_standard(name):
    return "/" not in name and "." not in name


def check_public(root, faults):
    found = set()
    for path in sources(root, "include/laterna"):
        relative = path.relative_to(root).as_posix()
        found.add(path.name)
        owner = PUBLIC_HEADERS.get(path.name)
        if owner is None:
            faults.add(relative, "is a public header of no room; name it in the table of public headers")
            continue
        for number, name, quoted in includes_of(path):
            place = f"{relative}:{number}"
            if quoted and not name.startswith("laterna/"):
                faults.add(place, f'includes "{name}"; expected only "laterna/..." in public headers')
            elif quoted:
                check_room_include(owner, name, place, faults)
            elif not is_standard(name) and not name.startswith(PUBLIC_LIBRARIES):
                faults.add(place, f"includes <{name}>; callers have only the standard library, GLM and tl::expected")
    for name in sorted(set(PUBLIC_HEADERS) - found):
        faults.add(f"include/laterna/{name}", "is in the table of public headers but not there")


def check_outside(root, folder, faults):
    """apps/ and examples/ know include/laterna and the files beside them."""
    for path in sources(root, folder):
        relative = path.relative_to(root).as_posix()
        for number, name, quoted in includes_of(path):
            if not quoted or (path.parent / name).exists():
                continue
            head, _, rest = name.partition("/")
            if head != "laterna" or rest not in PUBLIC_HEADERS:
                faults.add(f"{relative}:{number}", f'includes "{name}"; expected only "laterna/..." or a file beside it')


def check_plugins(root, faults):
    """plugins/ share with the library what src/ calls their interface, and nothing else; they know the files beside them."""
    for path in sources(root, "plugins"):
        relative = path.relative_to(root).as_posix()
        for number, name, quoted in includes_of(path):
            if (path.parent / name).exists():
                continue
            if quoted and not name.endswith("_interface.h") and not name.startswith("libav"):
                faults.add(f"{relative}:{number}", f'includes "{name}"; expected only a header named ..._interface.h')


def check_reaching_in(root, folder, faults):
    """tests/, bench/ and fuzz/ may reach every room and the command line's own files, by a path that exists."""
    for path in sources(root, folder):
        relative = path.relative_to(root).as_posix()
        for number, name, quoted in includes_of(path):
            if quoted and not any((start / name).exists() for start in
                                  (path.parent, root / "src", root / "include", root / "tests", root / "apps/laterna")):
                faults.add(f"{relative}:{number}", f'includes "{name}", which is not there')


def find_circle(graph):
    """A list of nodes from one to itself, or None."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return [*path[path.index(node):], node]
        if node in done:
            return None
        path.append(node)
        for following in graph.get(node, ()):
            circle = visit(following)
            if circle:
                return circle
        path.pop()
        done.add(node)
        return None

    for node in graph:
        circle = visit(node)
        if circle:
            return circle
    return None


def check_circles(root, faults):
    circle = find_circle(ROOMS)
    if circle:
        faults.add("scripts/check_includes.py", "the rooms go in a circle: " + " > ".join(circle))
    graph = {}
    for path in [*sources(root, "src"), *sources(root, "include")]:
        found = []
        for _, name, quoted in includes_of(path):
            target = next((s / name for s in (root / "src", root / "include") if (s / name).exists()), None)
            # A kernel file includes itself once per instruction set, through Highway.
            if quoted and target is not None and target != path:
                found.append(target)
        graph[path] = found
    circle = find_circle(graph)
    if circle:
        names = [p.relative_to(root).as_posix() for p in circle]
        faults.add(names[0], "includes itself through others: " + " > ".join(names))


def check_links(root, faults):
    """CMakeLists.txt gives each room exactly the rooms of the table, directly or through others."""
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    linked, lines = {}, {}
    for match in re.finditer(r"^laterna_room\((\w+)([^)]*)\)", text, re.MULTILINE):
        linked[match.group(1)] = re.findall(r"\broom_(\w+)", match.group(2))
        lines[match.group(1)] = text.count("\n", 0, match.start()) + 1

    def reached(room):
        rooms = set(linked.get(room, ()))
        return rooms.union(*(reached(r) for r in rooms))

    circle = find_circle(linked)
    if circle:
        faults.add("CMakeLists.txt", "links the rooms in a circle: " + " > ".join(circle))
        return
    for room, allowed in ROOMS.items():
        if room not in linked:
            faults.add("CMakeLists.txt", f"has no laterna_room({room})")
        elif reached(room) != set(allowed):
            faults.add(f"CMakeLists.txt:{lines[room]}",
                       f"links {room} with {', '.join(sorted(reached(room))) or 'nothing'}; "
                       f"expected {', '.join(sorted(allowed)) or 'nothing'}")
    for room in linked.keys() - ROOMS.keys():
        faults.add(f"CMakeLists.txt:{lines[room]}", f"has a room {room} that the table does not name")


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    faults = Faults()
    check_src(root, faults)
    check_public(root, faults)
    for folder in ("apps", "examples"):
        check_outside(root, folder, faults)
    check_plugins(root, faults)
    for folder in ("tests", "bench", "fuzz"):
        check_reaching_in(root, folder, faults)
    check_circles(root, faults)
    check_links(root, faults)
    return 1 if faults.count else 0


if __name__ == "__main__":
    sys.exit(main())
