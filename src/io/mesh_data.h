// The result of every reader: the union of a surface and a volume. A file format seldom says which of the two
// a file contains, so one reader serves `read_surface` and `read_volume`.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/io.h"
#include "io/watch.h"
#include "plane/facets.h"

namespace holdfast::io {

/// From this byte on, the text comes from another file, starting at this line of it. The path must outlive
/// it.
struct Origin {
  std::size_t begin;
  std::reference_wrapper<const std::filesystem::path> path;
  std::size_t line;
};

/// A file's bytes and the name to use in errors.
struct Source {
  const std::filesystem::path& path;
  std::string_view bytes;
  bool finite = false;  ///< refuse numbers that are not finite, because nothing checks them later
  Watch* watch = nullptr;
  double tolerance = 0;  ///< how far corners of a polygon may lie from its plane; see ReadOptions
  bool keeps_polygons = false;
  double arc_step = 0;                   ///< see ReadOptions
  std::span<const Origin> origins = {};  ///< for a text joined from several files: ascending, from its begin
};

[[nodiscard]] inline Source without_polygons(Source source) {
  source.keeps_polygons = false;
  return source;
}

/// Tags of entities of one kind that stay empty as long as every tag is 0.
///
/// Most files carry no markers, and "no markers" and "all markers are 0" mean the same everywhere.
class Tags {
 public:
  /// Records the tag of the next entity, of which `before` precede it.
  void add(std::size_t before, int tag) {
    if (tag == 0 && values_.empty()) return;
    values_.resize(before, 0);
    values_.push_back(tag);
  }
  [[nodiscard]] int of(std::size_t i) const { return i < values_.size() ? values_[i] : 0; }
  /// Changes the tag of an entity that already has one.
  void set(std::size_t i, int tag) { values_[i] = tag; }
  /// The tags, one per entity, or empty if all are 0.
  [[nodiscard]] std::vector<int> take(std::size_t count) {
    if (!values_.empty()) values_.resize(count, 0);
    return std::move(values_);
  }

 private:
  std::vector<int> values_;
};

/// The tag of entity `i`, or 0 if there are none.
[[nodiscard]] inline int tag_of(const std::vector<int>& tags, std::size_t i) {
  return tags.empty() ? 0 : tags[i];
}

/// Faces whose number of corners is not that of a triangle.
struct PolygonCounts {
  std::size_t cut = 0;       ///< polygons of more than three corners, which became triangles
  std::size_t crossing = 0;  ///< of these, those whose sides cross (plane::CutPolygon)
  std::size_t left_out = 0;  ///< faces of fewer than three corners, in formats to which these mean nothing
  double deviation = 0;      ///< largest distance of a corner from its polygon's mean plane

  void add(const PolygonCounts& other) {
    cut += other.cut;
    crossing += other.crossing;
    left_out += other.left_out;
    deviation = std::max(deviation, other.deviation);
  }
};

struct MeshData {
  MeshData() = default;
  explicit MeshData(const Source& source)
      : tolerance(source.tolerance), keeps_polygons(source.keeps_polygons), watch(source.watch) {}

  std::vector<Point> vertices;
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
  std::vector<Tetrahedron> tetrahedra;
  Tags vertex_markers, facet_markers, segment_markers, regions;
  std::vector<Surface::RegionSeed> region_seeds;
  std::vector<Point> holes;
  std::vector<Remark> remarks;
  Names names;
  /// Cells that became tetrahedra (cells.h).
  struct Cells {
    std::size_t hexahedra = 0, prisms = 0, pyramids = 0;
    std::size_t tetrahedra = 0;  ///< of all these cells
  } cells;
  std::vector<Index> quadrangles;  ///< the first of the two facets of each polygon of four corners
  PolygonCounts polygon_counts;
  double tolerance = 0;         ///< how far corners of a facet of several polygons may lie from its plane
  bool keeps_polygons = false;  ///< polygons are kept as they are
  std::vector<plane::PolygonFacet> polygons = {};
  Watch* watch = nullptr;
  /// Mid-edge nodes of elements of second order, as vertices of the file; empty if there are none. The edges
  /// are those of MidNodes; `no_entity` stands for a node of an element of first order.
  struct FileMids {
    std::vector<std::array<Index, 6>> tetrahedra;
    std::vector<std::array<Index, 3>> facets;
    std::vector<Index> segments;
    std::vector<Index> others;  ///< nodes that are not corners, of elements that keep none
  } mids;
  MidNodes mid_nodes;  ///< the result of `settle_mid_nodes` (mid_nodes.h)

  /// Records that `count` of `what` (a plural; `one` is its singular) are in the file and were left out.
  void leave_out(std::size_t count, std::string_view what, std::string_view one = {}) {
    if (count == 0) return;
    const std::string_view words = count == 1 && !one.empty() ? one : what;
    remarks.push_back(
        {RemarkKind::left_out, count,
         std::to_string(count) + " " + std::string(words) + (count == 1 ? " is" : " are") + " left out"});
  }
  /// The same for several kinds, by their numbers: "3 cards ('pshear', 'rod')". `text_of` gives their names.
  template <typename Kind, typename TextOf>
  void leave_out(const std::map<Kind, std::size_t>& count_of, TextOf&& text_of, const std::string& what,
                 const std::string& one) {
    std::string kinds;
    std::size_t all = 0;
    for (const auto& [kind, count] : count_of) {
      kinds += (kinds.empty() ? "" : ", ") + text_of(kind);
      all += count;
    }
    leave_out(all, what + " (" + kinds + ")", one + " (" + kinds + ")");
  }
  void add_vertex(const Point& vertex, int marker) {
    vertex_markers.add(vertices.size(), marker);
    vertices.push_back(vertex);
  }
  void add_facet(const Triangle& facet, int marker = 0) {
    facet_markers.add(facets.size(), marker);
    facets.push_back(facet);
  }
  /// The triangles of a polygon, and the largest distance of its corners from its mean plane.
  void add_cut(const std::vector<Triangle>& triangles, double off, int marker) {
    if (triangles.size() == 2) quadrangles.push_back(static_cast<Index>(facets.size()));
    for (const Triangle& triangle : triangles) add_facet(triangle, marker);
    polygon_counts.add({1, 0, 0, off});
  }
  void add_segment(const Segment& segment, int marker = 0) {
    segment_markers.add(segments.size(), marker);
    segments.push_back(segment);
  }
  void add_tetrahedron(const Tetrahedron& tetrahedron, int region = 0) {
    regions.add(tetrahedra.size(), region);
    tetrahedra.push_back(tetrahedron);
  }
};

}  // namespace holdfast::io
