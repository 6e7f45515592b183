#include "suppress/suppress.h"

#include <algorithm>

#include "suppress/collapse.h"

namespace holdfast {
namespace {

std::size_t unrounded(const TetMesh& mesh, const std::vector<Vertex>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](Vertex p) { return !mesh.is_explicit(p); }));
}

}  // namespace

SuppressStats suppress(TetMesh& mesh, std::vector<Vertex> points, Monitor& monitor) {
  SuppressStats stats;
  const auto all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  constexpr int kMostRounds = 30;
  constexpr int kPatience = 3;  // rounds without gain: recentring may open a way only later
  int idle = 0;
  for (int round = 0; round < kMostRounds && idle < kPatience && !points.empty(); ++round) {
    const std::size_t points_before = points.size();
    const std::size_t unrounded_before = unrounded(mesh, points);
    std::vector<Vertex> left;
    for (const Vertex p : points) {
      monitor.poll(Stage::suppress, 1.0 - static_cast<double>(points.size()) / all);
      switch (remove_or_recentre(mesh, p, {})) {
        case Fate::collapsed:
          ++stats.collapsed;
          break;
        case Fate::filled:
          ++stats.filled;
          break;
        case Fate::moved:
        case Fate::stays:
          left.push_back(p);
          break;
      }
    }
    points = std::move(left);
    const bool gained = points.size() < points_before || unrounded(mesh, points) < unrounded_before;
    idle = gained ? 0 : idle + 1;
  }
  stats.left = points.size();
  stats.unrounded = unrounded(mesh, points);
  return stats;
}

}  // namespace holdfast
