// Holdfast: surfaces from the arrays of other programs: strided, 32-bit floats, any integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "holdfast/export.h"
#include "holdfast/types.h"

namespace holdfast {

/// Type of the numbers of an array.
enum class Scalar { float32, float64, int32, uint32, int64, uint64 };

template <class Number>
[[nodiscard]] constexpr Scalar scalar_of() {
  if constexpr (std::is_floating_point_v<Number>) {
    static_assert(sizeof(Number) == 4 || sizeof(Number) == 8);
    return sizeof(Number) == 4 ? Scalar::float32 : Scalar::float64;
  } else {
    static_assert(std::is_integral_v<Number> && (sizeof(Number) == 4 || sizeof(Number) == 8));
    if constexpr (std::is_signed_v<Number>) return sizeof(Number) == 4 ? Scalar::int32 : Scalar::int64;
    return sizeof(Number) == 4 ? Scalar::uint32 : Scalar::uint64;
  }
}

/// A non-owning view of rows of numbers anywhere in memory. Number j of row i is at
/// data + i * row_stride + j * column_stride, in bytes. The numbers need not be aligned.
struct ArrayView {
  const void* data = nullptr;
  std::size_t rows = 0;
  Scalar type = Scalar::float64;
  std::ptrdiff_t row_stride = 0, column_stride = 0;
};

/// `rows` rows of `columns` numbers each, contiguous.
template <class Number>
[[nodiscard]] ArrayView rows_of(const Number* data, std::size_t rows, std::size_t columns) {
  return {data, rows, scalar_of<Number>(), static_cast<std::ptrdiff_t>(columns * sizeof(Number)),
          sizeof(Number)};
}

/// A complex built from arrays. Arrays in the library's own layout (points as rows of three doubles, indices
/// as rows of unsigned 32-bit integers, markers as consecutive 32-bit integers, all aligned) are not copied
/// and must outlive this object. Other arrays are converted once. A 32-bit float becomes the double of the
/// same value.
///
/// Throws std::invalid_argument for indices that are negative, beyond 32 bits or no integers, for integer
/// coordinates beyond 2^53, and for markers beyond 32 bits.
class HOLDFAST_API Arrays {
 public:
  /// Rows of three.
  void set_vertices(const ArrayView& points);
  void set_facets(const ArrayView& corners);
  /// Rows of two.
  void set_segments(const ArrayView& ends);
  /// Rows of one.
  void set_vertex_markers(const ArrayView& markers);
  void set_facet_markers(const ArrayView& markers);
  void set_segment_markers(const ArrayView& markers);
  void set_names(Names names);

  /// Valid while this object exists and is not changed.
  [[nodiscard]] const Complex& view() const& { return complex_; }
  const Complex& view() const&& = delete;

  Arrays() = default;
  Arrays(const Arrays&) = delete;
  Arrays& operator=(const Arrays&) = delete;

 private:
  Complex complex_;
  std::vector<Point> vertices_;
  std::vector<Triangle> facets_;
  std::vector<Segment> segments_;
  std::vector<int> vertex_markers_, facet_markers_, segment_markers_;
  Names names_;
};

}  // namespace holdfast
