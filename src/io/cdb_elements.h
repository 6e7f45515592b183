// Shapes of Ansys MAPDL's element types (Mechanical APDL element reference).
#pragma once

#include <cstdint>

namespace holdfast::io {

enum class CdbShape : std::uint8_t { surface, solid, line, other };

/// MESH200, elements of a mesh alone; its first option says which.
inline constexpr int kMesh200 = 200;
inline constexpr int kMesh200Line2 = 2, kMesh200Line3 = 3, kMesh200Triangle3 = 4, kMesh200Triangle6 = 5;
/// Tetrahedra of 4 and 10 nodes.
inline constexpr int kSolid285 = 285, kSolid187 = 187;

struct CdbType {
  int name = 0;    ///< 187 for SOLID187
  int option = 0;  ///< its first one
};
[[nodiscard]] CdbShape shape_of(const CdbType& type);

}  // namespace holdfast::io
