// The arrays of an XML unstructured grid, for the writers of volumes and of marks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "io/atomic_writer.h"
#include "io/vtk_cells.h"

namespace holdfast::io {

/// An array in the machine's own byte order; its values stay with the caller.
struct VtuArray {
  const char* type;
  const char* name;
  std::size_t components;
  std::span<const std::byte> bytes;
};

template <typename T>
[[nodiscard]] VtuArray vtu_array(const char* name, const std::vector<T>& values) {
  const char* type = std::is_same_v<T, Point>          ? "Float64"
                     : std::is_same_v<T, std::int64_t> ? "Int64"
                     : std::is_same_v<T, Index>        ? "UInt32"
                     : std::is_same_v<T, std::uint8_t> ? "UInt8"
                                                       : "Int32";
  static_assert(std::is_same_v<T, Point> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, Index> ||
                std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::int32_t>);
  return {type, name, std::is_same_v<T, Point> ? std::size_t{3} : std::size_t{1},
          std::as_bytes(std::span(values))};
}

/// A table of integers that belongs to the whole grid.
struct VtuTable {
  std::string name;
  std::size_t columns;
  std::vector<std::int64_t> values;
};

struct VtuArrays {
  std::size_t points, cells;
  VtuArray coordinates, connectivity, offsets, types;
  std::vector<VtuArray> cell_data;
  std::vector<VtuArray> point_data = {};
  VtkFields field_data = {};
  std::vector<VtuTable> tables = {};
};

/// Cells in VTK's flat form.
class VtuCells {
 public:
  void reserve(std::size_t cells, std::size_t corners) {
    connectivity_.reserve(corners);
    offsets_.reserve(cells);
    types_.reserve(cells);
  }
  void add(VtkCell type, std::span<const Index> corners) {
    connectivity_.insert(connectivity_.end(), corners.begin(), corners.end());
    offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    types_.push_back(static_cast<std::uint8_t>(type));
  }
  [[nodiscard]] VtuArrays arrays(const std::vector<Point>& points, std::vector<VtuArray> cell_data,
                                 std::vector<VtuArray> point_data = {}) const {
    return {points.size(),
            types_.size(),
            vtu_array("Points", points),
            vtu_array("connectivity", connectivity_),
            vtu_array("offsets", offsets_),
            vtu_array("types", types_),
            std::move(cell_data),
            std::move(point_data)};
  }

 private:
  std::vector<Index> connectivity_;
  std::vector<std::int64_t> offsets_;  // 64 bits: there may be more than 2^32 corners
  std::vector<std::uint8_t> types_;
};

/// Writes an unstructured grid of one piece.
void write_vtu_arrays(AtomicWriter& out, const VtuArrays& arrays, const WriteOptions& options);

}  // namespace holdfast::io
