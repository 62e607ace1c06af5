#!/bin/sh
# Builds the libFuzzer targets and runs each for FUZZ_SECONDS seconds (60). Stops at the first input that crashes, leaks,
# hangs or takes too much memory, and says where it lies. What is found on the way is kept in build/fuzz/found and used
# by the next run; fuzz/corpus holds the first examples.
#   scripts/fuzz.sh [TARGET...]          for instance: FUZZ_SECONDS=600 scripts/fuzz.sh fuzz_gltf
set -eu
cd "$(dirname "$0")/.."
seconds=${FUZZ_SECONDS:-60}
build=${FUZZ_BUILD_DIR:-build/fuzz}

cmake --preset fuzz -B "$build" >/dev/null
cmake --build "$build" --target fuzzers

if [ $# -eq 0 ]; then
  set --
  for source in fuzz/fuzz_*.cc; do set -- "$@" "$(basename "$source" .cc)"; done
fi

# An error that a sanitizer only prints would be passed over.
export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
for target in "$@"; do
  format=${target#fuzz_}
  found=$build/found/$format
  reproducers=$build/reproducers/$format
  mkdir -p "$found" "$reproducers"
  dictionary=
  if [ -f "fuzz/$format.dict" ]; then dictionary=-dict=fuzz/$format.dict; fi
  if [ ! -x "$build/fuzz/$target" ]; then  # fuzz_video, where FFmpeg's headers are not
    echo "$target: not built here"
    continue
  fi
  echo "$target: $seconds s"
  log=$build/$target.log
  # shellcheck disable=SC2086  # no dictionary: no argument
  if ! "$build/fuzz/$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
    -artifact_prefix="$reproducers/" $dictionary "$found" "fuzz/corpus/$format" >"$log" 2>&1; then
    tail -n 60 "$log"
    reproducer=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
    echo "$target failed; its whole output: $log" >&2
    if [ -n "$reproducer" ]; then echo "reproduce with: $build/fuzz/$target $reproducer" >&2; fi
    exit 1
  fi
  tail -n 1 "$log"
done
