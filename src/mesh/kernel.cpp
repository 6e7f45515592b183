#include "mesh/kernel.h"

#include <algorithm>
#include <cmath>

#include "exact/rounding.h"
#include "exact/volume.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

using exact::Dyadic;
using exact::ExactPoint;
using exact::PointRef;
using ExactVector = std::array<Dyadic, 3>;

// Besides the functions below, for exact vectors.
using holdfast::cross;
using holdfast::dot;

ExactVector minus(const ExactPoint& a, const ExactPoint& b) {
  return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
}
ExactVector cross(const ExactVector& a, const ExactVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Dyadic dot(const ExactVector& a, const ExactVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::int64_t top_exponent(const ExactVector& a) {
  std::int64_t top = INT64_MIN;
  for (const Dyadic& x : a)
    if (x.sign() != 0) top = std::max(top, exact::top_exponent(x));
  return top;
}
ExactVector scaled(const ExactVector& a, std::int64_t exponent) {
  return {a[0].scaled(exponent), a[1].scaled(exponent), a[2].scaled(exponent)};
}
// Scales by a power of two, so that the largest coordinate is near one.
ExactVector normalised(const ExactVector& a) { return scaled(a, -top_exponent(a)); }

double largest(const Vector& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

// A direction strictly to the positive side of both planes. For normals at an obtuse angle, c = n1.n2 < 0,
// the direction alpha n1 + n2 is one exactly for -c/|n1|^2 < alpha < |n2|^2/(-c). This interval is not empty
// by Cauchy-Schwarz. Sums of unit normals in floating point sometimes fail.
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

// The greatest good exponent up to `start`, if all exponents below some bound are good.
template <typename Good>
std::int64_t greatest_exponent(std::int64_t start, Good good) {
  if (good(start)) return start;
  std::int64_t bad = start, step = 1;
  for (; !good(start - step); step *= 2) bad = start - step;
  std::int64_t low = start - step;
  while (bad - low > 1) {
    const std::int64_t middle = low + (bad - low) / 2;
    (good(middle) ? low : bad) = middle;
  }
  return low;
}

bool are_parallel(const ExactVector& n, const ExactVector& m) {
  const ExactVector c = cross(n, m);
  return c[0].sign() == 0 && c[1].sign() == 0 && c[2].sign() == 0;
}

ExactVector exact_normal(const TetMesh& mesh, const std::array<Vertex, 3>& f) {
  const ExactPoint first = mesh.exact_position(f[0]);
  return cross(minus(mesh.exact_position(f[1]), first), minus(mesh.exact_position(f[2]), first));
}

// The normal of a face: its cross product is n * scale * 2^exponent, which may be out of the range of
// doubles.
struct FaceNormal {
  Vector n{};
  double scale = 1;
  std::int64_t exponent = 0;
};

// Differences are exact before they are rounded once. That is too coarse for the normal of a sliver, which is
// computed from exact coordinates.
FaceNormal normal_of(const TetMesh& mesh, const std::array<Vertex, 3>& f) {
  constexpr double kSliver = 1e-4;  // the sine at a corner; above it a dozen digits are left
  Vector u{}, w{};
  exact::difference(mesh.point(f[1]), mesh.point(f[0]), u.data());
  exact::difference(mesh.point(f[2]), mesh.point(f[0]), w.data());
  const double su = largest(u), sw = largest(w);
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] /= su;
    w[k] /= sw;
  }
  const Vector n = cross(u, w);
  if (dot(n, n) > kSliver * kSliver) {
    int exponent_u = 0, exponent_w = 0;
    const double scale = std::frexp(su, &exponent_u) * std::frexp(sw, &exponent_w);
    return {n, scale, std::int64_t{exponent_u} + exponent_w};
  }
  const ExactVector exact_n = exact_normal(mesh, f);
  const std::int64_t top = top_exponent(exact_n);
  const ExactVector near_one = scaled(exact_n, -top);
  return {{near_one[0].to_double(), near_one[1].to_double(), near_one[2].to_double()}, 1, top};
}

// The normals, near one in size, of the planes of faces through a point of the kernel's closure, each once;
// nothing if the point lies behind a face.
std::optional<std::vector<ExactVector>> normals_at(const TetMesh& mesh,
                                                   std::span<const std::array<Vertex, 3>> faces,
                                                   PointRef origin) {
  std::vector<ExactVector> normals;
  for (const auto& f : faces) {
    const int side = mesh.orient(f[0], f[1], f[2], origin);
    if (side < 0) return std::nullopt;
    if (side > 0) continue;
    const ExactVector n = normalised(exact_normal(mesh, f));
    const bool is_known = std::any_of(normals.begin(), normals.end(), [&](const ExactVector& m) {
      return are_parallel(n, m) && dot(n, m).sign() > 0;
    });
    if (!is_known) normals.push_back(n);
  }
  return normals;
}

// An exact point as the predicates see it.
struct View {
  explicit View(ExactPoint p) : exact(std::move(p)) {
    for (std::size_t k = 0; k < 3; ++k) approx[k] = exact.c[k].to_double();
  }
  [[nodiscard]] PointRef ref() const { return {approx.data(), &exact}; }
  ExactPoint exact;
  Point approx{};
};

}  // namespace

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

// In coordinates relative to the origin, scaled by the cavity's size. The linear programme starts at the
// origin; if the origin lies behind a face by -b, all faces are moved back by that distance.
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

