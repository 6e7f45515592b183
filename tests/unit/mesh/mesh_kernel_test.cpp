// Kernels of cavities: a point that is found lies inside, exactly, however narrow; none is found in an empty
// kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mesh/editor.h"
#include "mesh/inscribed_ball.h"
#include "mesh/kernel.h"
#include "mesh/measure.h"
#include "mesh_fixtures.h"

namespace holdfast::mesh_kernel_test {
namespace {

using namespace testing;
using exact::Dyadic;
using exact::ExactPoint;
using Random = std::mt19937_64;
using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

// Triangles in chosen planes, in a mesh without tetrahedra that has their corners.
struct Cavity {
  TetMesh mesh;
  std::vector<FaceKey> faces;

  // The plane through three points, its positive side being that of `inside`.
  void face(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& inside) {
    FaceKey f{MeshEditor(mesh).add_vertex(a), MeshEditor(mesh).add_vertex(b), MeshEditor(mesh).add_vertex(c)};
    const Point approx{inside.c[0].to_double(), inside.c[1].to_double(), inside.c[2].to_double()};
    if (mesh.orient(f[0], f[1], f[2], {approx.data(), &inside}) < 0) std::swap(f[0], f[1]);
    faces.push_back(f);
  }
  // The six sides of a cube round `centre`, not aligned with the axes.
  void cube(const ExactPoint& centre, int exponent) {
    static constexpr int kAxes[3][3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        const auto corner = [&](int u, int v) {
          ExactPoint p = centre;
          for (std::size_t k = 0; k < 3; ++k)
            p.c[k] +=
                Dyadic(side * kAxes[axis][k] + u * kAxes[(axis + 1) % 3][k] + v * kAxes[(axis + 2) % 3][k],
                       exponent);
          return p;
        };
        face(corner(-1, -1), corner(1, -1), corner(0, 1), centre);
      }
  }
  [[nodiscard]] Kernel kernel() const { return kernel_of(mesh, faces); }
};

ExactPoint moved(const ExactPoint& p, const std::array<std::int64_t, 3>& v, int exponent = 0) {
  ExactPoint q = p;
  for (std::size_t k = 0; k < 3; ++k) q.c[k] += Dyadic(exact::BigInt(v[k]), exponent);
  return q;
}

std::array<std::int64_t, 3> integer_vector(Random& random, int most) {
  std::array<std::int64_t, 3> v{};
  for (auto& x : v) x = std::uniform_int_distribution<int>(-most, most)(random);
  return v;
}

std::array<std::int64_t, 3> cross(const std::array<std::int64_t, 3>& a,
                                  const std::array<std::int64_t, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void expect_found(const Cavity& cavity, const ExactPoint& origin, const std::string& what) {
  const Point approx{origin.c[0].to_double(), origin.c[1].to_double(), origin.c[2].to_double()};
  const Kernel kernel = cavity.kernel();
  const auto found = kernel.find({approx.data(), &origin});
  ASSERT_TRUE(found.has_value()) << what;
  EXPECT_TRUE(holds(kernel, *found)) << what;
}

// Two planes through the origin, at angles down to 2^-60 and up to nearly 360 degrees of room, in a cube that
// is as large as the planes' triangles or much smaller; the origin is anywhere, not only at a double.
TEST(Kernel, OfTwoPlanesThroughTheOriginIsNeverEmpty) {
  Random random(1);
  for (int trial = 0; trial < 1500; ++trial) {
    ExactPoint origin = moved({}, integer_vector(random, 1000), -(trial % 12));
    if (trial % 3 == 1) origin.c[0] += Dyadic(1, -90);
    if (trial % 3 == 2)
      for (Dyadic& x : origin.c) x = x * Dyadic(exact::BigInt(1234567891234567), -50);
    const auto u = integer_vector(random, 20), v = integer_vector(random, 20);
    const auto n = cross(u, v);
    if (n == std::array<std::int64_t, 3>{}) continue;
    // The second plane holds u, too, and turns away from -v by n / 2^bits: a wedge of about that angle.
    const int bits = trial % 61;
    ExactPoint beside = moved(moved(origin, {-v[0], -v[1], -v[2]}), n, -bits);
    Cavity cavity;
    const ExactPoint in_wedge = moved(moved(origin, {-v[0], -v[1], -v[2]}), n, -bits - 1);
    const ExactPoint far = trial % 2 == 0 ? in_wedge : moved(origin, n);  // of the narrow or the wide wedge
    const ExactPoint back = moved(origin, {-u[0] - v[0], -u[1] - v[1], -u[2] - v[2]});
    cavity.face(moved(origin, u), moved(origin, v), back, far);
    cavity.face(moved(origin, u), beside, moved(origin, {-u[0], -u[1], -u[2]}), far);
    if (trial % 5 == 0)  // the same plane twice
      cavity.face(moved(origin, u, -1), moved(origin, v, -2), moved(back, u, 1), far);
    cavity.cube(origin, -(trial / 7 % 30));
    expect_found(cavity, origin, "trial " + std::to_string(trial));
  }
}

TEST(Kernel, OfOnePlaneThroughTheOriginIsNeverEmpty) {
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const ExactPoint origin = moved({}, integer_vector(random, 1 << 20), -(trial % 40));
    const auto u = integer_vector(random, 50), v = integer_vector(random, 50), n = cross(u, v);
    if (n == std::array<std::int64_t, 3>{}) continue;
    Cavity cavity;
    cavity.face(moved(origin, u), moved(origin, v), moved(origin, {-u[0] - v[0], -u[1] - v[1], -u[2] - v[2]}),
                moved(origin, n));
    cavity.cube(origin, -(trial % 60));
    expect_found(cavity, origin, "trial " + std::to_string(trial));
  }
}

// A cube cut down by two parallel planes, a gap apart.
Cavity slab(const ExactPoint& below, double gap) {
  Cavity cavity;
  ExactPoint inside = below;
  inside.c[2] += Dyadic(gap).scaled(-1);
  cavity.cube(inside, 0);
  for (const double level : {0.0, gap}) {
    ExactPoint at = below;
    at.c[2] += Dyadic(level);
    cavity.face(moved(at, {1, 0, 0}), moved(at, {0, 1, 0}), moved(at, {-1, -1, 0}), inside);
  }
  return cavity;
}

TEST(Kernel, NarrowSlabs) {
  for (const double gap : {1e-3, 1e-9, 1e-13, 1e-14, 1e-15, 1e-16, 1e-17, 1e-20, 1e-40, 1e-200}) {
    const ExactPoint below = exact::lift(Point{0.3, 0.2, 0}.data());
    const Cavity cavity = slab(below, gap);
    ExactPoint origin = below;
    origin.c[2] += Dyadic(gap).scaled(-1);
    expect_found(cavity, origin, "middle, gap " + std::to_string(std::log10(gap)));
    expect_found(cavity, below, "border, gap " + std::to_string(std::log10(gap)));
  }
}

// In doubles if some lie inside, otherwise at an exact position.
TEST(Kernel, BetweenNeighbouringDoubles) {
  const double ulp = std::numeric_limits<double>::epsilon();
  const ExactPoint below = exact::lift(Point{0.3, 0.2, 1}.data());
  for (const int ulps : {1, 2, 3, 4, 8, 16}) {
    const Cavity cavity = slab(below, ulps * ulp);
    ExactPoint origin = below;
    origin.c[2] += Dyadic(ulps * ulp).scaled(-1);
    const Point approx{0.3, 0.2, origin.c[2].to_double()};
    const Kernel kernel = cavity.kernel();
    const auto found = kernel.find({approx.data(), &origin});
    ASSERT_TRUE(found.has_value()) << ulps;
    EXPECT_TRUE(holds(kernel, *found)) << ulps;
    EXPECT_EQ(std::holds_alternative<Point>(*found), ulps > 1) << ulps;
    TetMesh mesh;
    EXPECT_EQ(mesh.is_explicit(MeshEditor(mesh).add_vertex(*found)), ulps > 1);
    MeshEditor(mesh).add_vertex(Point{});
    MeshEditor(mesh).move_vertex(1, *found);
    EXPECT_EQ(mesh.exact_position(1).c, exact_of(*found).c);
  }
}

// Wedges and needles between general planes whose normals nearly cancel, no plane through the origin.
TEST(Kernel, NarrowWedgesInGeneralPosition) {
  Random random(3);
  for (int trial = 0; trial < 600; ++trial) {
    const int bits = trial % 50;
    const auto u = integer_vector(random, 20), v = integer_vector(random, 20), n = cross(u, v);
    if (n == std::array<std::int64_t, 3>{}) continue;
    const ExactPoint origin = moved({}, integer_vector(random, 100), -3);
    Cavity cavity;
    cavity.cube(origin, 6);
    // Two sheets above and below the origin, 2^-bits n away, the upper one tilted a little.
    for (const int side : {-1, 1}) {
      const ExactPoint at = moved(origin, {side * n[0], side * n[1], side * n[2]}, -bits);
      cavity.face(moved(at, u), moved(moved(at, v), n, -bits - 3),
                  moved(at, {-u[0] - v[0], -u[1] - v[1], -u[2] - v[2]}), origin);
    }
    expect_found(cavity, origin, "trial " + std::to_string(trial));
  }
}

TEST(Kernel, EmptyOnesAreFoundToBeSo) {
  const ExactPoint origin = exact::lift(Point{0.25, 1, -3}.data());
  const Point approx{0.25, 1, -3};
  // Three planes through the origin whose normals cancel.
  Cavity star;
  const std::array<std::int64_t, 3> normals[3] = {{1, 0, 0}, {-1, 1, 0}, {0, -1, 0}};
  for (const auto& n : normals) {
    const std::array<std::int64_t, 3> along{-n[1], n[0], 0};
    star.face(moved(origin, along), moved(origin, {0, 0, 1}), moved(origin, {-along[0], -along[1], 0}),
              moved(origin, n));
  }
  star.cube(origin, 0);
  EXPECT_FALSE(star.kernel().find({approx.data(), nullptr}).has_value());
  // A cube inside out.
  Cavity inverted;
  inverted.cube(origin, 0);
  for (FaceKey& f : inverted.faces) std::swap(f[0], f[1]);
  EXPECT_FALSE(inverted.kernel().find({approx.data(), nullptr}).has_value());
  EXPECT_LE(inverted.kernel().centre({approx.data(), nullptr}).radius, 0);
  // Two half-spaces that face away from each other, slightly apart.
  Cavity apart = slab(origin, 1e-15);
  for (std::size_t k = 6; k < 8; ++k) std::swap(apart.faces[k][0], apart.faces[k][1]);
  EXPECT_FALSE(apart.kernel().find({approx.data(), nullptr}).has_value());
}

TEST(Kernel, CentreOfACube) {
  const Point middle{5, -2, 0.5};
  for (const int exponent : {0, -30, 40, -300, 300}) {
    Cavity cavity;
    cavity.cube(exponent < 200 ? exact::lift(middle.data()) : ExactPoint{}, exponent);
    const Point origin = exponent < 200 ? middle : Point{};
    const Kernel::Centre centre = cavity.kernel().centre({origin.data(), nullptr});
    const double side = std::ldexp(3, exponent);
    EXPECT_NEAR(centre.radius / side, 1, 1e-9) << exponent;
    for (const double x : centre.offset) EXPECT_NEAR(x / side, 0, 1e-9) << exponent;
    for (const double h : centre.heights) EXPECT_NEAR(h / side, 1, 1e-9) << exponent;
  }
}

// The ball of every vertex of a random mesh: the vertex itself is inside, what `find` gives is, and a
// neighbour is `seen_from` exactly when all tetrahedra coned to it are positive.
TEST(Kernel, OfBallsInAMesh) {
  TetMesh mesh = delaunay_in_box(random_points(150, 4));
  int collapsible = 0;
  for (Vertex p = 0; p < 150; ++p) {
    const std::vector<Tet> tets = ball_of(mesh, p);
    const std::vector<FaceKey> faces = outer_faces(mesh, tets);
    const Kernel kernel = kernel_of(mesh, faces);
    EXPECT_TRUE(kernel.holds(mesh.point(p)));
    const auto found = kernel.find(mesh.point(p));
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(holds(kernel, *found));
    EXPECT_TRUE(std::holds_alternative<Point>(*found));
    std::set<Vertex> link;
    for (const FaceKey& f : faces) link.insert(f.begin(), f.end());
    double fattest = -1;
    Vertex best = kNone;
    for (const Vertex v : link) {
      const auto fresh = cone(faces, v);
      ASSERT_EQ(kernel.seen_from(v), all_positive(mesh, fresh));
      if (!kernel.seen_from(v)) continue;
      ++collapsible;
      double thinnest = 2;
      for (const auto& c : fresh)
        thinnest = std::min(thinnest, fatness(mesh, c[0], c[1], c[2], mesh.point(c[3])));
      if (thinnest > fattest) {
        fattest = thinnest;
        best = v;
      }
    }
    EXPECT_EQ(best_apex(mesh, kernel), best);
  }
  EXPECT_GT(collapsible, 50);
}

TEST(InscribedBall, OfATetrahedron) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<Point> p = random_points(4, random());
    // Relative to a point inside; the radius is three volumes over the area.
    Vector inside{};
    for (const Point& q : p)
      for (std::size_t k = 0; k < 3; ++k) inside[k] += q[k] / 4;
    std::vector<HalfSpace> half_spaces;
    double area = 0, volume = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      Vector u{}, v{}, a{};
      for (std::size_t k = 0; k < 3; ++k) {
        u[k] = p[(i + 1) % 4][k] - p[i][k];
        v[k] = p[(i + 2) % 4][k] - p[i][k];
        a[k] = p[i][k] - inside[k];
      }
      Vector n = cross(u, v);
      const double size = length(n);
      double b = dot(n, a) / size;
      for (double& x : n) x /= b < 0 ? -size : size;
      b = std::abs(b);
      half_spaces.push_back({n, b});
      area += size / 2;
      volume += size / 2 * b / 3;
    }
    const InscribedBall ball = inscribed_ball(half_spaces);
    EXPECT_NEAR(ball.radius, 3 * volume / area, 1e-9);
    for (const HalfSpace& h : half_spaces) EXPECT_NEAR(h.b - dot(h.n, ball.centre), ball.radius, 1e-9);
  }
}

