# Libraries that a build may do without. Each has an option of its name, HOLDFAST_NAME.

# Looks for one: HOLDFAST_NAME_LIBRARIES is empty where it is not wanted, or not found, which is told.
macro(holdfast_find_optional name header library without)
  set(HOLDFAST_${name}_LIBRARIES "")
  if(HOLDFAST_${name})
    find_path(${name}_INCLUDE_DIR ${header})
    find_library(${name}_LIBRARY ${library})
    if(${name}_INCLUDE_DIR AND ${name}_LIBRARY)
      set(HOLDFAST_${name}_LIBRARIES ${${name}_LIBRARY})
    else()
      message(STATUS "${without}")
    endif()
  endif()
endmacro()

# Tells the one source that includes its header whether it is there, by defining HOLDFAST_NAME.
function(holdfast_use_optional name source)
  if(HOLDFAST_${name}_LIBRARIES)
    target_include_directories(holdfast_objects SYSTEM PRIVATE ${${name}_INCLUDE_DIR})
    set_source_files_properties(${PROJECT_SOURCE_DIR}/${source} PROPERTIES COMPILE_DEFINITIONS HOLDFAST_${name})
  endif()
endfunction()
