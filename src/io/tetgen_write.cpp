// Writes files as TetGen does (manual, section 5.2); the switches decide which ones.
#include <algorithm>
#include <memory>
#include <stdexcept>

#include "holdfast/tetgen.h"
#include "io/atomic_writer.h"
#include "io/file_bytes.h"
#include "io/text_reader.h"
#include "numbers/float_environment.h"
#include "second_order/edge_numbers.h"
#include "second_order/edges_of.h"

namespace holdfast {
namespace {

using Path = std::filesystem::path;

// TetGen's order of the mid-edge nodes of a tetrahedron, as positions in ours: its edges are 23 03 01 12 13
// 02.
constexpr std::array<std::size_t, 6> kTetgenOrder{5, 3, 0, 1, 4, 2};
constexpr int kMarkerOfUnmarked = 1;

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

void require_fit(const Volume& volume) {
  const auto fits = [](const auto& tags, std::size_t count) { return tags.empty() || tags.size() == count; };
  const MidNodes& mid = volume.mid_nodes;
  if (!fits(volume.vertex_markers, volume.vertices.size()) ||
      !fits(volume.regions, volume.tetrahedra.size()) || !fits(volume.facet_markers, volume.facets.size()) ||
      !fits(volume.segment_markers, volume.segments.size()) ||
      (!mid.empty() && mid.tetrahedra.size() != volume.tetrahedra.size()))
    throw std::invalid_argument(
        "a volume with regions, markers or mid-edge nodes of another number than their entities");
}

/// Writes one of the files; all have the same last line.
class Writer {
 public:
  Writer(const Path& name, const Volume& volume, const TetgenFiles& files)
      : name_(name), volume_(volume), files_(files), watch_(files, files.progress) {}

  void run() {
    const bool faces_or_edges = files_.faces || files_.edges;
    if (faces_or_edges && (files_.all_edges || !volume_.mid_nodes.empty() || files_.adjacent)) number_edges();
    if (files_.neighbours || (files_.faces && (files_.all_faces || files_.adjacent)))
      neighbours_ = neighbours(volume_.tetrahedra);
    if (files_.nodes) write_nodes(open(".node"));
    if (files_.elements) write_elements(open(".ele"));
    if (files_.faces) write_faces(open(".face"));
    if (files_.edges) write_edges(open(".edge"));
    if (files_.neighbours) write_neighbours(open(".neigh"));
    if (files_.surface) write_surface_file(open(".smesh"));
    // All files are completed before any gets its name, so that a full disk does not mix old and new ones.
    for (const auto& file : open_) {
      if (!files_.comment.empty()) *file << "# " << files_.comment << '\n';
      file->finish();
    }
    for (const auto& file : open_) file->commit();
    watch_.finish_written();
  }

 private:
  io::AtomicWriter& open(const char* extension) {
    Path path = name_;
    path += extension;
    open_.push_back(std::make_unique<io::AtomicWriter>(path, &watch_));
    return *open_.back();
  }

  [[nodiscard]] std::uint64_t number(std::size_t i) const {
    return i + static_cast<std::uint64_t>(files_.first);
  }
  [[nodiscard]] std::int64_t number_or_none(Index t) const {
    return t == no_entity ? -1 : static_cast<std::int64_t>(number(t));
  }

  // Numbers the edges of the tetrahedra; finds a tetrahedron at each, and its node.
  void number_edges() {
    const MidNodes& mid = volume_.mid_nodes;
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      watch_.beat();
      const Tetrahedron& v = volume_.tetrahedra[t];
      for (std::size_t e = 0; e < kTetrahedronEdges.size(); ++e) {
        const Index edge = edges_.of(v[kTetrahedronEdges[e][0]], v[kTetrahedronEdges[e][1]]);
        if (edge < at_edge_.size()) continue;
        at_edge_.push_back(static_cast<Index>(t));
        if (!mid.empty()) node_of_edge_.push_back(mid.tetrahedra[t][e]);
      }
    }
  }
  /// Writes a space and the mid-edge node; nothing in a mesh of first order.
  void write_node_of(io::AtomicWriter& out, Index a, Index b) const {
    if (node_of_edge_.empty()) return;
    const Index edge = edges_.find(a, b);
    if (edge == no_entity) throw std::invalid_argument("a facet or segment has an edge of no tetrahedron");
    out << ' ' << number(node_of_edge_[edge]);
  }

