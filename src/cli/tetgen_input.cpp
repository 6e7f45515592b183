#include "tetgen_input.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <system_error>

#include "command.h"
#include "files.h"
#include "holdfast/regular_tetrahedron.h"
#include "holdfast/tetgen.h"
#include "letters.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

fs::path without_gz(fs::path path) { return path.extension() == ".gz" ? path.replace_extension() : path; }

std::string ending_of(const fs::path& path) { return lower(without_gz(path).extension().string()); }

/// The output of "part.1.poly" is "part.2".
fs::path next_name(const fs::path& stem) {
  const std::string text = stem.filename().string();
  const std::size_t dot = text.rfind('.');
  const std::string number = dot == std::string::npos ? "" : text.substr(dot + 1);
  const bool is_number =
      !number.empty() && number.size() < 9 &&
      std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  const std::string name = is_number ? text.substr(0, dot) : text;
  return stem.parent_path() / fmt::format("{}.{}", name, is_number ? std::stoi(number) + 1 : 1);
}

std::vector<Triangle> hull_faces(const std::vector<Tetrahedron>& tetrahedra) {
  const std::vector<Neighbours> sides = neighbours(tetrahedra);
  std::vector<Triangle> faces;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (sides[t][k] == no_entity) faces.push_back(outward_face(tetrahedra[t], k));
  return faces;
}

}  // namespace

fs::path TetgenInput::beside(const char* ending) const {
  return without_gz(path).replace_extension().string() + ending;
}

fs::path TetgenInput::sizes() const { return is_there(beside(".b.mtr")) ? beside(".b.mtr") : beside(".mtr"); }

std::vector<fs::path> TetgenInput::files(const TetgenSwitches& switches) const {
  std::vector<fs::path> paths = files_of_surface(path);
  if (switches.insert) paths.push_back(more_points());
  if (switches.size_field)
    for (const fs::path& file : files_of_size_field(sizes())) paths.push_back(file);
  std::erase_if(paths, [&](const fs::path& file) { return file != path && !is_there(file); });
  return paths;
}

TetgenInput find_input(const fs::path& file, const TetgenSwitches& switches) {
  TetgenInput input;
  input.path = file;
  if (!is_there(file))
    for (const char* ending : {".poly", ".smesh", ".node"}) {
      fs::path with = file;
      with += ending;
      if ((!switches.complex && std::string_view(ending) != ".node") || !is_there(with)) continue;
      input.path = with;
      break;
    }
  const std::string ending = ending_of(input.path);
  input.is_complex = ending != ".node";
  input.is_own_format = ending == ".poly" || ending == ".smesh" || ending == ".mesh";
  const fs::path stem = without_gz(input.path).replace_extension();
  input.output = switches.same_name ? stem : next_name(stem);
  return input;
}

void read_input(TetgenInput& input, const TetgenSwitches& switches, const ReadOptions& options) {
  input.surface = read_surface(input.path, options);
  input.first = tetgen_first_number(input.path);
  // Here bounds on volumes are bounds, not sizes.
  std::erase_if(input.surface.remarks, [](const Remark& r) { return r.kind == RemarkKind::size_limits; });
  if (!switches.quiet) tell(input.surface.remarks);
  if (!switches.insert) return;
  const std::vector<Point> more = read_points(input.more_points(), options);
  input.surface.vertices.insert(input.surface.vertices.end(), more.begin(), more.end());
  if (!input.surface.vertex_markers.empty())
    input.surface.vertex_markers.resize(input.surface.vertices.size(), 0);
}

void read_sizes(const TetgenInput& input, const ReadOptions& options, Sizes& sizes) {
  SizeField field = read_size_field(input.sizes(), options);
  sizes.concurrent = true;
  if (!field.vertices.empty() && !field.metrics.empty()) {
    sizes.metric = metric_function(std::move(field));
  } else if (!field.vertices.empty()) {
    sizes.field = size_function(std::move(field));
  } else {
    if (field.sizes.size() > input.surface.vertices.size())
      throw FileError(input.sizes(), "",
                      fmt::format("there are more sizes than vertices: {} for {}", field.sizes.size(),
                                  input.surface.vertices.size()));
    sizes.vertex_sizes = std::move(field.sizes);
    sizes.vertex_sizes.resize(input.surface.vertices.size(), 0);  // points of switch i have none
  }
}

std::vector<RegionSeed> bounds_of_regions(std::vector<RegionSeed> seeds, bool bounded) {
  // The size is the rounded edge of the regular tetrahedron of that volume; slightly less keeps volumes below
  // the bound.
  constexpr double kBelow = 1 - 1e-14;
  for (RegionSeed& seed : seeds) {
    const double edge = seed.size / regular_edge_of_volume_one;
    seed.max_volume = bounded ? edge * edge * edge * kBelow : 0;
    seed.size = 0;
  }
  return seeds;
}

Volume delaunay_volume(const Surface& points, const Limits& limits) {
  DelaunayOptions options;
  static_cast<Limits&>(options) = limits;
  Volume volume;
  volume.vertices = points.vertices;
  volume.vertex_markers = points.vertex_markers;
  volume.tetrahedra = delaunay(points.vertices, options);
  volume.facets = hull_faces(volume.tetrahedra);
  return volume;
}

Volume facets_of_defects(const Surface& surface, const std::vector<Defect>& defects) {
  std::vector<Index> facets;
  for (const Defect& defect : defects)
    for (const Index f : defect.facets)
      if (f < surface.facets.size()) facets.push_back(f);
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  Volume volume;
  volume.vertices = surface.vertices;
  volume.vertex_markers = surface.vertex_markers;
  for (const Index f : facets) {
    volume.facets.push_back(surface.facets[f]);
    if (!surface.facet_markers.empty()) volume.facet_markers.push_back(surface.facet_markers[f]);
  }
  return volume;
}

Volume with_unused(const Surface& surface, Volume volume) {
  const std::size_t kept = surface.vertices.size();
  std::vector<Index> now(volume.vertices.size());
  std::vector<Point> vertices = surface.vertices;
  for (std::size_t v = 0; v < now.size(); ++v) {
    std::int64_t input = -1;
    if (!volume.input_vertices.empty())
      input = volume.input_vertices[v];
    else if (v < kept)
      input = static_cast<std::int64_t>(v);
    now[v] = static_cast<Index>(input < 0 ? vertices.size() : static_cast<std::size_t>(input));
    if (input < 0) vertices.push_back(volume.vertices[v]);
  }
  if (!surface.vertex_markers.empty()) {
    volume.vertex_markers = surface.vertex_markers;
    volume.vertex_markers.resize(vertices.size(), 0);
  }
  const auto renumber = [&](auto& entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = now[v];
  };
  renumber(volume.tetrahedra);
  renumber(volume.facets);
  renumber(volume.segments);
  volume.vertices = std::move(vertices);
  volume.input_vertices.clear();
  return volume;
}

}  // namespace holdfast::cli
