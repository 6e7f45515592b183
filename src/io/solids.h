// The solids of a file that places copies of its objects, such as 3MF and AMF. Markers stand for the copies
// and, within each copy, for its materials.
#pragma once

#include <string>
#include <vector>

#include "io/mesh_data.h"
#include "io/placement.h"

namespace holdfast::io {

/// The geometry of an object of the file, without its placed components.
struct Solid {
  std::string name;
  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  std::vector<std::string> materials;       ///< names
  std::vector<std::size_t> facet_material;  ///< one per facet, from 1; 0: none; empty: no facet has one
};

class Solids {
 public:
  explicit Solids(const Source& source) : source_(source), bytes_(source.bytes.size()), mesh_(source) {}

  /// Sets the total size of the source's files, if it is not the source's own length.
  void set_bytes(std::size_t bytes) { bytes_ = bytes; }

  /// Adds a copy of a solid. Throws FileError if copies of copies grow beyond the size of any mesh.
  void add(const Solid& solid, const std::string& name, const Placement& placement);
  /// All copies. If all belong to one copy and material, there are no markers but a name.
  [[nodiscard]] MeshData take();

 private:
  void add_geometry(const Solid& solid, const Placement& placement);
  void refuse_a_trap(const Solid& solid) const;

  /// Triangles of one copy and material.
  struct Group {
    std::string copy, material;
    bool alone = false;  ///< the group is the whole copy
  };

  Source source_;
  std::size_t bytes_;
  MeshData mesh_;
  std::size_t copies_ = 0;
  std::vector<Group> groups_;
  std::vector<std::size_t> facet_group_;
};

}  // namespace holdfast::io
