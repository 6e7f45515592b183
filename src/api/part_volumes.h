// The boundaries of volumes that are pasted together.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "holdfast/paste.h"
#include "mesh/anatomy.h"

namespace holdfast {

/// The faces of a volume with a tetrahedron on one side only.
struct Boundary {
  std::vector<Index> vertices;        ///< the volume's vertices on the boundary, ascending
  std::vector<Triangle> facets;       ///< of the volume's vertices, oriented outwards
  std::vector<Index> face;            ///< by facet: 4 * tetrahedron + opposite corner
  std::size_t first_tetrahedron = 0;  ///< in the tetrahedra of all volumes
  std::map<int, int> id_of;           ///< by region id of the volume, the id in the whole
};

/// A face as seen from outside the tetrahedron.
[[nodiscard]] inline Triangle face_of(const Tetrahedron& t, Index corner) {
  const Triangle f = corners_of_face(t, static_cast<int>(corner));
  return {f[0], f[2], f[1]};
}

/// Throws std::invalid_argument for indices out of range, faces with more than two tetrahedra, and a wrong
/// number of region ids.
[[nodiscard]] std::vector<Boundary> boundaries_of(std::span<const Volume> volumes);

/// With the markers of the volume's own facets.
[[nodiscard]] Surface surface_of(const Volume& volume, const Boundary& boundary);

/// Fills `id_of`, and the names of the regions in the surface. A volume whose tetrahedra have ids keeps them.
void number_regions(std::span<const Volume> volumes, std::span<Boundary> boundaries,
                    std::span<const std::string> part_names, PasteResult& pasted);

}  // namespace holdfast
