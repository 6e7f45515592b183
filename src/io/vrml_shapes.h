// Shapes of VRML that are polyhedra without lists of faces: Box, Cube, ElevationGrid and Extrusion.
#pragma once

#include <string_view>
#include <vector>

#include "io/vrml_scene.h"

namespace holdfast::io {

struct VrmlFaces {
  std::vector<Point> points;
  std::vector<std::vector<Index>> faces;  ///< seen from outside
};

/// Whether `faces_of_shape` knows the type of node.
[[nodiscard]] bool is_polyhedron(std::string_view type);

/// The faces of such a shape in its own coordinates. Throws FileError.
[[nodiscard]] VrmlFaces faces_of_shape(const VrmlScene& scene, const VrmlNode& shape);

}  // namespace holdfast::io
