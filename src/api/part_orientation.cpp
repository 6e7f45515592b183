#include "api/part_orientation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "numbers/finite.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"
#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast {
namespace {

/// A facet as a part has it.
struct Wall {
  Index part;
  std::array<Index, 3> corners;
  std::size_t parent = 0;  ///< index in `parents.all`, for walls of the result
  bool is_turned = false;
};

/// Walls of one part that meet at a side of no other wall of the part.
struct Meeting {
  Index first, second;  ///< walls
  bool agree;           ///< they run along the side in opposite directions
};

std::vector<Meeting> meetings(std::span<const Wall> walls) {
  struct Side {
    Index part, a, b, wall;
    bool is_ahead;  ///< the wall runs from a to b
  };
  std::vector<Side> sides;
  for (Index w = 0; w < walls.size(); ++w)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = walls[w].corners[i], to = walls[w].corners[(i + 1) % 3];
      sides.push_back(
          {walls[w].part, std::min(from, to), std::max(from, to), w, (from < to) != walls[w].is_turned});
    }
  const auto key = [](const Side& s) { return std::array{s.part, s.a, s.b, s.wall}; };
  std::sort(sides.begin(), sides.end(), [&](const Side& s, const Side& t) { return key(s) < key(t); });
  const auto same = [&](std::size_t i, std::size_t j) {
    return sides[i].part == sides[j].part && sides[i].a == sides[j].a && sides[i].b == sides[j].b;
  };
  std::vector<Meeting> found;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && same(i, j)) ++j;
    if (j - i == 2)
      found.push_back({sides[i].wall, sides[i + 1].wall, sides[i].is_ahead != sides[i + 1].is_ahead});
  }
  return found;
}

/// Parts with facets that meet and are turned against each other.
std::set<Index> inconsistent_parts(const Complex& joined, std::span<const Index> part) {
  const std::vector<Index> first = first_at_places(joined.vertices);
  std::vector<Wall> walls;
  for (std::size_t f = 0; f < joined.facets.size(); ++f) {
    Wall wall{part[f], joined.facets[f]};
    if (std::any_of(wall.corners.begin(), wall.corners.end(),
                    [&](Index v) { return v >= first.size() || !is_finite(joined.vertices[v]); }))
      continue;
    for (Index& v : wall.corners) v = first[v];
    walls.push_back(wall);
  }
  std::set<Index> parts;
  for (const Meeting& meeting : meetings(walls))
    if (!meeting.agree) parts.insert(walls[meeting.first].part);
  return parts;
}

/// Facets that some part has once. Two facets of a part that became one turn away from each other.
std::vector<Wall> walls_of(std::span<const Index> part, const PasteResult& result) {
  std::vector<Wall> walls;
  for (std::size_t f = 0; f < result.parents.size(); ++f)
    for (std::size_t k = result.parents.first[f]; k < result.parents.first[f + 1]; ++k) {
      const Index p = part[result.parents.all[k]];
      const auto parents = result.parents[f];
      if (std::count_if(parents.begin(), parents.end(), [&](Index q) { return part[q] == p; }) == 1)
        walls.push_back({p, result.surface.facets[f], k, result.turned[k] != 0});
    }
  return walls;
}

class Orientation {
 public:
  Orientation(const std::vector<Point>& vertices, std::span<const Wall> walls)
      : vertices_(vertices), walls_(walls), beside_(walls.size()), against_(walls.size(), unknown) {
    for (const Meeting& meeting : meetings(walls)) {
      beside_[meeting.first].push_back({meeting.second, meeting.agree});
      beside_[meeting.second].push_back({meeting.first, meeting.agree});
    }
  }

  /// Walls that are turned against the larger area of those that they are connected with.
  [[nodiscard]] std::vector<Index> turned() {
    std::vector<Index> found;
    for (Index start = 0; start < walls_.size(); ++start) {
      if (against_[start] != unknown) continue;
      std::vector<Index> connected;
      if (!compare(start, connected)) continue;  // one-sided, so no choice makes sense
      std::array<double, 2> areas{};
      for (const Index w : connected) areas[against_[w]] += area(w);
      const std::uint8_t lesser = areas[1] < areas[0] ? 1 : 0;
      for (const Index w : connected)
        if (against_[w] == lesser) found.push_back(w);
    }
    return found;
  }

 private:
  static constexpr std::uint8_t unknown = 2;

  /// Collects what is connected with a wall, and whether each is turned against it; false if that depends on
  /// the way.
  bool compare(Index start, std::vector<Index>& connected) {
    connected.push_back(start);
    against_[start] = 0;
    bool fits = true;
    for (std::size_t i = 0; i < connected.size(); ++i)
      for (const auto& [next, agree] : beside_[connected[i]]) {
        const auto wanted =
            static_cast<std::uint8_t>(agree ? against_[connected[i]] : 1 - against_[connected[i]]);
        if (against_[next] == unknown) {
          against_[next] = wanted;
          connected.push_back(next);
        }
        fits = fits && against_[next] == wanted;
      }
    return fits;
  }

  [[nodiscard]] double area(Index w) const {
    const auto& [a, b, c] = walls_[w].corners;
    return length(cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a])) / 2;
  }

  const std::vector<Point>& vertices_;
  const std::span<const Wall> walls_;
  std::vector<std::vector<std::pair<Index, bool>>> beside_;
  std::vector<std::uint8_t> against_;  // by wall, whether it is turned against the first of those connected
};

}  // namespace

void orient_folds(const Complex& joined, std::span<const Index> part, PasteResult& result) {
  const std::set<Index> inconsistent = inconsistent_parts(joined, part);
  std::vector<Wall> walls = walls_of(part, result);
  std::erase_if(walls, [&](const Wall& wall) { return inconsistent.contains(wall.part); });
  for (const Index w : Orientation(result.surface.vertices, walls).turned())
    result.turned[walls[w].parent] ^= 1;
}

}  // namespace holdfast
