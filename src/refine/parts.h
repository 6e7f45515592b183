// Cuts a mesh into parts that are meshes of their own. Threads change them at the same time, and they are
// joined again.
//
// A part is some of the tetrahedra of the kept regions, closed by ghosts. Its interfaces, the faces to the
// rest that are not facets, are treated as facets, and their edges as segments. So code that respects
// constraints works on a part as on a whole mesh. Changes that the interfaces forbid have to be made
// afterwards. The parts depend only on the mesh and are joined in their order, so the number of threads makes
// no difference.
#pragma once

#include <span>
#include <vector>

#include "mesh/parallel.h"
#include "refine/volume_data.h"

namespace holdfast {

class Part {
 public:
  TetMesh mesh;
  std::vector<RegionId> region_of;  ///< by slot
  std::vector<double> sizes;        ///< by vertex
  std::vector<Metric> metrics;      ///< by vertex, if there are any
  Vertex first_free = 0;            ///< lower ones stand: they are the whole's, or on an interface
  std::uint64_t seed = 1;           ///< the whole's

  /// Regions are those of the whole.
  [[nodiscard]] VolumeData data(const VolumeData& whole) {
    return {mesh, region_of,        sizes, whole.kept,         first_free,
            this, metrics_if_any(), seed,  whole.most_volumes, whole.most_sizes};
  }
  /// Whether a tetrahedron is the ghost on a face of an interface.
  [[nodiscard]] bool is_beyond_interface(Tet t) const {
    const Tet ghost = t - first_ghost_;  // huge where t is none
    return ghost < bounds_.size() && bounds_[ghost].is_interface;
  }
  /// The same, where there is another part beyond it.
  [[nodiscard]] bool is_beyond_cut(Tet t) const {
    return is_beyond_interface(t) && bounds_[t - first_ghost_].is_next_a_part;
  }
  /// By vertex: whether it is on an interface with another part. Higher ones are not.
  [[nodiscard]] std::span<const std::uint8_t> on_cut() const { return on_cut_; }
  /// By vertex: whether it was on an interface when the whole was cut before. Higher ones are new. Empty if
  /// the whole was not.
  [[nodiscard]] std::span<const std::uint8_t> was_on_cut() const { return was_on_cut_; }
  /// Numbers tetrahedra, and vertices that are not the whole's, along a Morton curve.
  void order_along_curve();

 private:
  friend class Parts;
  friend class PartMaker;
  friend class PartJoiner;

  // A face on the boundary, by ghost: its codes in the whole when it was cut.
  struct Bound {
    Face inner, outer;
    bool is_interface;      // no facet, nor on the hull
    bool is_next_a_part;    // beyond it
    std::uint8_t held = 0;  // bit j: the ghost's edge opposite corner j is a segment in this part alone
  };
  [[nodiscard]] std::vector<Metric>* metrics_if_any() { return metrics.empty() ? nullptr : &metrics; }
  template <typename Act>
  Face turn(Face in, Vertex across, Act&& act) const;
  void hold_interface(Tet ghost);
  void copy_constraints_to(Tet ghost);
  void release_interfaces();
  [[nodiscard]] std::size_t count_at_cuts() const;

  std::vector<Tet> slots_;        // in the whole, of the tetrahedra at first; ascending
  std::vector<Vertex> vertices_;  // of the whole, by vertex
  std::vector<Bound> bounds_;     // by ghost
  Tet first_ghost_ = 0;
  std::vector<std::uint8_t> on_cut_;      // by vertex below first_free
  std::vector<std::uint8_t> was_on_cut_;  // by vertex of the whole
};

class Parts {
 public:
  /// `part_of`, by slot, is the number of the part of a tetrahedron, or kNone for those that are in none. The
  /// whole must not be changed until the parts are joined.
  Parts(const VolumeData& whole, const std::vector<std::uint32_t>& part_of, std::size_t count,
        const Threads& threads);

  [[nodiscard]] const VolumeData& whole() const { return whole_; }
  [[nodiscard]] std::vector<Part>& parts() { return parts_; }
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// Takes note of the vertices that were on interfaces between other parts before, in ascending order.
  void set_cut_before(const std::vector<Vertex>& vertices, const Threads& threads);
  /// The share of tetrahedra with a vertex on an interface between two parts: small, unless there are
  /// vertices at which much of the mesh is.
  [[nodiscard]] double share_at_cuts(const Threads& threads) const;
  /// In all parts together, ghosts included.
  [[nodiscard]] std::size_t tet_count() const;
  /// Vertices that came to be in the parts.
  [[nodiscard]] std::size_t new_vertices() const;
  /// Puts the parts in the place of their tetrahedra.
  void join(const Threads& threads);
  /// Vertices of the whole on interfaces between these parts, in ascending order.
  [[nodiscard]] std::vector<Vertex> vertices_between() const;

 private:
  VolumeData whole_;
  std::vector<Part> parts_;
};

}  // namespace holdfast
