// What parts that are pasted together are called, and their regions.
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

/// As `paste` says it of region ids and names. Where `labels` has one for a part, messages call it so.
[[nodiscard]] NamedParts name_parts(std::span<const Surface> parts, std::span<const std::string> names,
                                    std::span<const std::string> labels);

}  // namespace holdfast
