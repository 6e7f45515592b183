// Cells that a file describes by their faces, as Ansys Fluent's does.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "holdfast/types.h"

namespace holdfast::io {

/// A triangle or quadrangle of a cell, oriented into the cell.
struct FaceOfCell {
  std::array<Index, 4> of{};
  std::size_t count = 0;
  [[nodiscard]] std::span<const Index> corners() const { return std::span(of).first(count); }
};

struct CornersOfCell {
  std::array<Index, 8> of{};
  std::size_t count = 0;
  [[nodiscard]] std::span<const Index> corners() const { return std::span(of).first(count); }
};

/// The corners of the tetrahedron, pyramid, prism or hexahedron with these faces, in the order of `add_cell`
/// (cells.h); a tetrahedron is positive if its faces are oriented into it. Nothing if it is another
/// polyhedron, or the faces do not fit together.
[[nodiscard]] std::optional<CornersOfCell> corners_of_cell(std::span<const FaceOfCell> faces);

}  // namespace holdfast::io
