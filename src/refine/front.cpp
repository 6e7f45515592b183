#include "refine/front.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "mesh/measure.h"
#include "numbers/vector.h"
#include "refine/circumcentre.h"
#include "refine/field_inserter.h"
#include "refine/tets_inside.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Circumradius, in sizes, above which a tetrahedron is refined.
double large_radius(const SizeFunction& sizes) {
  const double steepness = sizes.has_limit() ? 0 : sizes.steepness();
  return tuning::kLargeRadius + (tuning::kLargeRadiusOfSteep - tuning::kLargeRadius) * steepness;
}

class Front {
 public:
  Front(const VolumeData& volume, const SizeFunction& sizes, Stage stage, Monitor& monitor)
      : volume_(volume),
        mesh_(volume.mesh),
        sizes_(sizes),
        stage_(stage),
        monitor_(monitor),
        inserter_(volume, sizes, monitor),
        large_radius_(large_radius(sizes)) {}

  bool run() {
    state_.assign(mesh_.slot_count(), 0);
    queue_all_large();
    shuffle_front();
    while ((!front_.empty() || !rest_.empty()) && !inserter_.has_wasted_enough()) {
      monitor_.poll(stage_, progress());
      if (!front_.empty()) {
        prefetch_ahead();
        const Tet t = front_.front();
        front_.pop_front();
        if (!mesh_.alive(t) || (state_[t] & kQueued) == 0) continue;
        state_[t] = static_cast<std::uint8_t>(state_[t] & ~kQueued);
        if (!advance(t) && (state_[t] & kInRest) == 0) {
          state_[t] = static_cast<std::uint8_t>(state_[t] | kInRest);
          rest_.push_back(t);
        }
      } else {
        const Tet t = rest_.front();
        rest_.pop_front();
        if (!mesh_.alive(t) || (state_[t] & kInRest) == 0) continue;
        state_[t] = static_cast<std::uint8_t>(state_[t] & ~kInRest);
        split_long_edge(t);
      }
    }
    const auto is_left = [&](Tet t) { return mesh_.alive(t) && (state_[t] & (kQueued | kInRest)) != 0; };
    return std::any_of(front_.begin(), front_.end(), is_left) ||
           std::any_of(rest_.begin(), rest_.end(), is_left);
  }

 private:
  // Bit i below these: face i was tried.
  static constexpr std::uint8_t kIsLarge = 0x10, kQueued = 0x20, kInRest = 0x40;

  // The first ones come in random order: along the curve, a tenth more of the elements would be slivers. They
  // are random within blocks, so that points find the mesh in the caches, layer after layer.
  void shuffle_front() {
    std::uint64_t random = volume_.seed;
    for (std::size_t first = 0; first < front_.size(); first += tuning::kFrontBlock) {
      const std::size_t last = std::min(first + tuning::kFrontBlock, front_.size());
      for (std::size_t k = last - first; k > 1; --k) {
        random = random * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX
        std::swap(front_[first + k - 1], front_[first + (random >> 33) % k]);
      }
    }
  }

  // The front runs through the whole mesh, layer by layer, so the next tetrahedron is seldom in the cache.
  void prefetch_ahead() const {
    if (front_.size() > tuning::kPrefetchFar) mesh_.prefetch(front_[tuning::kPrefetchFar]);
    if (front_.size() > tuning::kPrefetchNear) mesh_.prefetch_neighbours(front_[tuning::kPrefetchNear]);
  }

  // The rest can be estimated only near the end: the front is large first and shrinks.
  [[nodiscard]] double progress() const {
    return 1 - static_cast<double>(front_.size()) / static_cast<double>(front_.size() + mesh_.slot_count());
  }

  void queue(Tet t, std::uint8_t state) {
    if ((state & kQueued) == 0) front_.push_back(t);
    state_[t] = state | kQueued;
  }

