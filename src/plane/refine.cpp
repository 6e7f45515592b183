// Delaunay refinement in the plane.
//
// Constrained edges whose diametral circle holds a corner next to them are halved; triangles with a small
// angle or too large get a point at the centre of their circle, or at an off-centre nearer to their shortest
// edge, unless that would lie in the diametral circle of a constraint, which is then halved instead. Where
// segments meet at less than 60 degrees they are cut at distances from their common end that are powers of
// two (Ruppert's concentric shells), and a triangle whose shortest edge joins two such cuts at the same
// distance stays as it is: it lies across from a small angle of the input (Miller, Pav, Walkington). All
// measures are floating point, since they only choose places; where a place lies, and what becomes of the
// triangles, exact signs decide.
#include "plane/refine.h"

#include <queue>
#include <tuple>

#include "numbers/elementary.h"
#include "plane/input_segments.h"
#include "plane/insertion.h"
#include "plane/shape.h"

namespace holdfast::plane {
namespace {

std::vector<Position> scaled(const Points& points, const Scale& scale) {
  std::vector<Position> at;
  for (const Position& p : points.positions()) at.push_back(scale.down(p));
  return at;
}

class Refinement {
 public:
  Refinement(Triangles& mesh, Points& points, const std::vector<Ends>& segments, const RefineOptions& options)
      : mesh_(mesh),
        points_(points),
        insertion_(mesh, points),
        options_(options),
        scale_(points.positions()),
        first_free_(static_cast<Vertex>(points.size())),
        at_(scaled(points, scale_)),
        segments_(mesh, at_, segments) {
    constexpr double kDegree = 3.14159265358979323846 / 180;
    bound_ = options.angle > 0 ? numbers::cos(options.angle * kDegree) : 1;
    // The height of the isosceles triangle with the bound as its least angle, over its base; a little less,
    // so that rounding leaves the angle above the bound.
    const double half = options.angle * kDegree / 2;
    off_ = options.angle > 0 ? 0.475 * numbers::cos(half) / numbers::sin(half) : 0;
    const double size = scale_.length_down(options.size);
    size2_ = options.size > 0 ? size * size : 0;
    for (const double area : options.areas) areas_.push_back(area > 0 ? scale_.area_down(area) : 0);
    mesh_.find_stars(points.size());
  }

  Refined run(const Poll& poll) {
    for (std::uint32_t t = 0; t < mesh_.size(); ++t) look_at(t);
    double share = 0;
    for (std::size_t turn = 0; !sides_.empty() || !bad_.empty(); ++turn) {
      if (turn % 256 == 0 && poll) {
        const auto made = static_cast<double>(points_.size() - first_free_);
        share = std::max(share, made / (made + static_cast<double>(bad_.size() + sides_.size())));
        poll(std::min(share, 0.999));
      }
      if (points_.size() - first_free_ >= options_.most_points) {
        result_.capped = true;
        break;
      }
      if (!sides_.empty())
        treat_side();
      else
        treat_triangle();
    }
    finish();
    return std::move(result_);
  }

 private:
  /// An edge. Where its triangle has changed since, the new triangles were looked at, so that it does not
  /// count.
  struct Side {
    EdgeCode code;
    Ends ends;
  };
  [[nodiscard]] Side side_of(EdgeCode e) const { return {e, {mesh_.from(e), mesh_.to(e)}}; }
  [[nodiscard]] bool stands(const Side& side) const {
    return mesh_.from(side.code) == side.ends[0] && mesh_.to(side.code) == side.ends[1] &&
           mesh_.constrained(side.code);
  }
  struct Bad {
    double shortest;
    std::uint64_t number;
    std::uint32_t triangle;
    std::array<Vertex, 3> corners;
    bool operator<(const Bad& other) const {  // the shortest edge goes first
      return shortest != other.shortest ? shortest > other.shortest : number > other.number;
    }
  };

  // --- Segments ---------------------------------------------------------------------------------------

  [[nodiscard]] bool encroaches(Vertex p, Vertex a, Vertex b) const {
    return dot_from(at_[p], at_[a], at_[b]) <= 0;
  }
  /// Points for the sake of a size keep a distance from all others, so that they are finitely many.
  [[nodiscard]] bool is_close(Vertex p, Vertex v) const {
    return squared(at_[p], at_[v]) < kClose * kClose * size2_;
  }
  /// With constraints as they are: whether p makes a triangle on one with an angle below the bound and below
  /// what stands there, or, for the sake of a size, a flat one.
  [[nodiscard]] bool crowds(Vertex p, EdgeCode e, bool large) const {
    const Position &a = at_[mesh_.from(e)], &b = at_[mesh_.to(e)];
    if (large && size2_ > 0) {
      const double cross = cross_from(a, b, at_[p]), side2 = squared(a, b), height2 = cross * cross / side2;
      return height2 < kClose * kClose * std::min(size2_, side2);
    }
    const double cosine = Shape(at_[p], a, b).cosine;
    return cosine > bound_ && cosine > shape_of(triangle_of(e)).cosine;
  }

