#include "io/solids.h"

#include <map>
#include <utility>

#include "io/labels.h"

namespace holdfast::io {
namespace {

// Nested copies can grow exponentially with the length of a file.
constexpr std::size_t kMostCopies = 1 << 20, kHarmlessWords = std::size_t{1} << 22, kMostTimes = 1000;

}  // namespace

void Solids::refuse_a_trap(const Solid& solid) const {
  const std::size_t size =
      mesh_.vertices.size() + solid.vertices.size() + mesh_.facets.size() + solid.facets.size();
  if (copies_ == kMostCopies || (size > kHarmlessWords && size / kMostTimes > bytes_))
    throw FileError(source_.path, "",
                    "holds more than " + std::to_string(copies_) + " copies of its objects, " +
                        std::to_string(mesh_.facets.size()) +
                        " triangles in all; such a file is damaged or malicious");
  if (mesh_.vertices.size() + solid.vertices.size() >= no_entity)
    throw FileError(source_.path, "", "has more vertices than 32 bits count");
}

void Solids::add_geometry(const Solid& solid, const Placement& placement) {
  const auto first = static_cast<Index>(mesh_.vertices.size());
  for (const Point& vertex : solid.vertices) {
    beat(source_.watch);
    mesh_.vertices.push_back(placement.of(vertex));
  }
  const bool mirrors = placement.mirrors();
  for (Triangle facet : solid.facets) {
    beat(source_.watch);
    for (Index& corner : facet) corner += first;
    if (mirrors) std::swap(facet[1], facet[2]);
    mesh_.facets.push_back(facet);
  }
}

void Solids::add(const Solid& solid, const std::string& name, const Placement& placement) {
  step(source_.watch);
  refuse_a_trap(solid);
  add_geometry(solid, placement);
  std::map<std::size_t, std::size_t> group_of;  // by material
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    const std::size_t material = solid.facet_material.empty() ? 0 : solid.facet_material[f];
    const auto [there, fresh] = group_of.try_emplace(material, groups_.size());
    if (fresh)
      groups_.push_back(
          {cleaned_name(name), material == 0 ? "" : cleaned_name(solid.materials[material - 1])});
    facet_group_.push_back(there->second);
  }
  if (group_of.size() == 1) groups_.back().alone = true;
  ++copies_;
}

MeshData Solids::take() {
  const bool several = groups_.size() > 1;
  for (std::size_t f = 0; several && f < facet_group_.size(); ++f)
    mesh_.facet_markers.add(f, static_cast<int>(facet_group_[f]) + 1);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const auto& [copy, material, alone] = groups_[g];
    const bool copy_says_it = !copy.empty() && (alone || material.empty());
    const std::string name = copy_says_it                   ? copy
                             : copies_ == 1 || copy.empty() ? material
                                                            : copy + " " + material;
    if (!name.empty()) mesh_.names.facets[several ? static_cast<int>(g) + 1 : 0] = name;
  }
  return std::move(mesh_);
}

}  // namespace holdfast::io
