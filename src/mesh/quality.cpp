#include "mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include "exact/determinant.h"
#include "exact/expansion.h"
#include "exact/point.h"
#include "mesh/parallel.h"
#include "numbers/elementary.h"
#include "numbers/vector.h"

namespace holdfast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kScale = 0.20412414523193150;  // sqrt(6) / 12
// Part of the sum of its terms below which a sum is computed exactly: some six digits are left above it.
constexpr double kCancelled = 1e-9;

// Differences as expansions, whose products of three neither over- nor underflow (magnitudes are checked
// first), or as dyadic numbers, which hold any.
struct ByExpansions {
  using Number = exact::Expansion<2>;
  static Number minus(double a, double b) { return Number(exact::two_diff(a, b)); }
  template <typename T>
  static double to_double(const T& x) {
    return x.estimate();
  }
};
struct ByDyadics {
  using Number = exact::Dyadic;
  static Number minus(double a, double b) { return exact::Dyadic(a) - exact::Dyadic(b); }
  static double to_double(const exact::Dyadic& x) { return x.to_double(); }
};

bool suits_expansions(std::initializer_list<const Point*> points) {
  constexpr double kLeast = 1e-60, kMost = 1e60;
  return std::all_of(points.begin(), points.end(), [](const Point* p) {
    return std::all_of(p->begin(), p->end(),
                       [](double x) { return x == 0 || (std::abs(x) >= kLeast && std::abs(x) <= kMost); });
  });
}

template <typename By>
exact::Row<typename By::Number> exactly_minus(const Point& a, const Point& b) {
  return {By::minus(a[0], b[0]), By::minus(a[1], b[1]), By::minus(a[2], b[2])};
}

template <typename By>
Vector exact_normal(const Point& a, const Point& b, const Point& c) {
  const auto u = exactly_minus<By>(b, a), v = exactly_minus<By>(c, a);
  const auto minor = [&](std::size_t i, std::size_t j) { return By::to_double(u[i] * v[j] - u[j] * v[i]); };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

template <typename By>
double exact_six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  return By::to_double(
      exact::det3(exactly_minus<By>(b, a), exactly_minus<By>(c, a), exactly_minus<By>(d, a)));
}

// (b - a) x (c - a), of length twice the area.
Vector normal(const Point& a, const Point& b, const Point& c) {
  const Vector u = b - a;
  const Vector v = c - a;
  Vector n{};
  double terms = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double left = u[(i + 1) % 3] * v[(i + 2) % 3];
    const double right = u[(i + 2) % 3] * v[(i + 1) % 3];
    n[i] = left - right;
    terms = std::max(terms, std::abs(left) + std::abs(right));
  }
  if (length(n) > kCancelled * terms) return n;
  return suits_expansions({&a, &b, &c}) ? exact_normal<ByExpansions>(a, b, c)
                                        : exact_normal<ByDyadics>(a, b, c);
}

// det(b - a, c - a, d - a); `n` is the normal of abc.
double six_volumes(const Point& a, const Point& b, const Point& c, const Point& d, const Vector& n) {
  const Vector w = d - a;
  double volume = 0;
  double terms = 0;
  const Vector u = b - a;
  const Vector v = c - a;
  for (std::size_t i = 0; i < 3; ++i) {
    volume += n[i] * w[i];
    terms += (std::abs(u[(i + 1) % 3] * v[(i + 2) % 3]) + std::abs(u[(i + 2) % 3] * v[(i + 1) % 3])) *
             std::abs(w[i]);
  }
  if (std::abs(volume) > kCancelled * terms) return volume;
  return suits_expansions({&a, &b, &c, &d}) ? exact_six_volumes<ByExpansions>(a, b, c, d)
                                            : exact_six_volumes<ByDyadics>(a, b, c, d);
}

// Points times the power of two that keeps products of coordinates in range; quality and angles stay.
template <std::size_t size>
std::array<Point, size> brought_in_range(std::array<Point, size> points) {
  double top = 0;
  for (const Point& p : points)
    for (const double x : p) top = std::max(top, std::abs(x));
  constexpr int kUsual = 200;
  if (top == 0 || !std::isfinite(top) || std::abs(std::ilogb(top)) <= kUsual) return points;
  const int k = -std::ilogb(top);
  for (Point& p : points)
    for (double& x : p) x = std::ldexp(x, k);
  return points;
}