  void write_nodes(io::AtomicWriter& out) {
    const bool marked = files_.markers && !volume_.vertex_markers.empty();
    out << std::uint64_t{volume_.vertices.size() + volume_.mid_nodes.points.size()} << "  3  0  "
        << (marked ? "1\n" : "0\n");
    const auto write = [&](std::size_t i, const Point& p, int marker) {
      out << number(i) << "  " << p[0] << ' ' << p[1] << ' ' << p[2];
      if (marked) out << "  " << marker;
      out << '\n';
    };
    for (std::size_t i = 0; i < volume_.vertices.size(); ++i)
      write(i, volume_.vertices[i], marked ? volume_.vertex_markers[i] : 0);
    for (std::size_t i = 0; i < volume_.mid_nodes.points.size(); ++i)
      write(volume_.vertices.size() + i, volume_.mid_nodes.points[i], 0);
  }

  void write_elements(io::AtomicWriter& out) {
    const bool second_order = !volume_.mid_nodes.empty();
    out << std::uint64_t{volume_.tetrahedra.size()} << (second_order ? "  10  " : "  4  ")
        << (files_.attributes ? "1\n" : "0\n");
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      out << number(t) << ' ';
      for (const Index v : volume_.tetrahedra[t]) out << ' ' << number(v);
      if (second_order)
        for (const std::size_t e : kTetgenOrder) out << ' ' << number(volume_.mid_nodes.tetrahedra[t][e]);
      if (files_.attributes) out << "  " << (volume_.regions.empty() ? 0 : volume_.regions[t]);
      out << '\n';
    }
  }

  void write_face(io::AtomicWriter& out, std::size_t i, const Triangle& f, int marker,
                  const std::array<Index, 2>& sides) const {
    out << number(i) << "  " << number(f[0]) << ' ' << number(f[1]) << ' ' << number(f[2]);
    for (const auto& [a, b] : kFacetEdges) write_node_of(out, f[a], f[b]);
    if (files_.markers) out << "  " << marker;
    if (files_.adjacent) out << "  " << number_or_none(sides[0]) << ' ' << number_or_none(sides[1]);
    out << '\n';
  }

  [[nodiscard]] int marker_of_facet(std::size_t f) const {
    return volume_.facet_markers.empty() ? kMarkerOfUnmarked : volume_.facet_markers[f];
  }

