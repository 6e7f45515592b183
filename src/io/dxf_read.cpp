// Reads the faces of DXF files as text (AutoCAD DXF reference): 3DFACE, polyface and polygon meshes, MESH,
// and blocks of these, placed by INSERT. Layers are markers. Lines, which have no faces, are read for
// outlines in planes; texts and solids of CAD kernels are left out.
#include <algorithm>
#include <map>
#include <set>

#include "io/dxf_faces.h"
#include "io/dxf_plane.h"
#include "io/dxf_text.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/placement.h"
#include "surface/weld.h"

namespace holdfast::io {
namespace {

struct Insert {
  std::string block;
  int layer;
  Placement placement;  ///< of the first copy
  std::int64_t rows, columns;
  Placement row, column;  ///< the steps between copies
  std::size_t place;
};

struct DxfBlock {
  explicit DxfBlock(const Source& source) : faces(source) {}
  Point base{0, 0, 0};
  DxfFaces faces;
  std::vector<Insert> inserts;
};

class DxfReader {
 public:
  explicit DxfReader(const Source& source) : source_(source), text_(source), top_(source), mesh_(source) {}

  MeshData read() {
    DxfEntity entity;
    while (text_.next(entity)) use(entity);
    if (!has_section_) throw FileError(source_.path, "", "no DXF: the file has no SECTION");
    if (!has_end_) throw FileError(source_.path, "", "the file does not end with EOF; it is truncated");
    top_.faces.finish(text_);
    put(top_, {}, 0, 0);
    tell_left_out();
    name_layers();
    if (source_.keeps_polygons) join_points();
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kDeepest = 100, kMostCopies = std::size_t{1} << 20;

  void use(const DxfEntity& entity) {
    const std::string_view type = entity.type;
    if (type == "EOF") {
      has_end_ = true;
    } else if (type == "SECTION") {
      section_ = DxfText::text(entity, 2);
      has_section_ = true;
    } else if (type == "ENDSEC") {
      section_.clear();
    } else if (section_ == "BLOCKS" && type == "BLOCK") {
      block_ = &blocks_.try_emplace(std::string(DxfText::text(entity, 2)), source_).first->second;
      block_->base = text_.point(entity, 10);
    } else if (section_ == "BLOCKS" && type == "ENDBLK") {
      if (block_ != nullptr) block_->faces.finish(text_);
      block_ = nullptr;
    } else if (section_ == "ENTITIES" || (section_ == "BLOCKS" && block_ != nullptr)) {
      DxfBlock& block = section_ == "ENTITIES" ? top_ : *block_;
      const bool is_on_paper = text_.integer(entity, 67, 0) == 1;
      if (is_on_paper) return;
      if (type == "INSERT")
        block.inserts.push_back(insert(entity));
      else if (!block.faces.add(text_, entity, layer_of(entity)))
        ++others_[std::string(type.substr(0, 24))];
    }
  }

  /// From 1; 0 is the layer "0", which means the layer of the block's copy.
  int layer_of(const DxfEntity& entity) {
    const std::string name = cleaned_name(DxfText::text(entity, 8));
    if (name.empty() || name == "0") return 0;
    const auto [found, is_new] = layers_.try_emplace(name, static_cast<int>(layers_.size()) + 1);
    return found->second;
  }

  Insert insert(const DxfEntity& entity) {
    Placement scaled;
    for (std::size_t axis = 0; axis < 3; ++axis)
      scaled.m[4 * axis] = text_.real(entity, 41 + static_cast<int>(axis), 1);
    const Placement plane = placement_of_plane(text_, entity);
    const Placement turned = plane.after(Placement::turned({}, {0, 0, 1}, text_.real(entity, 50, 0)));
    Insert result{std::string(DxfText::text(entity, 2)), layer_of(entity), {}, 1, 1, {}, {}, entity.place};
    result.placement = plane.after(Placement::moved_by(text_.point(entity, 10)))
                           .after(Placement::turned({}, {0, 0, 1}, text_.real(entity, 50, 0)))
                           .after(scaled);
    result.columns = std::max<std::int64_t>(text_.integer(entity, 70, 1), 1);
    result.rows = std::max<std::int64_t>(text_.integer(entity, 71, 1), 1);
    result.column = Placement::moved_by(turned.of({text_.real(entity, 44, 0), 0, 0}));
    result.row = Placement::moved_by(turned.of({0, text_.real(entity, 45, 0), 0}));
    return result;
  }

  void put(const DxfBlock& block, const Placement& placement, int layer, std::size_t depth) {
    put_faces(block.faces.mesh(), placement, layer);
    for (const Insert& insert : block.inserts) {
      const auto found = blocks_.find(insert.block);
      if (found == blocks_.end())
        text_.fail_at(insert.place, "the block " + in_quotes(insert.block) + " does not exist");
      if (depth == kDeepest) text_.fail_at(insert.place, "blocks that contain each other");
      const Placement to_base =
          Placement::moved_by({-found->second.base[0], -found->second.base[1], -found->second.base[2]});
      const int own = insert.layer == 0 ? layer : insert.layer;
      Placement row = placement;
      for (std::int64_t i = 0; i < insert.rows; ++i, row = row.after(insert.row)) {
        Placement copy = row;
        for (std::int64_t j = 0; j < insert.columns; ++j, copy = copy.after(insert.column)) {
          count_copy(insert);
          put(found->second, copy.after(insert.placement).after(to_base), own, depth + 1);
        }
      }
    }
  }

  /// Copies of copies can grow exponentially with the length of a file.
  void count_copy(const Insert& insert) {
    step(source_.watch);
    constexpr std::size_t kHarmless = std::size_t{1} << 22, kMostTimes = 1000;
    const std::size_t size = mesh_.vertices.size() + mesh_.facets.size() + mesh_.segments.size();
    if (++copies_ > kMostCopies || (size > kHarmless && size / kMostTimes > source_.bytes.size()))
      text_.fail_at(insert.place, "more than " + std::to_string(copies_ - 1) + " copies of blocks, " +
                                      std::to_string(mesh_.facets.size()) +
                                      " triangles in all; such a file is damaged or malicious");
  }

  void put_faces(const MeshData& faces, const Placement& placement, int layer) {
    if (mesh_.vertices.size() + faces.vertices.size() >= no_entity)
      throw FileError(source_.path, "", "has more vertices than 32 bits count");
    const auto first = static_cast<Index>(mesh_.vertices.size());
    for (const Point& vertex : faces.vertices) mesh_.vertices.push_back(placement.of(vertex));
    const bool mirrors = placement.mirrors();
    for (std::size_t f = 0; f < faces.facets.size(); ++f) {
      beat(source_.watch);
      Triangle facet = faces.facets[f];
      for (Index& corner : facet) corner += first;
      if (mirrors) std::swap(facet[1], facet[2]);
      const int own = faces.facet_markers.of(f) == 0 ? layer : faces.facet_markers.of(f);
      used_.insert(own);
      layer_of_facet_.push_back(own);
      mesh_.add_facet(facet);
    }
    for (std::size_t s = 0; s < faces.segments.size(); ++s) {
      beat(source_.watch);
      const int own = faces.segment_markers.of(s) == 0 ? layer : faces.segment_markers.of(s);
      used_.insert(own);
      layer_of_segment_.push_back(own);
      mesh_.add_segment({faces.segments[s][0] + first, faces.segments[s][1] + first});
    }
    mesh_.polygon_counts.add(faces.polygon_counts);
  }

  /// Each line has its own ends in the file. Points of outlines that nothing uses would stand in the
  /// triangles' file.
  void join_points() {
    std::vector<Index> number;
    std::vector<Point> points;
    Welder weld(points);
    for (const Point& vertex : mesh_.vertices) number.push_back(weld.add(vertex));
    for (Triangle& t : mesh_.facets)
      for (Index& v : t) v = number[v];
    for (Segment& s : mesh_.segments)
      for (Index& v : s) v = number[v];
    mesh_.vertices = std::move(points);
  }

  /// Layers in use are numbered from 1; a single one is no marker.
  void name_layers() {
    std::map<int, std::string> names{{0, "0"}};
    for (const auto& [name, layer] : layers_) names[layer] = name;
    std::map<int, int> markers;
    for (const int layer : used_) {
      const int marker = used_.size() > 1 ? static_cast<int>(markers.size()) + 1 : 0;
      markers[layer] = marker;
      if (!layer_of_facet_.empty()) mesh_.names.facets[marker] = names[layer];
      if (!layer_of_segment_.empty()) mesh_.names.segments[marker] = names[layer];
    }
    mesh_.facet_markers = mesh_.segment_markers = {};
    for (std::size_t f = 0; f < layer_of_facet_.size(); ++f)
      mesh_.facet_markers.add(f, markers[layer_of_facet_[f]]);
    for (std::size_t s = 0; s < layer_of_segment_.size(); ++s)
      mesh_.segment_markers.add(s, markers[layer_of_segment_[s]]);
  }

  void tell_left_out() {
    std::size_t lines = top_.faces.lines_left_out();
    for (const auto& [name, block] : blocks_) lines += block.faces.lines_left_out();
    if (lines > 0) others_["POLYLINE"] += lines;
    std::string names;
    std::size_t count = 0;
    for (const auto& [name, entities] : others_) {
      names += (names.empty() ? "" : ", ") + in_quotes(name);
      count += entities;
    }
    const bool for_outlines = source_.keeps_polygons;
    const std::string what = for_outlines ? "faces or lines" : "faces";
    if (mesh_.facets.empty() && mesh_.segments.empty())
      throw FileError(
          source_.path, "",
          "holds no " + what + " (3DFACE, MESH, polyface or polygon mesh" +
              (for_outlines ? ", LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE, SPLINE)" : ")") +
              (names.empty() ? ""
                             : ", but " + names + "; export solids as meshes, or as STL" +
                                   (for_outlines ? "" : "; `holdfast plane` fills outlines")));
    mesh_.leave_out(count, "entities without " + what + " (" + names + ")",
                    "entity without " + what + " (" + names + ")");
  }

  Source source_;
  DxfText text_;
  std::string section_;
  DxfBlock top_;
  std::map<std::string, DxfBlock> blocks_;
  DxfBlock* block_ = nullptr;  ///< that is being read
  MeshData mesh_;
  std::map<std::string, int> layers_;
  std::set<int> used_;
  std::vector<int> layer_of_facet_, layer_of_segment_;
  std::map<std::string, std::size_t> others_;
  std::size_t copies_ = 0;
  bool has_section_ = false, has_end_ = false;
};

}  // namespace

MeshData read_dxf(const Source& source) { return DxfReader(source).read(); }

}  // namespace holdfast::io
