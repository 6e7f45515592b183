// Writes pieces as Gmsh's .msh 4.1 with $PartitionedEntities and $GhostElements (Gmsh reference manual, "MSH
// file format"): one file, in which each part of a group is an entity, and so are the faces between each two
// parts.
//
// Nodes have the numbers of the whole, from 1. The elements are points, lines, triangles on facets, triangles
// between parts, and tetrahedra, numbered as in the whole but after all other elements. Parts are numbered
// from 1.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"
#include "io/msh_out.h"
#include "io/pieces.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

/// Identifies the elements of an entity: the group, and one part, or two for faces between parts.
struct EntityKey {
  int dimension;
  bool between;  ///< faces between parts on no facet; then `id` is 0
  int id;        ///< marker or region
  Index part, other = no_entity;
  friend auto operator<=>(const EntityKey&, const EntityKey&) = default;
};

/// An element of an entity, with nodes of the piece.
struct PieceElement {
  EntityKey entity;
  std::array<Index, 4> nodes;
  std::size_t count;
  Index tetrahedron = no_entity;  ///< in the piece
};

/// What piece k adds to the file, by entity. No earlier piece adds the same.
std::vector<PieceElement> elements_of(const MeshPiece& piece, Index k) {
  std::vector<PieceElement> elements;
  const Volume& volume = piece.volume;
  const auto add = [&](const EntityKey& entity, const auto& nodes, Index tetrahedron = no_entity) {
    PieceElement element{entity, {}, nodes.size(), tetrahedron};
    std::copy(nodes.begin(), nodes.end(), element.nodes.begin());
    elements.push_back(element);
  };
  for (Index v = 0; v < piece.own_vertices && v < volume.vertex_markers.size(); ++v)
    if (volume.vertex_markers[v] != 0 && piece.vertex_owners[v] == k)
      add({0, false, volume.vertex_markers[v], k}, std::array<Index, 1>{v});
  for (std::size_t i = 0; i < volume.segments.size(); ++i)
    if (piece.segment_owners[i] == k)
      add({1, false, tag_of(volume.segment_markers, i), k}, volume.segments[i]);
  std::map<Triangle, Index> others;
  for (const MeshPiece::Interface& interface : piece.interfaces)
    for (const Triangle& face : interface.faces) others[ascending(face)] = interface.other;
  std::set<Triangle> on_facets;
  for (std::size_t i = 0; i < volume.facets.size(); ++i) {
    const Triangle key = ascending(volume.facets[i]);
    on_facets.insert(key);
    if (piece.facet_owners[i] != k) continue;
    const auto found = others.find(key);
    add({2, false, tag_of(volume.facet_markers, i), k, found == others.end() ? no_entity : found->second},
        volume.facets[i]);
  }
  for (const MeshPiece::Interface& interface : piece.interfaces)
    for (const Triangle& face : interface.faces)
      if (interface.other > k && !on_facets.contains(ascending(face)))
        add({2, true, 0, k, interface.other}, face);
  for (Index t = 0; t < piece.own_tetrahedra; ++t)
    add({3, false, tag_of(volume.regions, t), k}, volume.tetrahedra[t], t);
  std::stable_sort(elements.begin(), elements.end(),
                   [](const PieceElement& a, const PieceElement& b) { return a.entity < b.entity; });
  return elements;
}

/// The contents of the file's header, gathered in a pass over the pieces.
class Survey {
 public:
  Survey(std::size_t parts, const PieceLoader& load, Watch& watch) {
    for (std::size_t k = 0; k < parts; ++k) {
      const MeshPiece piece = load(k);
      watch.step();
      for (const PieceElement& element : elements_of(piece, static_cast<Index>(k))) {
        ++counts[element.entity];
        ++elements;
        if (element.entity.dimension == 3) ++tetrahedra;
        if (!element.entity.between)
          ids_[static_cast<std::size_t>(element.entity.dimension)].insert(element.entity.id);
      }
      std::uint64_t own = 0;
      for (std::size_t v = 0; v < piece.own_vertices; ++v) {
        if (piece.vertex_owners[v] != k) continue;
        ++own;
        highest_node = std::max(highest_node, piece.vertices[v] + 1);
        extend(piece.volume.vertices[v]);
      }
      nodes_of_part.push_back(own);
      nodes += own;
      for (std::size_t t = piece.own_tetrahedra; t < piece.tetrahedra.size(); ++t)
        ghosts.push_back({piece.tetrahedra[t], piece.owners[t], static_cast<Index>(k)});
      highest_tetrahedron = std::max(
          highest_tetrahedron, piece.tetrahedra.empty() ? 0 : piece.tetrahedra[piece.own_tetrahedra - 1]);
      names_ = piece.volume.names;
    }
    std::sort(ghosts.begin(), ghosts.end());
    name_groups();
    give_tags(parts);
  }

