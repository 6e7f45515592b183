#include "mesh/kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/rounding.h"
#include "mesh/inscribed_ball.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;
using exact::PointRef;
using ExactVector = std::array<Dyadic, 3>;

ExactVector minus(const ExactPoint& a, const ExactPoint& b) {
  return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
}
ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Dyadic dot(const ExactVector& a, const ExactVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Scaled by a power of two so that the largest coordinate is near one.
ExactVector normalised(const ExactVector& a) {
  std::int64_t top = INT64_MIN;
  for (const Dyadic& x : a)
    if (x.sign() != 0) top = std::max(top, exact::top_exponent(x));
  return {a[0].scaled(-top), a[1].scaled(-top), a[2].scaled(-top)};
}

// A direction that leaves both planes on their positive sides. For normals at an obtuse angle, with
// c = n1.n2 < 0, alpha n1 + n2 does so exactly for -c/|n1|^2 < alpha < |n2|^2/(-c), an interval that is
// open by Cauchy-Schwarz; sums of unit normals in floating point do fail (design §2.5).
ExactVector direction_above(const ExactVector& n1, const ExactVector& n2) {
  const Dyadic c = dot(n1, n2);
  if (c.sign() >= 0) return {n1[0] + n2[0], n1[1] + n2[1], n1[2] + n2[2]};
  const Dyadic minus_c = -c;
  const Dyadic a1 = dot(n1, n1);
  const Dyadic a2 = dot(n2, n2);
  for (int bits = 53;; bits *= 2) {
    const Dyadic alpha = (exact::quotient(minus_c, a1, bits) + exact::quotient(a2, minus_c, bits)).scaled(-1);
    if ((alpha * a1 + c).sign() > 0 && (alpha * c + a2).sign() > 0)
      return {alpha * n1[0] + n2[0], alpha * n1[1] + n2[1], alpha * n1[2] + n2[2]};
  }
}

struct View {  // an exact point as the predicates see it
  explicit View(ExactPoint p) : exact(std::move(p)) {
    for (std::size_t k = 0; k < 3; ++k) approx[k] = exact.c[k].to_double();
  }
  [[nodiscard]] PointRef ref() const { return {approx.data(), &exact}; }
  ExactPoint exact;
  Point approx{};
};

}  // namespace

Vertex add_vertex(TetMesh& mesh, const Position& position) {
  return std::visit([&](const auto& p) { return mesh.add_vertex(p); }, position);
}

void move_vertex(TetMesh& mesh, Vertex v, const Position& position) {
  std::visit([&](const auto& p) { mesh.move_vertex(v, p); }, position);
}

bool Kernel::holds(PointRef x) const {
  return std::all_of(faces_.begin(), faces_.end(),
                     [&](const auto& f) { return mesh_.orient(f[0], f[1], f[2], x) > 0; });
}

bool Kernel::seen_from(Vertex v) const {
  return std::all_of(faces_.begin(), faces_.end(), [&](const auto& f) {
    return f[0] == v || f[1] == v || f[2] == v || mesh_.orient(f[0], f[1], f[2], v) > 0;
  });
}

std::optional<Position> Kernel::find(PointRef origin) const {
  const Guess g = guess(origin);
  if (g.radius > 0) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = origin.approx[k] + g.offset[k];
    if (holds({p.data(), nullptr})) return p;
    if (const auto near = neighbouring_doubles(p)) return *near;
    if (auto position = on_grid(origin, g)) return position;
  }
  return along_direction(origin, g.size);
}

