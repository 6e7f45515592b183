#include "api/remote_components.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "api/report.h"
#include "api/scale.h"
#include "mesh/anatomy.h"
#include "mesh/disjoint_sets.h"
#include "mesh/limit_message.h"
#include "mesh/shape_counts.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

constexpr int kReach = 300;  // 2^-300 .. 2^300: squares and cubes of lengths do not overflow or underflow

// From inside the tetrahedron: (f0 f1 f2 x) is positive for x inside.
Triangle face_of(const Tetrahedron& t, std::size_t i) { return corners_of_face(t, static_cast<int>(i)); }

class RemoteComponents {
 public:
  RemoteComponents(const Complex& complex, const Options& options, Result& result)
      : complex_(complex),
        options_(options),
        result_(result),
        volume_(result.volume),
        scale_(choose_scale(complex.vertices)) {}

  void run(const Threads& threads, const Mesher& mesh) {
    const std::vector<Point>& v = volume_.vertices;
    if (!has_remote_tetrahedra(threads)) return;
    find_components();
    if (components_.size() == 1) return;
    for (const std::vector<std::size_t>& tets : components_) {
      std::vector<Point> points;
      for (const std::size_t t : tets)
        for (const Index x : volume_.tetrahedra[t]) points.push_back(v[x]);
      if (is_remote(extent(points))) mesh_again(tets, mesh);
    }
    if (!fresh_.empty()) join();
  }

