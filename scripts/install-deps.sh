#!/bin/sh
# Installs the Debian 12 packages that a task needs, and nothing when nothing is missing.
#
#   scripts/install-deps.sh [build|demo|bench|lint|fuzz]...      default: build
#
# build   compiler, CMake and every library that cmake/dependencies.cmake and tests/ look for: `make test`
# demo    build, and the models that the demo lights
# bench   build, Google Benchmark, and the models of the crowd
# lint    build, clang-format and clang-tidy
# fuzz    build, clang with its sanitizer and fuzzer runtimes
set -eu

# libjpeg-dev is not ours: the CMake file of libturbojpeg0-dev refuses to load without its libjpeg.a.
BUILD="g++ make cmake ninja-build pkgconf python3 python3-jsonschema
  libhwy-dev libtbb-dev libglm-dev libexpected-dev libfmt-dev
  libpng-dev libturbojpeg0-dev libjpeg-dev libopenexr-dev libdeflate-dev libisal-dev
  nlohmann-json3-dev libassimp-dev libdraco-dev libmeshoptimizer-dev
  libembree-dev libcli11-dev libgtest-dev valgrind
  libavformat-dev libavcodec-dev libavutil-dev"

wanted=$BUILD
for task in "${@:-build}"; do
  case $task in
    build) ;;
    demo) wanted="$wanted assimp-testmodels" ;;
    bench) wanted="$wanted libbenchmark-dev assimp-testmodels" ;;
    lint) wanted="$wanted clang-format-14 clang-tidy-16" ;;
    fuzz) wanted="$wanted clang libclang-rt-14-dev" ;;
    *)
      echo "install-deps.sh: there is no task \"$task\"; there are: build demo bench lint fuzz" >&2
      exit 2
      ;;
  esac
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install-deps.sh: this is no Debian-like system (no dpkg-query or no apt-get)." >&2
  echo "Install what these Debian 12 packages hold, then build with the presets of CMakePresets.json:" >&2
  # shellcheck disable=SC2086 # words are packages
  echo $wanted >&2
  exit 1
fi

# shellcheck disable=SC2086 # words are packages
installed=" $(dpkg-query -W -f '${binary:Package}=${db:Status-Status}\n' $wanted 2>/dev/null |
  sed -n 's/\(:[^=]*\)\{0,1\}=installed$//p' | tr '\n' ' ')"
missing=""
for package in $wanted; do
  case $installed in
    *" $package "*) ;;
    *) missing="$missing $package" ;;
  esac
done
if [ -z "$missing" ]; then
  exit 0
fi

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps.sh: these packages are missing, and installing them takes root or sudo:" >&2
    echo "  apt-get install --no-install-recommends$missing" >&2
    exit 1
  fi
  as_root="sudo"
fi

echo "Installing:$missing"
# A fresh machine has no package lists; where they cannot be fetched, those that are there may do.
$as_root apt-get update -qq || echo "install-deps.sh: the package lists could not be refreshed; trying with the old ones" >&2
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
