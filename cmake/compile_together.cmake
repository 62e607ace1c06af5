# compile_together(TARGET APART file...): compiles the sources of a target six at a time, each group as one file that
# includes them, so that headers are read and templates made once per group: a third less work. Files that would not go
# with others stay apart. Not where ccache remembers objects: there a change would compile six files in place of one.
function(compile_together target)
  cmake_parse_arguments(PARSE_ARGV 1 TOGETHER "" "" "APART")
  if(CCACHE OR LATERNA_SANITIZE)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  set_source_files_properties(${TOGETHER_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # Both warn of what is meant in a header: here the "headers" are sources.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage -Wno-shadow)
endfunction()
