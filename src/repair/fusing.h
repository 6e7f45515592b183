// The work of `fuse`, which its steps share: patches (fuse.cpp), sides (fuse_sides.cpp), and the common
// triangles of patches (fuse_patches.cpp).
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "plane/triangulate.h"
#include "repair/fuse.h"
#include "repair/near.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"

namespace holdfast::repairing {

class Fusing {
 public:
  Fusing(State& state, std::span<const Index> part, double gap, double rounding, const Step& step)
      : state_(state), part_(part), gap_(gap), rounding_(rounding), step_(step) {}

  double run();

 private:
  using Side = std::array<Index, 2>;

  /// A facet's plane.
  struct PlaneOf {
    Vector normal{};    // of length 1
    double height = 0;  // the facet's least
    std::size_t axis = 0;
  };

  [[nodiscard]] const Point& at(Index v) const { return state_.vertices[v]; }
  [[nodiscard]] Index part_of(Index facet) const { return part_[state_.facet_parents.of(facet)[0]]; }
  /// Facets that parts have in common already stay as they are.
  [[nodiscard]] bool is_shared(Index facet) const { return state_.facet_parents.of(facet).size() > 1; }

  /// Each place has one vertex, the first.
  void name_places();
  void list_facets();
  [[nodiscard]] std::optional<PlaneOf> plane_of(const Triangle& t) const;

  /// Calls visit(f, g) for facets of different parts whose boxes come nearer than the gap.
  template <class Visit>
  void for_each_close(Visit&& visit) const;
  void find_patches();
  [[nodiscard]] double above(Index v, const Point& origin, const Vector& normal) const;

  /// Whether two facets nearly lie in one plane, and share more of it than rounding makes.
  [[nodiscard]] bool overlap(Index f, Index g) const;

  /// Whether a corner of one comes within the gap of the other, or a side of one passes a side of the other
  /// so.
  [[nodiscard]] bool touch(const Triangle& f, const Triangle& g) const;
  [[nodiscard]] PlanePoint flat(Index v, std::size_t axis) const;

  /// No line along a side parts them, nor cuts off a strip alone.
  [[nodiscard]] bool share_area(const Triangle& f, const Triangle& g, std::size_t axis) const;
  [[nodiscard]] bool is_flat(const std::vector<Index>& facets) const;
  [[nodiscard]] Index widest(const std::vector<Index>& facets) const;

  /// What a side is led through, by how far along it.
  struct OnSide {
    std::vector<Index> parts;
    std::vector<std::pair<double, Index>> points;
    enum { fresh, open, done } state = fresh;  // of part_from_itself
  };
  void list_sides();
  [[nodiscard]] Side side_of(Index f, std::size_t i) const;
  static bool meet(const std::vector<Index>& a, const std::vector<Index>& b);

  /// Of the sides of a part near a vertex the nearest.
  void put_vertices_on_sides();

  /// Two vertices that are within the gap may each pass a side of the other: the later one goes on the side.
  [[nodiscard]] bool is_led_back(Index v, Index end) const;
  [[nodiscard]] static bool has(const Side& side, const OnSide& on, Index v);

  /// Whether two sides have a vertex in common by now: then they meet there, and nowhere else.
  [[nodiscard]] static bool are_joined(const Side& s, const OnSide& on_s, const Side& t, const OnSide& on_t);
  void cross_sides();
  [[nodiscard]] Index near_on(const Side& side, const OnSide& on, const Point& p) const;
  Index add_vertex(const Point& p);

  /// A piece of a side may be a side, which is led through vertices in its turn. Where that would lead back
  /// to the first one, a vertex is left out.
  void part_from_itself(const Side& side, OnSide& on);

  /// The vertices of a side from one end to the other.
  [[nodiscard]] std::vector<Index> chain(Index from, Index to) const;
  void triangulate_patches();

  struct Pasted {
    Triangle corners;
    std::vector<Index> facets;  // ascending, in the state
  };
  bool triangulate(Index patch);

  /// A patch that is not plane: what several parts have in common is cut in the planes of the facets of the
  /// first of them, and the rest of the others' facets in their own.
  bool triangulate_curved(const std::vector<Index>& facets);

  /// By facet the vertices of other parts that lie on it, and on no side of its part.
  [[nodiscard]] std::map<Index, std::vector<Index>> vertices_inside(const std::vector<Index>& facets) const;

  /// A facet with the vertices inside it, and all pieces of other parts' sides between its vertices.
  bool cut_one(Index f, const std::vector<Index>& inside, const std::vector<Index>& patch,
               const std::vector<Box>& boxes, std::vector<Pasted>& pasted);

  /// The facet itself and, of each other part, the one that is nearest to the middle of a piece of it; in the
  /// order of parts.
  [[nodiscard]] std::vector<Index> facets_at(const Triangle& piece, Index f, const std::vector<Index>& patch,
                                             const std::vector<Box>& boxes) const;
  [[nodiscard]] double area(const Triangle& t, std::size_t axis) const;

  /// For each cell between the sides the facets that it is in, told by the middle of its largest triangle.
  [[nodiscard]] std::map<int, std::vector<Index>> facets_of_cells(const std::vector<Index>& facets,
                                                                  std::size_t axis,
                                                                  const std::vector<Index>& vertices,
                                                                  const PlaneMesh& mesh) const;
  [[nodiscard]] bool holds(const Triangle& t, const PlanePoint& p, std::size_t axis) const;
  void note_distance(const Triangle& child, const Triangle& facet);

  /// A facet that is in no patch, cut with its sides. Returns false where that leads back to itself, as it
  /// may in facets that are thinner than the gap.
  [[nodiscard]] bool split(const Triangle& t, std::vector<Triangle>& pieces, int depth = 0) const;
  void deliver();

  State& state_;
  const std::span<const Index> part_;
  const double gap_, rounding_;
  const Step& step_;
  std::vector<std::optional<PlaneOf>> planes_;  // by facet; nothing for those that are none
  std::vector<std::vector<Index>> parts_at_;    // by vertex, ascending
  std::vector<Index> close_;                    // facets near to another part
  std::vector<Index> close_vertices_;
  std::set<std::pair<Index, Index>>
      on_side_;                              // vertices, with the parts that have a side that is led through
  std::vector<std::vector<Index>> patches_;  // facets, ascending
  std::vector<Index> patch_of_;              // by facet, or no_index
  std::map<Side, OnSide> sides_;             // of close facets
  std::vector<Pasted> pasted_;
  double most_ = 0;
};

}  // namespace holdfast::repairing
