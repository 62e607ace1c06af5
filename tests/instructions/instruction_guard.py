#!/usr/bin/env python3
"""Counts the instructions of a small frame with callgrind, and fails when they have grown by more than a tenth.

    instruction_guard.py PROGRAM SCENES INSTRUCTION_SET [--record]

PROGRAM is laterna, SCENES the folder of stage.glb. The figures to hold are in figures.json beside this file; --record
writes what is counted now there. Counted is what Renderer::render_into does, on one thread: no start, no loading, no
waiting. Exit code 77, which ctest shows as skipped, where there is no valgrind or the processor lacks the instructions.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FIGURES = Path(__file__).resolve().parent / "figures.json"
ALLOWED_GROWTH = 1.10
SKIPPED = 77
COUNTED = "laterna::Renderer::render_into*"

def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def bench(program, scenes, instruction_set):
    """Two frames of 320 x 180, the first of which finds no memory ready."""
    return [program, "bench", f"{scenes}/stage.glb", "--rig", f"{scenes}/stage.json", "--size", "320x180",
            "--warm-up", "1", "--frames", "1", "--threads", "1", "--isa", instruction_set]


def has_instructions(program, instruction_set):
    """Asks the program: it knows what its kernels need."""
    doctor = subprocess.run([program, "doctor"], capture_output=True, text=True, check=False)
    return re.search(rf"\b{instruction_set}\b", doctor.stdout) is not None


def count(program, scenes, instruction_set):
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--toggle-collect={COUNTED}", f"--callgrind-out-file={folder}/out",
             *bench(program, scenes, instruction_set)],
            capture_output=True, text=True, check=False)
    collected = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or collected is None or int(collected[1]) == 0:
        sys.exit(f"nothing was counted:\n{run.stdout}{run.stderr}")
    return int(collected[1])


def main():
    parser = argparse.ArgumentParser(description="Holds the instructions of a small frame.")
    parser.add_argument("program")
    parser.add_argument("scenes")
    parser.add_argument("instruction_set", choices=["avx2", "sse4"])
    parser.add_argument("--record", action="store_true")
    args = parser.parse_args()
    if shutil.which("valgrind") is None:
        skip("there is no valgrind")
    if not has_instructions(args.program, args.instruction_set):
        skip(f"this processor has no {args.instruction_set}")

    counted = count(args.program, args.scenes, args.instruction_set)
    figures = json.loads(FIGURES.read_text(encoding="utf-8")) if FIGURES.exists() else {}
    if args.record:
        figures[args.instruction_set] = counted
        FIGURES.write_text(json.dumps(figures, indent=2, sort_keys=True) + "\n", encoding="utf-8")
        print(f"{args.instruction_set}: recorded {counted}")
        return
    recorded = figures[args.instruction_set]
    change = counted / recorded - 1
    print(f"{args.instruction_set}: {counted} instructions, {change:+.1%} against the recorded {recorded}")
    update = "cmake --build build/release --target record_instructions"
    if counted > recorded * ALLOWED_GROWTH:
        sys.exit(f"More than a tenth above what is recorded. If the picture is worth it: {update}")
    if 2 * counted < recorded:
        sys.exit(f"Less than half of what is recorded: is all of the drawing still counted? If so: {update}")
    if counted * ALLOWED_GROWTH < recorded:
        print(f"More than a tenth saved. To hold it: {update}")


main()