  /// A side that is too long, or whose diametral circle holds the corner opposite to it.
  [[nodiscard]] bool must_split(EdgeCode e) {
    const Vertex a = mesh_.from(e), b = mesh_.to(e);
    if (size2_ > 0 && squared(at_[a], at_[b]) > size2_) return true;
    if (is_encroached(mesh_.apex(e), a, b)) return true;
    const EdgeCode f = mesh_.across(e);
    return f != kNoEdge && is_encroached(mesh_.apex(f), a, b);
  }
  [[nodiscard]] bool is_encroached(Vertex p, Vertex a, Vertex b) {
    return encroaches(p, a, b) && (segments_.below(p) == kNoSegment ||
                                   !segments_.make_needle(segments_.of(a, b), segments_.below(p)));
  }

  void treat_side() {
    const Side side = sides_.back();
    sides_.pop_back();
    if (stands(side) && must_split(side.code)) static_cast<void>(split(side.code));
  }

  [[nodiscard]] bool is_too_fine(const Position& a, const Position& b) const {
    constexpr double kFinest = 0x1p-46;  // times the coordinates
    const double most = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(b[0]), std::abs(b[1])});
    const double finest = std::max(scale_.finest(), kFinest * most);
    return squared(a, b) < finest * finest;
  }

  /// False where doubles are too coarse for a point between the ends.
  bool split(EdgeCode e) {
    const Vertex a = mesh_.from(e), b = mesh_.to(e);
    if (is_too_fine(at_[a], at_[b])) return false;
    const std::uint32_t s = segments_.of(a, b);
    const Vertex p = add(segments_.cut_of(a, b));
    if (!insertion_.insert_on(e, p)) {
      take_back(p);
      return false;
    }
    segments_.put(p, s);
    look_round(p);
    return true;
  }

  // --- Points -----------------------------------------------------------------------------------------

  Vertex add(const Position& scaled) {
    const Position p = scale_.up(scaled);
    at_.push_back(scale_.down(p));
    mesh_.add_star(kNoVertex);
    segments_.resize(at_.size());
    return points_.add(p);
  }
  void take_back(Vertex first) {
    points_.shrink(first);
    at_.resize(first);
    mesh_.drop_stars(first);
    segments_.resize(first);
  }

  // --- Triangles --------------------------------------------------------------------------------------

  [[nodiscard]] bool is_large(std::uint32_t t, const Shape& shape) const {
    const std::uint32_t mark = mesh_[t].mark;
    if (mark < areas_.size() && areas_[mark] > 0 && area_of(t) > areas_[mark]) return true;
    if (size2_ == 0) return false;
    for (std::uint32_t i = 0; i < 3; ++i)
      if (shape.edges[i] > size2_ && !(options_.keep_boundary && mesh_.constrained(code(t, i)))) return true;
    return false;
  }

  /// Whether the least angle lies across from cuts at the same distance from a corner of the input, where two
  /// segments meet at less than 60 degrees, or at such a corner itself.
  [[nodiscard]] bool is_across(std::uint32_t t, const Shape& shape) const {
    const EdgeCode e = code(t, shape.shortest);
    const Vertex a = mesh_.from(e), b = mesh_.to(e);
    const std::uint32_t s = segments_.below(a), r = segments_.below(b);
    if (s == kNoSegment || r == kNoSegment || s == r) return false;
    const Vertex v = segments_.common_corner(s, r);
    if (v == kNoVertex) return false;
    if (segments_.make_needle(s, r)) return true;
    // At 60 degrees or more the edge between them would not be the shortest.
    const double p = std::sqrt(squared(at_[v], at_[a])), q = std::sqrt(squared(at_[v], at_[b]));
    return std::abs(p - q) <= kSame * std::max(p, q) && shape.edges[shape.shortest] < p * q;
  }
  /// The same at the end of the run, where an end of the shortest edge may be a corner of the input, too:
  /// whether it spans a needle.
  [[nodiscard]] bool spans_needle(std::uint32_t t, const Shape& shape) const {
    const EdgeCode e = code(t, shape.shortest);
    return segments_.any_make_needle(mesh_.from(e), mesh_.to(e));
  }
  /// Whether the least angle lies between two constraints, so that no point makes it larger.
  [[nodiscard]] bool is_between_constraints(std::uint32_t t, const Shape& shape) const {
    return mesh_.constrained(code(t, (shape.shortest + 1) % 3)) &&
           mesh_.constrained(code(t, (shape.shortest + 2) % 3));
  }

