#include "enforce/fictitious_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "enforce/partition_segment.h"
#include "exact/rounding.h"
#include "exact/volume.h"
#include "mesh/kernel.h"
#include "mesh/replace.h"
#include "mesh/traverse.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;
using Vector = std::array<double, 3>;
using Edge = std::array<Vertex, 2>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector scaled_to_one(Vector a) {
  const double length = std::sqrt(dot(a, a));
  if (length > 0)
    for (double& x : a) x /= length;
  return a;
}

// A half-plane through A'B', by a point of it, and the link edges that it crosses from A' to B'.
struct HalfPlane {
  Point through{};
  std::vector<Edge> crossed;
};

class CutMaker {
 public:
  CutMaker(TetMesh& mesh, Vertex p, const Edge& ends, std::mt19937_64& random, std::vector<Vertex>& created)
      : mesh_(mesh), p_(p), a_(ends[0]), b_(ends[1]), random_(random), created_(created) {}

  std::vector<CutPath> run() {
    collect_facet_directions();
    std::vector<CutPath> cuts;
    while (facet_fans_ + cuts.size() < 2) {
      std::optional<CutPath> cut = way_one();
      if (!cut) cut = way_three();
      for (std::size_t k = 0; k + 1 < cut->size(); ++k) taken_.push_back(sorted({(*cut)[k], (*cut)[k + 1]}));
      directions_.push_back(across((*cut)[1]));
      cuts.push_back(std::move(*cut));
    }
    return cuts;
  }

 private:
  static Edge sorted(Edge e) {
    if (e[0] > e[1]) std::swap(e[0], e[1]);
    return e;
  }

  [[nodiscard]] bool is_taken(const Edge& e) const {
    return std::find(taken_.begin(), taken_.end(), sorted(e)) != taken_.end();
  }

  // From the segment towards v, at right angles to it, of length one.
  [[nodiscard]] Vector across(Vertex v) const {
    Vector axis{};
    Vector d{};
    exact::difference(mesh_.point(b_), mesh_.point(a_), axis.data());
    exact::difference(mesh_.point(v), mesh_.point(p_), d.data());
    axis = scaled_to_one(axis);
    const double along = dot(axis, d);
    for (std::size_t k = 0; k < 3; ++k) d[k] -= along * axis[k];
    return scaled_to_one(d);
  }

