// Counts in messages: "1 vertex", "2 vertices".
#pragma once

#include <cstddef>
#include <string>

namespace holdfast {

[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one) {
  return counted(count, one, one + "s");
}

}  // namespace holdfast