  struct Ghost {
    std::uint64_t tetrahedron;
    Index owner, ghost_in;
    friend auto operator<=>(const Ghost&, const Ghost&) = default;
  };

  [[nodiscard]] int id_in_file(const EntityKey& key) const {
    return file_ids_[static_cast<std::size_t>(key.dimension)].at(key.id);
  }
  /// Tetrahedra are numbered after all other elements.
  [[nodiscard]] std::uint64_t number(std::uint64_t tetrahedron) const {
    return elements - tetrahedra + tetrahedron + 1;
  }

  std::map<EntityKey, std::uint64_t> counts;  ///< elements of each entity
  std::map<EntityKey, int> tags;
  std::array<std::map<int, int>, 4> parents;  ///< by dimension, then by id in the file
  std::vector<int> ghost_tags;                ///< by part
  std::array<Labels, 4> labels;
  std::vector<std::uint64_t> nodes_of_part;
  std::vector<Ghost> ghosts;
  std::uint64_t nodes = 0, elements = 0, tetrahedra = 0, highest_node = 0, highest_tetrahedron = 0;
  Point low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

 private:
  void extend(const Point& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(p[axis])) continue;
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }

  void name_groups() {
    const std::array<std::string_view, 4> stems{kVertexStem, kSegmentStem, kFacetStem, kRegionStem};
    const std::array<const std::map<int, std::string>*, 4> names{&names_.vertices, &names_.segments,
                                                                 &names_.facets, &names_.regions};
    for (std::size_t d = 0; d < 4; ++d) {
      const std::vector<int> ids(ids_[d].begin(), ids_[d].end());
      labels[d] = labels_of(stems[d], ids, ids.size(), *names[d], kMshNames);
      for (std::size_t i = 0; i < ids.size(); ++i) file_ids_[d][ids[i]] = labels[d].ids[i];
    }
  }

  /// Parents come first. Tags are unique over all dimensions.
  void give_tags(std::size_t parts) {
    int next = 1;
    for (std::size_t d = 0; d < 4; ++d)
      for (const auto& [id, name] : labels[d].names) parents[d][id] = next++;
    for (const auto& [key, count] : counts) tags[key] = next++;
    for (std::size_t k = 0; k < parts; ++k) ghost_tags.push_back(next++);
  }

  std::array<std::set<int>, 4> ids_;
  std::array<std::map<int, int>, 4> file_ids_;
  Names names_;
};

void write_box(MshOut& to, const Survey& survey, int dimension) {
  to.point(survey.low);
  if (dimension > 0) to.point(survey.high);
}

void write_parents(MshOut& to, const Survey& survey) {
  to.out() << "$Entities\n";
  for (const auto& of : survey.parents) to.size(of.size());
  to.end_line();
  for (int d = 0; d < 4; ++d)
    for (const auto& [id, tag] : survey.parents[static_cast<std::size_t>(d)]) {
      to.integer(tag);
      write_box(to, survey, d);
      to.size(1).integer(id);
      if (d > 0) to.size(0);
      to.end_line();
    }
  to.end_section("$EndEntities");
}

void write_partitioned(MshOut& to, const Survey& survey, std::size_t parts) {
  to.out() << "$PartitionedEntities\n";
  to.size(parts);
  to.end_line();
  to.size(survey.ghost_tags.size());
  to.end_line();
  for (std::size_t k = 0; k < parts; ++k) {
    to.integer(survey.ghost_tags[k]).integer(static_cast<std::int64_t>(k) + 1);
    to.end_line();
  }
  std::array<std::uint64_t, 4> sizes{};
  for (const auto& [key, tag] : survey.tags) ++sizes[static_cast<std::size_t>(key.dimension)];
  for (const std::uint64_t size : sizes) to.size(size);
  to.end_line();
  const int first_volume = survey.parents[3].empty() ? 0 : survey.parents[3].begin()->second;
  for (const auto& [key, tag] : survey.tags) {
    to.integer(tag);
    if (key.between)
      to.integer(3).integer(first_volume);
    else
      to.integer(key.dimension)
          .integer(survey.parents[static_cast<std::size_t>(key.dimension)].at(survey.id_in_file(key)));
    const bool two = key.other != no_entity;
    to.size(two ? 2 : 1).integer(std::int64_t{key.part} + 1);
    if (two) to.integer(std::int64_t{key.other} + 1);
    write_box(to, survey, key.dimension);
    to.size(key.between ? 0 : 1);
    if (!key.between) to.integer(survey.id_in_file(key));
    if (key.dimension > 0) to.size(0);
    to.end_line();
  }
  to.end_section("$EndPartitionedEntities");
}

