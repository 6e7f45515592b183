// The names of pasted parts and of their regions.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "holdfast/paste.h"

namespace holdfast {

struct NamedParts {
  std::vector<PastedPart> parts;
  std::map<int, std::string> regions;  ///< names of the whole, by id
};

/// Assigns region ids and names as `paste` documents. Messages use the label of a part if `labels` has one.
[[nodiscard]] NamedParts name_parts(std::span<const Surface> parts, std::span<const std::string> names,
                                    std::span<const std::string> labels);

}  // namespace holdfast
