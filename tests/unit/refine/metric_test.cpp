// The algebra of metrics, frames, and metrics read from files.
#include "metric/metric.h"

#include <gtest/gtest.h>

#include <random>

#include "io_samples.h"
#include "metric/frame.h"

namespace holdfast::metric_test {
namespace {

using Vector = std::array<double, 3>;

class RandomMetrics {
 public:
  explicit RandomMetrics(std::uint64_t seed) : random_(seed) {}
  Vector vector() {
    const double x = any_(random_), y = any_(random_);
    return {x, y, any_(random_)};
  }
  /// Sums of squares along three random vectors, of lengths that differ by up to four orders of magnitude.
  Metric metric() {
    Metric m{};
    for (const int power : {-2, 0, 2}) {
      const Vector e = vector();
      const Metric square{e[0] * e[0], e[0] * e[1], e[1] * e[1], e[0] * e[2], e[1] * e[2], e[2] * e[2]};
      m = m + std::pow(10, power) * square;
    }
    return m;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> any_{-1, 1};
};

constexpr Metric diagonal(double x, double y, double z) { return {x, 0, y, 0, 0, z}; }

void expect_near(const Metric& a, const Metric& b, double part) {
  const double most = std::abs(a[0]) + std::abs(a[2]) + std::abs(a[5]);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], part * most) << k;
}

TEST(Metric, IsPositiveDefiniteOrNot) {
  EXPECT_TRUE(is_positive_definite(diagonal(1, 2, 3)));
  EXPECT_TRUE(is_positive_definite(diagonal(1e-200, 1, 1e200)));
  EXPECT_TRUE(is_positive_definite({2, 1, 2, 1, 1, 2}));
  EXPECT_FALSE(is_positive_definite({}));
  EXPECT_FALSE(is_positive_definite(diagonal(1, 1, 0)));
  EXPECT_FALSE(is_positive_definite(diagonal(-1, 1, 1)));
  EXPECT_FALSE(is_positive_definite(diagonal(-1, -1, 1)));
  EXPECT_FALSE(is_positive_definite({1, 2, 1, 0, 0, 1}));
  EXPECT_FALSE(is_positive_definite({1, 0.9, 1, 0.9, -0.9, 1}));
  EXPECT_FALSE(is_positive_definite(diagonal(1, std::nan(""), 1)));
  EXPECT_FALSE(is_positive_definite(diagonal(1, 1, HUGE_VAL)));
  RandomMetrics random(1);
  for (int k = 0; k < 1000; ++k) EXPECT_TRUE(is_positive_definite(random.metric()));
}

TEST(Metric, MeasuresLengths) {
  EXPECT_DOUBLE_EQ(length(isotropic_metric(0.1), Vector{0.3, 0, 0.4}), 5);
  EXPECT_DOUBLE_EQ(length(diagonal(4, 1, 1), Vector{1, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(length({0, 1, 0, 0, 0, 0}, Vector{1, 2, 5}), 2);
  EXPECT_DOUBLE_EQ(largest_size(diagonal(4, 0.25, 1)), 2);
  // Sizes from h to 4 h over the length l: the integral of ds / h(s), 3 / (h log 4) times l / 3 over 4.
  const Vector e{1, 0, 0};
  EXPECT_NEAR(length(isotropic_metric(1), isotropic_metric(4), e), 0.75 / std::log(4), 1e-12);
  EXPECT_NEAR(length(isotropic_metric(4), isotropic_metric(1), e), 0.75 / std::log(4), 1e-12);
  EXPECT_DOUBLE_EQ(length(isotropic_metric(0.5), isotropic_metric(0.5), e), 2);
}

TEST(Metric, AFrameHasTheLengthsOfItsMetric) {
  RandomMetrics random(2);
  for (int k = 0; k < 1000; ++k) {
    const Metric m = random.metric();
    const Point origin = random.vector(), p = random.vector(), q = random.vector();
    const Frame frame(m, origin);
    const Point a = frame.to(p), b = frame.to(q), back = frame.from(a);
    const double in_frame = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    EXPECT_NEAR(in_frame / length(m, {p[0] - q[0], p[1] - q[1], p[2] - q[2]}), 1, 1e-9);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], p[i], 1e-6);
  }
  EXPECT_TRUE(Frame().is_plain());
  EXPECT_EQ(Frame().to({1, 2, 3}), (Point{1, 2, 3}));
}

TEST(Metric, AnIntersectionIsShorterInNeither) {
  RandomMetrics random(3);
  for (int k = 0; k < 1000; ++k) {
    const Metric a = random.metric(), b = random.metric(), both = intersection(a, b);
    ASSERT_TRUE(is_positive_definite(both));
    for (int i = 0; i < 20; ++i) {
      const Vector e = random.vector();
      EXPECT_GE(length(both, e) * (1 + 1e-6), std::max(length(a, e), length(b, e)));
    }
    expect_near(both, intersection(b, a), 1e-6);
    expect_near(both, intersection(both, a), 1e-6);
    EXPECT_EQ(intersection(a, 0.5 * a), a);
    EXPECT_EQ(intersection({}, a), a);
    EXPECT_EQ(intersection(a, {}), a);
  }
  expect_near(intersection(diagonal(4, 1, 9), diagonal(1, 16, 2)), diagonal(4, 16, 9), 1e-12);
  expect_near(intersection(isotropic_metric(0.5), diagonal(1, 25, 4)), diagonal(4, 25, 4), 1e-12);
}

TEST(Metric, LogarithmAndExponentialAreInverse) {
  RandomMetrics random(4);
  for (int k = 0; k < 1000; ++k) {
    const Metric m = random.metric();
    expect_near(m, exponential(logarithm(m)), 1e-9);
    // The determinant of a mean of logarithms is the geometric mean of the determinants: no swelling.
    const Metric other = random.metric(), mean = exponential(0.5 * (logarithm(m) + logarithm(other)));
    const auto determinant = [](const Metric& x) {
      return x[0] * (x[2] * x[5] - x[4] * x[4]) - x[1] * (x[1] * x[5] - x[4] * x[3]) +
             x[3] * (x[1] * x[4] - x[2] * x[3]);
    };
    EXPECT_TRUE(is_positive_definite(mean));
    EXPECT_NEAR(determinant(mean) / std::sqrt(determinant(m) * determinant(other)), 1, 1e-4);
  }
  expect_near(exponential({}), diagonal(1, 1, 1), 1e-12);
}

/// One tetrahedron, whose first corner has other sizes than the rest.
SizeField one_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 1, 2, 3}},
          {},
          {diagonal(1, 100, 1), diagonal(1, 1, 1), diagonal(1, 1, 1), diagonal(1, 1, 1)}};
}

