# Compile options that every target of the project shares. No contraction: the error bounds of the
# exact module assume that a*b+c rounds twice (Shewchuk 1997), so fused multiply-add is off. Nothing reads
# errno after a square root: without it that is one instruction.
function(holdfast_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -ffp-contract=off -fno-math-errno
                         $<$<BOOL:${HOLDFAST_WERROR}>:-Werror>)
  # g++ 12 sees overlaps in string concatenation where there are none (GCC bug 105651), and bounds that are passed, too, where
  # <string> is precompiled.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
    if(HOLDFAST_PRECOMPILE)
      target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    endif()
    # With sanitizers it takes std::optional for uninitialised (GCC bug 80635).
    if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
  endif()
  target_compile_definitions(${target} PRIVATE $<$<BOOL:${HOLDFAST_VALIDATE}>:HOLDFAST_VALIDATE=1>)
endfunction()
