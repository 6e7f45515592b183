# Sources of one folder are compiled together, some at a time: the templates that they share are instantiated once. Names in
# the anonymous namespaces of a folder's sources must differ. Builds by clang, and those of the preset `tidy`, compile each
# source alone, and so tell where one does not include what it names.
#
# CMake's own UNITY_BUILD includes sources by absolute paths, which keeps ccache from knowing them in another clone.
option(HOLDFAST_UNITY "Compile sources of one folder together" ${HOLDFAST_PRECOMPILE})
set(HOLDFAST_UNITY_SIZE 16)

# holdfast_sources(TARGET NAME SOURCE...): adds these sources, in groups of about equal length. Those with definitions of
# their own stay alone.
function(holdfast_sources target name)
  if(NOT HOLDFAST_UNITY)
    target_sources(${target} PRIVATE ${ARGN})
    return()
  endif()
  # g++ takes anonymous namespaces of an included source for those of a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/unity)
  list(LENGTH ARGN length)
  math(EXPR groups "(${length} + ${HOLDFAST_UNITY_SIZE} - 1) / ${HOLDFAST_UNITY_SIZE}")
  set(index 0)
  foreach(source IN LISTS ARGN)
    math(EXPR group "${index} * ${groups} / ${length}")
    math(EXPR index "${index} + 1")
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    if(definitions)
      target_sources(${target} PRIVATE ${source})
      continue()
    endif()
    file(RELATIVE_PATH path ${folder} ${source})
    string(APPEND includes_${group} "#include \"${path}\"\n")
    list(APPEND used ${group})
  endforeach()
  list(REMOVE_DUPLICATES used)
  foreach(group IN LISTS used)
    file(CONFIGURE OUTPUT ${folder}/${name}_${group}.cpp CONTENT "${includes_${group}}" @ONLY)
    target_sources(${target} PRIVATE ${folder}/${name}_${group}.cpp)
  endforeach()
endfunction()
