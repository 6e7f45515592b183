// Delaunay refinement in the plane.
//
// Constrained edges whose diametral circle contains an adjacent corner are halved. Triangles that are too
// large or have a small angle get a point at their circumcentre, or at an off-centre nearer to their shortest
// edge, unless that point lies in the diametral circle of a constraint, which is then halved instead.
// Segments that meet at less than 60 degrees are cut at distances from their common end that are powers of
// two (Ruppert's concentric shells). A triangle whose shortest edge joins two such cuts at the same distance
// stays as it is: it lies opposite a small angle of the input (Miller, Pav, Walkington). Measures are
// floating point, since they only choose places (criteria.h); exact signs decide where a place lies and how
// the triangles change (insertion.h).
#include "plane/refine.h"

#include <queue>
#include <tuple>

#include "plane/criteria.h"
#include "plane/growing_mesh.h"

namespace holdfast::plane {
namespace {

/// An edge. If its triangle has changed since, this entry is void: the new triangles have their own.
struct SegmentSide {
  EdgeCode code;
  Ends ends;
};
SegmentSide side_of(const Triangles& mesh, EdgeCode e) { return {e, {mesh.from(e), mesh.to(e)}}; }
bool stands(const Triangles& mesh, const SegmentSide& side) {
  return mesh.from(side.code) == side.ends[0] && mesh.to(side.code) == side.ends[1] &&
         mesh.constrained(side.code);
}

/// A triangle that is too large or too thin; void like a SegmentSide once it has changed.
struct Bad {
  double shortest;
  std::uint64_t number;
  std::uint32_t triangle;
  std::array<Vertex, 3> corners;
  bool operator<(const Bad& other) const {  // the shortest edge first
    return shortest != other.shortest ? shortest > other.shortest : number > other.number;
  }
};

/// What is left to treat: constraints, last in first out, and then triangles.
class Agenda {
 public:
  [[nodiscard]] bool is_empty() const { return sides_.empty() && bad_.empty(); }
  [[nodiscard]] bool has_side() const { return !sides_.empty(); }
  [[nodiscard]] std::size_t size() const { return sides_.size() + bad_.size(); }

  void add(const SegmentSide& side) { sides_.push_back(side); }
  void add(std::uint32_t triangle, const std::array<Vertex, 3>& corners, double shortest) {
    bad_.push({shortest, ++looks_, triangle, corners});
  }
  SegmentSide take_side() {
    const SegmentSide side = sides_.back();
    sides_.pop_back();
    return side;
  }
  Bad take_triangle() {
    const Bad bad = bad_.top();
    bad_.pop();
    return bad;
  }

 private:
  std::vector<SegmentSide> sides_;
  std::priority_queue<Bad> bad_;
  std::uint64_t looks_ = 0;
};

/// The triangles whose circumcircles contain a point.
class ConflictRegion {
 public:
  /// Calls `visit` for all edges of the triangles in conflict with p that are connected with `first`, one of
  /// them, over edges that are no constraints.
  template <typename Visit>
  void each_edge(const GrowingMesh& growing, Vertex p, std::uint32_t first, Visit&& visit) {
    const Triangles& mesh = growing.mesh();
    visited_.resize(mesh.size(), 0);
    visited_[first] = ++visit_;
    pending_.assign(1, first);
    while (!pending_.empty()) {
      const std::uint32_t t = pending_.back();
      pending_.pop_back();
      for (std::uint32_t i = 0; i < 3; ++i) {
        const EdgeCode e = code(t, i);
        visit(e);
        if (mesh.constrained(e)) continue;
        const EdgeCode f = mesh.across(e);
        if (f == kNoEdge || visited_[triangle_of(f)] == visit_) continue;
        const std::array<Vertex, 3>& v = mesh[triangle_of(f)].v;
        visited_[triangle_of(f)] = visit_;
        if (growing.points().incircle(v[0], v[1], v[2], p) > 0) pending_.push_back(triangle_of(f));
      }
    }
  }

