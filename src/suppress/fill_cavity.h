// Filling a cavity (suppress/cavity.h) again: without a point, or from one that sees all its faces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/kernel.h"
#include "mesh/tet_mesh.h"
#include "suppress/cavity.h"
#include "suppress/small_polyhedron.h"

namespace holdfast {

[[nodiscard]] Kernel kernel_of(const TetMesh& mesh, const Cavity& cavity);

/// The tetrahedra that join an apex to the faces that do not hold it.
[[nodiscard]] std::vector<TetMesh::Corners> cone_of(std::span<const std::array<Vertex, 3>> faces,
                                                    Vertex apex);

/// Fills a cavity without new points; the Steiner points inside are removed. Returns false, with the mesh
/// unchanged, if the search finds nothing. `created`, where given, receives the new tetrahedra.
bool fill(TetMesh& mesh, const Cavity& cavity, const PolyhedronOptions& search,
          std::vector<Tet>* created = nullptr);

/// Fills a cavity from an apex in its kernel, or one that moves into the kernel, to `place`. The other
/// Steiner points inside are removed.
void cone(TetMesh& mesh, const Cavity& cavity, Vertex apex, std::vector<Tet>* created = nullptr,
          const std::optional<Point>& place = {});

/// A place for a point that sees all faces. While there is none, the cavity grows, by at most `steps`
/// tetrahedra, across the faces that leave least room. The search for the kernel's centre starts at
/// `origin(cavity)`; `place(kernel, centre)` returns the place, if any.
template <typename Origin, typename Place>
[[nodiscard]] std::optional<Point> grow_until_placed(const TetMesh& mesh, Cavity& cavity, int steps,
                                                     Origin&& origin, Place&& place) {
  for (int step = 0; step <= steps; ++step) {
    const Kernel kernel = kernel_of(mesh, cavity);
    const Kernel::Centre centre = kernel.centre(origin(cavity));
    if (const std::optional<Point> found = place(kernel, centre)) return found;
    if (!cavity.grow_across_lowest(centre.heights)) break;
  }
  return std::nullopt;
}

}  // namespace holdfast
