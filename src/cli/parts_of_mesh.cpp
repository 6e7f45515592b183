#include "parts_of_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "command.h"
#include "holdfast/statistics.h"

namespace holdfast::cli {
namespace {

Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

template <typename T>
void keep(std::vector<T>& values, const std::vector<bool>& stays) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < stays.size(); ++i)
    if (stays[i]) values[kept++] = values[i];
  values.resize(kept);
}

/// Keeps the entities for which `stays` is true, with their tags and mid-edge nodes.
template <typename Entity, typename Nodes, typename Stays>
void keep(std::vector<Entity>& entities, std::vector<int>& tags, std::vector<Nodes>& nodes, Stays&& says) {
  std::vector<bool> stays(entities.size());
  for (std::size_t i = 0; i < stays.size(); ++i) stays[i] = says(i);
  keep(entities, stays);
  keep(tags, stays);
  keep(nodes, stays);
}

/// Drops unused mid-edge nodes; the others are numbered after `vertices` vertices instead of `before`.
void renumber_mid_nodes(MidNodes& mid, std::size_t before, std::size_t vertices) {
  std::vector<Index> now(mid.points.size(), no_entity);
  const auto for_each = [&](auto&& visit) {
    for (auto& nodes : mid.tetrahedra)
      for (Index& node : nodes) visit(node);
    for (auto& nodes : mid.facets)
      for (Index& node : nodes) visit(node);
    for (Index& node : mid.segments) visit(node);
  };
  for_each([&](Index& node) { now[node - before] = 0; });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (now[n] == no_entity) continue;
    mid.points[kept] = mid.points[n];
    now[n] = static_cast<Index>(vertices + kept++);
  }
  mid.points.resize(kept);
  for_each([&](Index& node) { node = now[node - before]; });
}

void drop_unused_vertices(Volume& volume) {
  std::vector<Index> now(volume.vertices.size(), no_entity);
  const auto use = [&](const auto& entities) {
    for (const auto& entity : entities)
      for (const Index v : entity) now[v] = 0;
  };
  use(volume.tetrahedra);
  use(volume.facets);
  use(volume.segments);
  Index kept = 0;
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (now[v] == no_entity) continue;
    volume.vertices[kept] = volume.vertices[v];
    if (!volume.vertex_markers.empty()) volume.vertex_markers[kept] = volume.vertex_markers[v];
    now[v] = kept++;
  }
  renumber_mid_nodes(volume.mid_nodes, now.size(), kept);
  volume.vertices.resize(kept);
  if (!volume.vertex_markers.empty()) volume.vertex_markers.resize(kept);
  volume.input_vertices.clear();
  const auto renumber = [&](auto& entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = now[v];
  };
  renumber(volume.tetrahedra);
  renumber(volume.facets);
  renumber(volume.segments);
}

/// For each facet, how many tetrahedra have it as a face, and how many of these see it oriented inwards.
struct SidesOfFacets {
  std::vector<int> count, inward;

  explicit SidesOfFacets(const Volume& volume)
      : count(volume.facets.size(), 0), inward(volume.facets.size(), 0) {
    std::map<Triangle, Index> listed;
    for (Index f = 0; f < volume.facets.size(); ++f) listed.emplace(ascending(volume.facets[f]), f);
    const auto turns_as = [](const Triangle& a, const Triangle& b) {
      for (std::size_t k = 0; k < 3; ++k)
        if (a[0] == b[k]) return a[1] == b[(k + 1) % 3];
      return false;
    };
    for (const Tetrahedron& t : volume.tetrahedra)
      for (const Triangle& face : {Triangle{t[1], t[2], t[3]}, Triangle{t[0], t[3], t[2]},
                                   Triangle{t[0], t[1], t[3]}, Triangle{t[0], t[2], t[1]}}) {
        const auto found = listed.find(ascending(face));
        if (found == listed.end()) continue;
        ++count[found->second];
        if (!turns_as(face, volume.facets[found->second])) ++inward[found->second];
      }
  }
};

/// Orients facets with a tetrahedron on one side only to face outwards: an interface that faces into a region
/// becomes its boundary when the other region is dropped.
void turn_outward(Volume& volume) {
  const SidesOfFacets sides(volume);
  for (std::size_t f = 0; f < volume.facets.size(); ++f) {
    if (sides.count[f] != 1 || sides.inward[f] != 1) continue;
    std::swap(volume.facets[f][1], volume.facets[f][2]);
    if (!volume.mid_nodes.facets.empty())  // nodes of the edges 01 12 02
      std::swap(volume.mid_nodes.facets[f][0], volume.mid_nodes.facets[f][2]);
  }
}

/// The first few regions, with their names.
std::string listed(const std::set<int>& regions, const Names& names) {
  constexpr std::size_t kMost = 10;
  std::string list;
  std::size_t count = 0;
  for (const int id : regions) {
    if (count++ == kMost) return list + fmt::format(" and {} more", regions.size() - kMost);
    const auto name = names.regions.find(id);
    list += (list.empty() ? "" : ", ") + std::to_string(id);
    if (name != names.regions.end()) list += fmt::format(" ({})", name->second);
  }
  return list;
}

