// Writes Gmsh's .msh, versions 4.1 and 2.2, ASCII (Gmsh reference manual, "File formats").
//
// Markers and region ids are physical tags. Gmsh takes a negative physical tag for a reversed
// orientation, so a file with such tags changes when Gmsh itself saves it again.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "io/formats.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

constexpr int kLine = 1, kTriangle = 2, kTetrahedron = 4, kPoint = 15;

/// Marked vertices as elements: nodes have no tags of their own.
struct MarkedVertices {
  std::vector<std::array<Index, 1>> vertices;
  std::vector<int> markers;

  explicit MarkedVertices(const Volume& volume) {
    for (std::size_t i = 0; i < volume.vertex_markers.size(); ++i) {
      if (volume.vertex_markers[i] == 0) continue;
      vertices.push_back({static_cast<Index>(i)});
      markers.push_back(volume.vertex_markers[i]);
    }
  }
};

void write_point(AtomicWriter& out, const Point& p) { out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n'; }

template <std::size_t N>
void write_corners(AtomicWriter& out, const std::array<Index, N>& corners) {
  for (const Index corner : corners) out << ' ' << std::uint64_t{corner} + 1;
  out << '\n';
}

/// The elements of one dimension in version 2.2. An elementary tag cannot be negative.
template <std::size_t N>
void write_elements_2(AtomicWriter& out, int type, const std::vector<std::array<Index, N>>& elements,
                      const std::vector<int>& tags, std::uint64_t& number) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const int tag = tag_of(tags, i);
    const std::int64_t elementary =
        std::min<std::int64_t>(std::abs(std::int64_t{tag}), std::numeric_limits<int>::max());
    out << ++number << ' ' << type << " 2 " << tag << ' ' << elementary;
    write_corners(out, elements[i]);
  }
}

/// Elements of one dimension by entity: an entity, numbered from 1, for every tag that occurs.
class Entities {
 public:
  Entities(const std::vector<int>& tags, std::size_t elements) {
    if (elements == 0) return;
    tags_ = tags.empty() ? std::vector<int>{0} : tags;
    sort_unique(tags_);
    // Counting sort, so that each entity's elements keep their order.
    starts_.assign(tags_.size() + 1, 0);
    for (std::size_t i = 0; i < elements; ++i) ++starts_[entity_of(tag_of(tags, i)) + 1];
    for (std::size_t e = 0; e < tags_.size(); ++e) starts_[e + 1] += starts_[e];
    order_.resize(elements);
    std::vector<std::size_t> next = starts_;
    for (std::size_t i = 0; i < elements; ++i) order_[next[entity_of(tag_of(tags, i))]++] = i;
  }
  /// One entity without elements, for nodes to lie on.
  static Entities lone() {
    Entities entities({}, 0);
    entities.tags_ = {0};
    entities.starts_ = {0, 0};
    return entities;
  }

  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  [[nodiscard]] int tag(std::size_t entity) const { return tags_[entity]; }
  [[nodiscard]] std::span<const std::size_t> elements(std::size_t entity) const {
    return std::span(order_).subspan(starts_[entity], starts_[entity + 1] - starts_[entity]);
  }

 private:
  [[nodiscard]] std::size_t entity_of(int tag) const {
    return static_cast<std::size_t>(std::lower_bound(tags_.begin(), tags_.end(), tag) - tags_.begin());
  }
  std::vector<int> tags_;
  std::vector<std::size_t> starts_, order_;
};

/// Least and largest finite coordinates, "0 0 0 0 0 0" if there are none.
std::array<Point, 2> bounds(const std::vector<Point>& points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Point& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(point[axis])) continue;
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (low[axis] > high[axis]) low[axis] = high[axis] = 0;
  return {low, high};
}

void write_entities(AtomicWriter& out, const Entities& entities, const std::array<Point, 2>& box) {
  for (std::size_t e = 0; e < entities.size(); ++e) {
    out << std::uint64_t{e + 1};
    for (const Point& corner : box) out << ' ' << corner[0] << ' ' << corner[1] << ' ' << corner[2];
    out << " 1 " << entities.tag(e) << " 0\n";
  }
}

void write_point_entities(AtomicWriter& out, const Entities& entities, const MarkedVertices& marked,
                          const std::vector<Point>& points) {
  for (std::size_t e = 0; e < entities.size(); ++e) {
    const Point& p = points[marked.vertices[entities.elements(e)[0]][0]];
    out << std::uint64_t{e + 1} << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << " 1 " << entities.tag(e)
        << '\n';
  }
}