  // Facets do not know their tetrahedra, so these are found from the faces.
  void write_faces(io::AtomicWriter& out) {
    const bool from_faces = files_.all_faces || files_.adjacent;
    const char* const columns = files_.markers ? "  1\n" : "  0\n";
    if (!from_faces) {
      out << std::uint64_t{volume_.facets.size()} << columns;
      for (std::size_t f = 0; f < volume_.facets.size(); ++f)
        write_face(out, f, volume_.facets[f], marker_of_facet(f), {});
      return;
    }
    std::vector<std::pair<Triangle, Index>> facets(volume_.facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f)
      facets[f] = {sorted(volume_.facets[f]), static_cast<Index>(f)};
    std::sort(facets.begin(), facets.end());
    out << std::uint64_t{files_.all_faces ? count_faces() : volume_.facets.size()} << columns;
    std::size_t written = 0;
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t)
      for (std::size_t k = 0; k < 4; ++k) {
        const Index other = neighbours_[t][k];
        if (other != no_entity && other < t) continue;
        const Triangle face = outward_face(volume_.tetrahedra[t], k);
        const auto at = std::lower_bound(facets.begin(), facets.end(), std::pair{sorted(face), Index{0}});
        const bool is_facet = at != facets.end() && at->first == sorted(face);
        if (!is_facet && !files_.all_faces) continue;
        write_face(out, written++, is_facet ? volume_.facets[at->second] : face,
                   is_facet ? marker_of_facet(at->second) : 0, {static_cast<Index>(t), other});
      }
  }

  [[nodiscard]] std::size_t count_faces() const {
    std::size_t sides = 0, shared = 0;
    for (const Neighbours& of : neighbours_)
      for (const Index t : of) ++(t == no_entity ? sides : shared);
    return sides + shared / 2;
  }

  // Writes the segments, then the sides of facets that are not segments; with all edges, the rest.
  void write_edges(io::AtomicWriter& out) {
    EdgeNumbers lines;
    std::vector<int> markers;
    const auto add = [&](Index a, Index b, int marker) {
      if (lines.of(a, b) == markers.size()) markers.push_back(marker);
    };
    for (std::size_t s = 0; s < volume_.segments.size(); ++s)
      add(volume_.segments[s][0], volume_.segments[s][1],
          volume_.segment_markers.empty() ? kMarkerOfUnmarked : volume_.segment_markers[s]);
    for (const Triangle& f : volume_.facets)
      for (const auto& [a, b] : kFacetEdges) add(f[a], f[b], kMarkerOfUnmarked);
    if (files_.all_edges)
      for (const Segment& e : edges_.edges()) add(e[0], e[1], 0);
    out << std::uint64_t{markers.size()} << "  1\n";
    for (std::size_t i = 0; i < markers.size(); ++i) {
      const auto [a, b] = lines.edges()[i];
      out << number(i) << "  " << number(a) << ' ' << number(b);
      write_node_of(out, a, b);
      out << "  " << markers[i];
      if (files_.adjacent) {
        const Index edge = edges_.find(a, b);
        out << "  " << number_or_none(edge == no_entity ? no_entity : at_edge_[edge]);
      }
      out << '\n';
    }
  }

  void write_neighbours(io::AtomicWriter& out) const {
    out << std::uint64_t{neighbours_.size()} << "  4\n";
    for (std::size_t t = 0; t < neighbours_.size(); ++t) {
      out << number(t) << ' ';
      for (const Index other : neighbours_[t]) out << ' ' << number_or_none(other);
      out << '\n';
    }
  }

  void write_surface_file(io::AtomicWriter& out) const {
    const bool marked = files_.markers && !volume_.facet_markers.empty();
    out << "0  3  0  0\n" << std::uint64_t{volume_.facets.size()} << (marked ? "  1\n" : "  0\n");
    for (std::size_t f = 0; f < volume_.facets.size(); ++f) {
      out << '3';
      for (const Index v : volume_.facets[f]) out << "  " << number(v);
      if (marked) out << "  " << volume_.facet_markers[f];
      out << '\n';
    }
    out << "0\n0\n";
  }

  const Path& name_;
  const Volume& volume_;
  const TetgenFiles& files_;
  io::Watch watch_;
  std::vector<std::unique_ptr<io::AtomicWriter>> open_;
  EdgeNumbers edges_;
  std::vector<Index> at_edge_, node_of_edge_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace

std::vector<Path> files_of_tetgen(const Path& name, const TetgenFiles& files) {
  std::vector<Path> paths;
  const auto add = [&](bool is_written, const char* extension) {
    if (!is_written) return;
    paths.push_back(name);
    paths.back() += extension;
  };
  add(files.nodes, ".node");
  add(files.elements, ".ele");
  add(files.faces, ".face");
  add(files.edges, ".edge");
  add(files.neighbours, ".neigh");
  add(files.surface, ".smesh");
  return paths;
}

void write_tetgen(const Path& name, const Volume& volume, const TetgenFiles& files) {
  const FloatEnvironment environment;
  require_fit(volume);
  Writer(name, volume, files).run();
}

int tetgen_first_number(const Path& path) {
  const std::string extension = io::lower(io::without_gz(path).extension().string());
  if (extension == ".mesh" || extension == ".meshb" || extension == ".stl") return 1;
  if (extension != ".node" && extension != ".poly" && extension != ".smesh") return 0;
  try {
    const io::FileBytes bytes(path);
    io::TextReader text({path, bytes.view()});
    const std::int64_t count = text.integer("the number of vertices");
    text.skip_line();
    if (count == 0) return extension == ".node" ? 0 : tetgen_first_number(io::sibling(path, ".node"));
    return text.integer("the vertex's number") == 1 ? 1 : 0;
  } catch (const FileError&) {
    return 0;
  }
}

}  // namespace holdfast