void take_regions(Volume& volume, const std::vector<std::string>& regions) {
  std::set<int> ids;
  const std::set<int> present(volume.regions.begin(), volume.regions.end());
  for (const std::string& region : regions) {
    const std::vector<int> named = region_ids(region, volume.names);
    const bool found = std::any_of(named.begin(), named.end(), [&](int id) { return present.count(id) > 0; });
    if (!found)
      throw UsageError(fmt::format("--only region={}: there is no such region; its regions are {}", region,
                                   listed(present, volume.names)));
    ids.insert(named.begin(), named.end());
  }
  const std::vector<int> region_of = volume.regions;
  keep(volume.tetrahedra, volume.regions, volume.mid_nodes.tetrahedra,
       [&](std::size_t t) { return ids.count(region_of[t]) > 0; });
  std::vector<Triangle> faces;
  std::vector<Segment> edges;
  for (const Tetrahedron& t : volume.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i) {
      faces.push_back(ascending({t[i], t[(i + 1) % 4], t[(i + 2) % 4]}));
      for (std::size_t j = i + 1; j < 4; ++j) edges.push_back({std::min(t[i], t[j]), std::max(t[i], t[j])});
    }
  std::sort(faces.begin(), faces.end());
  std::sort(edges.begin(), edges.end());
  keep(volume.facets, volume.facet_markers, volume.mid_nodes.facets, [&](std::size_t f) {
    return std::binary_search(faces.begin(), faces.end(), ascending(volume.facets[f]));
  });
  turn_outward(volume);
  keep(volume.segments, volume.segment_markers, volume.mid_nodes.segments, [&](std::size_t s) {
    const auto [a, b] = volume.segments[s];
    return std::binary_search(edges.begin(), edges.end(), Segment{std::min(a, b), std::max(a, b)});
  });
  std::erase_if(volume.names.regions, [&](const auto& name) { return ids.count(name.first) == 0; });
}

}  // namespace

Part part_of(const std::vector<std::string>& only) {
  constexpr std::string_view region = "region=";
  Part part;
  for (const std::string& text : only) {
    const Part::Kind kind = text == "volume"                                          ? Part::Kind::volume
                            : text == "surface"                                       ? Part::Kind::surface
                            : text.starts_with(region) && text.size() > region.size() ? Part::Kind::regions
                                                                                      : Part::Kind::all;
    if (kind == Part::Kind::all)
      throw UsageError("--only " + text + ": volume, surface, region=ID or region=NAME is expected");
    if (part.kind != Part::Kind::all && (part.kind != kind || kind != Part::Kind::regions))
      throw UsageError("--only " + text + ": only regions can be named together");
    part.kind = kind;
    if (kind == Part::Kind::regions) part.regions.push_back(text.substr(region.size()));
  }
  return part;
}

std::vector<int> region_ids(std::string text, const Names& names) {
  constexpr std::string_view prefix = "region:";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  int id = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error == std::errc() && stop == text.data() + text.size()) return {id};
  std::vector<int> ids;
  for (const auto& [named, name] : names.regions)
    if (name == text) ids.push_back(named);
  return ids;
}

void take_part(AnyMesh& mesh, const Part& part) {
  if (part.kind == Part::Kind::all) return;
  if (!mesh.is_volume) {
    if (part.kind == Part::Kind::surface) return;
    throw UsageError("--only: the file holds no tetrahedra, but a surface");
  }
  if (part.kind == Part::Kind::surface) {
    mesh.surface = surface_of(mesh.volume);
    mesh.is_volume = false;
    return;
  }
  Volume& volume = mesh.volume;
  if (part.kind == Part::Kind::regions) {
    take_regions(volume, part.regions);
  } else {
    volume.facets.clear();
    volume.facet_markers.clear();
    volume.segments.clear();
    volume.segment_markers.clear();
    volume.mid_nodes.facets.clear();
    volume.mid_nodes.segments.clear();
    volume.names.facets.clear();
    volume.names.segments.clear();
  }
  drop_unused_vertices(volume);
}

void drop_interfaces(Volume& volume) {
  const SidesOfFacets sides(volume);
  keep(volume.facets, volume.facet_markers, volume.mid_nodes.facets,
       [&](std::size_t f) { return sides.count[f] < 2; });
}

std::size_t scale(AnyMesh& mesh, double factor) {
  const auto multiply = [&](std::vector<Point>& points) {
    for (Point& p : points)
      for (double& x : p) {
        if (std::isfinite(x) && !std::isfinite(x * factor))
          throw UsageError(
              fmt::format("--scale {}: the coordinate {} becomes too large for a double", factor, x));
        x *= factor;
      }
  };
  if (!mesh.is_volume) {
    multiply(mesh.surface.vertices);
    multiply(mesh.surface.holes);
    for (Surface::RegionSeed& seed : mesh.surface.regions) {
      for (double& x : seed.where) x *= factor;
      seed.size *= factor;
      seed.max_volume *= factor * factor * factor;
    }
    return 0;
  }
  const auto bad = [&] {
    const Statistics counts = statistics(mesh.volume);
    return counts.negative + counts.null;
  };
  int exponent = 0;
  const auto underflows = [&](const Point& p) {
    return std::any_of(p.begin(), p.end(), [&](double x) {
      return x != 0 && std::abs(x * factor) < std::numeric_limits<double>::min();
    });
  };
  const std::vector<Point>& vertices = mesh.volume.vertices;
  const bool rounds =
      std::frexp(factor, &exponent) != 0.5 || std::any_of(vertices.begin(), vertices.end(), underflows);
  const std::size_t before = rounds ? bad() : 0;
  multiply(mesh.volume.vertices);
  multiply(mesh.volume.mid_nodes.points);
  const std::size_t after = rounds ? bad() : 0;
  return after > before ? after - before : 0;
}

}  // namespace holdfast::cli
