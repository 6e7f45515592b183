// Shared by the reader and the writer of Exodus II files (Schoof, Yarberry: EXODUS II: A Finite Element Data
// Model, SAND92-2137): how it numbers sides.
#pragma once

#include <array>
#include <cstddef>

namespace holdfast::io {

/// The number of a tetrahedron's side in Exodus, from 1, by the corner opposite to it.
inline constexpr std::array<std::size_t, 4> kExodusSideOpposite{2, 3, 1, 4};

/// The sides of cells as side_of_cell (cells.h) numbers them, by their number in Exodus less 1.
inline constexpr std::array<std::size_t, 6> kExodusSidesOfHexahedron{2, 3, 4, 5, 0, 1};
inline constexpr std::array<std::size_t, 5> kExodusSidesOfPrism{2, 3, 4, 0, 1};
inline constexpr std::array<std::size_t, 5> kExodusSidesOfPyramid{1, 2, 3, 4, 0};

}  // namespace holdfast::io
