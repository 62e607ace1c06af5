#!/usr/bin/env python3
"""Every kernel by instruction set, as two tables in Markdown: millions of pixels, triangles or values per second on one
thread, and instructions per pixel, triangle or value.

Callgrind counts instructions, exactly and on machines without counters of their own. It knows no AVX-512.

    scripts/kernel_tables.py [--bench build/release/bench/kernels_bench] [--quick]
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# Both in bench/kernels/kernel_run.h: what is counted, and when it is written to a file.
COUNTED = "void laterna::run_kernel*"
WRITTEN_AFTER = "void laterna::measure*"
# What is left out, with a minus as Google Benchmark wants it: whole pictures, and what callgrind cannot run.
NO_PICTURES = "-picture"
FOR_CALLGRIND = "-(picture|avx512)"


def run_benchmarks(bench, pattern, seconds, under=()):
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        run = subprocess.run(
            [*under, bench, f"--benchmark_filter={pattern}", f"--benchmark_min_time={seconds}",
             f"--benchmark_out={report.name}", "--benchmark_out_format=json"],
            capture_output=True, text=True, check=False)
        if run.returncode != 0:
            sys.exit(f"{bench} failed:\n{run.stdout}{run.stderr}")
        results = json.loads(Path(report.name).read_text(encoding="utf-8"))["benchmarks"]
    for result in results:
        if result.get("error_occurred"):
            sys.exit(f"{result['name']}: {result['error_message']}")
    return results


def count_instructions(bench):
    """(result of Google Benchmark, instructions) of every kernel, called once."""
    with tempfile.TemporaryDirectory() as folder:
        # A nanosecond is over after the first call.
        results = run_benchmarks(
            bench, FOR_CALLGRIND, 1e-9,
            under=["valgrind", "--tool=callgrind", f"--toggle-collect={COUNTED}", f"--dump-after={WRITTEN_AFTER}",
                   f"--callgrind-out-file={folder}/dump"])
        dumps = sorted(Path(folder).glob("dump.*"), key=lambda path: int(path.suffix[1:]))
        if len(dumps) != len(results) or any(r["iterations"] != 1 for r in results):
            sys.exit(f"{len(results)} benchmarks, but {len(dumps)} counts")
        return [(result, instructions_of(dump)) for result, dump in zip(results, dumps)]


def instructions_of(dump):
    match = re.search(r"^(?:totals|summary): (\d+)", dump.read_text(encoding="utf-8"), re.MULTILINE)
    return int(match[1])


def print_table(title, values):
    """values: (result of Google Benchmark, number)."""
    kernels = {}  # name -> (what is counted, {instruction set: number})
    sets = []
    for result, value in values:
        name, _, instruction_set = result["name"].partition("/")
        row = kernels.setdefault(name, (result["label"], {}))[1]
        row[instruction_set] = value
        if instruction_set and instruction_set not in sets:
            sets.append(instruction_set)
    print(f"| {title} | of | " + " | ".join(sets) + " |")
    print("|---|---|" + "---|" * len(sets))
    for name, (items, row) in kernels.items():
        # What is the same on all sets stands in the first column.
        cells = [row.get(s, row.get("") if s == sets[0] else None) for s in sets]
        text = ["" if c is None else f"{c:.0f}" if c >= 20 else f"{c:.1f}" for c in cells]
        print(f"| {name} | {items} | " + " | ".join(text) + " |")
    print()


def main():
    parser = argparse.ArgumentParser(description="Speed and instructions of every kernel.")
    parser.add_argument("--bench", default="build/release/bench/kernels_bench")
    parser.add_argument("--quick", action="store_true", help="each kernel for 0.01 s instead of 0.2 s")
    args = parser.parse_args()
    timed = run_benchmarks(args.bench, NO_PICTURES, 0.01 if args.quick else 0.2)
    print_table("millions per second", [(r, r["items_per_second"] / 1e6) for r in timed])
    if shutil.which("valgrind") is None:
        print("Instructions are not counted: there is no valgrind.")
        return
    counted = count_instructions(args.bench)
    print_table("instructions per item", [(r, n / r["items"]) for r, n in counted])


main()