  [[nodiscard]] double area_of(std::uint32_t t) const {
    const std::array<Vertex, 3>& v = mesh_[t].v;
    return cross_from(at_[v[0]], at_[v[1]], at_[v[2]]) / 2;
  }
  [[nodiscard]] Shape shape_of(std::uint32_t t) const {
    const std::array<Vertex, 3>& v = mesh_[t].v;
    return {at_[v[0]], at_[v[1]], at_[v[2]]};
  }

  void look_at(std::uint32_t t) {
    if (!options_.keep_boundary)
      for (std::uint32_t i = 0; i < 3; ++i)
        if (const EdgeCode e = code(t, i); mesh_.constrained(e) && must_split(e))
          sides_.push_back(side_of(e));
    const Shape shape = shape_of(t);
    const bool large = is_large(t, shape);
    if (!large && (!(shape.cosine > bound_) || is_across(t, shape) ||
                   (options_.keep_boundary && is_between_constraints(t, shape))))
      return;
    bad_.push({shape.edges[shape.shortest], ++looks_, t, mesh_[t].v});
  }

  void look_round(Vertex p) {
    insertion_.each_at(p, [&](std::uint32_t t) { look_at(t); });
  }

  void treat_triangle() {
    const Bad bad = bad_.top();
    bad_.pop();
    if (mesh_[bad.triangle].v != bad.corners) return;
    const std::array<Vertex, 3>& v = bad.corners;
    const Shape shape = shape_of(bad.triangle);
    const Position centre = circumcentre(at_[v[0]], at_[v[1]], at_[v[2]]);
    const bool large = is_large(bad.triangle, shape);
    const Position place = large ? centre : off_centre(bad.triangle, shape, centre);
    if (put(place, bad, large)) return;
    if (!options_.keep_boundary) return;
    if (large && size2_ > 0 && put(middle_of_longest(bad.triangle, shape), bad, true)) return;
    if (place != centre && put(centre, bad, false)) return;
    static_cast<void>(put(off_centre(bad.triangle, shape, centre), bad, false));
  }

  /// Of the edges that are no constraints.
  [[nodiscard]] Position middle_of_longest(std::uint32_t t, const Shape& shape) const {
    EdgeCode longest = kNoEdge;
    for (std::uint32_t i = 0; i < 3; ++i)
      if (!mesh_.constrained(code(t, i)) &&
          (longest == kNoEdge || shape.edges[i] > shape.edges[edge_of(longest)]))
        longest = code(t, i);
    if (longest == kNoEdge) longest = code(t, 0);
    return middle(at_[mesh_.from(longest)], at_[mesh_.to(longest)]);
  }

  /// The point on the line from the middle of the shortest edge to the centre from which that edge is seen at
  /// the bound, where it is nearer than the centre (Ungor).
  [[nodiscard]] Position off_centre(std::uint32_t t, const Shape& shape, const Position& centre) const {
    if (off_ == 0) return centre;
    const EdgeCode e = code(t, shape.shortest);
    const Position &a = at_[mesh_.from(e)], &b = at_[mesh_.to(e)];
    const Position m = middle(a, b);
    const double height = off_;  // times the length of ab, at a right angle to it, to its left
    const Position off{m[0] - height * (b[1] - a[1]), m[1] + height * (b[0] - a[0])};
    return squared(m, off) < squared(m, centre) || !std::isfinite(centre[0] + centre[1]) ? off : centre;
  }

  /// The last place on the way from one to another that doubles reach, which is beyond all points.
  static Position within_range(const Position& from, const Position& to) {
    constexpr double kMost = 2 - 0x1p-52;
    double share = 1;
    for (std::size_t k = 0; k < 2; ++k)
      if (std::abs(to[k]) > kMost)
        share = std::min(share, (kMost - (to[k] > 0 ? from[k] : -from[k])) / std::abs(to[k] - from[k]));
    return {std::clamp(from[0] + share * (to[0] - from[0]), -kMost, kMost),
            std::clamp(from[1] + share * (to[1] - from[1]), -kMost, kMost)};
  }

