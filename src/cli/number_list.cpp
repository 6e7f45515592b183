#include "number_list.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>

#include "command.h"
#include "number.h"

namespace holdfast::cli {

std::vector<double> numbers(const char* option, const std::string& text, std::size_t count,
                            const char* what) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    double value = 0;
    const auto [stop, error] = parse_double(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) break;
    values.push_back(value);
    at = stop;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (at != end || values.size() != count)
    throw UsageError(fmt::format("{}{}: {} expected", option, text, what));
  return values;
}

int region_id_of(const std::string& region, double number) {
  if (number != std::floor(number) || std::abs(number) > INT32_MAX)
    throw UsageError("--region " + region + ": the region id must be an integer of at most 2147483647");
  return static_cast<int>(number);
}

}  // namespace holdfast::cli