// An angle from 0 to 180 degrees by its sine and cosine, both divided by their sum; unknown where both are 0.
// To compare and count angles takes no arctangent.
struct Angle {
  double sine = 0, cosine = 0;

  [[nodiscard]] bool known() const { return sine != 0 || cosine != 0; }
  [[nodiscard]] double degrees() const {
    return known() ? numbers::atan2(sine, cosine) * 180.0 / std::numbers::pi : kNan;
  }
  friend bool operator<(const Angle& x, const Angle& y) {
    if (x.sine == 0 && y.sine == 0) return x.cosine > 0 && y.cosine < 0;
    return x.sine * y.cosine < x.cosine * y.sine;
  }
};

// The faces at edge k are opposite these corners.
constexpr std::array<std::array<std::size_t, 2>, 6> kFacesAt{
    {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};

struct Measures {
  std::array<Vector, 4> normals;  // of the faces opposite a, b, c, d, all inward or all outward
  double six_volumes;
  std::array<Vector, 6> edges;  // ab ac ad bc bd cd

  explicit Measures(const std::array<Point, 4>& p)
      : normals{normal(p[1], p[3], p[2]), normal(p[0], p[2], p[3]), normal(p[0], p[3], p[1]),
                normal(p[0], p[1], p[2])},
        six_volumes(holdfast::six_volumes(p[0], p[1], p[2], p[3], normals[3])),
        edges{p[1] - p[0], p[2] - p[0], p[3] - p[0], p[2] - p[1], p[3] - p[1], p[3] - p[2]} {}

  // The inradius is three volumes over the area.
  [[nodiscard]] double quality() const {
    double longest = 0;
    for (const Vector& e : edges) longest = std::max(longest, dot(e, e));
    double twice_area = 0;
    for (const Vector& n : normals) twice_area += length(n);
    if (!(std::abs(six_volumes) > 0)) return kInfinity;
    return kScale * std::sqrt(longest) * twice_area / std::abs(six_volumes);
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

  [[nodiscard]] PlainShape shape() const {
    PlainShape shape{quality(), {}};
    const std::array<Angle, 6> angles = dihedral_angles();
    for (std::size_t k = 0; k < 6; ++k)
      shape.cosines[k] =
          angles[k].known() ? angles[k].cosine / numbers::hypot(angles[k].sine, angles[k].cosine) : 1;
    return shape;
  }
};

// In plain arithmetic, right to ten digits; nothing for tetrahedra so thin, or so large or small, that it may
// not be.
std::optional<double> plain_quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr double kThin = 1e-5, kSmall = 1e-50, kLarge = 1e50;
  const Vector u = b - a, v = c - a, w = d - a;
  const Vector x = c - b, y = d - b, z = d - c;
  const double longest =
      std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w), dot(x, x), dot(y, y), dot(z, z)}));
  if (!(longest > kSmall && longest < kLarge)) return std::nullopt;
  const Vector n = cross(u, v);
  const double six_volumes = std::abs(dot(n, w));
  if (six_volumes < kThin * longest * longest * longest) return std::nullopt;
  const double twice_area = length(n) + length(cross(v, w)) + length(cross(w, u)) + length(cross(x, y));
  return kScale * longest * twice_area / six_volumes;
}

// The tetrahedra on a triangle that compete for the least Q.
//
// Let L be the longest side. Over a given foot the inradius grows with the height h of the apex p:
// r = A h / (A + sum of l_i sqrt(d_i^2 + h^2) / 2), with A the area, l_i the sides and d_i the distances of
// the foot from them. So p lies as high as the longest edge allows, and of the longest edge more than L
// never pays. That leaves p on a sphere of radius L round a corner, and the best one lies on two of them:
// those round the ends of the longest side, so that p makes an equilateral triangle with it. What remains
// is one number, the angle between that triangle and abc. (That the best p is of this kind was found by
// search over all p; the unit test repeats it.)
class BestTetrahedron {
 public:
  BestTetrahedron(const Point& a, const Point& b, const Point& c) {
    std::array<double, 3> side{length(c - b), length(a - c), length(b - a)};
    std::sort(side.begin(), side.end());
    longest_ = side[2];
    twice_area_ = length(normal(a, b, c));
    // The third corner beside the longest side: its height over it, and the part that it cuts off.
    height_ = twice_area_ / longest_;
    along_ = std::sqrt(std::max(0.0, side[1] * side[1] - height_ * height_));
  }

