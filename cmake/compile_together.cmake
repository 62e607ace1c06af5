# compile_together(TARGET APART file...): compiles the sources of a target six at a time, each group as one file that
# includes them, so that headers are read and templates made once per group: a third less work. Files that would not go
# with others stay apart. In every build alike, with ccache or without, so that whoever gives two things one name sees it.
option(LATERNA_COMPILE_TOGETHER "Compile sources in groups" ON)
function(compile_together target)
  cmake_parse_arguments(PARSE_ARGV 1 TOGETHER "" "" "APART")
  if(NOT LATERNA_COMPILE_TOGETHER OR LATERNA_SANITIZE)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  set_source_files_properties(${TOGETHER_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # Both warn of what is meant in a header: here the "headers" are sources. (An option would come before the flags of all.)
  set_target_properties(
    ${target} PROPERTIES UNITY_BUILD_CODE_BEFORE_INCLUDE "#pragma GCC diagnostic ignored \"-Wshadow\"
#pragma GCC diagnostic ignored \"-Wsubobject-linkage\"")
endfunction()
