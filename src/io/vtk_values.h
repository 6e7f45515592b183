// Values of the number types of the VTK formats, as coordinates or integers.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/byte_reader.h"
#include "io/text_reader.h"
#include "text/decimal.h"

namespace holdfast::io {

enum class VtkType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

[[nodiscard]] inline std::size_t size_of(VtkType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

/// A number as T; empty if T is an integer type that cannot hold it.
template <typename T, typename From>
[[nodiscard]] std::optional<T> converted(From value) {
  if constexpr (std::floating_point<T>) {
    return static_cast<T>(value);
  } else if constexpr (std::floating_point<From>) {
    // Reals count exactly up to 2^53; NaN fails too.
    if (!(std::abs(value) <= 0x1p53) || value != std::trunc(value)) return std::nullopt;
    return converted<T>(static_cast<std::int64_t>(value));
  } else {
    if (!std::in_range<T>(value)) return std::nullopt;
    return static_cast<T>(value);
  }
}

/// A number as a message shows it.
template <typename From>
[[nodiscard]] std::string words(From value) {
  if constexpr (std::floating_point<From>) {
    return decimal(static_cast<double>(value));
  } else {
    return std::to_string(value);
  }
}

/// Calls `visit` for each value of a type in `bytes`, in order.
template <typename T, typename Visit>
void visit_binary(std::string_view bytes, std::endian order, Visit&& visit) {
  for (std::size_t i = 0; i + sizeof(T) <= bytes.size(); i += sizeof(T))
    visit(load<T>(bytes.data() + i, order));
}

template <typename Visit>
void visit_binary(VtkType type, std::string_view bytes, std::endian order, Visit&& visit) {
  switch (type) {
    case VtkType::int8:
      return visit_binary<std::int8_t>(bytes, order, visit);
    case VtkType::uint8:
      return visit_binary<std::uint8_t>(bytes, order, visit);
    case VtkType::int16:
      return visit_binary<std::int16_t>(bytes, order, visit);
    case VtkType::uint16:
      return visit_binary<std::uint16_t>(bytes, order, visit);
    case VtkType::int32:
      return visit_binary<std::int32_t>(bytes, order, visit);
    case VtkType::uint32:
      return visit_binary<std::uint32_t>(bytes, order, visit);
    case VtkType::int64:
      return visit_binary<std::int64_t>(bytes, order, visit);
    case VtkType::uint64:
      return visit_binary<std::uint64_t>(bytes, order, visit);
    case VtkType::float32:
      return visit_binary<float>(bytes, order, visit);
    case VtkType::float64:
      return visit_binary<double>(bytes, order, visit);
  }
}

/// All values of `bytes` as T. `fail` is called with the reason, and must throw.
template <typename T, typename Fail>
[[nodiscard]] std::vector<T> binary_values(VtkType type, std::string_view bytes, std::endian order,
                                           Watch* watch, Fail&& fail) {
  std::vector<T> values;
  values.reserve(bytes.size() / size_of(type));
  visit_binary(type, bytes, order, [&](auto value) {
    beat(watch);
    const std::optional<T> result = converted<T>(value);
    if (!result) fail("a value that is not an integer, or out of range: " + words(value));
    values.push_back(*result);
  });
  return values;
}

/// The next number of a text as T; an integer may be spelled as a real.
template <typename T>
[[nodiscard]] T text_value(TextReader& text) {
  if constexpr (std::floating_point<T>) {
    return text.real("a number");
  } else {
    const std::int64_t value = text.integer("an integer");
    const std::optional<T> result = converted<T>(value);
    if (!result) text.fail("the value " + std::to_string(value) + " is out of range");
    return *result;
  }
}

/// Points from their coordinates, three each; incomplete points are ignored.
[[nodiscard]] inline std::vector<Point> points_of(const std::vector<double>& coordinates) {
  std::vector<Point> points(coordinates.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  return points;
}

}  // namespace holdfast::io
