#include "refine/order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/editor.h"

namespace holdfast {
namespace {

constexpr double kCells = 1024;  // along each axis
constexpr std::uint32_t kKeys = 1u << 30;

// Puts two zero bits between any two of ten bits.
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

// Sorts items by their keys, stably: three passes of 10 bits, whose counts fit in the nearest cache.
template <typename KeyOf>
void sort_by_key(std::vector<std::uint32_t>& items, KeyOf&& key_of) {
  constexpr unsigned kBits = 10, kPasses = 3;
  struct Item {
    std::uint32_t key, item;
  };
  std::vector<Item> all(items.size()), other(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) all[k] = {key_of(items[k]), items[k]};
  for (unsigned shift = 0; shift < kPasses * kBits; shift += kBits) {
    std::vector<std::size_t> start((std::size_t{1} << kBits) + 1, 0);
    const auto digit = [&](const Item& x) { return (x.key >> shift) & ((1u << kBits) - 1); };
    for (const Item& x : all) ++start[digit(x) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    for (const Item& x : all) other[start[digit(x)]++] = x;
    all.swap(other);
  }
  for (std::size_t k = 0; k < items.size(); ++k) items[k] = all[k].item;
}

}  // namespace

CurveKeys::CurveKeys(const TetMesh& mesh) : mesh_(mesh), keys_(mesh.vertex_count()) {
  const Curve curve(mesh.positions());
  for (Vertex v = 0; v < keys_.size(); ++v) keys_[v] = curve.key(mesh.position(v));
}

void CurveKeys::sort(std::vector<Tet>& tets) const {
  sort_by_key(tets, [&](Tet t) {
    std::uint32_t least = kKeys;
    for (const Vertex v : mesh_.corners(t))
      if (v != kGhost) least = std::min(least, keys_[v]);
    return least;
  });
}

void CurveKeys::sort_vertices(std::vector<Vertex>& vertices) const {
  sort_by_key(vertices, [&](Vertex v) { return keys_[v]; });
}

CurveOrder order_of(const TetMesh& mesh, Vertex first) {
  const CurveKeys keys(mesh);
  CurveOrder order;
  order.tets.reserve(mesh.tet_count());
  for (Tet t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) order.tets.push_back(t);
  for (Vertex v = first; v < mesh.vertex_count(); ++v) order.vertices.push_back(v);
  keys.sort(order.tets);
  keys.sort_vertices(order.vertices);
  return order;
}

void renumber(TetMesh& mesh, const CurveOrder& order, Vertex first, std::vector<RegionId>& region_of,
              std::vector<double>& sizes, std::vector<Metric>* metrics) {
  const auto& tets = order.tets;
  const auto& vertices = order.vertices;
  std::vector<RegionId> regions(tets.size());
  for (std::size_t k = 0; k < tets.size(); ++k) regions[k] = region_of[tets[k]];
  region_of = std::move(regions);
  const auto reorder = [&](auto& values) {
    const std::vector old(values.begin() + first, values.end());
    for (std::size_t k = 0; k < vertices.size(); ++k) values[first + k] = old[vertices[k] - first];
  };
  if (!sizes.empty()) reorder(sizes);
  if (metrics != nullptr) reorder(*metrics);
  MeshEditor(mesh).renumber(tets, first, vertices);
}

void order_along_curve(const VolumeData& volume) {
  renumber(volume.mesh, order_of(volume.mesh, volume.first_free), volume.first_free, volume.region_of,
           volume.sizes, volume.metrics);
}

}  // namespace holdfast