  [[nodiscard]] bool flat() const { return !(twice_area_ > 0); }

  // Q with the apex at this angle, in coordinates where the longest side is the x-axis.
  [[nodiscard]] double at(double angle) const {
    const double l = longest_;
    const double reach = l * std::numbers::sqrt3 / 2;
    const Vector apex{l / 2, reach * numbers::cos(angle), reach * numbers::sin(angle)};
    const double twice_lateral = l * reach + twice_area({along_, height_, 0}, apex) +
                                 twice_area({along_ - l, height_, 0}, {-l / 2, apex[1], apex[2]});
    const Vector to_third{along_ - apex[0], height_ - apex[1], apex[2]};
    const double longest = std::max(l, length(to_third));
    return kScale * longest * (twice_area_ + twice_lateral) / (twice_area_ * apex[2]);
  }

  [[nodiscard]] double best_angle() const {
    constexpr double kGolden = 0.6180339887498949;
    constexpr int kSteps = 60;
    double low = 1.2;  // acos(1/3) = 1.231, of the equilateral triangle, is the least
    double high = std::numbers::pi / 2;
    double x = high - kGolden * (high - low), y = low + kGolden * (high - low);
    double at_x = at(x), at_y = at(y);
    for (int k = 0; k < kSteps; ++k) {
      if (at_x < at_y) {
        high = std::exchange(y, x);
        at_y = at_x;
        at_x = at(x = high - kGolden * (high - low));
      } else {
        low = std::exchange(x, y);
        at_x = at_y;
        at_y = at(y = low + kGolden * (high - low));
      }
    }
    return 0.5 * (low + high);
  }

 private:
  // Of the triangle 0 u v.
  static double twice_area(const Vector& u, const Vector& v) { return length(cross(u, v)); }

  double longest_, twice_area_, height_, along_;
};

}  // namespace

double quality(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (const std::optional<double> q = plain_quality(a, b, c, d)) return *q;
  return Measures(brought_in_range<4>({a, b, c, d})).quality();
}

std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c, const Point& d) {
  const std::array<Angle, 6> angles = Measures(brought_in_range<4>({a, b, c, d})).dihedral_angles();
  std::array<double, 6> degrees{};
  std::transform(angles.begin(), angles.end(), degrees.begin(), [](const Angle& x) { return x.degrees(); });
  return degrees;
}

std::optional<PlainShape> plain_shape(const Point& a, const Point& b, const Point& c, const Point& d) {
  constexpr double kThin = 1e-3, kSmall = 1e-50, kLarge = 1e50;
  const Vector u = b - a, v = c - a, w = d - a;
  const Vector x = c - b, y = d - b, z = d - c;
  const double longest2 = std::max({dot(u, u), dot(v, v), dot(w, w), dot(x, x), dot(y, y), dot(z, z)});
  const double longest = std::sqrt(longest2);
  if (!(longest > kSmall && longest < kLarge)) return std::nullopt;
  const std::array<Vector, 4> n{cross(y, x), cross(v, w), cross(w, u), cross(u, v)};
  const double six_volumes = dot(n[3], w);
  if (!(std::abs(six_volumes) > kThin * longest2 * longest)) return std::nullopt;
  PlainShape shape;
  double twice_area = 0;
  std::array<double, 4> inverse{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double area = length(n[i]);
    twice_area += area;
    inverse[i] = 1 / area;
  }
  shape.quality = kScale * longest * twice_area / std::abs(six_volumes);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kFacesAt[k];
    shape.cosines[k] = -dot(n[i], n[j]) * inverse[i] * inverse[j];
  }
  return shape;
}

