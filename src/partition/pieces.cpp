// The pieces of a volume that is in memory: tetrahedra by part, the ghosts around them, the faces between.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <unordered_map>

#include "holdfast/holdfast.h"
#include "holdfast/partition.h"
#include "io/mesh_sets.h"
#include "partition/interfaces.h"
#include "second_order/edge_numbers.h"

namespace holdfast {
namespace partitions {
namespace {

/// The parts that have each of many entities. Few have more than one.
class PartsOf {
 public:
  explicit PartsOf(std::size_t entities) : least_(entities, no_entity) {}
  void add(std::size_t entity, Index part) {
    Index& least = least_[entity];
    if (least == part) return;
    if (least == no_entity) {
      least = part;
      return;
    }
    std::vector<Index>& more = more_[entity];
    if (part < least) std::swap(part, least);
    if (std::find(more.begin(), more.end(), part) == more.end()) more.push_back(part);
  }
  [[nodiscard]] bool has(std::size_t entity, Index part) const {
    if (least_[entity] == part) return true;
    const auto found = more_.find(entity);
    return found != more_.end() &&
           std::find(found->second.begin(), found->second.end(), part) != found->second.end();
  }
  [[nodiscard]] bool has_none(std::size_t entity) const { return least_[entity] == no_entity; }
  [[nodiscard]] bool shared(std::size_t entity) const { return more_.contains(entity); }
  /// The lowest part; 0 for entities in no part.
  [[nodiscard]] Index owner(std::size_t entity) const { return has_none(entity) ? 0 : least_[entity]; }
  [[nodiscard]] bool in_piece(std::size_t entity, Index part) const {
    return has(entity, part) || (part == 0 && has_none(entity));
  }

 private:
  std::vector<Index> least_;
  std::unordered_map<std::size_t, std::vector<Index>> more_;
};

class Pieces {
 public:
  Pieces(const Volume& volume, std::vector<Index> part_of, std::size_t parts)
      : volume_(volume),
        part_of_(std::move(part_of)),
        beside_(neighbours(volume.tetrahedra)),
        parts_of_facet_(volume.facets.size()),
        parts_of_segment_(volume.segments.size()),
        parts_of_vertex_(volume.vertices.size()),
        of_part_(parts) {
    find_vertices();
    find_facets();
    find_segments();
    adopt(volume_.facets, parts_of_facet_);
    adopt(volume_.segments, parts_of_segment_);
    find_shared();
  }

  [[nodiscard]] MeshPiece piece(Index part) const {
    MeshPiece piece;
    std::vector<Index> cells = of_part_.at(part);
    piece.own_tetrahedra = cells.size();
    for (const Index t : shared_)
      if (part_of_[t] != part && touches(t, part)) cells.push_back(t);
    std::vector<Index> number(volume_.vertices.size(), no_entity);
    number_vertices(piece, part, cells, number);
    add_tetrahedra(piece, cells, number);
    add_bounds(piece, part, number);
    add_interfaces(piece, part, number);
    piece.volume.names = volume_.names;
    return piece;
  }

 private:
  void find_vertices() {
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) {
      of_part_[part_of_[t]].push_back(t);
      for (const Index v : volume_.tetrahedra[t]) parts_of_vertex_.add(v, part_of_[t]);
    }
  }

  /// Piece 0 has the vertices of entities on no tetrahedron.
  template <class Entity>
  void adopt(const std::vector<Entity>& entities, const PartsOf& parts) {
    for (std::size_t i = 0; i < entities.size(); ++i)
      if (parts.has_none(i))
        for (const Index v : entities[i]) parts_of_vertex_.add(v, 0);
  }

  void find_shared() {
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) {
      const Tetrahedron& corners = volume_.tetrahedra[t];
      if (std::any_of(corners.begin(), corners.end(), [&](Index v) { return parts_of_vertex_.shared(v); }))
        shared_.push_back(t);
    }
  }

  void find_facets() {
    const std::vector<io::SidesOfFacet> sides = io::sides_of_facets(volume_);
    for (std::size_t f = 0; f < sides.size(); ++f)
      for (const auto& side : {sides[f].behind, sides[f].front})
        if (side) parts_of_facet_.add(f, part_of_[side->tetrahedron]);
  }

  void find_segments() {
    if (volume_.segments.empty()) return;
    EdgeNumbers numbers(volume_.segments.size());
    std::vector<std::vector<Index>> segments;  // of each edge: a segment may be duplicated
    for (Index s = 0; s < volume_.segments.size(); ++s) {
      const Index edge = numbers.of(volume_.segments[s][0], volume_.segments[s][1]);
      if (edge == segments.size()) segments.emplace_back();
      segments[edge].push_back(s);
    }
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      const Tetrahedron& c = volume_.tetrahedra[t];
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
          if (const Index edge = numbers.find(c[i], c[j]); edge != no_entity)
            for (const Index s : segments[edge]) parts_of_segment_.add(s, part_of_[t]);
    }
  }