 private:
  // The exponent of the largest side of the points' box.
  [[nodiscard]] static std::optional<std::int64_t> extent(std::span<const Point> points) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax_element(
          points.begin(), points.end(), [k](const Point& p, const Point& q) { return p[k] < q[k]; });
      most = std::max(most, (*high)[k] / 2 - (*low)[k] / 2);
    }
    return most > 0 ? std::optional<std::int64_t>(std::ilogb(most) + 1) : std::nullopt;
  }
  [[nodiscard]] bool is_remote(const std::optional<std::int64_t>& extent) const {
    return extent && std::abs(*extent + scale_) > kReach;
  }

  [[nodiscard]] bool has_remote_tetrahedra(const Threads& threads) const {
    std::atomic<bool> found = false;
    parallel_ranges(threads, volume_.tetrahedra.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last && !found; ++t) {
        std::array<Point, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) corners[i] = volume_.vertices[volume_.tetrahedra[t][i]];
        if (is_remote(extent(corners))) found = true;
      }
    });
    return found;
  }

  void find_components() {
    std::set<Triangle> walls;
    for (const Triangle& f : volume_.facets) walls.insert(ascending(f));
    std::map<Triangle, Index> first;
    DisjointSets sets(volume_.tetrahedra.size());
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t)
      for (std::size_t i = 0; i < 4; ++i) {
        const Triangle f = ascending(face_of(volume_.tetrahedra[t], i));
        if (walls.contains(f)) continue;
        const auto [at, is_new] = first.try_emplace(f, t);
        if (!is_new) sets.unite(t, at->second);
      }
    std::map<Index, std::vector<std::size_t>> by_root;
    for (Index t = 0; t < volume_.tetrahedra.size(); ++t) by_root[sets.root(t)].push_back(t);
    for (auto& [root, tets] : by_root) components_.push_back(std::move(tets));
  }

  // The component's facets face outwards, so that its inside is kept and its holes are not.
  Surface boundary_of(const std::vector<std::size_t>& tets, std::vector<Index>& vertices) const {
    std::map<Index, Index> local;
    std::map<Triangle, std::vector<Triangle>> faces;
    std::set<Segment> edges;
    for (const std::size_t t : tets) {
      const Tetrahedron& c = volume_.tetrahedra[t];
      for (const Index v : c)
        if (v < complex_.vertices.size() && local.try_emplace(v, static_cast<Index>(local.size())).second)
          vertices.push_back(v);
      for (std::size_t i = 0; i < 4; ++i) faces[ascending(face_of(c, i))].push_back(face_of(c, i));
      for (const auto& e : kEdgeVertex)
        edges.insert(
            ascending(Segment{c[static_cast<std::size_t>(e[0])], c[static_cast<std::size_t>(e[1])]}));
    }
    Surface out;
    for (const Index v : vertices) out.vertices.push_back(complex_.vertices[v]);
    for (const Triangle& f : volume_.facets) {
      const auto at = faces.find(ascending(f));
      if (at == faces.end()) continue;
      const Triangle& inwards = at->second[0];
      out.facets.push_back({local.at(inwards[0]), local.at(inwards[2]), local.at(inwards[1])});
    }
    for (const Segment& s : volume_.segments)
      if (edges.contains(ascending(s))) out.segments.push_back({local.at(s[0]), local.at(s[1])});
    return out;
  }

  void mesh_again(const std::vector<std::size_t>& tets, const Mesher& mesh) {
    const int id = volume_.regions[tets[0]];
    std::vector<Index> vertices;
    const Surface boundary = boundary_of(tets, vertices);
    Options options = options_;
    options.keep = Keep::automatic;
    options.holes.clear();
    options.regions.clear();
    Sizes& sizes = *options.sizes;
    sizes.vertex_sizes.clear();
    if (!options_.sizes->vertex_sizes.empty())
      for (const Index v : vertices) sizes.vertex_sizes.push_back(options_.sizes->vertex_sizes[v]);
    const auto limit = [](double& most, double by) {
      if (by > 0) most = most > 0 ? std::min(most, by) : by;
    };
    for (const RegionSeed& seed : options_.regions) {
      if (seed.id != id) continue;
      limit(sizes.size, seed.size);
      limit(sizes.max_volume, seed.max_volume);
    }
    Result found = mesh(boundary.view(), options);
    if (is_interruption(found.outcome)) throw Interrupted(found.outcome);
    if (found.outcome != Outcome::done) return;
    gone_.insert(tets.begin(), tets.end());
    fresh_.push_back({id, std::move(vertices), std::move(found)});
  }

  // Kept tetrahedra stay in order, followed by the new ones. Unused vertices are removed.
  void join() {
    Joined joined = join_all();
    renumber(joined);
    volume_.tetrahedra = std::move(joined.tets);
    volume_.regions = std::move(joined.regions);
    report();
  }

  struct Joined {
    std::vector<Point> points;
    std::vector<Tetrahedron> tets;
    std::vector<int> regions;
  };

  Joined join_all() {
    std::vector<Point> points = volume_.vertices;
    std::vector<Tetrahedron> tets;
    std::vector<int> regions;
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      if (gone_.contains(t)) continue;
      tets.push_back(volume_.tetrahedra[t]);
      regions.push_back(volume_.regions[t]);
    }
    for (Fresh& fresh : fresh_) {
      const Volume& found = fresh.result.volume;
      for (std::size_t v = fresh.vertices.size(); v < found.vertices.size(); ++v) {
        fresh.vertices.push_back(static_cast<Index>(points.size()));
        points.push_back(found.vertices[v]);
      }
      for (Tetrahedron t : found.tetrahedra) {
        for (Index& v : t) v = fresh.vertices[v];
        tets.push_back(t);
        regions.push_back(fresh.id);
      }
      result_.report.field.points += fresh.result.report.field.points;
    }
    return {std::move(points), std::move(tets), std::move(regions)};
  }

  // Keeps the vertices of the input and those in use.
  void renumber(Joined& joined) {
    std::vector<bool> used(joined.points.size(), false);
    for (const Tetrahedron& t : joined.tets)
      for (const Index v : t) used[v] = true;
    std::vector<Index> index(joined.points.size());
    volume_.vertices.clear();
    for (std::size_t v = 0; v < joined.points.size(); ++v) {
      index[v] = static_cast<Index>(volume_.vertices.size());
      if (v < complex_.vertices.size() || used[v]) volume_.vertices.push_back(joined.points[v]);
    }
    volume_.input_vertices.resize(volume_.vertices.size(), -1);
    if (!volume_.vertex_markers.empty()) volume_.vertex_markers.resize(volume_.vertices.size(), 0);
    for (Tetrahedron& t : joined.tets)
      for (Index& v : t) v = index[v];
  }

  void report() {
    Report& report = result_.report;
    report.steiner_points += volume_.vertices.size();
    report.steiner_points -= report.vertices;
    report.vertices = volume_.vertices.size();
    report.tetrahedra = volume_.tetrahedra.size();
    const VolumeShape shape = measure(volume_);
    report.elements = describe_elements(shape, report.elements.target);
    report.field.after = describe_shape(shape.elements);
  }

  struct Fresh {
    int id;
    std::vector<Index> vertices;  // of the whole, by vertex of the result
    Result result;
  };

  const Complex& complex_;
  const Options& options_;
  Result& result_;
  Volume& volume_;
  const int scale_;
  std::vector<std::vector<std::size_t>> components_;  // the tetrahedra of each
  std::set<std::size_t> gone_;
  std::vector<Fresh> fresh_;
};

}  // namespace

void mesh_remote_components(const Complex& complex, const Options& options, const Threads& threads,
                            const Mesher& mesh, Result& result) {
  RemoteComponents(complex, options, result).run(threads, mesh);
}

}  // namespace holdfast
