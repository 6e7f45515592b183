// check() against slow oracles: random piles of tetrahedra on a small integer grid, where all pairs of
// tetrahedra are tested by separating planes in integers; and random cells, where regions and enclosed voids
// are counted by flooding cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "unit/check_cases.h"

namespace holdfast::check_cases::check_overlap_test {
namespace {

using Vector = std::array<int, 3>;
using Corners = std::array<Vector, 4>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Corners corners(const Volume& volume, const Tetrahedron& t) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) corners[i][k] = static_cast<int>(volume.vertices[t[i]][k]);
  return corners;
}

int volume_of(const Corners& t) {
  return dot(cross(minus(t[1], t[0]), minus(t[2], t[0])), minus(t[3], t[0]));
}

bool separates(const Vector& normal, const Corners& s, const Corners& t) {
  if (normal == Vector{}) return false;
  const auto range = [&](const Corners& corners) {
    return std::minmax(
        {dot(normal, corners[0]), dot(normal, corners[1]), dot(normal, corners[2]), dot(normal, corners[3])});
  };
  const auto [s_low, s_high] = range(s);
  const auto [t_low, t_high] = range(t);
  return s_high <= t_low || t_high <= s_low;
}

/// Whether two tetrahedra have common inner points: no plane along a face of one, or along an edge of each,
/// separates them.
bool overlap(const Corners& s, const Corners& t) {
  for (const Corners* of : {&s, &t})
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector &a = (*of)[(i + 1) % 4], &b = (*of)[(i + 2) % 4], &c = (*of)[(i + 3) % 4];
      if (separates(cross(minus(b, a), minus(c, a)), s, t)) return false;
    }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = k + 1; l < 4; ++l)
          if (separates(cross(minus(s[j], s[i]), minus(t[l], t[k])), s, t)) return false;
  return true;
}

bool any_overlap(const Volume& volume) {
  for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i)
    for (std::size_t j = i + 1; j < volume.tetrahedra.size(); ++j)
      if (overlap(corners(volume, volume.tetrahedra[i]), corners(volume, volume.tetrahedra[j]))) return true;
  return false;
}