  // The faces of the facet, where there is one: its fan at A' gives its direction.
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
        taken_.push_back(sorted(e));
        if (e[0] != a_ && e[1] != a_) continue;
        ++facet_fans_;
        directions_.push_back(across(e[0] == a_ ? e[1] : e[0]));
      }
  }

  // Vertices that span mesh faces with P and `end`.
  [[nodiscard]] std::vector<Vertex> shell_link(Vertex end) {
    std::vector<Tet> ring;
    shell(mesh_, find_edge(mesh_, p_, end), p_, end, ring);
    std::vector<Vertex> link;
    for (const Tet t : ring)
      for (const Vertex v : mesh_.corners(t))
        if (v != p_ && v != end) link.push_back(v);
    std::sort(link.begin(), link.end());
    link.erase(std::unique(link.begin(), link.end()), link.end());
    return link;
  }

  // Towards the taken cuts: the nearest of them counts.
  [[nodiscard]] double closeness(const Vector& d) const {
    double worst = -1;
    for (const Vector& taken : directions_) worst = std::max(worst, dot(taken, d));
    return worst;
  }

  std::optional<CutPath> way_one() {
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

  std::optional<CutPath> way_three() {
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

  // Of some random half-planes the one that crosses the fewest link edges, the more even angle on a tie.
  HalfPlane choose_half_plane() {
    constexpr int kWanted = 12;
    constexpr int kTries = 4000;
    std::normal_distribution<double> normal;
    std::optional<HalfPlane> best;
    double best_closeness = 0;
    int found = 0;
    double size = 0;
    Vector d{};
    exact::difference(mesh_.point(b_), mesh_.point(a_), d.data());
    for (const double x : d) size = std::max(size, std::abs(x));
    for (int k = 0; k < kTries && found < kWanted; ++k) {
      HalfPlane plane;
      Vector g{};
      for (std::size_t i = 0; i < 3; ++i) {
        g[i] = normal(random_);
        plane.through[i] = mesh_.position(p_)[i] + size * g[i];
      }
      if (!trace(plane)) continue;
      ++found;
      const double c = closeness(scaled_to_one(g));
      if (!best || plane.crossed.size() < best->crossed.size() ||
          (plane.crossed.size() == best->crossed.size() && c < best_closeness)) {
        best = std::move(plane);
        best_closeness = c;
      }
    }
    if (!best) throw std::logic_error("holdfast: no half-plane through a segment point");
    return *best;
  }

  // The link edges crossed by the half-plane, from A' to B'; false if it meets a link vertex or a cut.
  bool trace(HalfPlane& plane) {
    const exact::PointRef q{plane.through.data(), nullptr};
    std::vector<Tet> ring;
    shell(mesh_, find_edge(mesh_, a_, p_), a_, p_, ring);
    for (const Tet t : ring) {
      const auto& cd = kOpposite[static_cast<std::size_t>(mesh_.index_of(t, a_))]
                                [static_cast<std::size_t>(mesh_.index_of(t, p_))];
      const Vertex c = mesh_.corner(t, cd[0]);
      const Vertex d = mesh_.corner(t, cd[1]);
      if (mesh_.orient(a_, p_, c, q) <= 0 ||
          exact::orient3d(mesh_.point(a_), mesh_.point(p_), q, mesh_.point(d)) <= 0)
        continue;
      return follow(plane, t, {c, d});
    }
    return false;
  }

  bool follow(HalfPlane& plane, Tet t, Edge e) {
    const exact::PointRef q{plane.through.data(), nullptr};
    const auto side = [&](Vertex v) { return mesh_.orient(a_, b_, v, q); };
    Vertex behind = a_;
    for (;;) {
      if (is_taken(e)) return false;
      plane.crossed.push_back(e);
      t = tet_of(mesh_.neighbour(t, mesh_.index_of(t, behind)));
      Vertex ahead = kNone;
      for (const Vertex v : mesh_.corners(t))
        if (v != p_ && v != e[0] && v != e[1]) ahead = v;
      if (ahead == b_) return true;
      const int s = side(ahead);
      if (s == 0) return false;
      if (s == side(e[0])) {
        behind = e[0];
        e[0] = ahead;
      } else {
        behind = e[1];
        e[1] = ahead;
      }
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

  // Splits the face (P, e_j) at a point so close to P that the way from A' over it to B' stays inside the
  // faces (P, e_i).
  Vertex put_vertex(const HalfPlane& plane, std::size_t j) {
    const Edge e = plane.crossed[j];
    const ExactPoint x = mesh_.exact_position(e[0]);
    const ExactPoint y = mesh_.exact_position(e[1]);
    const ExactPoint a = mesh_.exact_position(a_);
    const ExactPoint b = mesh_.exact_position(b_);
    const ExactPoint q = exact::lift(plane.through.data());
    const Dyadic gx = exact::determinant(a, b, q, x);
    const Dyadic gy = exact::determinant(a, b, q, y);
    const ExactPoint p = mesh_.exact_position(p_);
    for (int step = 1;; ++step) {  // closer to P, and closer to the plane
      const Dyadic s = exact::quotient(gx, gx - gy, 30 + 2 * step);
      ExactPoint w;
      for (std::size_t k = 0; k < 3; ++k)
        w.c[k] = p.c[k] + (x.c[k] + s * (y.c[k] - x.c[k]) - p.c[k]).scaled(-step);
      const Vertex v = mesh_.add_vertex(w);
      bool good = true;
      for (std::size_t i = 0; i < plane.crossed.size() && good; ++i)
        good = i == j || passes(i < j ? a_ : b_, mesh_.point(v), plane.crossed[i]);
      if (good && split_face_at(v, e)) return v;
      mesh_.remove_last_vertex();
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
    replace(mesh_, {.old_tets = old, .new_tets = fresh});
    return true;
  }

  TetMesh& mesh_;
  const Vertex p_, a_, b_;
  std::mt19937_64& random_;
  std::vector<Vertex>& created_;
  std::size_t facet_fans_ = 0;
  std::vector<Edge> taken_;         // link edges of the cuts there are
  std::vector<Vector> directions_;  // of the cuts, at right angles to the segment
};

}  // namespace

std::vector<CutPath> fictitious_cuts(TetMesh& mesh, Vertex p, const std::array<Vertex, 2>& ends,
                                     std::mt19937_64& random, std::vector<Vertex>& created) {
  return CutMaker(mesh, p, ends, random, created).run();
}

}  // namespace holdfast
