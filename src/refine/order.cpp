#include "refine/order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace holdfast {
namespace {

constexpr double kCells = 1024;  // along each axis
constexpr std::uint32_t kKeys = 1u << 30;

// Two zero bits between each two of ten.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000FFu;
  x = (x | (x << 8)) & 0x0300F00Fu;
  x = (x | (x << 4)) & 0x030C30C3u;
  x = (x | (x << 2)) & 0x09249249u;
  return x;
}

class Curve {
 public:
  explicit Curve(std::span<const Point> points) {
    low_.fill(std::numeric_limits<double>::infinity());
    Point high;
    high.fill(-std::numeric_limits<double>::infinity());
    for (const Point& p : points)
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, high[k] - low_[k]);
    scale_ = extent > 0 ? kCells / extent : 0;
  }
  [[nodiscard]] std::uint32_t key(const Point& p) const {
    std::uint32_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cell = std::clamp((p[k] - low_[k]) * scale_, 0.0, kCells - 1);
      key |= spread(static_cast<std::uint32_t>(cell)) << k;
    }
    return key;
  }

 private:
  Point low_{};
  double scale_ = 0;
};

// Items in the order of their keys, equal ones as they stood: two passes of 15 bits.
std::vector<std::uint32_t> sorted_by_key(std::vector<std::uint32_t> items,
                                         const std::vector<std::uint32_t>& keys) {
  constexpr unsigned kBits = 15;
  std::vector<std::uint32_t> other(items.size());
  for (unsigned shift = 0; shift < 2 * kBits; shift += kBits) {
    std::vector<std::size_t> start((std::size_t{1} << kBits) + 1, 0);
    const auto digit = [&](std::uint32_t item) { return (keys[item] >> shift) & ((1u << kBits) - 1); };
    for (const std::uint32_t item : items) ++start[digit(item) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    for (const std::uint32_t item : items) other[start[digit(item)]++] = item;
    items.swap(other);
  }
  return items;
}

}  // namespace

void order_along_curve(TetMesh& mesh, Vertex first, std::vector<RegionId>& region_of,
                       std::vector<double>& sizes) {
  const Curve curve(mesh.positions());
  std::vector<std::uint32_t> keys(mesh.vertex_count());
  for (Vertex v = 0; v < keys.size(); ++v) keys[v] = curve.key(mesh.position(v));
  std::vector<Tet> tets;
  tets.reserve(mesh.tet_count());
  std::vector<std::uint32_t> tet_keys(mesh.slot_count());
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    tets.push_back(t);
    std::uint32_t least = kKeys;
    for (const Vertex v : mesh.corners(t))
      if (v != kGhost) least = std::min(least, keys[v]);
    tet_keys[t] = least;
  }
  tets = sorted_by_key(std::move(tets), tet_keys);
  std::vector<Vertex> vertices;
  for (Vertex v = first; v < mesh.vertex_count(); ++v) vertices.push_back(v);
  vertices = sorted_by_key(std::move(vertices), keys);

  std::vector<RegionId> regions(tets.size());
  for (std::size_t k = 0; k < tets.size(); ++k) regions[k] = region_of[tets[k]];
  region_of = std::move(regions);
  if (!sizes.empty()) {
    const std::vector<double> old(sizes.begin() + first, sizes.end());
    for (std::size_t k = 0; k < vertices.size(); ++k) sizes[first + k] = old[vertices[k] - first];
  }
  mesh.renumber(tets, first, vertices);
}

}  // namespace holdfast