  /// Adds a point for a triangle, or cuts what stands in its way, after which the triangle is looked at
  /// again. False where neither can be.
  bool put(const Position& place, const Bad& bad, bool large) {
    const std::array<Vertex, 3>& v = bad.corners;
    const Position third{(at_[v[0]][0] + at_[v[1]][0] + at_[v[2]][0]) / 3,
                         (at_[v[0]][1] + at_[v[1]][1] + at_[v[2]][1]) / 3};
    if (!std::isfinite(place[0] + place[1])) return false;
    const Vertex p = add(within_range(third, place));
    const Vertex start = add(third);
    bool holds = true;
    for (std::uint32_t i = 0; i < 3; ++i) holds = holds && points_.orient(v[i], v[(i + 1) % 3], start) > 0;
    Insertion::Place found;
    if (holds) found = insertion_.locate(p, start, bad.triangle);
    take_back(start);
    using Kind = Insertion::Place::Kind;
    if (found.kind == Kind::on_edge && mesh_.constrained(found.edge)) found.kind = Kind::behind_constraint;
    std::vector<Side> hurt;
    if (found.kind == Kind::behind_constraint)
      hurt.push_back(side_of(found.edge));
    else if (found.kind != Kind::nowhere)
      find_hurt(p, found.triangle, large, hurt);
    if (found.kind == Kind::nowhere || !hurt.empty()) {
      take_back(p);
      return found.kind != Kind::nowhere && !options_.keep_boundary && split_all(hurt, bad);
    }
    if (found.kind == Kind::on_edge) {
      if (!insertion_.insert_on(found.edge, p)) {
        take_back(p);
        return false;
      }
    } else {
      insertion_.insert_inside(found.triangle, p);
    }
    ++result_.inside;
    look_round(p);
    return true;
  }

  bool split_all(const std::vector<Side>& sides, const Bad& bad) {
    bool any = false;
    for (const Side& side : sides) any = (stands(side) && split(side.code)) || any;
    if (any && mesh_[bad.triangle].v == bad.corners) look_at(bad.triangle);
    return any;
  }

  /// Constraints at the border of the region in conflict with p that p would crowd.
  void find_hurt(Vertex p, std::uint32_t first, bool large, std::vector<Side>& hurt) {
    visited_.resize(mesh_.size(), 0);
    ++visit_;
    visited_[first] = visit_;
    pending_.assign(1, first);
    while (!pending_.empty()) {
      const std::uint32_t t = pending_.back();
      pending_.pop_back();
      for (std::uint32_t i = 0; i < 3; ++i) {
        const EdgeCode e = code(t, i);
        if (options_.keep_boundary && large && is_close(p, mesh_.apex(e))) hurt.push_back(side_of(e));
        if (mesh_.constrained(e)) {
          const Vertex a = mesh_.from(e), b = mesh_.to(e);
          if (options_.keep_boundary ? crowds(p, e, large) : encroaches(p, a, b)) hurt.push_back(side_of(e));
          continue;
        }
        const EdgeCode f = mesh_.across(e);
        if (f == kNoEdge || visited_[triangle_of(f)] == visit_) continue;
        const std::array<Vertex, 3>& v = mesh_[triangle_of(f)].v;
        visited_[triangle_of(f)] = visit_;
        if (points_.incircle(v[0], v[1], v[2], p) > 0) pending_.push_back(triangle_of(f));
      }
    }
  }

  // --- The end ----------------------------------------------------------------------------------------

  void finish() {
    for (Vertex p = first_free_; p < points_.size(); ++p) {
      const std::uint32_t s = segments_.below(p);
      if (s == kNoSegment) continue;
      if (!segments_.is_given(s)) {
        ++result_.on_others;
        continue;
      }
      const auto [a, b] = segments_.ends()[s];
      result_.on_segments.push_back({s, dot_from(at_[a], at_[p], at_[b]), p});
    }
    std::sort(result_.on_segments.begin(), result_.on_segments.end(), [](const auto& a, const auto& b) {
      return std::tie(a.segment, a.where, a.point) < std::tie(b.segment, b.where, b.point);
    });
    for (std::uint32_t t = 0; t < mesh_.size(); ++t) {
      const Shape shape = shape_of(t);
      if (shape.cosine > bound_) {
        const bool of_input =
            is_across(t, shape) || is_between_constraints(t, shape) || spans_needle(t, shape);
        ++(of_input ? result_.small_input : result_.small_left);
      }
      if (is_large(t, shape)) ++result_.large_left;
    }
  }

  static constexpr double kClose = 0.4;     // of the size, that points keep from others and from constraints
  static constexpr double kSame = 0x1p-10;  // between distances that are the same but for rounding

  Triangles& mesh_;
  Points& points_;
  Insertion insertion_;
  const RefineOptions& options_;
  Scale scale_;
  Vertex first_free_;
  std::vector<Position> at_;  // points, scaled
  InputSegments segments_;
  double bound_ = 1, off_ = 0, size2_ = 0;
  std::vector<double> areas_;
  std::vector<Side> sides_;
  std::priority_queue<Bad> bad_;
  std::uint64_t looks_ = 0;
  std::vector<std::uint32_t> visited_, pending_;
  std::uint32_t visit_ = 0;
  Refined result_;
};

}  // namespace

Refined refine(Triangles& mesh, Points& points, const std::vector<Ends>& segments,
               const RefineOptions& options, const Poll& poll) {
  return Refinement(mesh, points, segments, options).run(poll);
}

}  // namespace holdfast::plane
