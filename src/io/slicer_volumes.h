// PrusaSlicer's description of the volumes of each object beside a 3MF model: runs of its triangles. Some
// volumes only change how the object is printed and are not material.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

struct SlicerVolume {
  std::uint64_t first = 0, last = 0;  ///< first and last of the object's triangles
  std::string name;
  std::string kind =
      "ModelPart";  ///< or "NegativeVolume", "ParameterModifier", "SupportBlocker" and the like

  [[nodiscard]] bool is_material() const { return kind == "ModelPart"; }
};
struct SlicerObject {
  std::string name;
  std::vector<SlicerVolume> volumes;
};

inline constexpr std::string_view kSlicerVolumes = "Metadata/Slic3r_PE_model.config";

/// By the number of the object in the model.
[[nodiscard]] std::map<std::uint64_t, SlicerObject> read_slicer_volumes(const Source& source);

}  // namespace holdfast::io
