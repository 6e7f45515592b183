#include "api/extract.h"

#include <algorithm>

#include "api/scale.h"

namespace holdfast {
namespace {

class Extractor {
 public:
  explicit Extractor(const Source& source)
      : source_(source),
        new_index_(std::max(source.mesh.vertex_count(), source.complex.vertices.size()), kNone) {}

  /// `id_of` returns a tetrahedron's region id, or nullopt to leave it out.
  template <typename IdOf>
  void take_tetrahedra(IdOf id_of, const Threads& threads) {
    const TetMesh& mesh = source_.mesh;
    Volume& volume = extract_.volume;
    volume.tetrahedra.reserve(mesh.tet_count());
    volume.regions.reserve(mesh.tet_count());
    const auto take = [&](Tet t) {
      if (!mesh.alive(t) || mesh.is_ghost(t)) return;
      const std::optional<int> id = id_of(t);
      if (!id) return;
      volume.tetrahedra.push_back(mesh.corners(t));
      volume.regions.push_back(*id);
      for (const Vertex v : mesh.corners(t)) new_index_[v] = 0;
    };
    parallel_ranges(threads.at_most(1), mesh.slot_count(), [&](std::size_t first, std::size_t last) {
      for (auto t = static_cast<Tet>(first); t < last; ++t) take(t);
    });
  }

  /// Numbers the vertices in use and writes their positions.
  void take_vertices(const Threads& threads) {
    const std::span<const Point> input = source_.complex.vertices;
    Volume& volume = extract_.volume;
    volume.vertices.assign(input.begin(), input.end());
    for (Vertex v = 0; v < input.size(); ++v) new_index_[v] = v;
    for (auto v = static_cast<Vertex>(input.size()); v < new_index_.size(); ++v)
      if (new_index_[v] != kNone) add_vertex(v);
    if (!source_.complex.vertex_markers.empty()) {
      volume.vertex_markers.assign(source_.complex.vertex_markers.begin(),
                                   source_.complex.vertex_markers.end());
      volume.vertex_markers.resize(volume.vertices.size(), 0);
    }
    parallel_ranges(threads, volume.tetrahedra.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        for (Index& v : volume.tetrahedra[k]) v = new_index_[v];
    });
  }

  template <typename Stays>
  void take_facets(Stays stays) {
    const Complex& complex = source_.complex;
    Volume& volume = extract_.volume;
    for (Index f = 0; f < complex.facets.size(); ++f) {
      if (!stays(f)) continue;
      volume.facets.push_back(complex.facets[f]);
      if (!complex.facet_markers.empty()) volume.facet_markers.push_back(complex.facet_markers[f]);
    }
  }

  /// Repeated segments are merged: the table names the first one of each.
  template <typename Stays>
  void take_segments(Stays stays) {
    const Complex& complex = source_.complex;
    Volume& volume = extract_.volume;
    for (Index s = 0; s < source_.table.segments.size(); ++s) {
      const Index input = source_.table.input_segment[s];
      if (input == no_index || !stays(s)) continue;
      volume.segments.push_back(complex.segments[input]);
      if (!complex.segment_markers.empty()) volume.segment_markers.push_back(complex.segment_markers[input]);
    }
  }

  void take_facet_regions(const Regions& regions, const Kept& kept) {
    const auto id = [&](RegionId r) { return kept.region[r] ? std::optional(kept.id[r]) : std::nullopt; };
    for (Index f = 0; f < source_.complex.facets.size(); ++f)
      if (kept.facet(regions, f))
        extract_.facet_regions.push_back({id(regions.of_facet[f][0]), id(regions.of_facet[f][1])});
  }

  void take_numbers() { extract_.number = new_index_; }

  Extract finish() { return std::move(extract_); }

 private:
  void add_vertex(Vertex v) {
    const TetMesh& mesh = source_.mesh;
    const auto index = static_cast<Index>(extract_.volume.vertices.size());
    new_index_[v] = index;
    if (v >= source_.first_free) ++extract_.steiner_points;
    if (source_.scale == 0 && mesh.is_explicit(v)) {
      extract_.volume.vertices.push_back(mesh.position(v));
      return;
    }
    const exact::ExactPoint p = scaled(mesh.exact_position(v), -source_.scale);
    extract_.volume.vertices.push_back({p.c[0].to_double(), p.c[1].to_double(), p.c[2].to_double()});
    if (!std::all_of(p.c.begin(), p.c.end(), [](const exact::Dyadic& x) { return x.is_double(); }))
      extract_.exact_vertices.push_back(
          {index, {p.c[0].to_string(), p.c[1].to_string(), p.c[2].to_string()}});
  }

  const Source& source_;
  std::vector<Index> new_index_;  // by mesh vertex; kNone if not in use
  Extract extract_;
};

}  // namespace

Extract extract_kept(const Source& source, const Regions& regions, const Kept& kept, const Threads& threads) {
  Extractor extractor(source);
  extractor.take_tetrahedra(
      [&](Tet t) -> std::optional<int> {
        const RegionId r = regions.of_tet[t];
        return kept.region[r] ? std::optional(kept.id[r]) : std::nullopt;
      },
      threads);
  extractor.take_vertices(threads);
  extractor.take_facets([&](Index f) { return kept.facet(regions, f); });
  extractor.take_facet_regions(regions, kept);
  extractor.take_segments([&](Index s) { return kept.segment[s]; });
  return extractor.finish();
}

Extract extract_all(const Source& source, const Standing& standing) {
  Extractor extractor(source);
  extractor.take_tetrahedra([](Tet) { return std::optional(0); }, 1);
  extractor.take_vertices(1);
  const auto stands = [](const std::vector<std::uint8_t>& flags) {
    return [&flags](Index i) { return i < flags.size() && flags[i] != 0; };
  };
  extractor.take_facets(stands(standing.facets));
  extractor.take_segments(stands(standing.segments));
  extractor.take_numbers();
  return extractor.finish();
}

}  // namespace holdfast
