// Writes Gmsh's .msh, versions 4.1 and 2.2, ASCII and binary (Gmsh reference manual, "File formats").
//
// Markers and region ids are physical tags, each group with a name. Ids below 1 get other numbers, because
// for Gmsh 0 means no group and a negative tag a reversed orientation. Each group is an entity; entity tags
// are unique over all dimensions, because some readers identify groups by them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"
#include "io/msh_out.h"

namespace holdfast::io {
namespace {

/// The entities of one dimension: their groups and access to their nodes.
struct Dimension {
  int number;
  int type;
  Labels labels;
  std::vector<Index> vertices;  ///< in dimension 0: the marked ones
};

struct MshData {
  const Volume& volume;
  std::array<Dimension, 4> dimensions;

  explicit MshData(const Volume& of) : volume(of) {
    const bool second = is_second_order(of);
    std::vector<int> markers;
    std::vector<Index> marked;
    for (std::size_t i = 0; i < of.vertex_markers.size(); ++i) {
      if (of.vertex_markers[i] == 0) continue;
      marked.push_back(static_cast<Index>(i));
      markers.push_back(of.vertex_markers[i]);
    }
    const Names& names = of.names;
    dimensions = {
        Dimension{0, kMshPoint, labels_of(kVertexStem, markers, markers.size(), names.vertices, kMshNames),
                  std::move(marked)},
        Dimension{1,
                  second ? kMshLine3 : kMshLine,
                  labels_of(kSegmentStem, of.segment_markers, of.segments.size(), names.segments, kMshNames),
                  {}},
        Dimension{2,
                  second ? kMshTriangle6 : kMshTriangle,
                  labels_of(kFacetStem, of.facet_markers, of.facets.size(), names.facets, kMshNames),
                  {}},
        Dimension{3,
                  second ? kMshTetrahedron10 : kMshTetrahedron,
                  labels_of(kRegionStem, of.regions, of.tetrahedra.size(), names.regions, kMshNames),
                  {}}};
  }