template <std::size_t kBins>
CosineBins<kBins>::CosineBins(double degrees) {
  for (std::size_t k = 0; k < end_.size(); ++k) {
    const double end = degrees * static_cast<double>(k + 1);
    end_[k] = end == 90 ? 0 : numbers::cos(end * std::numbers::pi / 180);
  }
  // Of a cosine half a cell before, which no rounding takes into the cell.
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    const double before = 1 - (static_cast<double>(cell) - 0.5) * (2.0 / kCells);
    first_[cell] = static_cast<std::uint8_t>(
        std::count_if(end_.begin(), end_.end(), [&](double end) { return before <= end; }));
  }
}
template class CosineBins<std::tuple_size_v<decltype(Report::Shape::least_dihedral)>>;
template class CosineBins<std::tuple_size_v<decltype(Report::Elements::histogram)>>;

double best_quality_on(const Point& a, const Point& b, const Point& c) {
  const auto p = brought_in_range<3>({a, b, c});
  const BestTetrahedron candidates(p[0], p[1], p[2]);
  return candidates.flat() ? kInfinity : candidates.at(candidates.best_angle());
}

namespace {

double target_of(std::span<const Point> vertices, std::span<const Triangle> facets) {
  // Any candidate bounds the best one from above: that of the worst triangle so far settles most triangles,
  // and all of its shape.
  constexpr double kRounding = 1e-12;
  double target = 0, angle = 1.3;
  for (const Triangle& f : facets) {
    const auto p = brought_in_range<3>({vertices[f[0]], vertices[f[1]], vertices[f[2]]});
    const BestTetrahedron candidates(p[0], p[1], p[2]);
    if (candidates.flat()) return kInfinity;
    if (!(candidates.at(angle) > (1 + kRounding) * target)) continue;
    const double best = candidates.best_angle();
    if (!(candidates.at(best) > target)) continue;
    target = candidates.at(best);
    angle = best;
  }
  return target;
}

}  // namespace

double target_quality(std::span<const Point> vertices, std::span<const Triangle> facets,
                      const Threads& threads) {
  constexpr std::size_t kBlock = 8192;  // whatever the threads, since the last bits may depend on it
  std::vector<double> targets(1 + facets.size() / kBlock);
  parallel(threads, targets.size(), [&](std::size_t k) {
    const std::size_t first = k * kBlock;
    targets[k] = target_of(vertices, facets.subspan(first, std::min(kBlock, facets.size() - first)));
  });
  return *std::max_element(targets.begin(), targets.end());
}

