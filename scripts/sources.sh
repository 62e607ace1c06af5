#!/bin/sh
# Every C++ source and header of the project, one per line; with an argument, only names that end so.
#
#   scripts/sources.sh [.cc]
set -eu
cd "$(dirname "$0")/.."
find include src apps examples tests bench fuzz \( -name '*.h' -o -name '*.cc' -o -name '*.cpp' \) | sort |
  grep -E "${1:-}\$"
