// Which tetrahedra of a list share a face, computed from their corners alone.
#include <algorithm>

#include "holdfast/holdfast.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

struct Side {
  std::array<Index, 2> others;  // the larger two corners, in order
  Index tetrahedron;
  std::uint8_t opposite;
};

/// Faces of tetrahedra, grouped by their smallest corner: those of corner c begin at start[c].
class Sides {
 public:
  explicit Sides(std::span<const Tetrahedron> tetrahedra) {
    Index most = 0;
    for (const Tetrahedron& t : tetrahedra) most = std::max(most, *std::max_element(t.begin(), t.end()));
    // If a list has few corners with large numbers, faces are grouped by sorted corners instead.
    const bool dense = most / 16 <= tetrahedra.size();
    if (!dense) corners_ = corners_of(tetrahedra);
    start_.assign((dense ? std::size_t{most} + 1 : corners_.size()) + 1, 0);
    for_each(tetrahedra, [&](std::size_t smallest, const Side&) { ++start_[smallest + 1]; });
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    sides_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each(tetrahedra, [&](std::size_t smallest, const Side& side) { sides_[next[smallest]++] = side; });
    for (std::size_t c = 0; c + 1 < start_.size(); ++c)
      std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(start_[c]),
                sides_.begin() + static_cast<std::ptrdiff_t>(start_[c + 1]),
                [](const Side& x, const Side& y) { return x.others < y.others; });
  }

  /// Calls visit(one, other) for each face that exactly two tetrahedra have.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t c = 0; c + 1 < start_.size(); ++c)
      for (std::size_t i = start_[c]; i < start_[c + 1];) {
        std::size_t end = i + 1;
        while (end < start_[c + 1] && sides_[end].others == sides_[i].others) ++end;
        if (end - i == 2) visit(sides_[i], sides_[i + 1]);
        i = end;
      }
  }

 private:
  static std::vector<Index> corners_of(std::span<const Tetrahedron> tetrahedra) {
    std::vector<Index> corners;
    corners.reserve(4 * tetrahedra.size());
    for (const Tetrahedron& t : tetrahedra) corners.insert(corners.end(), t.begin(), t.end());
    sort_unique(corners);
    return corners;
  }

  [[nodiscard]] std::size_t place(Index corner) const {
    if (corners_.empty()) return corner;
    return static_cast<std::size_t>(std::lower_bound(corners_.begin(), corners_.end(), corner) -
                                    corners_.begin());
  }

  template <class Visit>
  void for_each(std::span<const Tetrahedron> tetrahedra, Visit&& visit) const {
    for (std::size_t t = 0; t < tetrahedra.size(); ++t)
      for (std::uint8_t i = 0; i < 4; ++i) {
        Triangle face{};
        for (std::size_t k = 0; k < 3; ++k) face[k] = tetrahedra[t][(i + k + 1) % 4];
        face = ascending(face);
        visit(place(face[0]), Side{{face[1], face[2]}, static_cast<Index>(t), i});
      }
  }

  std::vector<Index> corners_;  // that occur, if their numbers are sparse
  std::vector<std::size_t> start_;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<Neighbours> neighbours(std::span<const Tetrahedron> tetrahedra) {
  std::vector<Neighbours> result(tetrahedra.size(), {no_entity, no_entity, no_entity, no_entity});
  if (tetrahedra.empty()) return result;
  Sides(tetrahedra).for_each_pair([&](const Side& one, const Side& other) {
    if (one.tetrahedron == other.tetrahedron) return;
    result[one.tetrahedron][one.opposite] = other.tetrahedron;
    result[other.tetrahedron][other.opposite] = one.tetrahedron;
  });
  return result;
}

}  // namespace holdfast
