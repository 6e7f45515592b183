// check() on arrays that make no sense: it answers, and never follows a wrong index. Also run under the
// sanitizers.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "unit/check_cases.h"

namespace holdfast::check_cases::check_garbage_test {
namespace {

/// Random surfaces and volumes, each part of which may be wrong in its own way.
class Garbage {
 public:
  explicit Garbage(unsigned seed) : random_(seed), wild_indices_(one_in(3)), wild_numbers_(one_in(3)) {
    fill(made.surface.vertices, number(9));
    made.volume.vertices = made.surface.vertices;
    if (one_in(8)) made.volume.vertices.resize(made.volume.vertices.size() / 2);
    std::vector<Point> more;
    fill(more, number(4));
    made.volume.vertices.insert(made.volume.vertices.end(), more.begin(), more.end());
    const std::size_t points = made.volume.vertices.size();
    entities(made.volume.tetrahedra, number(10), points);
    labels(made.volume.regions, made.volume.tetrahedra.size());
    entities(made.surface.facets, number(10), made.surface.vertices.size());
    entities(made.surface.segments, number(4), made.surface.vertices.size());
    if (one_in(2)) made.volume.facets = made.surface.facets;
    entities(made.volume.segments, number(4), points);
    labels(made.surface.facet_markers, made.surface.facets.size());
    labels(made.surface.segment_markers, made.surface.segments.size());
    labels(made.volume.facet_markers, made.volume.facets.size());
    labels(made.volume.segment_markers, made.volume.segments.size());
    made.options.outside_dropped = one_in(2);
    made.options.box = one_in(2);
    // Facets that are faces, which random ones seldom are.
    for (const Tetrahedron& t : made.volume.tetrahedra)
      if (one_in(2)) made.surface.facets.push_back({t[2], t[0], t[3]});
  }

  Case made;

 private:
  std::size_t number(std::size_t below) { return random_() % below; }
  bool one_in(std::size_t n) { return number(n) == 0; }

  double coordinate() {
    constexpr std::array wild{
        std::numeric_limits<double>::quiet_NaN(),  std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::max(),        -std::numeric_limits<double>::max(),
        std::numeric_limits<double>::denorm_min(), -0.0};
    if (wild_numbers_ && one_in(4)) return wild[number(2) == 0 ? number(6) : 2 + number(4)];
    return static_cast<double>(number(4));
  }
  void fill(std::vector<Point>& points, std::size_t count) {
    for (; count > 0; --count) points.push_back({coordinate(), coordinate(), coordinate()});
  }
  template <class Entity>
  void entities(std::vector<Entity>& made_here, std::size_t count, std::size_t vertices) {
    for (; count > 0; --count) {
      Entity entity;
      for (Index& v : entity) {
        v = static_cast<Index>(number(vertices + 1));
        if (v == vertices && v > 0 && !wild_indices_) v = 0;
        if (wild_indices_ && one_in(30))
          v = std::numeric_limits<Index>::max() - static_cast<Index>(number(3));
      }
      made_here.push_back(entity);
    }
  }
  void labels(std::vector<int>& made_here, std::size_t count) {
    if (one_in(8)) ++count;
    if (!one_in(3)) made_here.assign(count, static_cast<int>(number(2)));
  }

  std::mt19937 random_;
  bool wild_indices_, wild_numbers_;
};

TEST(CheckOfGarbage, Answers) {
  std::map<std::string, int> held;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    const CheckResult result = Garbage(seed).made.checked();
    ASSERT_EQ(result.rules.size(), 13U);
    for (const Rule& rule : result.rules) {
      ASSERT_FALSE(rule.detail.empty()) << rule.name;
      if (rule.holds) ++held[rule.name];
    }
  }
  EXPECT_EQ(held.size(), 13U) << "some rule was never reached";
}

}  // namespace
}  // namespace holdfast::check_cases::check_garbage_test
