// The elementary functions compared with wider numbers and with known bits; random orders; vectors; sorted
// lists and keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "mesh/keys.h"
#include "numbers/elementary.h"
#include "numbers/halving.h"
#include "numbers/random.h"
#include "numbers/sorted.h"
#include "numbers/vector.h"

namespace holdfast::numbers_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.141592653589793;

double even(numbers::Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// In units in the last place of the true value, over numbers between low and high, or 2^low and 2^high.
template <typename Ours, typename Theirs>
double worst_error(Ours&& ours, Theirs&& theirs, double low, double high, bool exponents = false) {
  numbers::Random random(1);
  double worst = 0;
  for (int k = 0; k < 100'000; ++k) {
    double x = even(random, low, high);
    if (exponents) x = std::exp2(x);
    const long double truth = theirs(static_cast<long double>(x));
    const double size = std::abs(static_cast<double>(truth));
    const double unit = std::nextafter(size, kInfinity) - size;
    worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(ours(x)) - truth) / unit));
  }
  return worst;
}

class Elementary : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "no wider numbers to compare with";
  }
};

TEST_F(Elementary, ExponentialIsRight) {
  const auto truth = [](long double x) { return std::exp(x); };
  EXPECT_LT(worst_error(numbers::exp, truth, -700, 700), 1);
  EXPECT_LT(worst_error(numbers::exp, truth, -1, 1), 1);
}

TEST_F(Elementary, LogarithmIsRight) {
  const auto truth = [](long double x) { return std::log(x); };
  EXPECT_LT(worst_error(numbers::log, truth, -1074, 1023, true), 1);
  EXPECT_LT(worst_error(numbers::log, truth, 0.5, 2), 1);
  EXPECT_LT(worst_error(numbers::log, truth, 0.999, 1.001), 1);
}

TEST_F(Elementary, CubeRootIsRight) {
  const auto truth = [](long double x) { return std::cbrt(x); };
  EXPECT_LT(worst_error(numbers::cbrt, truth, -1074, 1023, true), 1);
  EXPECT_LT(worst_error(numbers::cbrt, truth, -10, 10), 1);
}

TEST_F(Elementary, AnglesAreRight) {
  EXPECT_LT(worst_error(
                numbers::sin, [](long double x) { return std::sin(x); }, -3.1, 3.1),
            3);
  EXPECT_LT(worst_error(
                numbers::cos, [](long double x) { return std::cos(x); }, -1000, 1000),
            3);
  EXPECT_LT(worst_error(
                numbers::acos, [](long double x) { return std::acos(x); }, -1, 1),
            4);
  for (const double y : {1.0, -1.0})
    for (const double sign : {1.0, -1.0}) {
      const auto ours = [&](double x) { return numbers::atan2(y, sign * x); };
      const auto truth = [&](long double x) { return std::atan2(static_cast<long double>(y), sign * x); };
      EXPECT_LT(worst_error(ours, truth, -60, 60, true), 3);
    }
}

TEST_F(Elementary, LengthIsRightAtBothEndsOfTheRange) {
  for (const int scale : {0, -1060, 900}) {
    const double factor = std::ldexp(1.0, scale);
    const auto ours = [&](double x) { return numbers::hypot(factor * x, factor, -factor); };
    const auto truth = [&](long double x) {
      const auto y = static_cast<long double>(factor);
      return y * std::sqrt(x * x + 2);
    };
    EXPECT_LT(worst_error(ours, truth, -8, 8, true), 3) << scale;
  }
}

TEST(ElementaryEnds, AreHandled) {
  EXPECT_EQ(numbers::exp(0), 1);
  EXPECT_EQ(numbers::exp(-kInfinity), 0);
  EXPECT_EQ(numbers::exp(710), kInfinity);
  EXPECT_EQ(numbers::exp(-745), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(numbers::log(1), 0);
  EXPECT_EQ(numbers::log(0), -kInfinity);
  EXPECT_EQ(numbers::log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(numbers::log(-1)));
  EXPECT_EQ(numbers::cbrt(-8), -2);
  EXPECT_EQ(numbers::cbrt(27), 3);
  EXPECT_EQ(numbers::hypot(3, 4), 5);
  EXPECT_EQ(numbers::hypot(0, 0, 0), 0);
  EXPECT_EQ(numbers::hypot(1, -kInfinity, 1), kInfinity);
  EXPECT_EQ(numbers::hypot(3e-320, 4e-320), 5e-320);
  EXPECT_EQ(numbers::hypot(3e307, 4e307), 5e307);
  EXPECT_TRUE(std::isnan(numbers::hypot(1, std::nan(""), 1)));
  EXPECT_EQ(numbers::atan2(0, 1), 0);
  EXPECT_EQ(numbers::atan2(0, -1), kPi);
  EXPECT_EQ(numbers::atan2(2, 0), kPi / 2);
  EXPECT_EQ(numbers::atan2(-2, 0), -kPi / 2);
  EXPECT_EQ(numbers::acos(1), 0);
  EXPECT_EQ(numbers::acos(-1), kPi);
  EXPECT_EQ(numbers::cos(0), 1);
  EXPECT_TRUE(std::isnan(numbers::sin(kInfinity)));
}

// Any difference in a single bit between libraries or processors makes this fail.
TEST(ElementaryBits, AreTheSameEverywhere) {
  numbers::Random random(3);
  std::uint64_t digest = 0;
  const auto add = [&](double x) {
    digest = (digest ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
  };
  for (int k = 0; k < 20'000; ++k) {
    const double x = even(random, -30, 30), y = even(random, -1, 1);
    for (const double value : {numbers::exp(x), numbers::log(x + 31), numbers::cbrt(x), numbers::hypot(x, y),
                               numbers::hypot(x, y, 3), numbers::sin(x), numbers::cos(x),
                               numbers::atan2(x, y), numbers::acos(y), numbers::bell(random)})
      add(value);
  }
  EXPECT_EQ(digest, 12329334262455746209u);
}

TEST(RandomOrder, AllOrdersAreEquallyLikely) {
  numbers::Random random(2);
  for (const int size : {3, 4}) {
    std::map<std::vector<int>, int> count;
    constexpr int kTimes = 24'000;
    for (int k = 0; k < kTimes; ++k) {
      std::vector<int> order(static_cast<std::size_t>(size));
      std::iota(order.begin(), order.end(), 0);
      numbers::shuffle(order.begin(), order.end(), random);
      ++count[order];
    }
    const int orders = size == 3 ? 6 : 24;
    EXPECT_EQ(count.size(), static_cast<std::size_t>(orders));
    for (const auto& [order, n] : count) EXPECT_NEAR(n, kTimes / orders, 6 * std::sqrt(kTimes / orders));
  }
}

TEST(RandomOrder, IsTheSameEverywhere) {
  numbers::Random random(2);
  std::vector<int> order(9);
  std::iota(order.begin(), order.end(), 0);
  numbers::shuffle(order.begin(), order.end(), random);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 4, 8, 6, 2, 5, 7, 3}));
  std::vector<int> none;
  numbers::shuffle(none.begin(), none.end(), random);
  std::vector<int> one{7};
  numbers::shuffle(one.begin(), one.end(), random);
  EXPECT_EQ(one, std::vector<int>{7});
}

