// Writes surfaces: in text formats that hold nothing else, and in volume formats without tetrahedra.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "holdfast/surface_io.h"
#include "io/formats.h"
#include "io/indices.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "numbers/float_environment.h"
#include "numbers/sorted.h"
#include "surface/isolated.h"

namespace holdfast {
namespace io {
namespace {

std::string surface_extension_of(const std::filesystem::path& path, std::string_view format) {
  std::string extension = lower(format.empty() ? path.extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  return extension;
}

AtomicWriter& operator<<(AtomicWriter& out, const Point& p) {
  return out << p[0] << ' ' << p[1] << ' ' << p[2];
}

/// Writes segments as faces of two corners and isolated vertices as faces of one, as the reader expects.
void write_off(AtomicWriter& out, const Surface& surface) {
  const std::vector<Index> isolated = isolated_vertices(surface.view());
  out << "OFF\n"
      << std::uint64_t{surface.vertices.size()} << ' '
      << std::uint64_t{surface.facets.size() + surface.segments.size() + isolated.size()} << " 0\n";
  for (const Point& p : surface.vertices) out << p << '\n';
  for (const Triangle& t : surface.facets) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  for (const Segment& s : surface.segments) out << "2 " << s[0] << ' ' << s[1] << '\n';
  for (const Index v : isolated) out << "1 " << v << '\n';
}

/// A name of an STL solid or OBJ group extends to the line's end; groups are words.
constexpr NameRule kSolidNames{1000, "!\"#$%&'()*+,-./:;<=>?@[]^_`{|}~", true, true, false, true};
constexpr NameRule kGroups{1000, "!$%&'()*+,-./:;<=>?@[]^_`{|}~", false, true, false, true};
constexpr NameRule kComments{1000, "!\"#$%&'()*+,-./:;<=>?@[]^_`{|}~", true, true, false, true};

Labels facet_labels(const Surface& surface, const NameRule& rule) {
  return labels_of(kFacetStem, surface.facet_markers, surface.facets.size(), surface.names.facets, rule,
                   kAnyId);
}

bool has_sets(const Surface& surface) {
  return !surface.facet_markers.empty() || !surface.names.facets.empty();
}

void write_obj(AtomicWriter& out, const Surface& surface) {
  const Labels labels = facet_labels(surface, kGroups);
  if (has_sets(surface)) write_id_comments(out, "#", labels);
  for (const Point& p : surface.vertices) out << "v " << p << '\n';
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const bool other = f == 0 || labels.ids[f] != labels.ids[f - 1];
    if (other && has_sets(surface)) out << "g " << labels.names.at(labels.ids[f]) << '\n';
    const Triangle& t = surface.facets[f];
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  for (const Segment& s : surface.segments) out << "l " << s[0] + 1 << ' ' << s[1] + 1 << '\n';
}

void write_ply(AtomicWriter& out, const Surface& surface) {
  const bool marked = !surface.facet_markers.empty(), vertices_marked = !surface.vertex_markers.empty();
  out << "ply\nformat ascii 1.0\n";
  if (has_sets(surface)) write_id_comments(out, "comment", facet_labels(surface, kComments));
  out << "element vertex " << std::uint64_t{surface.vertices.size()}
      << "\nproperty double x\nproperty double y\nproperty double z\n"
      << (vertices_marked ? "property int marker\n" : "") << "element face "
      << std::uint64_t{surface.facets.size()} << "\nproperty list uchar uint vertex_indices\n"
      << (marked ? "property int marker\n" : "") << "end_header\n";
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    out << surface.vertices[v];
    if (vertices_marked) out << ' ' << surface.vertex_markers[v];
    out << '\n';
  }
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Triangle& t = surface.facets[f];
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2];
    if (marked) out << ' ' << surface.facet_markers[f];
    out << '\n';
  }
}

/// A unit normal, or zero if it cannot be computed; readers ignore it.
Point normal_of(const Surface& surface, const Triangle& t) {
  const Point &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
  std::array<double, 3> u{}, v{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  const Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  return {n[0] / length, n[1] / length, n[2] / length};
}

void write_stl(AtomicWriter& out, const Surface& surface) {
  const Labels labels = facet_labels(surface, kSolidNames);
  std::vector<int> solids(labels.ids);
  if (solids.empty()) solids.push_back(0);
  std::sort(solids.begin(), solids.end());
  solids.erase(std::unique(solids.begin(), solids.end()), solids.end());
  for (const int solid : solids) {
    // Unmarked facets need no name.
    const std::string name = has_sets(surface) && labels.names.contains(solid) ? labels.names.at(solid) : "";
    out << "solid " << name << '\n';
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
      if (tag_of(surface.facet_markers, f) != solid) continue;
      out << "facet normal " << normal_of(surface, surface.facets[f]) << "\nouter loop\n";
      for (const Index v : surface.facets[f]) out << "vertex " << surface.vertices[v] << '\n';
      out << "endloop\nendfacet\n";
    }
    out << "endsolid " << name << '\n';
  }
}

void write_poly(AtomicWriter& out, const Surface& surface) {
  const bool marked = !surface.vertex_markers.empty();
  out << std::uint64_t{surface.vertices.size()} << (marked ? " 3 0 1\n" : " 3 0 0\n");
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    out << std::uint64_t{v} << ' ' << surface.vertices[v];
    if (marked) out << ' ' << surface.vertex_markers[v];
    out << '\n';
  }
  out << std::uint64_t{surface.facets.size() + surface.segments.size()} << " 1\n";
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Triangle& t = surface.facets[f];
    out << "1 0 " << tag_of(surface.facet_markers, f) << "\n3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
  for (std::size_t s = 0; s < surface.segments.size(); ++s)
    out << "1 0 " << tag_of(surface.segment_markers, s) << "\n2 " << surface.segments[s][0] << ' '
        << surface.segments[s][1] << '\n';
  out << std::uint64_t{surface.holes.size()} << '\n';
  for (std::size_t h = 0; h < surface.holes.size(); ++h)
    out << std::uint64_t{h} << ' ' << surface.holes[h] << '\n';
  out << std::uint64_t{surface.regions.size()} << '\n';
  for (std::size_t r = 0; r < surface.regions.size(); ++r) {
    const RegionSeed& seed = surface.regions[r];
    // The volume of the regular tetrahedron with edges of this size.
    const double volume = seed.size > 0 ? seed.size * seed.size * seed.size / (6 * std::sqrt(2.0)) : -1;
    out << std::uint64_t{r} << ' ' << seed.where << ' ' << seed.id << ' ' << volume << '\n';
  }
}

