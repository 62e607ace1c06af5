# Everything here is a Debian 12 package; scripts/install-deps.sh installs them.
find_package(PkgConfig REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(glm REQUIRED)
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(PNG REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(OpenEXR 3.1 CONFIG REQUIRED)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(libisal REQUIRED IMPORTED_TARGET libisal)
find_package(nlohmann_json REQUIRED)
find_package(assimp REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(embree 3 REQUIRED)
find_package(CLI11 REQUIRED)
# For video slides only; without it everything else is built, and a video is an error that says what is missing.
pkg_check_modules(ffmpeg IMPORTED_TARGET libavformat>=59 libavcodec>=59 libavutil>=57)

# Highway is used through its headers only: its shared library calibrates a timer at every process start (7 ms), and
# we choose the instruction set per render call, not per process (src/base/instruction_set.h).
find_path(HWY_INCLUDE_DIR hwy/highway.h REQUIRED)
add_library(hwy_headers INTERFACE)
target_include_directories(hwy_headers SYSTEM INTERFACE ${HWY_INCLUDE_DIR})