  [[nodiscard]] Nodes nodes(const Dimension& dimension, std::size_t i) const {
    switch (dimension.number) {
      case 0:
        return {{dimension.vertices[i]}, 1};
      case 1:
        return segment_nodes(volume, i);
      case 2:
        return facet_nodes(volume, i);
      default:
        return tetrahedron_nodes(volume, i, kGmshEdges);
    }
  }
  [[nodiscard]] std::uint64_t elements() const {
    std::uint64_t count = 0;
    for (const Dimension& dimension : dimensions) count += dimension.labels.ids.size();
    return count;
  }
};

void write_head(MshOut& to, std::string_view version, const MshData& data) {
  write_msh_head(to, version,
                 {&data.dimensions[0].labels, &data.dimensions[1].labels, &data.dimensions[2].labels,
                  &data.dimensions[3].labels});
}

/// The least and largest finite coordinates, all 0 if there are none.
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

/// The entity tag of each group, unique over all dimensions. It equals the group's own tag if that is free,
/// because GetFEM takes entity tags for group tags.
using EntityTags = std::array<std::map<int, int>, 4>;

EntityTags entity_tags(const MshData& data) {
  EntityTags tags;
  std::set<int> used;
  for (std::size_t d = 4; d-- > 0;)
    for (const auto& [id, name] : data.dimensions[d].labels.names)
      tags[d][id] = used.insert(id).second ? id : 0;
  int next = 1;
  for (auto& of : tags)
    for (auto& [id, tag] : of) {
      if (tag != 0) continue;
      while (!used.insert(next).second) ++next;
      tag = next;
    }
  return tags;
}

/// The entity of all nodes; an empty volume if there is none.
std::pair<int, int> home_of_nodes(const EntityTags& tags) {
  for (const int d : {3, 2, 1})
    if (const auto& of = tags[static_cast<std::size_t>(d)]; !of.empty()) return {d, of.begin()->second};
  std::set<int> used;
  for (const auto& [id, tag] : tags[0]) used.insert(tag);
  int lone = 1;
  while (used.contains(lone)) ++lone;
  return {3, lone};
}

void write_entities(MshOut& to, const MshData& data, const EntityTags& tags, std::pair<int, int> home) {
  const bool lone = home.first == 3 && tags[3].empty();
  const std::array<Point, 2> box = bounds(data.volume.vertices);
  to.out() << "$Entities\n";
  for (std::size_t d = 0; d < 4; ++d) to.size(tags[d].size() + (d == 3 && lone ? 1 : 0));
  to.end_line();
  const Dimension& points = data.dimensions[0];
  std::map<int, Index> first;
  for (std::size_t i = 0; i < points.vertices.size(); ++i)
    first.try_emplace(points.labels.ids[i], points.vertices[i]);
  for (std::size_t d = 0; d < 4; ++d)
    for (const auto& [id, tag] : tags[d]) {
      to.integer(tag);
      if (d == 0)
        to.point(data.volume.vertices[first[id]]);
      else
        to.point(box[0]).point(box[1]);
      to.size(1).integer(id);
      if (d > 0) to.size(0);
      to.end_line();
    }
  if (lone) {
    to.integer(home.second).point(box[0]).point(box[1]).size(0).size(0);
    to.end_line();
  }
  to.end_section("$EndEntities");
}

/// Writes all nodes in one block, in the order of their indices.
void write_nodes_4(MshOut& to, const Volume& volume, std::pair<int, int> home) {
  const std::uint64_t count = node_count(volume);
  to.out() << "$Nodes\n";
  to.size(count == 0 ? 0 : 1).size(count).size(count == 0 ? 0 : 1).size(count);
  to.end_line();
  if (count > 0) {
    to.integer(home.first).integer(home.second).integer(0).size(count);
    to.end_line();
  }
  for (std::uint64_t i = 1; i <= count; ++i) {
    to.size(i);
    to.end_line();
  }
  for (std::size_t i = 0; i < count; ++i) {
    beat(to.out().watch());
    to.point(node(volume, i));
    to.end_line();
  }
  to.end_section("$EndNodes");
}

void write_elements_4(MshOut& to, const MshData& data, const EntityTags& tags) {
  std::uint64_t blocks = 0, number = 0;
  for (const auto& of : tags) blocks += of.size();
  const std::uint64_t elements = data.elements();
  to.out() << "$Elements\n";
  to.size(blocks).size(elements).size(elements == 0 ? 0 : 1).size(elements);
  to.end_line();
  for (std::size_t d = 0; d < 4; ++d) {
    const Dimension& dimension = data.dimensions[d];
    for (const auto& [id, members] : dimension.labels.sets()) {
      to.integer(dimension.number).integer(tags[d].at(id)).integer(dimension.type).size(members.size());
      to.end_line();
      for (const std::size_t i : members) {
        beat(to.out().watch());
        to.size(++number);
        for (const Index v : data.nodes(dimension, i)) to.size(std::uint64_t{v} + 1);
        to.end_line();
      }
    }
  }
  to.end_section("$EndElements");
}

void write_msh_4(MshOut& to, const MshData& data) {
  write_head(to, "4.1", data);
  const EntityTags tags = entity_tags(data);
  const std::pair<int, int> home = home_of_nodes(tags);
  write_entities(to, data, tags, home);
  write_nodes_4(to, data.volume, home);
  write_elements_4(to, data, tags);
}

void write_msh_2(MshOut& to, const MshData& data) {
  write_head(to, "2.2", data);
  const std::uint64_t count = node_count(data.volume);
  to.out() << "$Nodes\n" << count << '\n';
  for (std::size_t i = 0; i < count; ++i) {
    beat(to.out().watch());
    to.integer(static_cast<std::int64_t>(i) + 1).point(node(data.volume, i));
    to.end_line();
  }
  to.end_section("$EndNodes");
  to.out() << "$Elements\n" << data.elements() << '\n';
  const EntityTags tags = entity_tags(data);
  std::int64_t number = 0;
  for (std::size_t d = 0; d < 4; ++d) {
    const Dimension& dimension = data.dimensions[d];
    const std::vector<int>& ids = dimension.labels.ids;
    if (to.binary() && !ids.empty())
      to.integer(dimension.type).integer(static_cast<std::int64_t>(ids.size())).integer(2);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      beat(to.out().watch());
      to.integer(++number);
      if (!to.binary()) to.integer(dimension.type).integer(2);
      to.integer(ids[i]).integer(tags[d].at(ids[i]));
      for (const Index v : data.nodes(dimension, i)) to.integer(std::int64_t{v} + 1);
      to.end_line();
    }
  }
  to.end_section("$EndElements");
}

}  // namespace

void write_msh_head(MshOut& to, std::string_view version, const std::array<const Labels*, 4>& labels) {
  to.out() << "$MeshFormat\n" << version << (to.binary() ? " 1 8\n" : " 0 8\n");
  if (to.binary()) {
    to.integer(1);
    to.out() << '\n';
  }
  to.out() << "$EndMeshFormat\n";
  std::uint64_t groups = 0;
  for (const Labels* of : labels) groups += of->names.size();
  if (groups == 0) return;
  to.out() << "$PhysicalNames\n" << groups << '\n';
  for (std::size_t dimension = 0; dimension < labels.size(); ++dimension)
    for (const auto& [id, name] : labels[dimension]->names)
      to.out() << std::uint64_t{dimension} << ' ' << id << " \"" << name << "\"\n";
  to.out() << "$EndPhysicalNames\n";
}

void write_msh(AtomicWriter& out, const Volume& volume, const WriteOptions& options) {
  MshOut to(out, options.binary);
  const MshData data(volume);
  if (options.legacy_msh)
    write_msh_2(to, data);
  else
    write_msh_4(to, data);
}

std::vector<Remark> not_in_msh(const Volume& volume, const WriteOptions& options) {
  std::vector<Remark> remarks;
  for (const Dimension& dimension : MshData(volume).dimensions) tell(dimension.labels, ".msh", remarks);
  const auto descends = [](const std::vector<int>& ids) { return !std::is_sorted(ids.begin(), ids.end()); };
  if (!options.legacy_msh &&
      (descends(volume.regions) || descends(volume.facet_markers) || descends(volume.segment_markers)))
    remarks.push_back(
        {RemarkKind::not_held, volume.tetrahedra.size() + volume.facets.size() + volume.segments.size(),
         "version 4.1 of .msh groups tetrahedra, triangles and lines by their ids, so that they stand in "
         "another order; version 2.2 and other formats keep it"});
  return remarks;
}

}  // namespace holdfast::io