  [[nodiscard]] bool touches(Index t, Index part) const {
    const Tetrahedron& corners = volume_.tetrahedra[t];
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index v) { return parts_of_vertex_.has(v, part); });
  }

  void number_vertices(MeshPiece& piece, Index part, const std::vector<Index>& cells,
                       std::vector<Index>& number) const {
    for (const Index t : cells)
      for (const Index v : volume_.tetrahedra[t]) number[v] = 0;
    const auto take = [&](Index v) {
      number[v] = static_cast<Index>(piece.vertices.size());
      piece.vertices.push_back(v);
      piece.vertex_owners.push_back(parts_of_vertex_.owner(v));
      piece.volume.vertices.push_back(volume_.vertices[v]);
      if (!volume_.vertex_markers.empty()) piece.volume.vertex_markers.push_back(volume_.vertex_markers[v]);
      if (!volume_.input_vertices.empty()) piece.volume.input_vertices.push_back(volume_.input_vertices[v]);
    };
    for (Index v = 0; v < number.size(); ++v)
      if (parts_of_vertex_.in_piece(v, part)) take(v);
    piece.own_vertices = piece.vertices.size();
    for (Index v = 0; v < number.size(); ++v)
      if (number[v] != no_entity && !parts_of_vertex_.in_piece(v, part)) take(v);
  }

  void add_tetrahedra(MeshPiece& piece, const std::vector<Index>& cells,
                      const std::vector<Index>& number) const {
    for (const Index t : cells) {
      Tetrahedron corners{};
      for (std::size_t k = 0; k < 4; ++k) corners[k] = number[volume_.tetrahedra[t][k]];
      piece.volume.tetrahedra.push_back(corners);
      piece.volume.regions.push_back(volume_.regions.empty() ? 0 : volume_.regions[t]);
      piece.tetrahedra.push_back(t);
      piece.owners.push_back(part_of_[t]);
    }
  }

  /// Calls add(entity, i) for every facet, or segment, i of a piece, with its vertices numbered in the piece.
  template <class Entity, class Add>
  static void for_each_in_piece(const std::vector<Entity>& entities, const PartsOf& parts, Index part,
                                const std::vector<Index>& number, const Add& add) {
    for (std::size_t i = 0; i < entities.size(); ++i) {
      if (!parts.in_piece(i, part)) continue;
      Entity entity = entities[i];
      for (Index& v : entity) v = number[v];
      add(entity, i);
    }
  }

  void add_bounds(MeshPiece& piece, Index part, const std::vector<Index>& number) const {
    Volume& own = piece.volume;
    const auto add_facet = [&](const Triangle& facet, std::size_t f) {
      own.facets.push_back(facet);
      piece.facet_owners.push_back(parts_of_facet_.owner(f));
      if (!volume_.facet_markers.empty()) own.facet_markers.push_back(volume_.facet_markers[f]);
    };
    const auto add_segment = [&](const Segment& segment, std::size_t s) {
      own.segments.push_back(segment);
      piece.segment_owners.push_back(parts_of_segment_.owner(s));
      if (!volume_.segment_markers.empty()) own.segment_markers.push_back(volume_.segment_markers[s]);
    };
    for_each_in_piece(volume_.facets, parts_of_facet_, part, number, add_facet);
    for_each_in_piece(volume_.segments, parts_of_segment_, part, number, add_segment);
  }

  void add_interfaces(MeshPiece& piece, Index part, const std::vector<Index>& number) const {
    InterfaceFaces faces;
    for (const Index t : of_part_[part])
      for (std::size_t side = 0; side < 4; ++side) {
        const Index other = beside_[t][side];
        if (other == no_entity || part_of_[other] == part) continue;
        Triangle face = outward_face(volume_.tetrahedra[t], side);
        for (Index& corner : face) corner = number[corner];
        faces.add(part_of_[other], face);
      }
    piece.interfaces = faces.take(piece.vertices);
  }

  const Volume& volume_;
  std::vector<Index> part_of_;
  std::vector<Neighbours> beside_;
  PartsOf parts_of_facet_, parts_of_segment_, parts_of_vertex_;
  std::vector<std::vector<Index>> of_part_;
  std::vector<Index> shared_;  // tetrahedra with a vertex of several parts: what can be a ghost
};

}  // namespace
}  // namespace partitions

PieceLoader pieces_of(const Volume& volume, std::vector<Index> part_of, std::size_t parts) {
  if (part_of.size() != volume.tetrahedra.size() ||
      std::any_of(part_of.begin(), part_of.end(), [&](Index part) { return part >= parts; }))
    throw std::invalid_argument("a partition needs a part for each tetrahedron");
  if (io::is_second_order(volume))
    throw std::invalid_argument("volumes of second order are not written in pieces");
  const auto pieces = std::make_shared<const partitions::Pieces>(volume, std::move(part_of), parts);
  return [pieces](std::size_t k) { return pieces->piece(static_cast<Index>(k)); };
}

}  // namespace holdfast
