// An oracle for small integer complexes that shares no idea with the code under test: whether convex hulls
// meet is a question of linear algebra. Points of both hulls are the solutions x >= 0 of
// sum x_i (a_i, 1) = sum x_j (b_j, 1); their null space is found by integer elimination, and the
// inequalities are decided by Fourier and Motzkin's elimination. No geometric case distinction anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "holdfast/types.h"

namespace holdfast::oracle {

using Integer = std::int64_t;
using IntPoint = std::array<Integer, 3>;
using Row = std::vector<Integer>;

inline Integer times(Integer a, Integer b) {
  Integer product = 0;
  if (__builtin_mul_overflow(a, b, &product)) throw std::overflow_error("oracle: coordinates too large");
  return product;
}

inline Integer minus(Integer a, Integer b) {
  Integer difference = 0;
  if (__builtin_sub_overflow(a, b, &difference)) throw std::overflow_error("oracle: coordinates too large");
  return difference;
}

// p * a - q * b for two rows, divided by the greatest common divisor.
inline Row combine(Integer p, const Row& a, Integer q, const Row& b) {
  Row row(a.size());
  Integer divisor = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[i] = minus(times(p, a[i]), times(q, b[i]));
    divisor = std::gcd(divisor, row[i]);
  }
  if (divisor > 1) {
    for (Integer& x : row) x /= divisor;
  }
  return row;
}

// Basis of the x with rows * x = 0.
inline std::vector<Row> null_space(std::vector<Row> rows, std::size_t columns) {
  std::vector<std::size_t> pivots;
  std::size_t rank = 0;
  for (std::size_t c = 0; c < columns && rank < rows.size(); ++c) {
    std::size_t r = rank;
    while (r < rows.size() && rows[r][c] == 0) ++r;
    if (r == rows.size()) continue;
    std::swap(rows[r], rows[rank]);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k != rank && rows[k][c] != 0) rows[k] = combine(rows[rank][c], rows[k], rows[k][c], rows[rank]);
    }
    pivots.push_back(c);
    ++rank;
  }
  std::vector<Row> basis;
  for (std::size_t c = 0; c < columns; ++c) {
    bool is_pivot = false;
    for (const std::size_t p : pivots) is_pivot = is_pivot || p == c;
    if (is_pivot) continue;
    Integer common = 1;
    for (std::size_t k = 0; k < rank; ++k) common = std::lcm(common, rows[k][pivots[k]]);
    Row x(columns, 0);
    x[c] = common;
    for (std::size_t k = 0; k < rank; ++k) x[pivots[k]] = times(-rows[k][c], common / rows[k][pivots[k]]);
    basis.push_back(x);
  }
  return basis;
}

struct Inequality {
  Row row;  // row * y > 0 if strict, else >= 0
  bool strict;
};

// Whether a homogeneous system has a solution.
inline bool feasible(std::vector<Inequality> system, std::size_t unknowns) {
  for (std::size_t k = 0; k < unknowns; ++k) {
    std::vector<Inequality> next;
    for (const Inequality& p : system) {
      if (p.row[k] == 0) next.push_back(p);
      if (p.row[k] <= 0) continue;
      for (const Inequality& q : system) {
        if (q.row[k] < 0) next.push_back({combine(-q.row[k], p.row, -p.row[k], q.row), p.strict || q.strict});
      }
    }
    system = std::move(next);
  }
  for (const Inequality& p : system) {
    if (p.strict) return false;  // 0 > 0
  }
  return true;
}

// Whether there are weights x > 0 (where `strict`) or x >= 0, with the sum over `some` positive unless
// `some` is empty, such that the points of a and of b with these weights are one point.
inline bool meet(const std::vector<IntPoint>& a, const std::vector<IntPoint>& b, bool strict,
                 const std::vector<std::size_t>& some) {
  const std::size_t n = a.size() + b.size();
  std::vector<Row> rows(4, Row(n, 0));
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i < a.size();
    const IntPoint& p = first ? a[i] : b[i - a.size()];
    for (std::size_t k = 0; k < 3; ++k) rows[k][i] = first ? p[k] : -p[k];
    rows[3][i] = first ? 1 : -1;
  }
  const std::vector<Row> basis = null_space(rows, n);
  std::vector<Inequality> system;
  const auto add = [&](const std::vector<std::size_t>& indices, bool is_strict) {
    Inequality inequality{Row(basis.size(), 0), is_strict};
    for (std::size_t j = 0; j < basis.size(); ++j) {
      for (const std::size_t i : indices) inequality.row[j] += basis[j][i];
    }
    system.push_back(inequality);
  };
  for (std::size_t i = 0; i < n; ++i) add({i}, strict);
  if (!some.empty()) add(some, true);
  return feasible(system, basis.size());
}

// Whether the relative interiors meet.
inline bool interiors_meet(const std::vector<IntPoint>& a, const std::vector<IntPoint>& b) {
  return meet(a, b, true, {});
}

// Whether the hulls of vertices a and b (indices into points) meet outside the hull of the vertices that they
// share. The points of each are affinely independent, so that a point of a is outside if and only if some
// vertex that is not shared has weight.
inline bool misfit(const std::vector<IntPoint>& points, const std::vector<Index>& a,
                   const std::vector<Index>& b) {
  std::vector<IntPoint> p, q;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < a.size(); ++i) {
    p.push_back(points[a[i]]);
    bool shared = false;
    for (const Index v : b) shared = shared || v == a[i];
    if (!shared) own.push_back(i);
  }
  for (const Index v : b) q.push_back(points[v]);
  if (own.empty()) return false;  // a is a face of b
  return meet(p, q, false, own);
}

}  // namespace holdfast::oracle
