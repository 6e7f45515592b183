#include "text/decimal.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace holdfast {
namespace {

using Digits = std::array<char, 32>;  // sign, 17 digits, point and exponent

}  // namespace

std::string decimal(double value) {
  Digits text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string decimal(double value, int digits) {
  Digits text;
  return {
      text.data(),
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

bool is_text_of_float(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (!(std::fabs(value) <= kMost)) return false;
  const double nearest = static_cast<double>(static_cast<float>(value));
  if (nearest == value) return true;
  Digits text, of_float;
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  const std::string_view written(text.data(), end);
  const std::string_view mantissa = written.substr(0, written.find('e'));
  const std::size_t point = mantissa.find('.');
  const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  char* const end_of_float = std::to_chars(of_float.data(), of_float.data() + of_float.size(), nearest,
                                           std::chars_format::scientific, decimals)
                                 .ptr;
  return written == std::string_view(of_float.data(), end_of_float);
}

}  // namespace holdfast
