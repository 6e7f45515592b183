// Distinguishes names that several parts give to different things.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace holdfast::io {

/// The names by id in each part. If parts use a name for different ids, it is prefixed with the part's name,
/// `part.name`, provided that the parts have names.
[[nodiscard]] std::vector<std::map<int, std::string>> names_apart(
    std::vector<std::map<int, std::string>> of_parts, std::span<const std::string> parts);

}  // namespace holdfast::io