TEST(RandomNumbers, AreBelowAndEven) {
  numbers::Random random(4);
  std::array<int, 7> count{};
  for (int k = 0; k < 70'000; ++k) ++count.at(numbers::below(7, random));
  for (const int n : count) EXPECT_NEAR(n, 10'000, 600);
  // A range for which most numbers have to be discarded.
  const std::uint64_t large = (std::uint64_t{1} << 63) + 1;
  for (int k = 0; k < 1000; ++k) EXPECT_LT(numbers::below(large, random), large);
}

TEST(RandomNumbers, OfABellHaveMeanZeroAndVarianceOne) {
  numbers::Random random(5);
  double sum = 0, squares = 0;
  constexpr int kTimes = 100'000;
  for (int k = 0; k < kTimes; ++k) {
    const double x = numbers::bell(random);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kTimes, 0, 0.02);
  EXPECT_NEAR(squares / kTimes, 1, 0.02);
}

TEST(Vectors, CrossIsNormalToBothAndRightHanded) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vector{0, 0, 1}));
  const Vector u{1, 2, 3}, v{-2, 5, 7};
  EXPECT_EQ(dot(cross(u, v), u), 0);
  EXPECT_EQ(dot(cross(u, v), v), 0);
  EXPECT_EQ(dot(cross(u, v), cross(u, v)), dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v));
  EXPECT_EQ(distance({1, 2, 3}, {4, 6, 15}), 13);
}

TEST(Vectors, DistancesInTheWholeRangeOfDoubles) {
  const Vector far{3e200, 4e200, 0}, near{3e-200, 4e-200, 0};
  EXPECT_EQ(distance({}, far), kInfinity);
  EXPECT_DOUBLE_EQ(numbers::distance({}, far), 5e200);
  EXPECT_EQ(distance({}, near), 0);
  EXPECT_DOUBLE_EQ(numbers::distance({}, near), 5e-200);
}

TEST(Sorted, ListsHoldEachEntryOnce) {
  std::vector<int> list{3, 1, 2, 3, 3, 1};
  sort_unique(list);
  EXPECT_EQ(list, (std::vector<int>{1, 2, 3}));
  list.clear();
  sort_unique(list);
  EXPECT_TRUE(list.empty());
}

TEST(Sorted, CornersOfFacesAreHeldOnce) {
  // 5, 69 and 133 have the same lowest bits.
  const std::vector<std::array<std::uint32_t, 3>> faces{{5, 69, 133}, {69, 5, 0}, {133, 0, 5}, {7, 5, 69}};
  EXPECT_EQ(corners_of_all(faces), (std::vector<std::uint32_t>{0, 5, 7, 69, 133}));
  EXPECT_TRUE(corners_of_all({}).empty());
}

TEST(Halving, BeginsInTheMiddleOfEveryPart) {
  using numbers::halved;
  EXPECT_EQ(halved(std::vector<int>{1, 2, 3, 4, 5, 6, 7}), (std::vector<int>{4, 2, 6, 1, 3, 5, 7}));
  EXPECT_EQ(halved(std::vector<int>{1, 2}), (std::vector<int>{2, 1}));
  EXPECT_TRUE(halved(std::vector<int>{}).empty());
}

TEST(Sorted, KeysAreTheSameForAnyOrderOfTheVertices) {
  FaceKey face{3, kGhost, 70'000};
  std::sort(face.begin(), face.end());
  const FaceKey expected = face;
  do EXPECT_EQ(face_key(face), expected);
  while (std::next_permutation(face.begin(), face.end()));
  EXPECT_EQ(edge_key(5, kGhost), edge_key(kGhost, 5));
  EXPECT_LT(edge_key(4, kGhost), edge_key(5, 6));
  EXPECT_NE(edge_key(1, 2), edge_key(2, 1 << 16));

  const std::array<Vertex, 4> corners{40, 30, 20, 10};
  EXPECT_EQ(edge_key(corners, 5), edge_key(10, 20));
  EXPECT_EQ(face_key(corners, 0), (FaceKey{10, 20, 30}));
}

}  // namespace
}  // namespace holdfast::numbers_test
