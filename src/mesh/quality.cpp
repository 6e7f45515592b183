#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/careful.h"
#include "mesh/quality_below.h"
#include "numbers/elementary.h"

namespace holdfast {
namespace {

// The faces at edge k are opposite these corners.
constexpr std::array<std::array<std::size_t, 2>, 6> kFacesAt{
    {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};

// Normals of the faces opposite a, b, c, d, all inward or all outward.
using Normals = std::array<Vector, 4>;

// The quantities that determine Q, in plain arithmetic.
struct Plain {
  Normals normals;
  std::array<double, 4> lengths;  // of the normals
  double longest, six_volumes, twice_area;

  [[nodiscard]] bool is_thinner_than(double thin) const {
    return !(six_volumes >= thin * longest * longest * longest);
  }
  // The inradius is three volumes over the area.
  [[nodiscard]] double quality() const { return kInradiusOfRegular * longest * twice_area / six_volumes; }
};

// None if the tetrahedron is too small or too large for plain arithmetic.
std::optional<Plain> plain_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr double kSmall = 1e-50, kLarge = 1e50;
  const Vector u = b - a, v = c - a, w = d - a;
  const Vector x = c - b, y = d - b, z = d - c;
  const double longest =
      std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w), dot(x, x), dot(y, y), dot(z, z)}));
  if (!(longest > kSmall && longest < kLarge)) return std::nullopt;
  const Vector n = cross(u, v);
  const Normals normals{cross(y, x), cross(v, w), cross(w, u), n};
  const std::array<double, 4> l{length(normals[0]), length(normals[1]), length(normals[2]),
                                length(normals[3])};
  return Plain{normals, l, longest, std::abs(dot(n, w)), l[3] + l[1] + l[2] + l[0]};
}

// The same quantities, computed with care where terms cancel.
struct Careful {
  Normals normals;
  double six_volumes;
  std::array<Vector, 6> edges;  // ab ac ad bc bd cd

  explicit Careful(const std::array<Point, 4>& p)
      : normals{careful::normal(p[1], p[3], p[2]), careful::normal(p[0], p[2], p[3]),
                careful::normal(p[0], p[3], p[1]), careful::normal(p[0], p[1], p[2])},
        six_volumes(careful::six_volumes(p[0], p[1], p[2], p[3], normals[3])),
        edges{p[1] - p[0], p[2] - p[0], p[3] - p[0], p[2] - p[1], p[3] - p[1], p[3] - p[2]} {}

  [[nodiscard]] double quality() const {
    double longest = 0;
    for (const Vector& e : edges) longest = std::max(longest, dot(e, e));
    double twice_area = 0;
    for (const Vector& n : normals) twice_area += length(n);
    if (!(std::abs(six_volumes) > 0)) return std::numeric_limits<double>::infinity();
    return kInradiusOfRegular * std::sqrt(longest) * twice_area / std::abs(six_volumes);
  }

  // At an edge e between faces of normals m and n, m x n = 6 V e up to sign: the sine of the angle is as
  // exact as the volume.
  [[nodiscard]] std::array<Angle, 6> dihedral_angles() const {
    std::array<Angle, 6> angles{};
    for (std::size_t k = 0; k < 6; ++k) {
      const Vector& m = normals[kFacesAt[k][0]];
      const Vector& n = normals[kFacesAt[k][1]];
      if (!(dot(m, m) > 0) || !(dot(n, n) > 0)) continue;
      const double sine = std::abs(six_volumes) * length(edges[k]), cosine = -dot(m, n);
      const double sum = sine + std::abs(cosine);
      if (sum > 0) angles[k] = {sine / sum, cosine / sum};
    }
    return angles;
  }
};

Careful careful_of(const Point& a, const Point& b, const Point& c, const Point& d) {
  return Careful(careful::brought_in_range<4>({a, b, c, d}));
}

// Where six volumes, in cubes of the longest edge, exceed this, plain arithmetic keeps ten digits.
constexpr double kThin = 1e-5;

// Q lies between these bounds in spite of rounding. The length of each normal errs by less than 10 eps times
// the square of the longest edge, the volume by less than 30 eps times its cube, and values computed with
// care err by a millionth.
struct Bounds {
  double lower, upper;
};
Bounds bounds_of_quality(const Plain& plain) {
  constexpr double kRounding = 1e-14, kCare = 0.001;
  const double square = plain.longest * plain.longest;
  const double of_area = kRounding * square, of_volume = kRounding * square * plain.longest;
  const double times = kInradiusOfRegular * plain.longest;
  const double least_volume = plain.six_volumes - of_volume;
  return {(1 - kCare) * times * (plain.twice_area - of_area) / (plain.six_volumes + of_volume),
          least_volume > 0 ? (1 + kCare) * times * (plain.twice_area + of_area) / least_volume
                           : std::numeric_limits<double>::infinity()};
}