TEST(MetricField, SizesBetweenVerticesAreGeometricMeans) {
  const auto metric = metric_function(one_tetrahedron());
  expect_near(metric({0, 0, 0}), diagonal(1, 100, 1), 1e-9);
  expect_near(metric({0.5, 0, 0}), diagonal(1, 10, 1), 1e-9);
  EXPECT_EQ(metric({1, 1, 1}), Metric{});
}

TEST(MetricField, EveryVertexNeedsAMetric) {
  SizeField field = one_tetrahedron();
  field.metrics[2] = diagonal(1, 1, -1);
  EXPECT_THROW(static_cast<void>(metric_function(field)), std::invalid_argument);
  field.metrics.pop_back();
  EXPECT_THROW(static_cast<void>(metric_function(field)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(size_function(field)), std::invalid_argument);
  field = one_tetrahedron();
  field.tetrahedra[0][3] = 4;
  EXPECT_THROW(static_cast<void>(metric_function(field)), std::invalid_argument);
}

class MetricFiles : public ::testing::Test {
 protected:
  /// Writes the same mesh in all formats, with the given form of the tensors in each.
  void write(const std::string& lower, const std::string& full, const std::string& vtk) {
    samples::put(folder_ / "m.mesh",
                 "MeshVersionFormatted 2 Dimension 3 Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                 "Tetrahedra 1\n1 2 3 4 0\nEnd\n");
    samples::put(folder_ / "m.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 3\n" +
                                        times(4, lower + "\n") + "End\n");
    samples::put(folder_ / "t.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    samples::put(folder_ / "t.ele", "1 4 0\n0 0 1 2 3\n");
    samples::put(folder_ / "t.mtr", "4 6\n" + times(4, lower + "\n"));
    samples::put(folder_ / "g.pos",
                 "View \"m\" {\nTT(0,0,0,1,0,0,0,1,0,0,0,1){" + times(3, full + ",\n") + full + "};\n};\n");
    for (const auto& [name, components, tensor] :
         {std::tuple("nine.vtu", "9", full), std::tuple("six.vtu", "6", vtk)}) {
      std::string values = times(4, tensor + "\n");
      std::replace(values.begin(), values.end(), ',', ' ');
      samples::put(folder_ / name,
                   "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
                   "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>"
                   "<DataArray type=\"Float64\" Name=\"metric\" NumberOfComponents=\"" +
                       std::string(components) + "\" format=\"ascii\">" + values +
                       "</DataArray></PointData><Points>"
                       "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
                       "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
                       "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
                       "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
                       "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells>"
                       "</Piece></UnstructuredGrid></VTKFile>");
    }
  }
  static std::string times(int count, const std::string& text) {
    std::string all;
    for (int k = 0; k < count; ++k) all += text;
    return all;
  }
  /// The message with which a file is refused.
  std::string refused(const std::string& name) const {
    try {
      static_cast<void>(read_size_field(folder_ / name));
    } catch (const FileError& error) {
      return error.what();
    }
    ADD_FAILURE() << name << " was read";
    return {};
  }
  void expect_refused(const std::string& name, const std::string& where, const std::string& reason) const {
    const std::string message = refused(name);
    EXPECT_NE(message.find(where), std::string::npos) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  }

  samples::TemporaryFolder folder_;
};

TEST_F(MetricFiles, AreReadInEveryFormat) {
  write("9 1 8 2 3 7", "9,1,2,1,8,3,2,3,7", "9,8,7,1,3,2");
  for (const char* name : {"m.mesh", "m.sol", "t.mtr", "g.pos", "nine.vtu", "six.vtu"}) {
    const SizeField field = read_size_field(folder_ / name);
    EXPECT_EQ(field.tetrahedra.size(), 1u) << name;
    EXPECT_TRUE(field.sizes.empty()) << name;
    EXPECT_EQ(field.metrics, std::vector<Metric>(4, Metric{9, 1, 8, 2, 3, 7})) << name;
  }
}

TEST_F(MetricFiles, BinaryOnesAreReadInEveryVersion) {
  write("9 1 8 2 3 7", "9,1,2,1,8,3,2,3,7", "9,8,7,1,3,2");
  std::filesystem::remove(folder_ / "m.sol");
  std::vector<double> tensors;
  for (int k = 0; k < 4; ++k) tensors.insert(tensors.end(), {9, 1, 8, 2, 3, 7});
  for (const std::int32_t version : {1, 2, 3, 4})
    for (const bool big : {false, true}) {
      samples::put(folder_ / "m.solb", samples::binary_sol(version, big, 4, 3, tensors));
      for (const char* name : {"m.mesh", "m.solb"})
        EXPECT_EQ(read_size_field(folder_ / name).metrics, std::vector<Metric>(4, Metric{9, 1, 8, 2, 3, 7}));
      samples::put(folder_ / "m.solb", samples::binary_sol(version, big, 4, 1, {1, 2, 3, 4}));
      EXPECT_EQ(read_size_field(folder_ / "m.mesh").sizes, (std::vector<double>{1, 2, 3, 4}));
    }
}

TEST_F(MetricFiles, BrokenBinaryOnesAreRefused) {
  write("9 1 8 2 3 7", "9,1,2,1,8,3,2,3,7", "9,8,7,1,3,2");
  const std::string good = samples::binary_sol(2, false, 4, 1, {1, 2, 3, 4});
  samples::put(folder_ / "m.solb", good);
  static_cast<void>(read_size_field(folder_ / "m.solb"));
  for (std::size_t length = 0; length + 20 < good.size(); ++length) {
    samples::put(folder_ / "m.solb", good.substr(0, length));
    expect_refused("m.solb", "m.solb", "");
  }
  samples::put(folder_ / "m.solb", samples::binary_sol(2, false, 4, 2, {1, 2, 3, 4}));
  expect_refused("m.solb", "byte", "symmetric tensor (type 3)");
  samples::put(folder_ / "m.solb", samples::binary_sol(2, false, 3, 1, {1, 2, 3}));
  expect_refused("m.solb", "", "sizes for 3 vertices, but the mesh has 4");
  samples::put(folder_ / "m.solb", samples::binary_sol(2, false, -1, 1, {}));
  expect_refused("m.solb", "byte", "negative");
  samples::put(folder_ / "m.solb", samples::binary_sol(4, false, 1ll << 60, 3, {1}));
  expect_refused("m.solb", "byte", "truncated");
  samples::put(folder_ / "m.solb", samples::binary_gmf(3, false));
  expect_refused("m.solb", "byte", "no section SolAtVertices");
}

TEST_F(MetricFiles, TensorsThatAreNotPositiveDefiniteAreRefusedWithTheirPlace) {
  write("9 10 8 2 3 7", "9,10,2,10,8,3,2,3,7", "9,8,7,10,3,2");
  expect_refused("m.mesh", "m.sol: line 6", "not positive definite");
  expect_refused("t.mtr", "line 2", "not positive definite");
  expect_refused("g.pos", "line 2", "positive definite");
  expect_refused("nine.vtu", "vertex 0", "not positive definite");
  expect_refused("six.vtu", "vertex 0", "not positive definite");
  write("9 1 8 2 3 nan", "9,1,2,4,8,3,2,3,7", "9,8,nan,1,3,2");
  expect_refused("m.sol", "line 6", "not finite");
  expect_refused("g.pos", "line 2", "symmetric");
  expect_refused("nine.vtu", "vertex 0", "not symmetric");
  expect_refused("six.vtu", "line 1", "not finite");
}

TEST_F(MetricFiles, BrokenOnesAreRefused) {
  write("9 1 8 2 3", "9,1,2,1,8,3,2,3", "9,8,7,1,3");  // a number is missing
  expect_refused("m.sol", "line", "");  // whichever number is met first in the place of another
  expect_refused("t.mtr", "line", "");
  expect_refused("g.pos", "line", "");
  expect_refused("nine.vtu", "", "values instead of 36");
  write("9 1 8 2 3 7", "9,1,2,1,8,3,2,3,7", "9,8,7,1,3,2");
  samples::put(folder_ / "m.sol", "MeshVersionFormatted 2 Dimension 3 SolAtVertices 4\n1 2\n1 2 3 4\n");
  expect_refused("m.sol", "line 2", "symmetric tensor (type 3)");
  samples::put(folder_ / "t.mtr", "4 3\n1 2 3 4\n");
  expect_refused("t.mtr", "line 1", "1 column (sizes) or 6");
  samples::put(folder_ / "g.pos", "TT(0,0,0,1,0,0,0,1,0,0,0,1){" + times(36, "1 ") + "};\n");
  expect_refused("g.pos", "line 1", "positive definite");
  samples::put(folder_ / "alone.mtr", "1 6\n9 1 8 2 3 7\n");
  expect_refused("alone.mtr", "", "need a background mesh");
}

}  // namespace
}  // namespace holdfast::metric_test
