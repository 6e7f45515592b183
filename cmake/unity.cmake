# Sources of one folder are compiled together, some at a time: the templates that they share are instantiated once. Names in
# the anonymous namespaces of a folder's sources must differ. Builds by clang, and those of the preset `tidy`, compile each
# source alone, and so tell where one does not include what it names.
option(HOLDFAST_UNITY "Compile sources of one folder together" ${HOLDFAST_PRECOMPILE})
set(HOLDFAST_UNITY_SIZE 16)

# holdfast_unity(TARGET NAME SOURCE...): these sources of the target, in groups of about equal length.
function(holdfast_unity target name)
  if(NOT HOLDFAST_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # g++ takes anonymous namespaces of an included source for those of a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  list(LENGTH ARGN length)
  math(EXPR groups "(${length} + ${HOLDFAST_UNITY_SIZE} - 1) / ${HOLDFAST_UNITY_SIZE}")
  set(index 0)
  foreach(source IN LISTS ARGN)
    math(EXPR group "${index} * ${groups} / ${length}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${group})
    math(EXPR index "${index} + 1")
  endforeach()
endfunction()
