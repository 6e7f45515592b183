// Parts of a divided surface, meshed separately, as pieces of one volume. Only data on the surface and the
// interfaces, and the layer of tetrahedra there, are kept from piece to piece.
#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>

#include "holdfast/partition.h"
#include "numbers/sorted.h"
#include "partition/interfaces.h"

namespace holdfast {
namespace partitions {
namespace {

using Number = std::uint64_t;
template <std::size_t N>
using Numbers = std::array<Number, N>;

/// In order; few.
using Parts = std::vector<Index>;

void add(Parts& parts, Index part) {
  if (parts.empty() || parts.back() != part) parts.push_back(part);  // parts come in order
}
bool has(const Parts& parts, Index part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

class JoinedPieces {
 public:
  JoinedPieces(const Complex& surface, std::size_t parts, PartLoader load, int interface_marker)
      : load_(std::move(load)), marker_(interface_marker) {
    Joiner joiner(surface, interface_marker);
    surface_places_ = joiner.vertices();
    for (std::size_t k = 0; k < parts; ++k) number(load_(k), joiner, static_cast<Index>(k));
    common_ = joiner.surface();
    for (Number v = 0; v < surface_places_; ++v)
      if (!parts_of_.contains(v)) in_no_part_.push_back(v);
    for (std::size_t k = 0; k < parts; ++k) keep_layer(load_(k), static_cast<Index>(k));
  }

  [[nodiscard]] MeshPiece piece(Index k) const {
    const Volume part = load_(k);
    const std::vector<Number> numbers = numbers_of(part, k);
    MeshPiece piece;
    std::vector<Index> local = take_own_vertices(piece, part, numbers, k);
    for (std::size_t t = 0; t < part.tetrahedra.size(); ++t)
      add_tetrahedron(piece, renumbered(part.tetrahedra[t], local),
                      part.regions.empty() ? 0 : part.regions[t], first_tetrahedron_[k] + t, k);
    piece.own_tetrahedra = part.tetrahedra.size();
    add_bounds(piece, part, numbers, local, k);
    add_ghosts(piece, k);
    piece.volume.names = common_.names;
    return piece;
  }

 private:
  /// A tetrahedron with a vertex of several parts.
  struct LayerCell {
    Number id;
    Index owner;
    int region;
    Numbers<4> corners;
  };

  void number(const Volume& part, Joiner& joiner, Index k) {
    first_tetrahedron_.push_back(k == 0 ? 0 : first_tetrahedron_.back() + tetrahedra_of_last_);
    tetrahedra_of_last_ = part.tetrahedra.size();
    first_fresh_.push_back(joiner.vertices());
    const Joiner::Numbered numbered = joiner.add(part);
    std::vector<bool> is_fresh(part.vertices.size(), false);
    for (const Index v : numbered.fresh) is_fresh[v] = true;
    auto& known = known_.emplace_back();
    for (Index v = 0; v < part.vertices.size(); ++v)
      if (!is_fresh[v]) known.emplace_back(v, numbered.vertices[v]);
    for (const Number v : numbered.vertices)
      if (v < surface_places_) add(parts_of_[v], k);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
      const Numbers<3> key = key_of(part.facets[f], numbered.vertices);
      add(parts_of_facet_[key], k);
      if (is_interface(part, f))
        for (const Number v : key) add(parts_of_[v], k);
    }
    for (const Segment& s : part.segments) add(parts_of_segment_[key_of(s, numbered.vertices)], k);
  }

  [[nodiscard]] bool is_interface(const Volume& part, std::size_t facet) const {
    return !part.facet_markers.empty() && part.facet_markers[facet] == marker_;
  }

  template <std::size_t N>
  static Numbers<N> key_of(const std::array<Index, N>& corners, const std::vector<Number>& numbers) {
    Numbers<N> key{};
    for (std::size_t i = 0; i < N; ++i) key[i] = numbers[corners[i]];
    std::sort(key.begin(), key.end());
    return key;
  }

  /// The same as the joiner gave: fresh vertices have numbers that follow each other.
  [[nodiscard]] std::vector<Number> numbers_of(const Volume& part, Index k) const {
    std::vector<Number> numbers(part.vertices.size());
    Number next = first_fresh_[k];
    auto known = known_[k].begin();
    for (std::size_t v = 0; v < numbers.size(); ++v) {
      if (known != known_[k].end() && known->first == v)
        numbers[v] = (known++)->second;
      else
        numbers[v] = next++;
    }
    return numbers;
  }

  [[nodiscard]] const Parts* parts_of(Number v) const {
    const auto found = parts_of_.find(v);
    return found == parts_of_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] bool shared(Number v) const {
    const Parts* parts = parts_of(v);
    return parts != nullptr && parts->size() > 1;
  }

  void keep_layer(const Volume& part, Index k) {
    const std::vector<Number> numbers = numbers_of(part, k);
    for (std::size_t t = 0; t < part.tetrahedra.size(); ++t) {
      const Tetrahedron& c = part.tetrahedra[t];
      if (std::none_of(c.begin(), c.end(), [&](Index v) { return shared(numbers[v]); })) continue;
      LayerCell cell{first_tetrahedron_[k] + t, k, part.regions.empty() ? 0 : part.regions[t], {}};
      for (std::size_t i = 0; i < 4; ++i) {
        cell.corners[i] = numbers[c[i]];
        points_.emplace(numbers[c[i]], std::pair(part.vertices[c[i]], k));
      }
      layer_.push_back(cell);
    }
  }

  [[nodiscard]] Index owner_of_vertex(Number v, Index k) const {
    const Parts* parts = parts_of(v);
    return parts == nullptr ? k : parts->front();
  }

  void add_vertex(MeshPiece& piece, Number v, const Point& p, Index owner) const {
    piece.vertices.push_back(v);
    piece.vertex_owners.push_back(owner);
    piece.volume.vertices.push_back(p);
    piece.volume.input_vertices.push_back(v < surface_places_ ? common_.input_vertices[v] : -1);
    if (!common_.vertex_markers.empty())
      piece.volume.vertex_markers.push_back(v < surface_places_ ? common_.vertex_markers[v] : 0);
  }

  /// In the order of the whole, the first piece with those in no part; returns the piece's index of each of
  /// the part's vertices.
  std::vector<Index> take_own_vertices(MeshPiece& piece, const Volume& part,
                                       const std::vector<Number>& numbers, Index k) const {
    std::vector<Index> order(numbers.size()), local(numbers.size());
    for (std::size_t v = 0; v < order.size(); ++v) order[v] = static_cast<Index>(v);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return numbers[a] < numbers[b]; });
    auto loose = k == 0 ? in_no_part_.begin() : in_no_part_.end();
    const auto add_loose_below = [&](Number end) {
      for (; loose != in_no_part_.end() && *loose < end; ++loose)
        add_vertex(piece, *loose, common_.vertices[*loose], 0);
    };
    for (const Index v : order) {
      add_loose_below(numbers[v]);
      local[v] = static_cast<Index>(piece.vertices.size());
      add_vertex(piece, numbers[v], part.vertices[v], owner_of_vertex(numbers[v], k));
    }
    add_loose_below(surface_places_);
    piece.own_vertices = piece.vertices.size();
    return local;
  }

