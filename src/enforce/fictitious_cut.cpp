#include "enforce/fictitious_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "enforce/partition_segment.h"
#include "enforce/tuning.h"
#include "exact/rounding.h"
#include "exact/volume.h"
#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;
using Edge = std::array<Vertex, 2>;

Vector scaled_to_one(Vector a) {
  const double length = std::sqrt(dot(a, a));
  if (length > 0)
    for (double& x : a) x /= length;
  return a;
}

// A half-plane bounded by A'B', given by one of its points, and the link edges that it crosses from A' to B'.
struct HalfPlane {
  ExactPoint through;
  Point approx{};
  bool is_double = false;  // whether `approx` is the point
  std::vector<Edge> crossed;

  [[nodiscard]] exact::PointRef ref() const { return {approx.data(), is_double ? nullptr : &through}; }
};

class CutMaker {
 public:
  CutMaker(TetMesh& mesh, Vertex p, const Edge& ends, std::vector<Vertex>& created)
      : mesh_(mesh), p_(p), a_(ends[0]), b_(ends[1]), created_(created) {}

  std::vector<CutPath> run() {
    collect_facet_directions();
    std::vector<CutPath> cuts;
    while (facet_fans_ + cuts.size() < 2) {
      std::optional<CutPath> cut = through_link_vertex();
      if (!cut) cut = through_new_vertex();
      for (std::size_t k = 0; k + 1 < cut->size(); ++k)
        taken_.push_back(ascending(Edge{(*cut)[k], (*cut)[k + 1]}));
      directions_.push_back(across((*cut)[1]));
      cuts.push_back(std::move(*cut));
    }
    return cuts;
  }

 private:
  [[nodiscard]] bool is_taken(const Edge& e) const {
    return std::find(taken_.begin(), taken_.end(), ascending(e)) != taken_.end();
  }

  // The vector from the segment to a point, at right angles to the segment.
  [[nodiscard]] Vector distance_to(exact::PointRef x) const {
    Vector axis{};
    Vector d{};
    exact::difference(mesh_.point(b_), mesh_.point(a_), axis.data());
    exact::difference(x, mesh_.point(p_), d.data());
    axis = scaled_to_one(axis);
    const double along = dot(axis, d);
    for (std::size_t k = 0; k < 3; ++k) d[k] -= along * axis[k];
    return d;
  }
  // The same, scaled to length one.
  [[nodiscard]] Vector across(Vertex v) const { return scaled_to_one(distance_to(mesh_.point(v))); }

  // Collects the faces of the facet, if there is one: its fan at A' gives its direction.
  void collect_facet_directions() {
    std::vector<Tet> tets;
    ball(mesh_, p_, tets);
    for (const Tet t : tets)
      for (int i = 0; i < 4; ++i) {
        const Vertex w = mesh_.corner(t, i);
        if (w == p_ || !mesh_.is_facet(face_code(t, i))) continue;
        Edge e{kNone, kNone};
        std::size_t n = 0;
        for (const Vertex v : mesh_.corners(t))
          if (v != p_ && v != w) e[n++] = v;
        if (is_taken(e)) continue;
        taken_.push_back(ascending(e));
        if (e[0] != a_ && e[1] != a_) continue;
        ++facet_fans_;
        directions_.push_back(across(e[0] == a_ ? e[1] : e[0]));
      }
  }

  // Vertices that form mesh faces with P and `end`.
  [[nodiscard]] std::vector<Vertex> shell_link(Vertex end) {
    std::vector<Tet> ring;
    shell(mesh_, find_edge(mesh_, p_, end), p_, end, ring);
    std::vector<Vertex> link;
    for (const Tet t : ring)
      for (const Vertex v : mesh_.corners(t))
        if (v != p_ && v != end) link.push_back(v);
    sort_unique(link);
    return link;
  }

  // The closeness of direction d to the nearest cut so far.
  [[nodiscard]] double closeness(const Vector& d) const {
    double worst = -1;
    for (const Vector& taken : directions_) worst = std::max(worst, dot(taken, d));
    return worst;
  }

