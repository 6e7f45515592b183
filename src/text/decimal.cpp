#include "text/decimal.h"

#include <array>
#include <charconv>

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

}  // namespace holdfast
