// Writes meshes of legacy DOLFIN, .xml (FEniCS 2019, "DOLFIN XML"). Regions and markers are values in
// <domains>, each of an entity of a cell; corners are in the order of their numbers, as DOLFIN needs them.
#include <algorithm>
#include <optional>

#include "io/dolfin.h"
#include "io/solver_text.h"
#include "io/two_dimensions.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

constexpr NameRule kDolfinNames{1000, "_"};

/// Ids from 0 on; negative ones become free numbers.
Labels labels_from_zero(std::string_view stem, const std::vector<int>& tags, std::size_t count) {
  const bool has_negative = std::any_of(tags.begin(), tags.end(), [](int tag) { return tag < 0; });
  return labels_of(stem, tags, count, {}, kDolfinNames, {has_negative});
}

struct DolfinLabels {
  Labels regions, facets, segments, vertices;

  explicit DolfinLabels(const Volume& volume)
      : regions(labels_from_zero(kRegionStem, volume.regions, volume.tetrahedra.size())),
        facets(labels_from_zero(kFacetStem, volume.facet_markers, volume.facets.size())),
        segments(labels_from_zero(kSegmentStem, volume.segment_markers, volume.segments.size())),
        vertices(labels_from_zero(kVertexStem, volume.vertex_markers, volume.vertex_markers.size())) {}
};

/// An entity of a cell.
struct Place {
  std::size_t cell, entity;
};

class DolfinWriter {
 public:
  explicit DolfinWriter(const Volume& volume)
      : volume_(volume),
        labels_(volume),
        is_surface_(volume.tetrahedra.empty()),
        is_in_plane_(is_in_plane(volume)) {}

  [[nodiscard]] const DolfinLabels& labels() const { return labels_; }
  [[nodiscard]] std::size_t cells() const {
    return is_surface_ ? volume_.facets.size() : volume_.tetrahedra.size();
  }

  /// The corners of a cell in ascending order.
  [[nodiscard]] std::vector<Index> corners(std::size_t cell) const {
    std::vector<Index> n;
    if (is_surface_)
      n.assign(volume_.facets[cell].begin(), volume_.facets[cell].end());
    else
      n.assign(volume_.tetrahedra[cell].begin(), volume_.tetrahedra[cell].end());
    std::sort(n.begin(), n.end());
    return n;
  }

  [[nodiscard]] std::vector<std::optional<Place>> places_of_facets() const {
    const std::vector<SidesOfFacet> sides = sides_of_facets(volume_);
    std::vector<std::optional<Place>> places;
    for (const SidesOfFacet& of : sides) {
      const std::optional<SideOfTet>& side = of.behind ? of.behind : of.front;
      if (!side) {
        places.emplace_back();
        continue;
      }
      const Index opposite = volume_.tetrahedra[side->tetrahedron][side->side];
      places.push_back(Place{side->tetrahedron, position(corners(side->tetrahedron), opposite)});
    }
    return places;
  }