/// The sides of a tetrahedron, counterclockwise from outside.
std::array<Triangle, 4> sides(const Tetrahedron& t) {
  return {{{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}};
}

/// A pile that grows at random boundary faces, to new or old vertices; sometimes a loose tetrahedron is
/// added. All are positive, and no face has more than two.
class Pile {
 public:
  explicit Pile(unsigned seed) : random_(seed) {
    const int pieces = 2 + number(14);
    size_ = 3 + number(6);
    if (number(3) == 0) start_large();
    while (static_cast<int>(volume.tetrahedra.size()) < pieces) {
      if (volume.tetrahedra.empty() || number(12) == 0)
        add({vertex(), vertex(), vertex(), vertex()});
      else
        grow();
    }
    std::vector<bool> used(volume.vertices.size(), false);  // vertices of refused tetrahedra go
    for (const Tetrahedron& t : volume.tetrahedra)
      for (const Index v : t) used[v] = true;
    std::vector<Index> index(volume.vertices.size());
    std::vector<Point> kept;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (used[i]) {
        index[i] = static_cast<Index>(kept.size());
        kept.push_back(volume.vertices[i]);
      }
    volume.vertices = kept;
    for (Tetrahedron& t : volume.tetrahedra)
      for (Index& v : t) v = index[v];
    volume.regions.assign(volume.tetrahedra.size(), 1);
  }

  Volume volume;

 private:
  int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  Index vertex() {
    Point point = corner_;
    for (double& x : point) x += spacing_ * number(size_);
    volume.vertices.push_back(point);
    return static_cast<Index>(volume.vertices.size() - 1);
  }

  /// Starts with a large tetrahedron, and puts everything else near a point that may be inside it.
  void start_large() {
    const double far = spacing_ * size_;
    volume.vertices = {{0, 0, 0}, {far, 0, 0}, {0, far, 0}, {0, 0, far}};
    add({0, 1, 2, 3});
    for (double& x : corner_) x = number(spacing_ * size_ / 2);
    spacing_ = 1;
    size_ = 3;
  }

  void grow() {
    const auto& from =
        volume.tetrahedra[static_cast<std::size_t>(number(static_cast<int>(volume.tetrahedra.size())))];
    const Triangle side = sides(from)[static_cast<std::size_t>(number(4))];
    const bool old = number(3) == 0;
    const Index apex = old ? static_cast<Index>(number(static_cast<int>(volume.vertices.size()))) : vertex();
    if (std::ranges::find(side, apex) == side.end()) add({side[0], side[1], side[2], apex});
  }

  /// Adds a tetrahedron if it is positive and each of its sides is new, or has one tetrahedron on the other
  /// side.
  void add(const Tetrahedron& t) {
    if (volume_of(corners(volume, t)) <= 0) return;
    for (Triangle side : sides(t)) {
      std::rotate(side.begin(), std::ranges::min_element(side), side.end());
      const Triangle opposite{side[0], side[2], side[1]};
      if (std::ranges::count(turns_, side) > 0 || std::ranges::count(turns_, opposite) > 1) return;
    }
    for (Triangle side : sides(t)) {
      std::rotate(side.begin(), std::ranges::min_element(side), side.end());
      turns_.push_back(side);
    }
    volume.tetrahedra.push_back(t);
  }

  std::mt19937 random_;
  Point corner_{};
  int spacing_ = 8;
  int size_ = 3;
  std::vector<Triangle> turns_;  ///< sides as they turn in their tetrahedra, smallest vertex first
};

// A mesh has each place once; repeats are a separate error.
bool repeats_a_place(const Volume& volume) {
  std::vector<Point> points = volume.vertices;
  std::ranges::sort(points);
  return std::ranges::adjacent_find(points) != points.end();
}

TEST(CheckAgainstOracle, OverlapIsFoundExactlyWhereItIs) {
  int overlapping = 0, disjoint = 0, touching = 0, covered = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    const Case c = filled(Pile(seed).volume);
    if (repeats_a_place(c.volume)) continue;
    const Names names = broken(c);
    const bool found = names.contains("no overlap");
    ASSERT_TRUE(names.empty() || names == Names{"no overlap"}) << seed;
    if (any_overlap(c.volume)) {
      ++overlapping;
      ASSERT_TRUE(found) << seed;
      if (contains(detail(c, "no overlap"), "inside other tetrahedra")) ++covered;
    } else if (found) {  // no common volume, but blocks that touch outside common faces
      ++touching;
      ASSERT_TRUE(contains(detail(c, "no overlap"), "pairs of boundary faces intersect")) << seed;
    } else {
      ++disjoint;
    }
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(disjoint, 500);
  EXPECT_GT(touching, 50);
  EXPECT_GT(covered, 10);
}

/// The cells of a cube of `size` cells that are connected through faces to a given one and have its id.
class Flood {
 public:
  Flood(int size, const RegionOf& id)
      : size_(size), id_(id), seen_(static_cast<std::size_t>(size * size * size)) {}

  /// Number of components of cells for which `counts(id)`; those that reach the border only if `border`.
  template <class Counts>
  int components(Counts&& counts, bool border) {
    int found = 0;
    for (int z = 0; z < size_; ++z)
      for (int y = 0; y < size_; ++y)
        for (int x = 0; x < size_; ++x)
          if (!seen(x, y, z) && counts(id_(x, y, z))) {
            reached_border_ = false;
            flood(x, y, z, id_(x, y, z));
            if (border || !reached_border_) ++found;
          }
    return found;
  }

 private:
  std::vector<bool>::reference seen(int x, int y, int z) {
    return seen_[static_cast<std::size_t>((z * size_ + y) * size_ + x)];
  }
  void flood(int x, int y, int z, int id) {
    if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= size_) {
      reached_border_ = true;
      return;
    }
    if (seen(x, y, z) || id_(x, y, z) != id) return;
    seen(x, y, z) = true;
    for (const int step : {-1, 1}) {
      flood(x + step, y, z, id);
      flood(x, y + step, z, id);
      flood(x, y, z + step, id);
    }
  }

  int size_;
  const RegionOf& id_;
  std::vector<bool> seen_;
  bool reached_border_ = false;
};

TEST(CheckAgainstOracle, RegionsAndVoidsAreCounted) {
  constexpr int size = 5;
  int with_voids = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<int> ids(size * size * size);
    for (int& id : ids) id = static_cast<int>(random() % (2 + seed % 3));
    ids[0] = 1;  // never all empty
    const RegionOf region_of = [&](int x, int y, int z) {
      return ids[static_cast<std::size_t>((z * size + y) * size + x)];
    };
    const Case c = grid({size, size, size}, region_of);
    ASSERT_EQ(broken(c), Names{}) << seed;
    const int regions = Flood(size, region_of).components([](int id) { return id > 0; }, true);
    const int voids = Flood(size, region_of).components([](int id) { return id == 0; }, false);
    EXPECT_TRUE(detail(c, "regions numbered")
                    .starts_with(std::to_string(regions) + (regions == 1 ? " region," : " regions,")))
        << seed;
    const std::string dropped = detail(c, "nothing dropped");
    if (voids > 0) {
      ++with_voids;
      EXPECT_TRUE(contains(dropped, "; " + std::to_string(voids) + " enclosed regions are left empty"))
          << seed;
    } else {
      EXPECT_FALSE(contains(dropped, "enclosed")) << seed;
    }
  }
  EXPECT_GT(with_voids, 60);
}

}  // namespace
}  // namespace holdfast::check_cases::check_overlap_test
