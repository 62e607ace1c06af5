#!/bin/sh
# How the cost of a frame grows, and every kernel by instruction set: tables in Markdown, for docs/performance.md.
# Scenes are made in code; where ../shared is beside the project, its workloads are measured too.
#
#   scripts/bench.sh [--quick]     --quick: one round, without the largest rows
set -eu
cd "$(dirname "$0")/.."
bench=${LATERNA_BUILD:-build/release}/bench
echo "## Growth"
echo
"$bench/growth_bench" "$@" --workloads ../shared/bench/workloads.json
echo "## Kernels"
echo
scripts/kernel_tables.py --bench "$bench/kernels_bench" "$@"