// Feasible, and no step in any of many directions leads to a larger ball: the programme is concave.
TEST(InscribedBall, IsTheLargest) {
  Random random(6);
  std::normal_distribution<double> normal;
  const auto depth = [](const std::vector<HalfSpace>& half_spaces, const Vector& y) {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfSpace& h : half_spaces) least = std::min(least, h.b - dot(h.n, y));
    return least;
  };
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<HalfSpace> half_spaces;
    for (int k = 0; k < 6; ++k) {
      Vector n{};
      n[static_cast<std::size_t>(k / 2)] = k % 2 == 0 ? 1 : -1;
      half_spaces.push_back({n, 2});
    }
    for (int k = 0; k < 5 + trial % 40; ++k) {
      Vector n{normal(random), normal(random), normal(random)};
      const double size = length(n);
      for (double& x : n) x /= size;
      half_spaces.push_back({n, k % 3 == 0 ? 0 : std::abs(normal(random))});
    }
    const InscribedBall ball = inscribed_ball(half_spaces);
    EXPECT_NEAR(depth(half_spaces, ball.centre), ball.radius, 1e-9);
    for (int k = 0; k < 300; ++k) {
      Vector y = ball.centre;
      for (double& x : y) x += normal(random) * std::pow(10, -(k % 7));
      EXPECT_LE(depth(half_spaces, y), ball.radius + 1e-9);
    }
  }
}

TEST(InscribedBall, OfAnUnboundedSetIsNone) {
  EXPECT_EQ(inscribed_ball({}).radius, 0);
  const HalfSpace one{{0, 0, 1}, 1};
  EXPECT_EQ(inscribed_ball(std::span(&one, 1)).radius, 0);
}

TEST(InscribedBall, OfAFlatSetHasNoRadius) {
  std::vector<HalfSpace> flat{{{0, 0, 1}, 0},  {{0, 0, -1}, 0}, {{1, 0, 0}, 1},
                              {{-1, 0, 0}, 1}, {{0, 1, 0}, 1},  {{0, -1, 0}, 1}};
  EXPECT_EQ(inscribed_ball(flat).radius, 0);
}

}  // namespace
}  // namespace holdfast::mesh_kernel_test
