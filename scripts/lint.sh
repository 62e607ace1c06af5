#!/bin/bash
# clang-format and clang-tidy over the sources; fails at the first of the two that finds something.
#
#   scripts/lint.sh BUILD_FOLDER [FILE.cc]...     default: every file that BUILD_FOLDER/compile_commands.json compiles
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
shift

scripts/sources.sh | xargs clang-format-14 --dry-run -Werror

if [ $# -gt 0 ]; then
  files=("$@")
else
  # Only what the build compiles has flags: fuzzers and benchmarks only where they are configured.
  mapfile -t files < <(scripts/sources.sh '\.(cc|cpp)' | while read -r file; do
    if grep -qF "\"file\": \"$PWD/$file\"" "$build/compile_commands.json"; then echo "$file"; fi
  done)
fi
# GCC's precompiled headers are not for clang: without them the headers themselves are read.
mkdir -p "$build/lint"
sed -E 's/-Winvalid-pch|-include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" >"$build/lint/compile_commands.json"
printf '%s\n' "${files[@]}" |
  xargs -P "${JOBS:-$(nproc)}" -n 1 clang-tidy-16 --quiet --warnings-as-errors='*' -p "$build/lint" 2> >(
    grep -Ev '^[0-9]+ warnings? (and [0-9]+ errors? )?generated|^Suppressed|^Use -header-filter' >&2)
