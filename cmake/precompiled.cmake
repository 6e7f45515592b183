# Headers of others that most sources of a target include are parsed once, not once a source: that is half of the time of a
# build. A source still includes what it names; builds by clang have none of this, and so tell where one does not.
set(default OFF)
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(default ON)
endif()
option(HOLDFAST_PRECOMPILE "Precompile headers of the standard library, Boost and others" ${default})

set(HOLDFAST_STANDARD_HEADERS
    <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <cstdint> <cstring> <deque> <filesystem> <fstream> <functional>
    <limits> <map> <memory> <mutex> <numeric> <optional> <queue> <random> <set> <span> <stdexcept> <string> <string_view> <thread>
    <tuple> <unordered_map> <unordered_set> <utility> <variant> <vector>)

# holdfast_precompile(TARGET HEADER...): those of the standard library, and these.
function(holdfast_precompile target)
  if(HOLDFAST_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${HOLDFAST_STANDARD_HEADERS} ${ARGN})
  endif()
endfunction()
