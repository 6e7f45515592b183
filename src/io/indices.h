// Whether entities name vertices that exist, before their indices are followed.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::io {

template <typename Entity>
bool name_vertices(const std::vector<Entity>& entities, std::size_t vertices) {
  return std::all_of(entities.begin(), entities.end(), [vertices](const Entity& corners) {
    return std::all_of(corners.begin(), corners.end(), [vertices](Index v) { return v < vertices; });
  });
}

/// Of a surface or a volume. Throws std::invalid_argument.
template <typename Mesh>
void require_indices(const Mesh& mesh) {
  const std::size_t vertices = mesh.vertices.size();
  bool fit = name_vertices(mesh.facets, vertices) && name_vertices(mesh.segments, vertices);
  if constexpr (requires { mesh.tetrahedra; }) fit = fit && name_vertices(mesh.tetrahedra, vertices);
  if (!fit) throw std::invalid_argument("an index is not that of a vertex");
}

}  // namespace holdfast::io