/// Faces name their edges; segments are edges of no face. A face may be followed by its marker.
void write_gts(AtomicWriter& out, const Surface& surface) {
  constexpr std::array<std::array<std::size_t, 2>, 3> kSides{{{0, 1}, {1, 2}, {2, 0}}};
  std::vector<Segment> edges;
  for (const Segment& s : surface.segments) edges.push_back(ascending(s));
  for (const Triangle& t : surface.facets)
    for (const auto& [a, b] : kSides) edges.push_back(ascending(Segment{t[a], t[b]}));
  sort_unique(edges);
  out << std::uint64_t{surface.vertices.size()} << ' ' << std::uint64_t{edges.size()} << ' '
      << std::uint64_t{surface.facets.size()} << " GtsSurface GtsFace GtsEdge GtsVertex\n";
  for (const Point& p : surface.vertices) out << p << '\n';
  for (const Segment& edge : edges) out << edge[0] + 1 << ' ' << edge[1] + 1 << '\n';
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Triangle& t = surface.facets[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found =
          std::lower_bound(edges.begin(), edges.end(), ascending(Segment{t[kSides[k][0]], t[kSides[k][1]]}));
      out << (k > 0 ? " " : "") << static_cast<std::uint64_t>(found - edges.begin()) + 1;
    }
    if (!surface.facet_markers.empty()) out << ' ' << surface.facet_markers[f];
    out << '\n';
  }
}

struct SurfaceFormat {
  std::string_view extension;
  void (*write)(AtomicWriter&, const Surface&);  ///< null: as a volume without tetrahedra
  bool markers, segments, seeds;                 ///< whether it stores them
  bool vertex_markers, segment_markers;          ///< without a writer, the volume's writer decides
  const NameRule* names = nullptr;               ///< of markers; null: it stores none, or the writer decides
};

