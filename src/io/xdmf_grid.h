// XDMF's light data: grids that name arrays in HDF5.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

/// Where the arrays and the points are, and the number of points.
struct XdmfHeavy {
  std::string file, file_of_points;
  std::uint64_t points;
};

struct XdmfCells {
  std::string_view shape, array;  ///< the name of the shape, and the array of nodes
  std::uint64_t cells, nodes_each;
  std::vector<std::string_view> attributes;  ///< arrays of 32-bit integers, one per cell
};

/// Writes a grid of a file with several.
void put_xdmf_grid(AtomicWriter& out, const XdmfHeavy& heavy, std::string_view name, const XdmfCells& cells,
                   const Names& names, bool surface_is_beside = false);
void begin_xdmf(AtomicWriter& out);
void end_xdmf(AtomicWriter& out);

/// Writes a file with the single grid "mesh".
void write_xdmf_grid(AtomicWriter& out, const XdmfHeavy& heavy, const XdmfCells& cells, const Names& names,
                     bool surface_is_beside = false);

}  // namespace holdfast::io