 private:
  std::vector<std::uint32_t> visited_, pending_;
  std::uint32_t visit_ = 0;
};

/// The last place from one to the other within the range of doubles, which is beyond all points.
Position within_range(const Position& from, const Position& to) {
  constexpr double kMost = 2 - 0x1p-52;
  double share = 1;
  for (std::size_t k = 0; k < 2; ++k)
    if (std::abs(to[k]) > kMost)
      share = std::min(share, (kMost - (to[k] > 0 ? from[k] : -from[k])) / std::abs(to[k] - from[k]));
  return {std::clamp(from[0] + share * (to[0] - from[0]), -kMost, kMost),
          std::clamp(from[1] + share * (to[1] - from[1]), -kMost, kMost)};
}

/// Treats an agenda. All new edges and triangles are examined, so every bad one is on the agenda, and an
/// empty agenda is the end.
class Refinement {
 public:
  Refinement(GrowingMesh& growing, const RefineOptions& options)
      : growing_(growing), mesh_(growing.mesh()), options_(options), criteria_(growing, options) {}

  /// Returns whether it stopped at the limit on added points.
  bool run(const Poll& poll) {
    for (std::uint32_t t = 0; t < mesh_.size(); ++t) look_at(t);
    double share = 0;
    for (std::size_t turn = 0; !agenda_.is_empty(); ++turn) {
      if (turn % 256 == 0 && poll) {
        const auto made = static_cast<double>(growing_.added());
        share = std::max(share, made / (made + static_cast<double>(agenda_.size())));
        poll(std::min(share, 0.999));
      }
      if (growing_.added() >= options_.most_points) return true;
      if (agenda_.has_side())
        treat(agenda_.take_side());
      else
        treat(agenda_.take_triangle());
    }
    return false;
  }

  [[nodiscard]] const Criteria& criteria() const { return criteria_; }
  /// The number of points not on a constraint.
  [[nodiscard]] std::size_t inside() const { return inside_; }

 private:
  void look_at(std::uint32_t t) {
    if (!options_.keep_boundary)
      for (std::uint32_t i = 0; i < 3; ++i)
        if (const EdgeCode e = code(t, i); mesh_.constrained(e) && criteria_.must_cut(e))
          agenda_.add(side_of(mesh_, e));
    const Shape shape = growing_.shape_of(t);
    if (!criteria_.is_large(t, shape) && (!criteria_.is_thin(shape) || criteria_.is_left_thin(t, shape)))
      return;
    agenda_.add(t, mesh_[t].v, shape.edges[shape.shortest]);
  }
  void look_round(Vertex p) {
    growing_.each_at(p, [&](std::uint32_t t) { look_at(t); });
  }

  void treat(const SegmentSide& side) {
    if (stands(mesh_, side) && criteria_.must_cut(side.code)) static_cast<void>(cut(side.code));
  }
  bool cut(EdgeCode e) {
    const Vertex p = growing_.cut(e);
    if (p == kNoVertex) return false;
    look_round(p);
    return true;
  }

  void treat(const Bad& bad) {
    const std::uint32_t t = bad.triangle;
    if (mesh_[t].v != bad.corners) return;
    const Shape shape = growing_.shape_of(t);
    const Position centre = criteria_.centre_of(t);
    const bool large = criteria_.is_large(t, shape);
    const Position place = large ? centre : criteria_.off_centre(t, shape, centre);
    if (put(place, bad, large)) return;
    if (!options_.keep_boundary) return;
    if (large && criteria_.has_size() && put(criteria_.middle_of_longest(t, shape), bad, true)) return;
    if (place != centre && put(centre, bad, false)) return;
    static_cast<void>(put(criteria_.off_centre(t, shape, centre), bad, false));
  }

