// Labels and remarks of the writers of solvers' text formats.
#pragma once

#include "io/formats.h"
#include "io/labels.h"
#include "io/mesh_sets.h"

namespace holdfast::io {

/// The labels of the three kinds of entities in solvers' formats.
struct SolverLabels {
  Labels regions, facets, segments;

  SolverLabels(const Volume& volume, const NameRule& names, const IdRule& ids)
      : regions(labels_of(kRegionStem, volume.regions, volume.tetrahedra.size(), volume.names.regions, names,
                          ids)),
        facets(labels_of(kFacetStem, volume.facet_markers, volume.facets.size(), volume.names.facets, names,
                         ids)),
        segments(labels_of(kSegmentStem, volume.segment_markers, volume.segments.size(),
                           volume.names.segments, names, ids)) {}
};

/// The vertices that have a marker: 0 is no set. Labels are in their order.
struct MarkedVertices {
  std::vector<Index> vertices;
  Labels labels;

  MarkedVertices(const Volume& volume, const NameRule& names, const IdRule& ids) {
    std::vector<int> markers;
    for (Index v = 0; v < volume.vertex_markers.size(); ++v) {
      if (volume.vertex_markers[v] == 0) continue;
      vertices.push_back(v);
      markers.push_back(volume.vertex_markers[v]);
    }
    labels = labels_of(kVertexStem, markers, markers.size(), volume.names.vertices, names, ids);
  }
};

/// Reports what formats without segments, vertex markers or second order leave out.
inline void tell_left_out(const Volume& volume, std::string_view format, bool segments, bool second_order,
                          std::vector<Remark>& remarks) {
  const auto say = [&](std::size_t count, std::string_view what) {
    if (count > 0)
      remarks.push_back(
          {RemarkKind::not_held, count,
           std::to_string(count) + " " + std::string(what) + " have no place in " + std::string(format)});
  };
  if (!segments) say(volume.segments.size(), "segments");
  if (!second_order) say(volume.mid_nodes.points.size(), "nodes in the middle of edges");
  tell_marked_vertices(volume, format, remarks);
}

}  // namespace holdfast::io