namespace {

double degrees_of(double cosine) {
  return numbers::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

// Gathers the angles of a volume: cosines where they are good enough, which is nearly everywhere.
class AngleHistogram {
 public:
  using Counts = decltype(Report::Elements::histogram);

  AngleHistogram() {
    for (std::size_t k = 0; k < kBins; ++k) {
      const double angle = std::numbers::pi * static_cast<double>(k) / kBins;
      start_[k] = {numbers::sin(angle), 2 * k == kBins ? 0 : numbers::cos(angle)};
    }
  }
  void add_cosine(double cosine) {
    greatest_cosine_ = std::max(greatest_cosine_, cosine);
    least_cosine_ = std::min(least_cosine_, cosine);
    ++counts_[bins_(cosine)];
  }
  void add(Angle angle) {
    if (!angle.known()) angle = {0, 1};
    if (angle < least_) least_ = angle;
    if (most_ < angle) most_ = angle;
    const auto after = std::upper_bound(start_.begin() + 1, start_.end(), angle);
    ++counts_[static_cast<std::size_t>(after - start_.begin()) - 1];
  }
  void add(const AngleHistogram& other) {
    for (std::size_t k = 0; k < kBins; ++k) counts_[k] += other.counts_[k];
    greatest_cosine_ = std::max(greatest_cosine_, other.greatest_cosine_);
    least_cosine_ = std::min(least_cosine_, other.least_cosine_);
    if (other.least_ < least_) least_ = other.least_;
    if (most_ < other.most_) most_ = other.most_;
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] double least_degrees() const {
    return std::min(least_.degrees(), degrees_of(greatest_cosine_));
  }
  [[nodiscard]] double most_degrees() const { return std::max(most_.degrees(), degrees_of(least_cosine_)); }

 private:
  static constexpr std::size_t kBins = std::tuple_size_v<Counts>;

  std::array<Angle, kBins> start_;  // of each bin
  CosineBins<kBins> bins_{180.0 / kBins};
  Counts counts_{};
  double greatest_cosine_ = -1, least_cosine_ = 1;
  Angle least_{0, -1}, most_{0, 1};
};

}  // namespace

void ShapeHistogram::add(const PlainShape& element) {
  double of_least = -1, of_most = 1;
  for (const double cosine : element.cosines) {
    of_least = std::max(of_least, cosine);
    of_most = std::min(of_most, cosine);
  }
  if (of_least > of_least_) {
    of_least_ = of_least;
    shape_.min_dihedral_deg = degrees_of(of_least_);
  }
  if (of_most < of_most_) {
    of_most_ = of_most;
    shape_.max_dihedral_deg = degrees_of(of_most_);
  }
  std::size_t q = 0;
  for (const double end : Report::quality_bins) q += element.quality < end ? 0 : 1;
  ++shape_.least_dihedral[bins_(of_least)];
  ++shape_.quality[q];
}

void ShapeHistogram::add(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto plain = plain_shape(a, b, c, d);
  add(plain ? *plain : Measures(brought_in_range<4>({a, b, c, d})).shape());
}

void ShapeHistogram::add(const ShapeHistogram& other) {
  for (std::size_t k = 0; k < shape_.least_dihedral.size(); ++k)
    shape_.least_dihedral[k] += other.shape_.least_dihedral[k];
  for (std::size_t k = 0; k < shape_.quality.size(); ++k) shape_.quality[k] += other.shape_.quality[k];
  if (other.of_least_ > of_least_) {
    of_least_ = other.of_least_;
    shape_.min_dihedral_deg = other.shape_.min_dihedral_deg;
  }
  if (other.of_most_ < of_most_) {
    of_most_ = other.of_most_;
    shape_.max_dihedral_deg = other.shape_.max_dihedral_deg;
  }
}

namespace {

// Of some of the elements of a volume.
struct Measured {
  double worst = 0;
  AngleHistogram angles;
  ShapeHistogram shapes;

  void add(const Point& a, const Point& b, const Point& c, const Point& d, bool with_shapes) {
    PlainShape element;
    if (const auto plain = plain_shape(a, b, c, d)) {
      element = *plain;
      for (const double cosine : element.cosines) angles.add_cosine(cosine);
    } else {
      const Measures measures(brought_in_range<4>({a, b, c, d}));
      element = measures.shape();
      for (const Angle& angle : measures.dihedral_angles()) angles.add(angle);
    }
    worst = std::max(worst, element.quality);
    if (with_shapes) shapes.add(element);
  }
  void add(const Measured& other) {
    worst = std::max(worst, other.worst);
    angles.add(other.angles);
    shapes.add(other.shapes);
  }
};

}  // namespace

Report::Elements measure(const Volume& volume, double target, Report::Shape* shape, const Threads& threads) {
  const std::vector<Point>& v = volume.vertices;
  Measured all;
  std::mutex mutex;
  parallel_ranges(threads, volume.tetrahedra.size(), [&](std::size_t first, std::size_t last) {
    Measured own;
    for (std::size_t k = first; k < last; ++k) {
      const Tetrahedron& t = volume.tetrahedra[k];
      own.add(v[t[0]], v[t[1]], v[t[2]], v[t[3]], shape != nullptr);
    }
    const std::scoped_lock lock(mutex);
    all.add(own);
  });
  if (shape != nullptr) *shape = all.shapes.shape();
  Report::Elements q;
  q.worst = all.worst;
  q.histogram = all.angles.counts();
  q.min_dihedral_deg = volume.tetrahedra.empty() ? 0 : all.angles.least_degrees();
  q.max_dihedral_deg = volume.tetrahedra.empty() ? 0 : all.angles.most_degrees();
  q.target = target;
  return q;
}

}  // namespace holdfast
