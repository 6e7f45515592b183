#include "optimise/forced_apex.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <span>

#include "mesh/quality.h"
#include "mesh/quality_below.h"
#include "numbers/vector.h"
#include "optimise/walk_tuning.h"

namespace holdfast {
namespace {

constexpr std::size_t kBlock = 1024;  // vertices between two checks of what other threads have found
constexpr double kAboveRounding = 1.01, kWithSquare = 1e-100;

// Whether some vertex makes an element on face f with Q below `limit`, even if it does not see the facet. If
// no vertex does, no exchange improves the element at a facet.
bool has_better_apex(const TetMesh& mesh, Face f, double limit, const Threads& threads) {
  const std::array<Vertex, 3> v = mesh.face_vertices(f);
  const Point &a = mesh.position(v[0]), &b = mesh.position(v[1]), &c = mesh.position(v[2]);
  const Vector u = b - a, w = c - a, normal = cross(u, w);
  const std::array<double, 3> lengths{length(u), length(w), length(c - b)};
  const double longest = std::max({lengths[0], lengths[1], lengths[2]});
  const double side = dot(mesh.position(mesh.apex(f)) - a, normal) > 0 ? 1 : -1;
  // The inradius is below half of the height, so most vertices need no Q.
  const double least_height = 2 * kInradiusOfRegular * longest / limit;
  const double twice_area = length(normal), least = least_height * twice_area;
  // It is also below the facet's inradius, so the longest edge must not be too many times as long.
  const double most =
      kAboveRounding * limit / kInradiusOfRegular * twice_area / (lengths[0] + lengths[1] + lengths[2]);
  const double most_squared = most > kWithSquare ? most * most : std::numeric_limits<double>::infinity();
  const std::span<const Point> positions = mesh.positions();
  const auto is_better = [&](const Point& p) {
    const Vector from = p - a;
    return !(dot(from, from) > most_squared) && side * dot(from, normal) > least &&
           is_quality_below(a, b, c, p, limit);
  };
  std::atomic<bool> found = false;
  parallel_ranges(threads, positions.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t begin = first; begin < last && !found; begin += kBlock)
      if (const auto block = positions.subspan(begin, std::min(kBlock, last - begin));
          std::any_of(block.begin(), block.end(), is_better))
        found = true;
  });
  return found;
}

}  // namespace

bool may_be_better(const TetMesh& mesh, const WaitingElement& e, const Threads& threads) {
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(e.tet, i);
    if (mesh.is_facet(f) && !has_better_apex(mesh, f, tuning::kForcedFrom * e.quality, threads)) return false;
  }
  return true;
}

}  // namespace holdfast