  /// Adds a point for a triangle, or cuts the constraint that it would crowd, after which the triangle is
  /// examined again. Returns false if neither is possible.
  bool put(const Position& place, const Bad& bad, bool large) {
    if (!std::isfinite(place[0] + place[1])) return false;
    const Vertex p = growing_.add(within_range(growing_.middle_of(bad.triangle), place));
    using Kind = Insertion::Place::Kind;
    Insertion::Place found = growing_.locate(p, bad.triangle);
    if (found.kind == Kind::on_edge && mesh_.constrained(found.edge)) found.kind = Kind::behind_constraint;
    std::vector<SegmentSide> hurt;
    if (found.kind == Kind::behind_constraint)
      hurt.push_back(side_of(mesh_, found.edge));
    else if (found.kind != Kind::nowhere)
      hurt = find_hurt(p, found.triangle, large);
    if (found.kind == Kind::nowhere || !hurt.empty()) {
      growing_.take_back(p);
      return found.kind != Kind::nowhere && !options_.keep_boundary && cut_all(hurt, bad);
    }
    if (found.kind == Kind::inside) {
      growing_.insert_inside(found.triangle, p);
    } else if (!growing_.insert_on(found.edge, p)) {
      growing_.take_back(p);
      return false;
    }
    ++inside_;
    look_round(p);
    return true;
  }

  /// The constraints on the border of the region in conflict with p that p would crowd.
  [[nodiscard]] std::vector<SegmentSide> find_hurt(Vertex p, std::uint32_t first, bool large) {
    std::vector<SegmentSide> hurt;
    region_.each_edge(growing_, p, first, [&](EdgeCode e) {
      if (options_.keep_boundary && large && criteria_.is_close(p, mesh_.apex(e)))
        hurt.push_back(side_of(mesh_, e));
      if (mesh_.constrained(e) && criteria_.hurts(p, e, large)) hurt.push_back(side_of(mesh_, e));
    });
    return hurt;
  }

  bool cut_all(const std::vector<SegmentSide>& sides, const Bad& bad) {
    bool any = false;
    for (const SegmentSide& side : sides) any = (stands(mesh_, side) && cut(side.code)) || any;
    if (any && mesh_[bad.triangle].v == bad.corners) look_at(bad.triangle);
    return any;
  }

  GrowingMesh& growing_;
  const Triangles& mesh_;
  const RefineOptions& options_;
  Criteria criteria_;
  Agenda agenda_;
  ConflictRegion region_;
  std::size_t inside_ = 0;
};

void list_points_on_segments(const GrowingMesh& growing, Refined& result) {
  const InputSegments& segments = growing.segments();
  for (Vertex p = growing.first_added(); p < growing.points().size(); ++p) {
    const std::uint32_t s = segments.below(p);
    if (s == kNoSegment) continue;
    if (!segments.is_given(s)) {
      ++result.on_others;
      continue;
    }
    const auto [a, b] = segments.ends()[s];
    result.on_segments.push_back({s, dot_from(growing.at(a), growing.at(p), growing.at(b)), p});
  }
  std::sort(result.on_segments.begin(), result.on_segments.end(), [](const auto& a, const auto& b) {
    return std::tie(a.segment, a.where, a.point) < std::tie(b.segment, b.where, b.point);
  });
}

void count_what_is_left(const GrowingMesh& growing, const Criteria& criteria, Refined& result) {
  for (std::uint32_t t = 0; t < growing.mesh().size(); ++t) {
    const Shape shape = growing.shape_of(t);
    if (criteria.is_thin(shape))
      ++(criteria.is_thin_for_input(t, shape) ? result.small_input : result.small_left);
    if (criteria.is_large(t, shape)) ++result.large_left;
  }
}

}  // namespace

Refined refine(Triangles& mesh, Points& points, const std::vector<Ends>& segments,
               const RefineOptions& options, const Poll& poll) {
  GrowingMesh growing(mesh, points, segments);
  Refinement refinement(growing, options);
  Refined result;
  result.capped = refinement.run(poll);
  result.inside = refinement.inside();
  list_points_on_segments(growing, result);
  count_what_is_left(growing, refinement.criteria(), result);
  return result;
}

}  // namespace holdfast::plane