template <std::size_t N>
void write_blocks(AtomicWriter& out, const Entities& entities, int dimension, int type,
                  const std::vector<std::array<Index, N>>& elements, std::uint64_t& number) {
  for (std::size_t e = 0; e < entities.size(); ++e) {
    const std::span<const std::size_t> members = entities.elements(e);
    if (members.empty()) continue;
    out << dimension << ' ' << std::uint64_t{e + 1} << ' ' << type << ' ' << std::uint64_t{members.size()}
        << '\n';
    for (const std::size_t i : members) {
      out << ++number;
      write_corners(out, elements[i]);
    }
  }
}

/// All nodes in one block, so that they stand in the order of their indices.
void write_nodes_4(AtomicWriter& out, const std::vector<Point>& vertices, int dimension) {
  const std::uint64_t count = vertices.size();
  out << "$Nodes\n"
      << (count == 0 ? 0 : 1) << ' ' << count << ' ' << (count == 0 ? 0 : 1) << ' ' << count << '\n';
  if (count > 0) out << dimension << " 1 0 " << count << '\n';
  for (std::uint64_t i = 1; i <= count; ++i) out << i << '\n';
  for (const Point& point : vertices) write_point(out, point);
  out << "$EndNodes\n";
}

void write_msh_4(AtomicWriter& out, const Volume& volume) {
  const MarkedVertices marked(volume);
  const Entities points(marked.markers, marked.vertices.size());
  const Entities curves(volume.segment_markers, volume.segments.size());
  const Entities surfaces(volume.facet_markers, volume.facets.size());
  Entities volumes(volume.regions, volume.tetrahedra.size());
  if (curves.size() + surfaces.size() + volumes.size() == 0) volumes = Entities::lone();
  const std::array<Point, 2> box = bounds(volume.vertices);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n"
      << std::uint64_t{points.size()} << ' ' << std::uint64_t{curves.size()} << ' '
      << std::uint64_t{surfaces.size()} << ' ' << std::uint64_t{volumes.size()} << '\n';
  write_point_entities(out, points, marked, volume.vertices);
  write_entities(out, curves, box);
  write_entities(out, surfaces, box);
  write_entities(out, volumes, box);
  out << "$EndEntities\n";
  write_nodes_4(out, volume.vertices, volumes.size() > 0 ? 3 : surfaces.size() > 0 ? 2 : 1);
  const std::uint64_t elements =
      marked.vertices.size() + volume.tetrahedra.size() + volume.facets.size() + volume.segments.size();
  const std::uint64_t blocks =
      (volume.tetrahedra.empty() ? 0 : volumes.size()) + points.size() + curves.size() + surfaces.size();
  out << "$Elements\n"
      << blocks << ' ' << elements << ' ' << (elements == 0 ? 0 : 1) << ' ' << elements << '\n';
  std::uint64_t number = 0;
  write_blocks(out, points, 0, kPoint, marked.vertices, number);
  write_blocks(out, curves, 1, kLine, volume.segments, number);
  write_blocks(out, surfaces, 2, kTriangle, volume.facets, number);
  write_blocks(out, volumes, 3, kTetrahedron, volume.tetrahedra, number);
  out << "$EndElements\n";
}

void write_msh_2(AtomicWriter& out, const Volume& volume) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << std::uint64_t{volume.vertices.size()} << '\n';
  for (std::size_t i = 0; i < volume.vertices.size(); ++i) {
    out << std::uint64_t{i + 1} << ' ';
    write_point(out, volume.vertices[i]);
  }
  const MarkedVertices marked(volume);
  out << "$EndNodes\n$Elements\n"
      << std::uint64_t{marked.vertices.size() + volume.tetrahedra.size() + volume.facets.size() +
                       volume.segments.size()}
      << '\n';
  std::uint64_t number = 0;
  write_elements_2(out, kPoint, marked.vertices, marked.markers, number);
  write_elements_2(out, kLine, volume.segments, volume.segment_markers, number);
  write_elements_2(out, kTriangle, volume.facets, volume.facet_markers, number);
  write_elements_2(out, kTetrahedron, volume.tetrahedra, volume.regions, number);
  out << "$EndElements\n";
}

}  // namespace

void write_msh(AtomicWriter& out, const Volume& volume, const WriteOptions& options) {
  if (options.legacy_msh)
    write_msh_2(out, volume);
  else
    write_msh_4(out, volume);
}

}  // namespace holdfast::io
