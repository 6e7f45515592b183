// Right-aligned columns of formats with fixed widths.
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <string_view>

#include "io/atomic_writer.h"

namespace holdfast::io {

inline void column(AtomicWriter& out, std::string_view text, std::size_t width) {
  for (std::size_t i = text.size(); i < width; ++i) out << ' ';
  out << text;
}

template <std::integral T>
void column(AtomicWriter& out, T value, std::size_t width) {
  char digits[24];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  column(out, std::string_view(digits, static_cast<std::size_t>(result.ptr - digits)), width);
}

}  // namespace holdfast::io
