// Arrays of other programs as a complex: used in place if possible, otherwise converted.
#include "holdfast/arrays.h"

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace holdfast {
namespace {

[[noreturn]] void refuse(const char* what, std::size_t row, const char* why) {
  throw std::invalid_argument(std::string(what) + " " + std::to_string(row) + " " + why);
}

template <class To, class From>
To converted(From value, const char* what, std::size_t row) {
  if constexpr (std::is_same_v<To, double>) {
    constexpr std::int64_t kExact = std::int64_t{1} << 53;
    if constexpr (std::is_integral_v<From>)
      if (std::cmp_greater(value, kExact) || std::cmp_less(value, -kExact))
        refuse(what, row, "has a coordinate beyond what a double counts exactly");
    return static_cast<double>(value);
  } else if constexpr (std::is_floating_point_v<From>) {
    refuse(what, row, "is not of integers");
  } else {
    if (!std::in_range<To>(value))
      refuse(what, row,
             std::is_signed_v<To> ? "is beyond 32 bits" : "has a number that is negative or beyond 32 bits");
    return static_cast<To>(value);
  }
}

template <class From, class Row>
void convert(const ArrayView& array, std::vector<Row>& rows, const char* what) {
  using To = std::remove_cvref_t<decltype(rows[0][0])>;
  const char* row = static_cast<const char*>(array.data);
  for (std::size_t i = 0; i < array.rows; ++i, row += array.row_stride)
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      From value;
      std::memcpy(&value, row + static_cast<std::ptrdiff_t>(j) * array.column_stride, sizeof value);
      rows[i][j] = converted<To>(value, what, i);
    }
}

template <class Row>
void convert_any(const ArrayView& array, std::vector<Row>& rows, const char* what) {
  switch (array.type) {
    case Scalar::float32:
      return convert<float>(array, rows, what);
    case Scalar::float64:
      return convert<double>(array, rows, what);
    case Scalar::int32:
      return convert<std::int32_t>(array, rows, what);
    case Scalar::uint32:
      return convert<std::uint32_t>(array, rows, what);
    case Scalar::int64:
      return convert<std::int64_t>(array, rows, what);
    case Scalar::uint64:
      return convert<std::uint64_t>(array, rows, what);
  }
  throw std::invalid_argument("an array of an unknown type of numbers");
}

/// Whether rows may be used in place. Signed indices are converted, because they must be checked for negative
/// values.
template <class Row>
bool lies_as(const ArrayView& array) {
  using Number = std::remove_cvref_t<decltype(std::declval<Row>()[0])>;
  const bool same_type = std::is_same_v<Number, double> ? array.type == Scalar::float64
                         : std::is_same_v<Number, int>  ? array.type == Scalar::int32
                                                        : array.type == Scalar::uint32;
  return same_type && array.column_stride == sizeof(Number) && array.row_stride == sizeof(Row) &&
         reinterpret_cast<std::uintptr_t>(array.data) % alignof(Row) == 0;
}

/// Returns the rows, stored in `owned` if they had to be converted.
template <class Row>
std::span<const Row> taken(const ArrayView& array, std::vector<Row>& owned, const char* what) {
  std::vector<Row>().swap(owned);
  if (array.rows == 0) return {};
  if (array.data == nullptr) throw std::invalid_argument("an array of rows without memory");
  if (lies_as<Row>(array)) return {static_cast<const Row*>(array.data), array.rows};
  owned.resize(array.rows);
  convert_any(array, owned, what);
  return owned;
}

std::span<const int> taken_markers(const ArrayView& array, std::vector<int>& owned) {
  using Row = std::array<int, 1>;
  std::vector<int>().swap(owned);
  if (array.rows == 0) return {};
  if (array.data == nullptr) throw std::invalid_argument("an array of rows without memory");
  ArrayView rows = array;
  rows.column_stride = sizeof(int);  // a single column may come with any stride
  if (lies_as<Row>(rows)) return {static_cast<const int*>(array.data), array.rows};
  std::vector<Row> converted_rows(array.rows);
  convert_any(array, converted_rows, "marker");
  owned.reserve(array.rows);
  for (const Row& row : converted_rows) owned.push_back(row[0]);
  return owned;
}

}  // namespace

void Arrays::set_vertices(const ArrayView& points) {
  complex_.vertices = {};
  complex_.vertices = taken(points, vertices_, "point");
}

void Arrays::set_facets(const ArrayView& corners) {
  complex_.facets = {};
  complex_.facets = taken(corners, facets_, "triangle");
}

void Arrays::set_segments(const ArrayView& ends) {
  complex_.segments = {};
  complex_.segments = taken(ends, segments_, "segment");
}

void Arrays::set_vertex_markers(const ArrayView& markers) {
  complex_.vertex_markers = {};
  complex_.vertex_markers = taken_markers(markers, vertex_markers_);
}

void Arrays::set_facet_markers(const ArrayView& markers) {
  complex_.facet_markers = {};
  complex_.facet_markers = taken_markers(markers, facet_markers_);
}

void Arrays::set_segment_markers(const ArrayView& markers) {
  complex_.segment_markers = {};
  complex_.segment_markers = taken_markers(markers, segment_markers_);
}

void Arrays::set_names(Names names) {
  names_ = std::move(names);
  complex_.names = &names_;
}

}  // namespace holdfast
