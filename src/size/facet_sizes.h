// The sizes that facets can bear. Elements on a facet that is much larger than the wanted size, or long and
// thin, cannot be both small and well shaped: many small elements mean many bad ones.
//
// So a facet needs a size for points next to it, in proportion to its longest side, but no more than some
// times the wanted size. Off the facet the need falls with the distance, until the wanted size is reached.
// And points keep a distance from such facets: a point next to the tetrahedron on a large facet is not joined
// to the facet, so the cavities of points do not show how near it is. Facets that can bear the desired size
// are left out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "holdfast/types.h"
#include "mesh/parallel.h"

namespace holdfast {

class FacetSizes {
 public:
  struct Facet {
    std::array<Point, 3> corners;
    double wanted;          ///< the least size at its corners, of their own and of the user's limits
    bool is_asked = false;  ///< whether that is the user's
  };
  /// Whether the desired size is known at corners, or may be smaller anywhere: then facets need no more than
  /// some times the desired size at the point in question.
  enum class Wanted { at_corners, anywhere };
  /// What determines the size at a place. If it is the surface, because it is finer there than the user's
  /// size, facets that are too large only for the user's size do not make the size larger: otherwise giving a
  /// size would make elements larger.
  enum class By { surface, user };
  FacetSizes() = default;
  /// Facets that can bear the desired size are left out, where it is known. Facets that are too large for the
  /// user's size need at most this part of what they may need otherwise.
  explicit FacetSizes(std::span<const Facet> facets, Wanted wanted = Wanted::at_corners,
                      const Threads& threads = 1, double part_of_most_need = 1);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] std::size_t count() const { return facets_.size(); }

  /// The most that the facets need at x, if it is above the `size` that is wanted there; else `size`.
  [[nodiscard]] double bearable(const Point& x, double size, By by = By::user) const;
  struct Limit {
    double size;
    Index facet;  ///< the one that needs it, as numbered when given; no_entity where the wanted size is borne
  };
  /// The same with the facet.
  [[nodiscard]] Limit limit(const Point& x, double size, By by = By::user) const;
  /// Whether x, where `size` is wanted, is nearer to a facet than a part of the size that it needs at x.
  [[nodiscard]] bool is_too_near(const Point& x, double size, By by = By::user) const;

 private:
  struct Held {
    std::array<Point, 3> corners;
    double need;
    Index facet;
    bool is_asked;
    double clearance;  // part of the need at a point that is its least distance
  };
  // A box round facets first .. first + count - 1; children are nodes `left` and left + 1, none if it is 0.
  struct Node {
    Point low, high;
    double need;  // the most of its facets
    std::uint32_t first, count, left;
  };
  void part_facets(const Threads& threads);
  void enclose(Node& node) const;
  // Calls act(facet, distance) for the facets that need more than `size` and `rate` a unit of length at x,
  // and some others, until it returns false; it may raise `size`.
  template <typename Act>
  void for_each_near(const Point& x, double rate, const double& size, By by, Act&& act) const;
  // The bearable size at x; calls note(facet) for each facet that raises it.
  template <typename Note>
  [[nodiscard]] double raised(const Point& x, double size, By by, Note&& note) const;

  [[nodiscard]] double most_need(double size) const;

  Wanted wanted_ = Wanted::at_corners;
  std::vector<Held> facets_;
  std::vector<Node> nodes_;
};

}  // namespace holdfast
