# Warnings are errors, and floating point means the same on every machine: no fused multiply-add is formed behind
# our back (-ffp-contract=off), and nothing is reassociated.
add_library(compiler_flags INTERFACE)
target_compile_options(
  compiler_flags
  INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off -fno-math-errno
            $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
if(LATERNA_SCALAR_ONLY)
  target_compile_definitions(compiler_flags INTERFACE HWY_COMPILE_ONLY_SCALAR)
endif()
if(LATERNA_SANITIZE)
  # GCC sees uninitialised values in libstdc++'s own <regex> once it has added its checks.
  target_compile_options(compiler_flags INTERFACE -fsanitize=${LATERNA_SANITIZE} -fno-omit-frame-pointer -g1
                                                  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(compiler_flags INTERFACE -fsanitize=${LATERNA_SANITIZE})
endif()
# Builds with sanitizers keep what their preset says.
if(NOT LATERNA_SANITIZE)
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
endif()
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