  // Way 1.
  std::optional<CutPath> through_link_vertex() {
    const std::vector<Vertex> at_a = shell_link(a_);
    const std::vector<Vertex> at_b = shell_link(b_);
    std::vector<Vertex> both;
    std::set_intersection(at_a.begin(), at_a.end(), at_b.begin(), at_b.end(), std::back_inserter(both));
    Vertex best = kNone;
    double least = 0;
    for (const Vertex v : both) {
      if (is_taken({a_, v}) || is_taken({v, b_})) continue;
      const double c = closeness(across(v));
      if (best == kNone || c < least) {
        best = v;
        least = c;
      }
    }
    if (best == kNone) return std::nullopt;
    return CutPath{a_, best, b_};
  }

  // Way 2.
  CutPath through_new_vertex() {
    const HalfPlane plane = choose_half_plane();
    const std::size_t middle = plane.crossed.size() / 2;
    const Vertex w = put_vertex(plane, middle);
    std::vector<Vertex> first = partition_line(mesh_, a_, w);
    const std::vector<Vertex> second = partition_line(mesh_, w, b_);
    first.insert(first.end(), second.begin() + 1, second.end());
    created_.insert(created_.end(), first.begin() + 1, first.end() - 1);
    for (std::size_t k = 0; k + 1 < first.size(); ++k)
      if (find_face(mesh_, p_, first[k], first[k + 1]) == kNone)
        throw std::logic_error("holdfast: a fictitious cut is no fan of faces");
    return first;
  }

  // The half-planes of one gap between directions to link vertices cross the same link edges. The existing
  // cuts lie in the directions of their vertices, so any gap is possible. Among the widest gaps, chooses the
  // one whose half-planes cross the fewest link edges; on a tie, the one that divides the angle more evenly.
  HalfPlane choose_half_plane() {
    const std::vector<Edge> gaps = widest_gaps(tuning::kMostGaps);
    std::optional<HalfPlane> best;
    double best_closeness = 0;
    for (const Edge& gap : gaps) {
      HalfPlane plane = half_plane_between(gap);
      trace(plane);
      const double c = closeness(scaled_to_one(distance_to(plane.ref())));
      if (best && (plane.crossed.size() > best->crossed.size() ||
                   (plane.crossed.size() == best->crossed.size() && c >= best_closeness)))
        continue;
      best = std::move(plane);
      best_closeness = c;
    }
    return *best;
  }