  /// Of the segments that are edges of cells.
  [[nodiscard]] std::vector<std::optional<Place>> places_of_segments() const {
    std::vector<std::pair<Segment, std::size_t>> wanted;
    for (std::size_t s = 0; s < volume_.segments.size(); ++s)
      wanted.emplace_back(ascending(volume_.segments[s]), s);
    std::sort(wanted.begin(), wanted.end());
    std::vector<std::optional<Place>> places(wanted.size());
    if (wanted.empty()) return places;
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      const std::vector<Index> n = corners(cell);
      for (std::size_t e = 0; e < (is_surface_ ? 3 : 6); ++e) {
        const auto& [a, b] = is_surface_ ? kDolfinEdgesOfTriangle[e] : kDolfinEdges[e];
        const Segment edge = ascending(Segment{n[a], n[b]});
        auto found = std::lower_bound(wanted.begin(), wanted.end(), edge,
                                      [](const auto& entry, const Segment& s) { return entry.first < s; });
        for (; found != wanted.end() && found->first == edge; ++found) places[found->second] = Place{cell, e};
      }
    }
    return places;
  }

  /// Of the vertices with markers that are in cells.
  [[nodiscard]] std::vector<std::optional<Place>> places_of_vertices() const {
    std::vector<std::optional<Place>> places(volume_.vertex_markers.size());
    for (std::size_t cell = 0; !places.empty() && cell < cells(); ++cell) {
      const std::vector<Index> n = corners(cell);
      for (std::size_t k = 0; k < n.size(); ++k)
        if (volume_.vertex_markers[n[k]] != 0) places[n[k]] = Place{cell, k};
    }
    return places;
  }

  void write(AtomicWriter& out) const {
    out << "<?xml version=\"1.0\"?>\n<dolfin xmlns:dolfin=\"http://fenicsproject.org\">\n  <mesh celltype=\""
        << (is_surface_ ? "triangle" : "tetrahedron") << "\" dim=\"" << (is_in_plane_ ? 2 : 3)
        << "\">\n    <vertices size=\"" << std::uint64_t{volume_.vertices.size()} << "\">\n";
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) {
      beat(out.watch());
      const Point& p = volume_.vertices[v];
      out << "      <vertex index=\"" << std::uint64_t{v} << "\" x=\"" << p[0] << "\" y=\"" << p[1];
      if (!is_in_plane_) out << "\" z=\"" << p[2];
      out << "\"/>\n";
    }
    out << "    </vertices>\n    <cells size=\"" << std::uint64_t{cells()} << "\">\n";
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      beat(out.watch());
      out << "      <" << (is_surface_ ? "triangle" : "tetrahedron") << " index=\"" << std::uint64_t{cell}
          << '"';
      const std::vector<Index> n = corners(cell);
      for (std::size_t k = 0; k < n.size(); ++k) out << " v" << static_cast<int>(k) << "=\"" << n[k] << '"';
      out << "/>\n";
    }
    out << "    </cells>\n    <domains>\n";
    std::vector<std::optional<Place>> all(cells());
    for (std::size_t cell = 0; cell < cells(); ++cell) all[cell] = Place{cell, 0};
    if (is_surface_) {
      write_values(out, 2, labels_.facets.ids, all);
    } else {
      write_values(out, 3, labels_.regions.ids, all);
      write_values(out, 2, labels_.facets.ids, places_of_facets());
    }
    write_values(out, 1, labels_.segments.ids, places_of_segments());
    write_values(out, 0, labels_.vertices.ids, places_of_vertices());
    out << "    </domains>\n  </mesh>\n</dolfin>\n";
  }

 private:
  static std::size_t position(const std::vector<Index>& corners, Index vertex) {
    return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
  }

  static void write_values(AtomicWriter& out, int dimension, const std::vector<int>& ids,
                           const std::vector<std::optional<Place>>& places) {
    const auto count =
        std::count_if(places.begin(), places.end(), [](const auto& place) { return place.has_value(); });
    if (count == 0) return;
    out << "      <mesh_value_collection name=\"m\" type=\"uint\" dim=\"" << dimension << "\" size=\""
        << static_cast<std::uint64_t>(count) << "\">\n";
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i])
        out << "        <value cell_index=\"" << std::uint64_t{places[i]->cell} << "\" local_entity=\""
            << std::uint64_t{places[i]->entity} << "\" value=\"" << ids[i] << "\"/>\n";
    out << "      </mesh_value_collection>\n";
  }

  const Volume& volume_;
  DolfinLabels labels_;
  bool is_surface_;
  bool is_in_plane_;  ///< of two dimensions
};

}  // namespace

void write_dolfin(AtomicWriter& out, const Volume& volume) { DolfinWriter(volume).write(out); }

std::vector<Remark> not_in_dolfin(const Volume& volume, const WriteOptions&) {
  std::vector<Remark> remarks;
  const DolfinWriter writer(volume);
  const DolfinLabels& labels = writer.labels();
  for (const Labels* of : {&labels.regions, &labels.facets, &labels.segments, &labels.vertices})
    tell(*of, ".xml", remarks);
  tell_names(volume.names, ".xml", remarks);
  const auto say = [&](const std::vector<std::optional<Place>>& places, const char* what) {
    const auto count = static_cast<std::size_t>(std::count(places.begin(), places.end(), std::nullopt));
    if (count > 0)
      remarks.push_back({RemarkKind::not_held, count,
                         std::to_string(count) + " " + what + " of no cell have no place in .xml"});
  };
  if (!volume.tetrahedra.empty()) say(writer.places_of_facets(), "facets");
  say(writer.places_of_segments(), "segments");
  if (!volume.mid_nodes.points.empty())
    remarks.push_back({RemarkKind::not_held, volume.mid_nodes.points.size(),
                       std::to_string(volume.mid_nodes.points.size()) +
                           " nodes in the middle of edges have no place in .xml"});
  return remarks;
}

}  // namespace holdfast::io
