// Names that several parts give to different things, told apart.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace holdfast::io {

/// The names by id that each part gives. A name that parts have under different ids comes with the part's own
/// name before it, `part.name`, if the parts have names.
[[nodiscard]] std::vector<std::map<int, std::string>> names_apart(
    std::vector<std::map<int, std::string>> of_parts, std::span<const std::string> parts);

}  // namespace holdfast::io