  // Pairs of link vertices with no other direction in between.
  [[nodiscard]] std::vector<Edge> widest_gaps(std::size_t most) const {
    const std::vector<Vertex> around = directions_round();
    struct Gap {
      double cosine;
      Edge sides;
    };
    std::vector<Gap> gaps;
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Edge sides{around[k], around[(k + 1) % around.size()]};
      gaps.push_back({dot(across(sides[0]), across(sides[1])), sides});
    }
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const Gap& x, const Gap& y) { return x.cosine < y.cosine; });
    std::vector<Edge> widest;
    for (std::size_t k = 0; k < std::min(most, gaps.size()); ++k) widest.push_back(gaps[k].sides);
    return widest;
  }

  // One link vertex for each direction from the segment to the link, in order round the segment. P lies
  // inside its ball and on the segment, so there is a direction in each open half of the circle: at least
  // three, and less than 180 degrees from one to the next.
  [[nodiscard]] std::vector<Vertex> directions_round() const {
    std::vector<Tet> tets;
    ball(mesh_, p_, tets);
    std::vector<Vertex> link;
    for (const Tet t : tets)
      for (const Vertex v : mesh_.corners(t))
        if (v != p_ && v != a_ && v != b_) link.push_back(v);
    sort_unique(link);

    // 0 to 180 degrees ahead of the first, or 180 to 360.
    const auto turn = [&](Vertex v, Vertex w) { return mesh_.orient(a_, b_, v, w); };
    const Vertex first = link.front();
    const Vertex beside =
        *std::find_if(link.begin(), link.end(), [&](Vertex v) { return turn(first, v) != 0; });
    struct Direction {
      bool is_in_second_half;
      Vertex vertex;
    };
    std::vector<Direction> directions;
    for (const Vertex v : link) {
      const int s = turn(first, v);
      directions.push_back({s < 0 || (s == 0 && turn(beside, v) != turn(beside, first)), v});
    }
    std::stable_sort(directions.begin(), directions.end(), [&](const Direction& x, const Direction& y) {
      return x.is_in_second_half != y.is_in_second_half ? y.is_in_second_half : turn(x.vertex, y.vertex) > 0;
    });
    std::vector<Vertex> around;
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (k == 0 || directions[k - 1].is_in_second_half != directions[k].is_in_second_half ||
          turn(directions[k - 1].vertex, directions[k].vertex) != 0)
        around.push_back(directions[k].vertex);
    return around;
  }

  // A sum of positive multiples of two directions less than 180 degrees apart is strictly between them. It is
  // computed exactly, and rounded to doubles if the rounded sum is strictly between them as well.
  [[nodiscard]] HalfPlane half_plane_between(const Edge& gap) const {
    const ExactPoint p = mesh_.exact_position(p_);
    HalfPlane plane{p, {}, false, {}};
    const std::array<Vector, 2> distance{distance_to(mesh_.point(gap[0])), distance_to(mesh_.point(gap[1]))};
    const std::array<int, 2> size{exponent_of(distance[0]), exponent_of(distance[1])};
    const int unit = std::max(size[0], size[1]);
    for (std::size_t i = 0; i < 2; ++i) {
      const ExactPoint v = mesh_.exact_position(gap[i]);
      for (std::size_t k = 0; k < 3; ++k) plane.through.c[k] += (v.c[k] - p.c[k]).scaled(unit - size[i]);
    }
    for (std::size_t k = 0; k < 3; ++k) plane.approx[k] = plane.through.c[k].to_double();
    const exact::PointRef rounded{plane.approx.data(), nullptr};
    plane.is_double = std::isfinite(plane.approx[0] + plane.approx[1] + plane.approx[2]) &&
                      mesh_.orient(a_, b_, gap[0], rounded) > 0 && mesh_.orient(b_, a_, gap[1], rounded) > 0;
    if (plane.is_double) plane.through = exact::lift(plane.approx.data());
    return plane;
  }
  // The exponent of d's length; an arbitrary one if the length is lost in rounding.
  [[nodiscard]] static int exponent_of(const Vector& d) {
    const double length = std::sqrt(dot(d, d));
    return length > 0 && std::isfinite(length) ? std::ilogb(length) : 0;
  }

  // Finds the link edges that the half-plane crosses, from A' to B'.
  void trace(HalfPlane& plane) {
    std::vector<Tet> ring;
    shell(mesh_, find_edge(mesh_, a_, p_), a_, p_, ring);
    for (const Tet t : ring) {
      const auto [c, d] = mesh_.opposite_edge(t, a_, p_);
      if (mesh_.orient(a_, p_, c, plane.ref()) > 0 && mesh_.orient(p_, a_, d, plane.ref()) > 0)
        return follow(plane, t, {c, d});
    }
    throw std::logic_error("holdfast: a half-plane through a segment point starts nowhere");
  }

  void follow(HalfPlane& plane, Tet t, Edge e) {
    const auto side = [&](Vertex v) { return mesh_.orient(a_, b_, v, plane.ref()); };
    Vertex behind = a_;
    for (;;) {
      plane.crossed.push_back(e);
      t = tet_of(mesh_.neighbour(t, mesh_.index_of(t, behind)));
      Vertex ahead = kNone;
      for (const Vertex v : mesh_.corners(t))
        if (v != p_ && v != e[0] && v != e[1]) ahead = v;
      if (ahead == b_) return;
      const std::size_t i = side(ahead) == side(e[0]) ? 0 : 1;
      behind = std::exchange(e[i], ahead);
    }
  }

  // Whether the segment from `end` to w passes through the inside of the face (P, e).
  [[nodiscard]] bool passes(Vertex end, exact::PointRef w, const Edge& e) const {
    const exact::PointRef a = mesh_.point(end);
    const exact::PointRef p = mesh_.point(p_);
    const exact::PointRef x = mesh_.point(e[0]);
    const exact::PointRef y = mesh_.point(e[1]);
    const int s = exact::orient3d(a, w, p, x);
    return s != 0 && exact::orient3d(a, w, x, y) == s && exact::orient3d(a, w, y, p) == s &&
           exact::orient3d(p, x, y, a) * exact::orient3d(p, x, y, w) < 0;
  }

  // Splits the face (P, e_j) at a point w so close to P that the path from A' over w to B' stays inside the
  // faces (P, e_i). Let c_i be the point where e_i crosses the half-plane. From A' to a point w on the ray
  // from P through c_j, the path crosses the rays through all c_i in between, as close to P as w is. But e_j
  // need not cross the half-plane in a binary fraction: so w lies off the half-plane, by less than a
  // 2^-30-th of that distance, and each step reduces this to a quarter. So the path is inside the faces in
  // the end, and some step is the last.
  Vertex put_vertex(const HalfPlane& plane, std::size_t j) {
    const Edge e = plane.crossed[j];
    const ExactPoint x = mesh_.exact_position(e[0]);
    const ExactPoint y = mesh_.exact_position(e[1]);
    const ExactPoint a = mesh_.exact_position(a_);
    const ExactPoint b = mesh_.exact_position(b_);
    const ExactPoint& q = plane.through;
    const Dyadic gx = exact::determinant(a, b, q, x);
    const Dyadic gy = exact::determinant(a, b, q, y);
    const ExactPoint p = mesh_.exact_position(p_);
    for (int step = 1;; step += std::max(1, step / 2)) {  // closer to P, and closer to the plane
      const Dyadic s = exact::quotient(gx, gx - gy, 30 + 2 * step);
      ExactPoint w;
      for (std::size_t k = 0; k < 3; ++k)
        w.c[k] = p.c[k] + (x.c[k] + s * (y.c[k] - x.c[k]) - p.c[k]).scaled(-step);
      const Vertex v = MeshEditor(mesh_).add_vertex(w);
      bool good = true;
      for (std::size_t i = 0; i < plane.crossed.size() && good; ++i)
        good = i == j || passes(i < j ? a_ : b_, mesh_.point(v), plane.crossed[i]);
      if (good && split_face_at(v, e)) return v;
      MeshEditor(mesh_).remove_last_vertex();
    }
  }

  bool split_face_at(Vertex v, const Edge& e) {
    const Face f = find_face(mesh_, p_, e[0], e[1]);
    const std::array<Tet, 2> old{tet_of(f), tet_of(mesh_.neighbour(f))};
    Kernel kernel(mesh_);
    for (const Tet t : old)
      for (const Vertex c : {p_, e[0], e[1]}) {
        const auto face = mesh_.face_vertices(face_code(t, mesh_.index_of(t, c)));
        kernel.add(face[0], face[1], face[2]);
      }
    if (!kernel.holds(mesh_.point(v))) return false;
    std::vector<TetMesh::Corners> fresh;
    for (const auto& face : kernel.faces()) fresh.push_back({face[0], face[1], face[2], v});
    MeshEditor(mesh_).replace({.old_tets = old, .new_tets = fresh});
    return true;
  }

  TetMesh& mesh_;
  const Vertex p_, a_, b_;
  std::vector<Vertex>& created_;
  std::size_t facet_fans_ = 0;
  std::vector<Edge> taken_;         // link edges of the existing cuts
  std::vector<Vector> directions_;  // of the cuts, at right angles to the segment
};

}  // namespace

std::vector<CutPath> fictitious_cuts(TetMesh& mesh, Vertex p, const std::array<Vertex, 2>& ends,
                                     std::vector<Vertex>& created) {
  return CutMaker(mesh, p, ends, created).run();
}

}  // namespace holdfast