// If the origin is next to the plane, the rounded distance is too coarse for kernels as thin as the spacing
// of doubles. Then it is computed from exact coordinates, as a volume over an area.
HalfSpace Kernel::half_space_over(const std::array<Vertex, 3>& f, PointRef origin, double unit) const {
  constexpr double kNear = 1e-8;  // of the unit: half of a double's digits are left
  const FaceNormal normal = normal_of(mesh_, f);
  Vector a{};
  exact::difference(mesh_.point(f[0]), origin, a.data());
  for (double& x : a) x /= unit;

  const double length = std::sqrt(dot(normal.n, normal.n));
  HalfSpace out;
  for (std::size_t k = 0; k < 3; ++k) out.n[k] = -normal.n[k] / length;
  out.b = dot(out.n, a);
  if (std::abs(out.b) > kNear) return out;

  const Dyadic volume = exact::determinant(mesh_.exact_position(f[0]), mesh_.exact_position(f[1]),
                                           mesh_.exact_position(f[2]), exact::lift(origin));
  int exponent_unit = 0;
  const double unit_mantissa = std::frexp(unit, &exponent_unit);
  out.b = volume.scaled(-normal.exponent - exponent_unit).to_double() / normal.scale / length / unit_mantissa;
  return out;
}

// A kernel thinner than the spacing of doubles may still hold a double next to the centre.
std::optional<Point> Kernel::double_next_to(const Point& centre) const {
  const Point middle = mesh_.on_grid(centre);
  for (int code = 0; code < 27; ++code) {
    Point p = middle;
    int rest = code;
    for (std::size_t k = 0; k < 3; ++k, rest /= 3)
      if (rest % 3 != 0) p[k] = mesh_.grid().next(p[k], rest % 3 == 1);
    if (holds({p.data(), nullptr})) return p;
  }
  return std::nullopt;
}

// Far from the origin, rounded normals blur the centre of a thin kernel; seen from the centre itself it is
// sharp.
std::optional<Point> Kernel::double_at(PointRef origin, const Centre& centre) const {
  constexpr double kThin = 1e-8;  // radius over size: half of a double's digits are left
  constexpr int kRefinements = 3;
  Point p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = origin.approx[k] + centre.offset[k];
  Centre refined = centre;
  for (int k = 0;; ++k) {
    if (const auto found = double_next_to(p)) return found;
    if (k == kRefinements || !(std::abs(refined.radius) < kThin * refined.size)) return std::nullopt;
    refined = this->centre({p.data(), nullptr});
    for (std::size_t i = 0; i < 3; ++i) p[i] += refined.offset[i];
  }
}

std::optional<Position> Kernel::on_grid(PointRef origin, const Centre& centre) const {
  const ExactPoint o = exact::lift(origin);
  const int start = std::ilogb(centre.radius) - 1;  // of half the radius
  constexpr int kFiner = 4;                         // bits
  constexpr int kTries = 4;                         // if more are needed, the guess itself is wrong
  for (int k = 0; k < kTries; ++k) {
    ExactPoint p;
    for (std::size_t i = 0; i < 3; ++i)
      p.c[i] = exact::rounded_to(o.c[i] + Dyadic(centre.offset[i]), start - kFiner * k);
    const View view(std::move(p));
    if (holds(view.ref())) return view.exact;
  }
  return std::nullopt;
}

// At most two different planes pass through the origin. All others leave room round it, so a short enough
// step in a direction strictly above these two stays inside.
std::optional<Position> Kernel::along_direction(PointRef origin, double size) const {
  const std::optional<std::vector<ExactVector>> normals = normals_at(mesh_, faces_, origin);
  if (!normals || normals->empty() || normals->size() > 2) return std::nullopt;
  const ExactVector &first = normals->front(), &last = normals->back();
  const bool is_one_plane = normals->size() == 1;
  if (!is_one_plane && are_parallel(first, last)) return std::nullopt;  // opposite: nothing is above both
  const ExactVector u = normalised(is_one_plane ? first : direction_above(first, last));

  const ExactPoint o = exact::lift(origin);
  const auto step = [&](std::int64_t exponent) {
    ExactPoint p;
    for (std::size_t i = 0; i < 3; ++i) p.c[i] = o.c[i] + u[i].scaled(exponent);
    return p;
  };
  const auto is_inside = [&](std::int64_t exponent) { return holds(View(step(exponent)).ref()); };
  constexpr double kLargest = std::numeric_limits<double>::max();
  const std::int64_t longest =
      greatest_exponent(size > 0 ? std::ilogb(std::min(size, kLargest)) : 0, is_inside);
  // Half of that step, rounded to as few bits as are enough: exact positions with many bits cost time.
  constexpr std::int64_t kFirstBits = 2, kMoreBits = 4, kMostBits = 64;
  for (std::int64_t bits = kFirstBits; bits < kMostBits; bits += kMoreBits) {
    ExactPoint p = step(longest - 1);
    for (Dyadic& x : p.c) x = exact::rounded_to(x, longest - bits);
    const View coarse(std::move(p));
    if (holds(coarse.ref())) return coarse.exact;
  }
  return step(longest);
}

Kernel kernel_of_ball(const TetMesh& mesh, Vertex v, std::span<const Tet> tets) {
  Kernel kernel(mesh);
  for (const Tet t : tets) {
    const auto f = mesh.face_vertices(face_code(t, mesh.index_of(t, v)));
    kernel.add(f[0], f[1], f[2]);
  }
  return kernel;
}

}  // namespace holdfast