// Bounds of Q by products only, which decide for most tetrahedra. No face is larger than an
// equilateral triangle on the longest edge l, and any two faces together are at least as large as a third. So
// with n, twice the area of abc: 2 n l <= Q 6V / (sqrt(6)/12) and Q <= sqrt(1/2) l^3 / 6V.
enum class Verdict { below, not_below, undecided };
Verdict compared_by_products(const Point& a, const Point& b, const Point& c, const Point& d, double limit) {
  constexpr double kSmall = 1e-60, kLarge = 1e100;
  // Six volumes and n err by less than 30 and 10 eps times a cube and a square of l. Squares below these
  // parts of l^6 and l^4 may be meaningless.
  constexpr double kRoundedVolume = 1e-20, kRoundedArea = 1e-8;
  constexpr double kCare = 1.01, kTwoAreas = 4 * kInradiusOfRegular * kInradiusOfRegular / kCare;
  const Vector u = b - a, v = c - a, w = d - a;
  const Vector x = c - b, y = d - b, z = d - c;
  const double square = std::max({dot(u, u), dot(v, v), dot(w, w), dot(x, x), dot(y, y), dot(z, z)});
  if (!(square > kSmall && square < kLarge)) return Verdict::undecided;
  const Vector n = cross(u, v);
  const double six_volumes = dot(n, w), cubed = square * square * square, area = dot(n, n);
  const double of_volume = six_volumes * six_volumes;
  if (of_volume > std::max(kRoundedVolume, kCare / 2 / (limit * limit)) * cubed) return Verdict::below;
  if (area > kRoundedArea * (square * square) &&
      kTwoAreas * square * area > limit * limit * std::max(of_volume, kRoundedVolume * cubed))
    return Verdict::not_below;
  return Verdict::undecided;
}

}  // namespace

double Angle::degrees() const {
  return is_known() ? numbers::atan2(sine, cosine) * 180.0 / std::numbers::pi
                    : std::numeric_limits<double>::quiet_NaN();
}

double quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::optional<Plain> plain = plain_of(a, b, c, d);
  if (plain && !plain->is_thinner_than(kThin)) return plain->quality();
  return careful_of(a, b, c, d).quality();
}

std::optional<double> quality_below(const Point& a, const Point& b, const Point& c, const Point& d,
                                    double limit) {
  if (compared_by_products(a, b, c, d, limit) == Verdict::not_below) return std::nullopt;
  const std::optional<Plain> plain = plain_of(a, b, c, d);
  double q = 0;
  if (plain && !plain->is_thinner_than(kThin)) {
    q = plain->quality();
  } else {
    if (plain && bounds_of_quality(*plain).lower >= limit) return std::nullopt;
    q = careful_of(a, b, c, d).quality();
  }
  return q < limit ? std::optional<double>(q) : std::nullopt;
}

bool is_quality_below(const Point& a, const Point& b, const Point& c, const Point& d, double limit) {
  const Verdict verdict = compared_by_products(a, b, c, d, limit);
  if (verdict != Verdict::undecided) return verdict == Verdict::below;
  if (const std::optional<Plain> plain = plain_of(a, b, c, d)) {
    if (!plain->is_thinner_than(kThin)) return plain->quality() < limit;
    const Bounds bounds = bounds_of_quality(*plain);
    if (bounds.lower >= limit) return false;
    if (bounds.upper < limit) return true;
  }
  return careful_of(a, b, c, d).quality() < limit;
}

std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<Angle, 6> angles = careful_of(a, b, c, d).dihedral_angles();
  std::array<double, 6> degrees{};
  std::transform(angles.begin(), angles.end(), degrees.begin(), [](const Angle& x) { return x.degrees(); });
  return degrees;
}

std::optional<PlainShape> plain_shape(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr double kThinForAngles = 1e-3;  // a cosine keeps nine digits
  const std::optional<Plain> plain = plain_of(a, b, c, d);
  if (!plain || plain->is_thinner_than(kThinForAngles)) return std::nullopt;
  const Normals& n = plain->normals;
  PlainShape shape{plain->quality(), {}};
  std::array<double, 4> inverse{};
  for (std::size_t i = 0; i < 4; ++i) inverse[i] = 1 / plain->lengths[i];
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kFacesAt[k];
    shape.cosines[k] = -dot(n[i], n[j]) * inverse[i] * inverse[j];
  }
  return shape;
}

CarefulShape careful_shape(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Careful measures = careful_of(a, b, c, d);
  return {measures.quality(), measures.dihedral_angles()};
}

PlainShape CarefulShape::plain() const {
  PlainShape shape{quality, {}};
  for (std::size_t k = 0; k < 6; ++k)
    shape.cosines[k] =
        angles[k].is_known() ? angles[k].cosine / numbers::hypot(angles[k].sine, angles[k].cosine) : 1;
  return shape;
}

}  // namespace holdfast
