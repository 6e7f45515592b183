#include "mesh/kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/rounding.h"
#include "exact/volume.h"

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

// The greatest exponent up to `start` that is good, if all below a good one are.
template <typename Good>
std::optional<std::int64_t> greatest_exponent(std::int64_t start, Good good) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 24;
  if (good(start)) return start;
  std::int64_t bad = start, step = 1;
  for (; !good(start - step); step *= 2) {
    if (step > kFarthest) return std::nullopt;
    bad = start - step;
  }
  std::int64_t low = start - step;
  while (bad - low > 1) {
    const std::int64_t middle = low + (bad - low) / 2;
    (good(middle) ? low : bad) = middle;
  }
  return low;
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
  const Centre best = centre(origin);
  if (best.radius > 0) {
    if (const auto p = double_at(origin, best)) return *p;
    if (auto position = on_grid(origin, best)) return position;
  }
  return along_direction(origin, best.size);
}

// In coordinates relative to the origin, scaled by the cavity's size. The programme starts from the origin;
// where that lies behind a face by -b, all faces are moved back by as much.
Kernel::Centre Kernel::centre(PointRef origin) const {
  Centre out;
  for (const auto& f : faces_) {
    std::array<double, 3> a{};
    exact::difference(mesh_.point(f[0]), origin, a.data());
    for (const double x : a) out.size = std::max(out.size, std::abs(x));
  }
  if (!(out.size > 0) || !std::isfinite(out.size)) return out;
  std::vector<HalfSpace> half_spaces;
  double behind = 0;
  for (const auto& f : faces_) {
    half_spaces.push_back(half_space_over(f, origin, out.size));
    behind = std::min(behind, half_spaces.back().b);
  }
  for (HalfSpace& h : half_spaces) h.b -= behind;
  const InscribedBall ball = inscribed_ball(half_spaces);
  for (std::size_t i = 0; i < 3; ++i) out.offset[i] = ball.centre[i] * out.size;
  out.radius = (ball.radius + behind) * out.size;
  for (const HalfSpace& h : half_spaces) {
    double height = h.b + behind;
    for (std::size_t i = 0; i < 3; ++i) height -= h.n[i] * ball.centre[i];
    out.heights.push_back(height * out.size);
  }
  return out;
}

// Differences are exact before they are rounded once; where the origin is next to the plane even that is
// too coarse for kernels as thin as the spacing of doubles, and the height is that of the exact volume.
HalfSpace Kernel::half_space_over(const std::array<Vertex, 3>& f, PointRef origin, double unit) const {
  constexpr double kNear = 1e-8;
  std::array<double, 3> u{}, w{}, a{};
  exact::difference(mesh_.point(f[1]), mesh_.point(f[0]), u.data());
  exact::difference(mesh_.point(f[2]), mesh_.point(f[0]), w.data());
  exact::difference(mesh_.point(f[0]), origin, a.data());
  const double su = std::max({std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
  const double sw = std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2])});
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] /= su;
    w[k] /= sw;
    a[k] /= unit;
  }
  const std::array<double, 3> n{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                                u[0] * w[1] - u[1] * w[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {};  // distinct exact points can share a double; the exact test decides
  HalfSpace out;
  for (std::size_t k = 0; k < 3; ++k) out.n[k] = -n[k] / length;
  out.b = out.n[0] * a[0] + out.n[1] * a[1] + out.n[2] * a[2];
  if (std::abs(out.b) > kNear) return out;
  const Dyadic volume = exact::determinant(mesh_.exact_position(f[0]), mesh_.exact_position(f[1]),
                                           mesh_.exact_position(f[2]), exact::lift(origin));
  out.b = volume.to_double() / su / sw / length / unit;
  return out;
}

// A kernel thinner than the spacing of doubles may still hold one next to the centre.
std::optional<Point> Kernel::double_at(PointRef origin, const Centre& centre) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int code = 0; code < 27; ++code) {
    Point p{};
    int rest = code;
    for (std::size_t k = 0; k < 3; ++k, rest /= 3) {
      p[k] = origin.approx[k] + centre.offset[k];
      if (rest % 3 == 1) p[k] = std::nextafter(p[k], kInfinity);
      if (rest % 3 == 2) p[k] = std::nextafter(p[k], -kInfinity);
    }
    if (holds({p.data(), nullptr})) return p;
  }
  return std::nullopt;
}

std::optional<Position> Kernel::on_grid(PointRef origin, const Centre& centre) const {
  const ExactPoint o = exact::lift(origin);
  const int start = std::ilogb(centre.radius) - 1;
  constexpr int kFiner = 4;
  constexpr int kTries = 4;  // beyond them the guess itself is wrong
  for (int k = 0; k < kTries; ++k) {
    ExactPoint p;
    for (std::size_t i = 0; i < 3; ++i)
      p.c[i] = exact::rounded_to(o.c[i] + Dyadic(centre.offset[i]), start - kFiner * k);
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
  const auto inside = [&](std::int64_t e) { return holds(View(step(e)).ref()); };
  const auto e = greatest_exponent(size > 0 ? std::ilogb(size) : 0, inside);
  if (!e) return std::nullopt;
  for (std::int64_t grid = *e - 2; grid > *e - 64; grid -= 4) {  // few bits, where few will do
    ExactPoint p = step(*e - 1);
    for (Dyadic& x : p.c) x = exact::rounded_to(x, grid);
    const View coarse(std::move(p));
    if (holds(coarse.ref())) return coarse.exact;
  }
  return step(*e);
}

}  // namespace holdfast