constexpr std::array kSurfaceFormats{
    SurfaceFormat{".off", write_off, false, true, false, false, false},
    SurfaceFormat{".obj", write_obj, true, true, false, false, false, &kGroups},
    SurfaceFormat{".stl", write_stl, true, false, false, false, false, &kSolidNames},
    SurfaceFormat{".ply", write_ply, true, false, false, true, false, &kComments},
    SurfaceFormat{".gts", write_gts, true, true, false, false, false},
    SurfaceFormat{".poly", write_poly, true, true, true, true, true},
    SurfaceFormat{".mesh", nullptr, true, true, false, true, true},
    SurfaceFormat{".meshb", nullptr, true, true, false, true, true},
    SurfaceFormat{".msh", nullptr, true, true, false, true, true},
    SurfaceFormat{".vtk", nullptr, true, true, false, true, true},
    SurfaceFormat{".vtu", nullptr, true, true, false, true, true}};

const SurfaceFormat& format_of(const std::filesystem::path& path, std::string_view name) {
  const std::string extension = surface_extension_of(path, name);
  std::string known;
  for (const SurfaceFormat& format : kSurfaceFormats) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  const std::string named =
      extension.empty() ? "a name without extension" : "the format " + in_quotes(extension);
  throw FileError(path, "", "surfaces are not written in " + named + "; the formats are " + known);
}

void require_consistent(const Surface& surface) {
  const auto matches = [](const auto& tags, const auto& entities) {
    return tags.empty() || tags.size() == entities.size();
  };
  if (!matches(surface.vertex_markers, surface.vertices) || !matches(surface.facet_markers, surface.facets) ||
      !matches(surface.segment_markers, surface.segments))
    throw std::invalid_argument("a surface with markers of another number than their entities");
  require_indices(surface);
}

}  // namespace

Volume as_volume(const Surface& surface) {
  Volume volume;
  volume.vertices = surface.vertices;
  volume.facets = surface.facets;
  volume.facet_markers = surface.facet_markers;
  volume.segments = surface.segments;
  volume.segment_markers = surface.segment_markers;
  volume.vertex_markers = surface.vertex_markers;
  volume.names = surface.names;
  return volume;
}

}  // namespace io

void write_surface(const std::filesystem::path& path, const Surface& surface, const WriteOptions& options) {
  const FloatEnvironment environment;
  const io::SurfaceFormat& format = io::format_of(path, options.format);
  io::require_consistent(surface);
  if (format.write == nullptr) return write_volume(path, io::as_volume(surface), options);
  io::Watch watch(options, options.progress);
  io::AtomicWriter out(path, &watch);
  format.write(out, surface);
  out.commit();
}

std::vector<Remark> not_held(const std::filesystem::path& path, const Surface& surface,
                             const WriteOptions& options) {
  const io::SurfaceFormat& format = io::format_of(path, options.format);
  std::vector<Remark> remarks;
  const auto say = [&](std::size_t count, const char* one, const char* many) {
    io::tell_without_place(count, one, many, format.extension, remarks);
  };
  if (!format.markers) say(surface.facet_markers.size(), "marker", "markers");
  if (!format.segments) say(surface.segments.size(), "segment", "segments");
  if (!format.vertex_markers) say(io::marked(surface.vertex_markers), "vertex's marker", "vertices' markers");
  if (format.segments && !format.segment_markers)
    say(io::marked(surface.segment_markers), "segment's marker", "segments' markers");
  if (!format.seeds) say(surface.regions.size() + surface.holes.size(), "seed", "seeds");
  if (format.names != nullptr)
    io::tell(io::facet_labels(surface, *format.names), format.extension, remarks);
  else if (format.write != nullptr)
    io::tell_names(surface.names, format.extension, remarks);
  if (format.write == nullptr)
    for (Remark& remark : not_held(path, io::as_volume(surface), options))
      remarks.push_back(std::move(remark));
  return remarks;
}

std::vector<std::string> surface_formats() {
  std::vector<std::string> extensions;
  extensions.reserve(std::size(io::kSurfaceFormats));
  for (const io::SurfaceFormat& format : io::kSurfaceFormats) extensions.emplace_back(format.extension);
  return extensions;
}

}  // namespace holdfast
