// *INCLUDE in .inp files. A file named by INPUT of *NODE or *ELEMENT is inserted after the keyword.
#pragma once

#include "io/includes.h"

namespace holdfast::io {

[[nodiscard]] const IncludeRule& inp_includes();

}  // namespace holdfast::io
