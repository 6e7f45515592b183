// The solids of a file that places copies of its objects, as 3MF and AMF do. Markers are the copies and,
// within each, its materials.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// x' = x m[0] + y m[3] + z m[6] + m[9], and so on: the rows of 3MF's transforms.
struct Placement {
  std::array<double, 12> m = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  [[nodiscard]] Point of(const Point& p) const;
  /// This placement of what `inner` has placed.
  [[nodiscard]] Placement after(const Placement& inner) const;
  /// Whether it turns what is seen from outside inside out.
  [[nodiscard]] bool mirrors() const;
  bool operator==(const Placement&) const = default;
};

/// What an object of the file holds itself.
struct Solid {
  std::string name;
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  std::vector<std::string> materials;       ///< names
  std::vector<std::size_t> facet_material;  ///< one a facet, from 1; 0: none; empty: none has one
};

class Solids {
 public:
  explicit Solids(const Source& source) : source_(source), mesh_(source) {}

  /// Puts a copy of a solid. Throws FileError where copies of copies grow beyond what a mesh is.
  void add(const Solid& solid, const std::string& name, const Placement& placement);
  /// All copies. There are no markers but a name where all is of one copy and material.
  [[nodiscard]] MeshData take();

 private:
  void add_geometry(const Solid& solid, const Placement& placement);
  void refuse_a_trap(const Solid& solid) const;

  /// Triangles of one copy and material.
  struct Group {
    std::string copy, material;
    bool alone = false;  ///< all of the copy
  };

  Source source_;
  MeshData mesh_;
  std::size_t copies_ = 0;
  std::vector<Group> groups_;
  std::vector<std::size_t> facet_group_;
};

}  // namespace holdfast::io
