// Lists in messages.
#pragma once

#include <string>
#include <vector>

#include "holdfast/types.h"

namespace holdfast {

/// "triangle 4", "triangles 4 and 7", "triangles 4, 7, 9 and 12 more"; nothing for no ids.
[[nodiscard]] std::string listed(const std::string& noun, const std::string& plural,
                                 const std::vector<Index>& ids);

}  // namespace holdfast
