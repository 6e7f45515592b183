// The vertices that each side of nearly coincident interfaces is led through: vertices of other parts, and
// crossings. They are decided once for all facets of the side, so no crack can open: a vertex of another part
// lies on at most one side of a part, and two sides cross in one vertex.
#pragma once

#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "repair/part_facets.h"
#include "surface/search.h"

namespace holdfast::repairing {

class LedSides {
 public:
  /// Leads the sides of facets that are close to another part through the vertices that they pass within
  /// `gap`, and through new vertices where they cross. New vertices are added to `vertices`.
  LedSides(const PartFacets& facets, std::span<const Index> close, double gap, std::vector<Point>& vertices,
           const Step& step);

  /// The vertices of a side from one end to the other.
  [[nodiscard]] std::vector<Index> chain(Index from, Index to) const;
  /// The edges from vertex to vertex round a facet, along its led sides.
  [[nodiscard]] std::vector<std::array<Index, 2>> round(const Triangle& t) const;
  /// Whether some side of a part is led through a vertex.
  [[nodiscard]] bool is_on_side(Index v, Index part) const { return on_side_.count({v, part}) != 0; }
  /// A facet that is in no patch, cut with its sides: exactly these are sides of an odd number of the pieces.
  [[nodiscard]] std::vector<Triangle> split(const Triangle& t) const;
  /// The largest distance between a side and a vertex that it is led through.
  [[nodiscard]] double most() const { return most_; }

 private:
  using Side = std::array<Index, 2>;  // ascending

  /// The vertices that a side is led through, by their position along it.
  struct OnSide {
    std::vector<Index> parts;
    std::vector<std::pair<double, Index>> points;
    enum { fresh, open, done } state = fresh;  // of part_from_itself
  };
  using Sides = std::map<Side, OnSide>;

  /// The nearest side of a part to a vertex, by vertex and part.
  struct NearSide {
    double distance, t;
    Sides::iterator side;
  };
  using NearestSides = std::map<std::pair<Index, Index>, NearSide>;

  /// Where two sides pass each other, by their numbers and the positions along them.
  struct Crossing {
    Index first, second;
    double t, s;
    Point where;
  };

  /// False if the chain leads back to itself, as it may in facets thinner than the gap.
  [[nodiscard]] bool split_deeper(const Triangle& t, std::vector<Triangle>& pieces, int depth) const;
  [[nodiscard]] std::vector<Triangle> fan(const Triangle& t) const;
  void append(Index from, Index to, std::vector<Index>& chain, int depth = 0) const;
  [[nodiscard]] const Point& at(Index v) const { return facets_.at(v); }
  void list(std::span<const Index> close);
  void put_vertices(std::span<const Index> close, const Step& step);
  void note_nearness(Index v, Sides::iterator side, NearestSides& nearest) const;
  void cross_sides(std::vector<Point>& vertices, const Step& step);
  void join_at(const Crossing& crossing, Sides::value_type& first, Sides::value_type& second,
               std::vector<Point>& vertices) const;
  [[nodiscard]] bool is_led_back(Index v, Index end) const;
  [[nodiscard]] Index near_on(const Side& side, const OnSide& on, const Point& p, const Side& other) const;
  [[nodiscard]] double distance(Index v, const Side& side) const;
  void part_from_itself(const Side& side, OnSide& on);

  [[nodiscard]] static bool meet(const std::vector<Index>& a, const std::vector<Index>& b);
  [[nodiscard]] static bool has(const Side& side, const OnSide& on, Index v);
  [[nodiscard]] static bool are_joined(const Side& s, const OnSide& on_s, const Side& t, const OnSide& on_t);

  const PartFacets& facets_;
  const double gap_;
  Sides sides_;
  std::set<std::pair<Index, Index>> on_side_;  // vertices, with the parts that have a side led through them
  double most_ = 0;
};

}  // namespace holdfast::repairing
