// Lists of numbers on the command line: "0.5,1,2".
#pragma once

#include <string>
#include <vector>

namespace holdfast::cli {

/// Splits the text at commas into exactly `count` finite numbers. Throws UsageError; `what` names what is
/// expected.
[[nodiscard]] std::vector<double> numbers(const char* option, const std::string& text, std::size_t count,
                                          const char* what);

/// An id among such numbers. Throws UsageError unless it is an integer of 32 bits.
[[nodiscard]] int region_id_of(const std::string& region, double number);

}  // namespace holdfast::cli
