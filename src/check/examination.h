// Check: what the rules of one examination share. Each rule is a function that may use what the rules
// before it established, and says "not examined" where that is missing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "check/boundary.h"
#include "check/face_table.h"
#include "check/input.h"
#include "check/pulse.h"
#include "holdfast/check.h"

namespace holdfast::checking {

/// What became of an input facet, segment or vertex.
enum class Fate : std::uint8_t {
  kept,
  lost,     ///< not in the mesh, although (or because) tetrahedra are where it should be
  dropped,  ///< not in the mesh, and outside all tetrahedra
};

struct Examination {
  const Complex& surface;  ///< findings name its entities by their indices here
  const Volume& volume;
  const CheckOptions& options;
  const Input input;  ///< the surface's entities by vertices of the mesh
  Pulse& pulse;       ///< for loops over what may be many

  // Established by the rules, in this order.
  bool vertices_kept = false;
  bool well_formed = false;                 ///< indices can be followed and coordinates computed with
  std::vector<std::int16_t> orientation{};  ///< of each tetrahedron, exact
  bool positive = false;
  FaceTable faces{};
  std::vector<bool> input_face{};      ///< by where a face's half-faces begin: whether it is an input facet
  bool matched = false;                ///< no face has two tetrahedra on one side
  std::optional<Boundary> boundary{};  ///< if positive and matched
  bool disjoint = false;               ///< no overlap: the mesh is a simplicial complex
  std::vector<Fate> facets{}, segments{}, vertices{};

  /// How many of the mesh's vertices the input asks for: they come first.
  [[nodiscard]] std::size_t input_vertices() const { return input.first.size(); }
};

inline constexpr const char* not_well_formed = "the input or the mesh is not well formed";

// rules_form.cpp
[[nodiscard]] Rule vertices_kept(Examination& on);
[[nodiscard]] Rule well_formed(Examination& on);
[[nodiscard]] Rule no_vertex_unused(const Examination& on);
// rules_space.cpp
[[nodiscard]] Rule positive_volumes(Examination& on);
[[nodiscard]] Rule faces_matched(Examination& on);
[[nodiscard]] Rule no_overlap(Examination& on);
[[nodiscard]] Rule boundary_is_input(const Examination& on);
[[nodiscard]] Rule steiner_points_inside(const Examination& on);
// rules_input.cpp
void find_input_faces(Examination& on);
void find_fates(Examination& on);
[[nodiscard]] Rule facets_kept(const Examination& on);
[[nodiscard]] Rule segments_kept(const Examination& on);
[[nodiscard]] Rule nothing_dropped(const Examination& on);
// rules_labels.cpp
[[nodiscard]] Rule regions_numbered(const Examination& on);
[[nodiscard]] Rule markers_kept(const Examination& on);
// rules_second_order.cpp: mid-edge nodes, then Jacobians
[[nodiscard]] std::array<Rule, 2> second_order(const Examination& on);

}  // namespace holdfast::checking