  template <std::size_t N>
  static std::array<Index, N> renumbered(std::array<Index, N> corners, const std::vector<Index>& local) {
    for (Index& v : corners) v = local[v];
    return corners;
  }

  static void add_tetrahedron(MeshPiece& piece, const Tetrahedron& corners, int region, Number id,
                              Index owner) {
    piece.volume.tetrahedra.push_back(corners);
    piece.volume.regions.push_back(region);
    piece.tetrahedra.push_back(id);
    piece.owners.push_back(owner);
  }

  /// Facets and segments but for interfaces, and the faces of two parts.
  void add_bounds(MeshPiece& piece, const Volume& part, const std::vector<Number>& numbers,
                  const std::vector<Index>& local, Index k) const {
    InterfaceFaces faces;
    const std::map<Triangle, Triangle> outward = outward_faces(part);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
      const Parts& parts = parts_of_facet_.at(key_of(part.facets[f], numbers));
      if (parts.size() == 2)
        if (const auto found = outward.find(ascending(part.facets[f])); found != outward.end())
          faces.add(parts[0] == k ? parts[1] : parts[0], renumbered(found->second, local));
      if (is_interface(part, f)) continue;
      piece.volume.facets.push_back(renumbered(part.facets[f], local));
      piece.facet_owners.push_back(parts.front());
      if (!part.facet_markers.empty()) piece.volume.facet_markers.push_back(part.facet_markers[f]);
    }
    piece.interfaces = faces.take(piece.vertices);
    for (std::size_t s = 0; s < part.segments.size(); ++s) {
      piece.volume.segments.push_back(renumbered(part.segments[s], local));
      piece.segment_owners.push_back(parts_of_segment_.at(key_of(part.segments[s], numbers)).front());
      if (!part.segment_markers.empty()) piece.volume.segment_markers.push_back(part.segment_markers[s]);
    }
  }