  void queue_all_large() {
    std::vector<Tet> block;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      monitor_.poll(stage_, 0);
      if (volume_.is_inside(t)) block.push_back(t);
      if (block.size() < tuning::kFieldBlock && t + 1 < mesh_.slot_count()) continue;
      queue_large(block);
      block.clear();
    }
  }

  // A user's function is asked for limits at many points at a time, and only where they matter.
  void queue_large(std::span<const Tet> tets) {
    if (volume_.metrics != nullptr || !sizes_.has_field()) {
      for (const Tet t : tets)
        if (is_large(t)) queue(t, kIsLarge);
      return;
    }
    middles_.clear();
    regions_.clear();
    for (const Tet t : tets) {
      if (is_larger(sphere_of(t), large_radius_ * radius_of_corners(t))) continue;
      middles_.push_back(centroid(mesh_, t));
      regions_.push_back(volume_.region_of[t]);
    }
    limits_.resize(middles_.size());
    if (!middles_.empty()) sizes_.limits(middles_, regions_, limits_);
    auto limit = limits_.begin();
    for (const Tet t : tets) {
      const ScaledCentre sphere = sphere_of(t);
      double allowed = radius_of_corners(t);
      if (!is_larger(sphere, large_radius_ * allowed)) allowed = std::min(allowed, *limit++);
      if (is_larger_than_bearable(t, sphere, allowed)) queue(t, kIsLarge);
    }
  }

  // Whether the radius of t's sphere is large. Called for every new tetrahedron, so without roots and
  // divisions.
  [[nodiscard]] bool is_large(Tet t) const {
    if (volume_.metrics != nullptr) return is_large_in_metric(t);
    double allowed = radius_of_corners(t);
    if (sizes_.has_limit())
      allowed = std::min(allowed, sizes_.limit(centroid(mesh_, t), volume_.region_of[t]));
    return is_larger_than_bearable(t, sphere_of(t), allowed);
  }

  // Whether the radius of t's sphere exceeds both what is allowed and what nearby facets can bear.
  [[nodiscard]] bool is_larger_than_bearable(Tet t, const ScaledCentre& sphere, double allowed) const {
    if (!is_larger(sphere, large_radius_ * allowed)) return false;
    const double bearable = sizes_.of_facets().bearable(centroid(mesh_, t), allowed,
                                                        sizes_.decider(allowed, volume_.region_of[t]));
    return !(bearable > allowed) || is_larger(sphere, large_radius_ * bearable);
  }

  [[nodiscard]] ScaledCentre sphere_of(Tet t) const {
    return sphere_centre(mesh_.position(mesh_.corner(t, 0)), mesh_.position(mesh_.corner(t, 1)),
                         mesh_.position(mesh_.corner(t, 2)), mesh_.position(mesh_.corner(t, 3)));
  }

  static bool is_larger(const ScaledCentre& centre, double radius) {
    const double limit = centre.scale * radius;
    return !(dot(centre.at, centre.at) < limit * limit);
  }

  // The same at its corners, or in the middle, which the corners may not represent.
  [[nodiscard]] bool is_large_in_metric(Tet t) const {
    if (is_larger(volume_.see(mesh_.corners(t), sphere_centre), tuning::kLargeRadius)) return true;
    const Point middle = centroid(mesh_, t);
    double most = sizes_.limit(middle, volume_.region_of[t]);
    for (const Vertex v : mesh_.corners(t))
      most = std::min(most, volume_.sizes[v] + sizes_.gradation() * distance(mesh_.position(v), middle));
    const Frame frame(sizes_.metric(middle, most), middle);
    std::array<Point, 4> q;
    for (std::size_t i = 0; i < 4; ++i) q[i] = frame.to(mesh_.position(mesh_.corners(t)[i]));
    return is_larger(sphere_centre(q[0], q[1], q[2], q[3]), tuning::kLargeRadius);
  }

  // The radius that the sizes at the corners allow, over large_radius_. Sizes grow with the distance: r =
  // large_radius_ (h + gradation r).
  [[nodiscard]] double radius_of_corners(Tet t) const {
    const TetMesh::Corners& c = mesh_.corners(t);
    const std::vector<double>& size = volume_.sizes;
    const std::array<double, 4> h{size[c[0]], size[c[1]], size[c[2]], size[c[3]]};
    double allowed = *std::min_element(h.begin(), h.end()) / (1 - large_radius_ * sizes_.gradation());
    if (!sizes_.grows()) allowed = std::min(allowed, tuning::kLevel * 0.25 * (h[0] + h[1] + h[2] + h[3]));
    return allowed;
  }

  // Tries a point over each face of t that is on the front.
  bool advance(Tet t) {
    for (int i = 0; i < 4; ++i) {
      const auto bit = static_cast<std::uint8_t>(1u << i);
      if ((state_[t] & bit) != 0 || !is_on_front(face_code(t, i))) continue;
      state_[t] = static_cast<std::uint8_t>(state_[t] | bit);
      Point p;
      if (place_over(face_code(t, i), p) && try_insert(p, t)) return true;
    }
    return false;
  }

  // Where the front does not advance, as over a facet much larger than the size: puts a point on the longest
  // edge, one size away from one of its ends.
  bool split_long_edge(Tet t) {
    const Frame frame = volume_.frame_of(mesh_.corners(t));
    int longest = -1;
    double length = 0;
    for (int k = 0; k < 6; ++k) {
      const auto& ends = kEdgeVertex[static_cast<std::size_t>(k)];
      const double d = distance(frame.to(mesh_.position(mesh_.corner(t, ends[0]))),
                                frame.to(mesh_.position(mesh_.corner(t, ends[1]))));
      if (mesh_.is_segment(t, k) || d <= length) continue;
      length = d;
      longest = k;
    }
    if (longest < 0) return false;
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(longest)];
    for (std::size_t i = 0; i < 2; ++i) {
      const Vertex v = mesh_.corner(t, ends[i]);
      const Point &a = mesh_.position(v), &b = mesh_.position(mesh_.corner(t, ends[1 - i]));
      const double part = volume_.size_in_frame(v) / length;
      if (part > tuning::kLongestPart) continue;
      Point p;
      for (std::size_t j = 0; j < 3; ++j) p[j] = a[j] + part * (b[j] - a[j]);
      if (try_insert(p, t)) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_on_front(Face f) const {
    if (mesh_.is_facet(f)) return true;
    const Tet n = tet_of(mesh_.neighbour(f));
    return mesh_.is_ghost(n) || (state_[n] & kIsLarge) == 0;
  }

  bool place_over(Face f, Point& p) const {
    const auto v = mesh_.face_vertices(f);
    const Frame frame = volume_.frame_of(v);
    const Point a = frame.to(mesh_.position(v[0])), b = frame.to(mesh_.position(v[1])),
                c = frame.to(mesh_.position(v[2])), d = frame.to(mesh_.position(mesh_.apex(f)));
    const Vector u = b - a, w = c - a;
    const Vector n = cross(u, w);
    const double nn = dot(n, n);
    if (!(nn > 0)) return false;
    const double area = std::sqrt(nn);
    const double sum =
        volume_.size_in_frame(v[0]) + volume_.size_in_frame(v[1]) + volume_.size_in_frame(v[2]);
    double length = sum / 3 * (1 + tuning::kHalfHeight * sizes_.gradation());
    if (!sizes_.of_facets().empty()) length = bearable_at(middle_of(v), volume_.region_of[tet_of(f)], length);
    // The centre of the circle through the corners, or, if that is far away, of the triangle.
    Vector foot = circle_centre(u, w);
    const double radius2 = dot(foot, foot);
    const bool round = radius2 < tuning::kLargestRound * length * length;
    const double top = dot(n, d - a) / area;
    double height = round ? std::sqrt(length * length - radius2) : tuning::kHeightOverLarge * length;
    if (round) {
      // The centre of the tetrahedron's sphere is over the foot as well.
      const double over = sphere_height(d - a, foot, n, area);
      if (over < tuning::kLeastSphereHeight * height) return false;
      height = std::min(height, over);
    } else {
      for (std::size_t k = 0; k < 3; ++k) foot[k] = (u[k] + w[k]) / 3;
      height = std::max(height, std::min(tuning::kHeightOverLarge * grown_over(f), top / 2));
      if (has_thin_wall_over(f, top, height)) height = top / 2;
      if (top < height) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + foot[k] + height * n[k] / area;
    p = frame.from(p);
    return true;
  }

  // Over a face much larger than sizes that are given at its corners: these have grown as far as its middle.
  // A point as near as its corners ask for would be too near for the size wanted there.
  [[nodiscard]] double grown_over(Face f) const {
    if (!sizes_.is_given_at_vertices() || !sizes_.grows() || volume_.metrics != nullptr) return 0;
    const auto corners = mesh_.face_vertices(f);
    const Point middle = middle_of(corners);
    double size = kInfinity;
    for (const Vertex v : corners)
      size = std::min(size, volume_.sizes[v] + sizes_.gradation() * distance(mesh_.position(v), middle));
    return bearable_at(middle, volume_.region_of[tet_of(f)], size);
  }

  // Sizes at vertices may have been raised already, but the sizes of a user's function have not.
  [[nodiscard]] double bearable_at(const Point& x, RegionId region, double size) const {
    const double bearable = sizes_.of_facets().bearable(x, size, sizes_.decider(size, region));
    if (!(bearable > size) || !sizes_.has_field()) return bearable;
    return sizes_.of_facets().bearable(x, std::min(size, sizes_.limit(x, region)));
  }

  [[nodiscard]] Point middle_of(const std::array<Vertex, 3>& face) const {
    const Point &a = mesh_.position(face[0]), &b = mesh_.position(face[1]), &c = mesh_.position(face[2]);
    return {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
  }

  // Whether a point of that height over a large facet would come close to the other side of a wall, while a
  // point in the middle of the wall would not. Where the user asks for the size, the wall is to have points.
  [[nodiscard]] bool has_thin_wall_over(Face f, double top, double height) const {
    return sizes_.has_limit() && mesh_.is_facet(f) && top < 2 * height &&
           top > tuning::kThinnestWall * height;
  }

  // Height of the centre of the tetrahedron's sphere over the plane of a face. The centre has equal distance
  // from the apex d and from the corner that is the origin.
  [[nodiscard]] static double sphere_height(const Vector& d, const Vector& foot, const Vector& n,
                                            double area) {
    return (dot(d, d) - 2 * dot(d, foot)) * area / (2 * dot(d, n));
  }

  bool try_insert(const Point& x, Tet start) {
    const auto created = inserter_.insert(x, start);
    if (created.empty()) return false;
    state_.resize(mesh_.slot_count(), 0);
    for (const Tet t : created) state_[t] = 0;
    queue_large(created);
    // A neighbour may now be on the front.
    for (const RimFace& rim : inserter_.rim()) {
      const Tet n = tet_of(rim.outer);
      if ((state_[n] & kIsLarge) != 0 && (rim.flags & facet_bit(3)) == 0 && (state_[n] & kQueued) == 0)
        queue(n, state_[n]);
    }
    return true;
  }

  const VolumeData volume_;
  TetMesh& mesh_;
  const SizeFunction& sizes_;
  const Stage stage_;
  Monitor& monitor_;
  FieldInserter inserter_;
  const double large_radius_;
  std::vector<std::uint8_t> state_;  // by slot
  std::vector<Point> middles_;       // where limits are asked for
  std::vector<RegionId> regions_;
  std::vector<double> limits_;
  std::deque<Tet> front_;
  std::deque<Tet> rest_;  // large ones for which the front did not advance
};

void limit_at_corners(const VolumeData& volume, const SizeFunction& sizes, const std::vector<Tet>& tets,
                      Monitor& monitor) {
  std::vector<Point> points;
  std::vector<RegionId> regions;
  std::vector<double> limits;
  for (std::size_t first = 0; first < tets.size(); first += tuning::kFieldBlock) {
    monitor.poll(Stage::field_points, 0);
    const auto block = std::span(tets).subspan(first, std::min(tuning::kFieldBlock, tets.size() - first));
    points.clear();
    regions.clear();
    for (const Tet t : block)
      for (const Vertex v : volume.mesh.corners(t)) {
        points.push_back(volume.mesh.position(v));
        regions.push_back(volume.region_of[t]);
      }
    limits.resize(points.size());
    sizes.limits(points, regions, limits);
    auto limit = limits.begin();
    for (const Tet t : block)
      for (const Vertex v : volume.mesh.corners(t)) volume.sizes[v] = std::min(volume.sizes[v], *limit++);
  }
}

// Sets the user's metric, limited by the sizes that are set.
void set_metrics_at_vertices(const VolumeData& volume, const SizeFunction& sizes, Monitor& monitor) {
  constexpr double kMost = 0x1p200;  // instead of no limit
  std::vector<Metric>& metrics = *volume.metrics;
  metrics.resize(volume.mesh.vertex_count());
  for (Vertex v = 0; v < metrics.size(); ++v) {
    monitor.poll(Stage::field_points, 0);
    metrics[v] = sizes.metric(volume.mesh.position(v), std::min(volume.sizes[v], kMost));
    volume.sizes[v] = largest_size(metrics[v]);
  }
}

}  // namespace

// Vertices of the surface have their sizes. Others (Steiner points and corners of a box) get what the
// vertices round them allow.
void set_sizes_at_vertices(const VolumeData& volume, const SizeFunction& sizes, const Threads& threads,
                           Monitor& monitor) {
  const TetMesh& mesh = volume.mesh;
  std::vector<double>& size = volume.sizes;
  size.assign(mesh.vertex_count(), kInfinity);
  for (Vertex v = 0; v < sizes.vertex_count(); ++v) size[v] = sizes.of_vertex(v);
  const auto is_given = [&](Vertex v) { return v < sizes.vertex_count() && sizes.of_vertex(v) < kInfinity; };
  const std::vector<Tet> at_others = tets_inside(volume, threads, [&](Tet t) {
    const TetMesh::Corners& c = mesh.corners(t);
    return !std::all_of(c.begin(), c.end(), is_given);
  });
  for (bool changed = true; changed;) {
    changed = false;
    for (const Tet t : at_others) {
      monitor.poll(Stage::field_points, 0);
      for (const Vertex v : mesh.corners(t)) {
        if (is_given(v)) continue;
        for (const Vertex w : mesh.corners(t)) {
          const double h = size[w] + sizes.gradation() * distance(mesh.position(v), mesh.position(w));
          if (!(h < size[v] * (1 - 1e-9))) continue;
          size[v] = h;
          changed = true;
        }
      }
    }
  }
  if (sizes.has_limit()) limit_at_corners(volume, sizes, tets_inside(volume, threads), monitor);
  if (sizes.has_metric()) set_metrics_at_vertices(volume, sizes, monitor);
}

bool advance_front(const VolumeData& volume, const SizeFunction& sizes, Stage stage, Monitor& monitor) {
  return Front(volume, sizes, stage, monitor).run();
}

}  // namespace holdfast