/// Nodes belong to a volume of the lowest part that has them.
void write_nodes(MshOut& to, const Survey& survey, std::size_t parts, const PieceLoader& load) {
  const auto blocks = static_cast<std::uint64_t>(
      std::count_if(survey.nodes_of_part.begin(), survey.nodes_of_part.end(), [](auto n) { return n > 0; }));
  to.out() << "$Nodes\n";
  to.size(blocks).size(survey.nodes).size(survey.nodes == 0 ? 0 : 1).size(survey.highest_node);
  to.end_line();
  for (std::size_t k = 0; k < parts; ++k) {
    if (survey.nodes_of_part[k] == 0) continue;
    const MeshPiece piece = load(k);
    const auto entity =
        survey.tags.lower_bound(EntityKey{3, false, tag_of(piece.volume.regions, 0), static_cast<Index>(k)});
    to.integer(3).integer(entity->second).integer(0).size(survey.nodes_of_part[k]);
    to.end_line();
    const auto for_each = [&](auto&& visit) {
      for (std::size_t v = 0; v < piece.own_vertices; ++v) {
        beat(to.out().watch());
        if (piece.vertex_owners[v] == k) visit(v);
      }
    };
    for_each([&](std::size_t v) {
      to.size(piece.vertices[v] + 1);
      to.end_line();
    });
    for_each([&](std::size_t v) {
      to.point(piece.volume.vertices[v]);
      to.end_line();
    });
  }
  to.end_section("$EndNodes");
}

void write_elements(MshOut& to, const Survey& survey, std::size_t parts, const PieceLoader& load) {
  constexpr std::array kTypes{kMshPoint, kMshLine, kMshTriangle, kMshTetrahedron};
  to.out() << "$Elements\n";
  to.size(survey.counts.size())
      .size(survey.elements)
      .size(survey.elements == 0 ? 0 : 1)
      .size(survey.number(survey.highest_tetrahedron));
  to.end_line();
  std::uint64_t next = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPiece piece = load(k);
    const std::vector<PieceElement> elements = elements_of(piece, static_cast<Index>(k));
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const PieceElement& element = elements[i];
      beat(to.out().watch());
      if (i == 0 || elements[i - 1].entity != element.entity) {
        const int d = element.entity.dimension;
        to.integer(d).integer(survey.tags.at(element.entity)).integer(kTypes[static_cast<std::size_t>(d)]);
        to.size(survey.counts.at(element.entity));
        to.end_line();
      }
      to.size(element.tetrahedron == no_entity ? ++next
                                               : survey.number(piece.tetrahedra[element.tetrahedron]));
      for (std::size_t v = 0; v < element.count; ++v) to.size(piece.vertices[element.nodes[v]] + 1);
      to.end_line();
    }
  }
  to.end_section("$EndElements");
}

/// Writes each tetrahedron that is a ghost somewhere, its part, and the parts that have it as a ghost.
void write_ghosts(MshOut& to, const Survey& survey) {
  const auto same = [](const Survey::Ghost& a, const Survey::Ghost& b) {
    return a.tetrahedron == b.tetrahedron;
  };
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < survey.ghosts.size(); ++i)
    if (i == 0 || !same(survey.ghosts[i - 1], survey.ghosts[i])) ++count;
  to.out() << "$GhostElements\n";
  to.size(count);
  to.end_line();
  for (std::size_t i = 0, j = 0; i < survey.ghosts.size(); i = j) {
    for (j = i; j < survey.ghosts.size() && same(survey.ghosts[i], survey.ghosts[j]);) ++j;
    to.size(survey.number(survey.ghosts[i].tetrahedron)).integer(std::int64_t{survey.ghosts[i].owner} + 1);
    to.size(j - i);
    for (std::size_t k = i; k < j; ++k) to.integer(std::int64_t{survey.ghosts[k].ghost_in} + 1);
    to.end_line();
  }
  to.end_section("$EndGhostElements");
}

}  // namespace

void write_msh_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                      const WriteOptions& options, Watch& watch) {
  const Survey survey(parts, load, watch);
  AtomicWriter out(path, &watch);
  MshOut to(out, options.binary);
  write_msh_head(to, "4.1", {&survey.labels[0], &survey.labels[1], &survey.labels[2], &survey.labels[3]});
  write_parents(to, survey);
  write_partitioned(to, survey, parts);
  write_nodes(to, survey, parts, load);
  write_elements(to, survey, parts, load);
  write_ghosts(to, survey);
  out.commit();
}

}  // namespace holdfast::io