// The inscribed ball in coordinates relative to the origin, which are subtracted exactly, scaled by the
// cavity's size.
Kernel::Guess Kernel::guess(PointRef origin) const {
  struct Plane {
    std::array<double, 3> n, a;
  };
  std::vector<Plane> planes;
  planes.reserve(faces_.size());
  double size = 0;
  for (const auto& f : faces_) {
    std::array<double, 3> u{}, w{}, a{};
    exact::difference(mesh_.point(f[1]), mesh_.point(f[0]), u.data());
    exact::difference(mesh_.point(f[2]), mesh_.point(f[0]), w.data());
    exact::difference(mesh_.point(f[0]), origin, a.data());
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, std::abs(a[k]));
    const double su = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
    const double sw = std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2])});
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] /= su;
      w[k] /= sw;
    }
    std::array<double, 3> n{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0)) continue;  // distinct exact points can share a double; the exact test decides
    for (double& x : n) x /= length;
    planes.push_back({n, a});
  }
  if (!(size > 0) || !std::isfinite(size)) return {};
  std::vector<HalfSpace> half_spaces;
  half_spaces.reserve(planes.size());
  for (const Plane& p : planes) {
    const double b = -(p.n[0] * p.a[0] + p.n[1] * p.a[1] + p.n[2] * p.a[2]) / size;
    half_spaces.push_back({{-p.n[0], -p.n[1], -p.n[2]}, std::max(b, 0.0)});
  }
  const InscribedBall ball = inscribed_ball(half_spaces);
  return {{ball.centre[0] * size, ball.centre[1] * size, ball.centre[2] * size}, ball.radius * size, size};
}

// A kernel thinner than the spacing of doubles may still hold one next to the centre.
std::optional<Point> Kernel::neighbouring_doubles(const Point& centre) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int code = 0; code < 27; ++code) {
    Point p = centre;
    int rest = code;
    for (double& x : p) {
      if (rest % 3 == 1) x = std::nextafter(x, kInfinity);
      if (rest % 3 == 2) x = std::nextafter(x, -kInfinity);
      rest /= 3;
    }
    if (holds({p.data(), nullptr})) return p;
  }
  return std::nullopt;
}

std::optional<Position> Kernel::on_grid(PointRef origin, const Guess& g) const {
  const ExactPoint o = exact::lift(origin);
  const int start = std::ilogb(g.radius) - 1;
  constexpr int kFiner = 4;
  constexpr int kTries = 4;  // beyond them the guess itself is wrong
  for (int k = 0; k < kTries; ++k) {
    ExactPoint p;
    for (std::size_t i = 0; i < 3; ++i)
      p.c[i] = exact::rounded_to(o.c[i] + Dyadic(g.offset[i]), start - kFiner * k);
    const View view(std::move(p));
    if (holds(view.ref())) return view.exact;
  }
  return std::nullopt;
}

// Every plane through the origin is one of at most two; all others leave room round it, so that a short
// enough step in a direction strictly above both stays inside.
std::optional<Position> Kernel::along_direction(PointRef origin, double size) const {
  const ExactPoint o = exact::lift(origin);
  std::vector<ExactVector> normals;
  for (const auto& f : faces_) {
    if (mesh_.orient(f[0], f[1], f[2], origin) != 0) continue;
    const ExactPoint a = mesh_.exact_position(f[0]);
    const ExactVector n =
        normalised(cross(minus(mesh_.exact_position(f[1]), a), minus(mesh_.exact_position(f[2]), a)));
    const bool known = std::any_of(normals.begin(), normals.end(), [&](const ExactVector& m) {
      const ExactVector c = cross(n, m);
      return c[0].sign() == 0 && c[1].sign() == 0 && c[2].sign() == 0 && dot(n, m).sign() > 0;
    });
    if (!known) normals.push_back(n);
  }
  if (normals.empty() || normals.size() > 2) return std::nullopt;
  const ExactVector u =
      normalised(normals.size() == 1 ? normals[0] : direction_above(normals[0], normals[1]));
  const auto step = [&](std::int64_t e) {
    ExactPoint p;
    for (std::size_t i = 0; i < 3; ++i) p.c[i] = o.c[i] + u[i].scaled(e);
    return p;
  };
  constexpr int kHalvings = 4000;  // the exponent range of doubles, twice
  std::int64_t e = size > 0 ? std::ilogb(size) : 0;
  for (int k = 0; k < kHalvings; ++k, --e) {
    const View view(step(e));
    if (!holds(view.ref())) continue;
    for (std::int64_t grid = e - 2; grid > e - 64; grid -= 4) {  // few bits, where few will do
      ExactPoint p = step(e - 1);
      for (Dyadic& x : p.c) x = exact::rounded_to(x, grid);
      const View coarse(std::move(p));
      if (holds(coarse.ref())) return coarse.exact;
    }
    return view.exact;
  }
  return std::nullopt;
}

}  // namespace holdfast
