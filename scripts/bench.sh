#!/bin/sh
# Milliseconds per stage of the demo's scenes, then the kernels on every instruction set and what projected light costs
# beside plain texturing.
#
#   scripts/bench.sh [ARGUMENT]...     of Google Benchmark, such as --benchmark_filter=slide
set -eu
cd "$(dirname "$0")/.."
build=${LATERNA_BUILD:-build/release}
for scene in stage table; do
  echo "$scene:"
  "$build/apps/laterna" bench "examples/scenes/$scene.glb" --rig "examples/scenes/$scene.json" --camera front \
    --size 1920x1080 --frames 15
  echo
done
"$build/bench/laterna_bench" --benchmark_min_time=0.3 "$@"
