// Convex polytopes with rational vertices, in one to three dimensions, cut by half-spaces exactly.
//
// The double description method (Motzkin, Raiffa, Thompson, Thrall 1953; Fukuda, Prodon 1996): the vertices
// stand, each with the half-spaces on whose border it lies, and a further half-space keeps those inside and
// adds one on every edge that it cuts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/dyadic.h"

namespace holdfast::exact {

/// The points x with a.x <= b; coordinates from the dimension on are 0.
struct IntegerHalfSpace {
  std::array<BigInt, 3> a;
  BigInt b;
};

/// The quotient rounded down; the divisor is positive.
[[nodiscard]] BigInt floor_of(const BigInt& dividend, const BigInt& divisor);
/// The quotient rounded up; the divisor is positive.
[[nodiscard]] BigInt ceiling_of(const BigInt& dividend, const BigInt& divisor);

class Polytope {
 public:
  /// x / w; w is positive, and nothing divides all four.
  struct Vertex {
    std::array<BigInt, 3> x;
    BigInt w;
    std::vector<std::uint64_t> tight;  ///< bit k: it lies on the border of half-space k
  };
  /// Of a linear form: the quotients are its least and greatest value.
  struct Range {
    BigInt low, low_divisor, high, high_divisor;
    [[nodiscard]] BigInt first() const { return ceiling_of(low, low_divisor); }  ///< integer, of those inside
    [[nodiscard]] BigInt last() const { return floor_of(high, high_divisor); }
  };

  /// A box; its half-spaces are the first 2 * dimension, -x <= -low and x <= high in turn.
  Polytope(int dimension, std::span<const BigInt> low, std::span<const BigInt> high);

  void cut(const IntegerHalfSpace& half_space);
  [[nodiscard]] bool is_empty() const { return vertices_.empty(); }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  /// All that were given, the box's first.
  [[nodiscard]] const std::vector<IntegerHalfSpace>& half_spaces() const { return half_spaces_; }
  /// The numbers of those whose border holds a vertex: the others change nothing.
  [[nodiscard]] std::vector<std::size_t> touching() const;
  /// The polytope must not be empty.
  [[nodiscard]] Range range(std::span<const BigInt> form) const;

 private:
  [[nodiscard]] bool share_an_edge(const Vertex& p, const Vertex& q) const;

  std::size_t dimension_;
  std::vector<IntegerHalfSpace> half_spaces_;
  std::vector<Vertex> vertices_;
};

}  // namespace holdfast::exact
