// Entities of a cell as DOLFIN numbers them (UFC specification): the facet i and the vertex i are opposite,
// and edges are opposite the edges of the same number counted from the end.
#pragma once

#include <array>
#include <cstddef>

namespace holdfast::io {

inline constexpr std::array<std::array<std::size_t, 2>, 6> kDolfinEdges{
    {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};
inline constexpr std::array<std::array<std::size_t, 2>, 3> kDolfinEdgesOfTriangle{{{1, 2}, {0, 2}, {0, 1}}};

}  // namespace holdfast::io
