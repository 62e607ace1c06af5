include(cmake/compile_together.cmake)

# laterna_room(NAME [SEPARATE] LINK target... PRECOMPILE header...): one room of src/ as an object library. SEPARATE: its
# files have, by design, functions of the same names.
# Kernels (*.simd.cc) are compiled once per instruction set by Highway.
set(LATERNA_ROOMS "")
macro(laterna_room name)
  cmake_parse_arguments(ROOM "SEPARATE" "" "LINK;PRECOMPILE" ${ARGN})
  file(GLOB room_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cc)
  if(room_sources)
    add_library(room_${name} OBJECT ${room_sources})
    target_include_directories(room_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(room_${name} PUBLIC ${ROOM_LINK} PRIVATE compiler_flags)
    # Loops over the vectors of a block and the edges of a triangle are as short as their bounds say: unrolled, their
    # values stay in registers.
    set(room_kernels ${room_sources})
    list(FILTER room_kernels INCLUDE REGEX "\\.simd\\.cc$")
    if(NOT LATERNA_SANITIZE)
      set_source_files_properties(${room_kernels} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
    endif()
    # What nearly every file of a large room includes is read once; not where ccache, which remembers objects, would then
    # remember none. Kernels go their own way: Highway wants to be first.
    set(room_plain ${room_sources})
    list(FILTER room_plain EXCLUDE REGEX "\\.simd\\.cc$")
    list(LENGTH room_plain room_size)
    if(ROOM_PRECOMPILE AND room_size GREATER 20 AND NOT CCACHE AND NOT LATERNA_SANITIZE)
      target_precompile_headers(room_${name} PRIVATE ${ROOM_PRECOMPILE})
      set_source_files_properties(${room_kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
    if(NOT ROOM_SEPARATE)
      compile_together(room_${name} APART ${room_kernels})
    endif()
    list(APPEND LATERNA_ROOMS ${name})
  else()
    add_library(room_${name} INTERFACE)
    target_include_directories(room_${name} INTERFACE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(room_${name} INTERFACE ${ROOM_LINK})
  endif()
endmacro()