  /// Facets on the boundary of the part, seen from outside.
  static std::map<Triangle, Triangle> outward_faces(const Volume& part) {
    std::map<Triangle, Triangle> facets;
    for (const Triangle& t : part.facets) facets[ascending(t)];
    std::map<Triangle, int> sides;
    for (const Tetrahedron& t : part.tetrahedra)
      for (std::size_t side = 0; side < 4; ++side) {
        const Triangle face = outward_face(t, side);
        const auto found = facets.find(ascending(face));
        if (found == facets.end()) continue;
        found->second = face;
        ++sides[found->first];
      }
    std::erase_if(facets, [&](const auto& facet) {
      const auto found = sides.find(facet.first);
      return found == sides.end() || found->second != 1;
    });
    return facets;
  }

  void add_ghosts(MeshPiece& piece, Index k) const {
    std::vector<const LayerCell*> ghosts;
    std::vector<Number> beyond;  // vertices of ghosts alone
    for (const LayerCell& cell : layer_) {
      const auto here = [&](Number v) {
        const Parts* parts = parts_of(v);
        return parts != nullptr && has(*parts, k);
      };
      if (cell.owner == k || std::none_of(cell.corners.begin(), cell.corners.end(), here)) continue;
      ghosts.push_back(&cell);
      for (const Number v : cell.corners)
        if (!here(v)) beyond.push_back(v);
    }
    sort_unique(beyond);
    for (const Number v : beyond) {
      const auto& [point, owner] = points_.at(v);
      add_vertex(piece, v, point, owner_of_vertex(v, owner));
    }
    const auto own_end = piece.vertices.begin() + static_cast<std::ptrdiff_t>(piece.own_vertices);
    const auto index_of = [&](Number v) {
      auto at = std::lower_bound(piece.vertices.begin(), own_end, v);
      if (at == own_end || *at != v) at = std::lower_bound(own_end, piece.vertices.end(), v);
      return static_cast<Index>(at - piece.vertices.begin());
    };
    for (const LayerCell* cell : ghosts) {
      Tetrahedron corners{};
      for (std::size_t i = 0; i < 4; ++i) corners[i] = index_of(cell->corners[i]);
      add_tetrahedron(piece, corners, cell->region, cell->id, cell->owner);
    }
  }

  PartLoader load_;
  int marker_;
  Number surface_places_ = 0, tetrahedra_of_last_ = 0;
  Volume common_;
  std::vector<Number> in_no_part_;                            // vertices of the surface, which piece 0 has
  std::vector<Number> first_tetrahedron_, first_fresh_;       // of each part
  std::vector<std::vector<std::pair<Index, Number>>> known_;  // vertices that were there before
  std::unordered_map<Number, Parts> parts_of_;                // of vertices on the surface and interfaces
  std::map<Numbers<3>, Parts> parts_of_facet_;
  std::map<Numbers<2>, Parts> parts_of_segment_;
  std::vector<LayerCell> layer_;
  std::unordered_map<Number, std::pair<Point, Index>> points_;  // of the layer, and a part that has it
};

}  // namespace
}  // namespace partitions

PieceLoader joined_pieces(const Complex& surface, std::size_t parts, const PartLoader& load,
                          int interface_marker) {
  const auto pieces =
      std::make_shared<const partitions::JoinedPieces>(surface, parts, load, interface_marker);
  return [pieces](std::size_t k) { return pieces->piece(static_cast<Index>(k)); };
}

}  // namespace holdfast
