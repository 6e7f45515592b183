#include "exact/polytope.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace holdfast::exact {
namespace {

constexpr std::size_t kWord = 64;

void set_bit(std::vector<std::uint64_t>& bits, std::size_t k) {
  if (bits.size() <= k / kWord) bits.resize(k / kWord + 1, 0);
  bits[k / kWord] |= std::uint64_t{1} << (k % kWord);
}
std::uint64_t word(const std::vector<std::uint64_t>& bits, std::size_t k) {
  return k < bits.size() ? bits[k] : 0;
}

// b w - a.x: positive inside, zero on the border.
BigInt height(const IntegerHalfSpace& h, const Polytope::Vertex& v, std::size_t dimension) {
  BigInt sum = h.b * v.w;
  for (std::size_t k = 0; k < dimension; ++k) sum -= h.a[k] * v.x[k];
  return sum;
}

void reduce(Polytope::Vertex& v) {
  BigInt divisor = v.w;
  for (const BigInt& x : v.x)
    if (divisor != 1 && x.sign() != 0) divisor = gcd(divisor, x);
  if (divisor == 1) return;
  v.w /= divisor;
  for (BigInt& x : v.x) x /= divisor;
}

}  // namespace

BigInt floor_of(const BigInt& dividend, const BigInt& divisor) {
  BigInt quotient = dividend / divisor;  // towards zero
  if (dividend.sign() < 0 && quotient * divisor != dividend) --quotient;
  return quotient;
}

BigInt ceiling_of(const BigInt& dividend, const BigInt& divisor) { return -floor_of(-dividend, divisor); }

Polytope::Polytope(int dimension, std::span<const BigInt> low, std::span<const BigInt> high)
    : dimension_(static_cast<std::size_t>(dimension)) {
  for (std::size_t k = 0; k < dimension_; ++k) {
    if (low[k] > high[k]) return;
    IntegerHalfSpace below{}, above{};
    below.a[k] = -1;
    below.b = -low[k];
    above.a[k] = 1;
    above.b = high[k];
    half_spaces_.push_back(std::move(below));
    half_spaces_.push_back(std::move(above));
  }
  for (std::size_t corner = 0; corner < std::size_t{1} << dimension_; ++corner) {
    Vertex v{{}, 1, {}};
    bool is_new = true;  // a box without thickness lists each corner once
    for (std::size_t k = 0; k < dimension_; ++k) {
      const bool is_high = ((corner >> k) & 1u) != 0;
      const bool is_flat = low[k] == high[k];
      is_new = is_new && !(is_flat && is_high);
      v.x[k] = is_high ? high[k] : low[k];
      if (!is_high || is_flat) set_bit(v.tight, 2 * k);
      if (is_high || is_flat) set_bit(v.tight, 2 * k + 1);
    }
    if (is_new) vertices_.push_back(std::move(v));
  }
}

void Polytope::cut(const IntegerHalfSpace& half_space) {
  const std::size_t index = half_spaces_.size();
  half_spaces_.push_back(half_space);
  std::vector<BigInt> heights;
  heights.reserve(vertices_.size());
  bool cuts = false;
  for (Vertex& v : vertices_) {
    heights.push_back(height(half_space, v, dimension_));
    if (heights.back().sign() == 0) set_bit(v.tight, index);
    cuts = cuts || heights.back().sign() < 0;
  }
  if (!cuts) return;
  std::vector<Vertex> fresh;
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    for (std::size_t j = 0; j < vertices_.size(); ++j) {
      if (heights[i].sign() <= 0 || heights[j].sign() >= 0 || !share_an_edge(vertices_[i], vertices_[j]))
        continue;
      const Vertex &p = vertices_[i], &q = vertices_[j];
      Vertex v;
      for (std::size_t k = 0; k < dimension_; ++k) v.x[k] = heights[i] * q.x[k] - heights[j] * p.x[k];
      v.w = heights[i] * q.w - heights[j] * p.w;
      reduce(v);
      for (std::size_t k = 0; k < std::min(p.tight.size(), q.tight.size()); ++k)
        v.tight.push_back(p.tight[k] & q.tight[k]);
      set_bit(v.tight, index);
      fresh.push_back(std::move(v));
    }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (heights[i].sign() < 0) continue;
    if (kept != i) vertices_[kept] = std::move(vertices_[i]);
    ++kept;
  }
  vertices_.resize(kept);
  std::move(fresh.begin(), fresh.end(), std::back_inserter(vertices_));
}

// The combinatorial test (Fukuda, Prodon 1996, proposition 7): no third vertex lies on all borders that
// contain both p and q.
bool Polytope::share_an_edge(const Vertex& p, const Vertex& q) const {
  const std::size_t words = std::min(p.tight.size(), q.tight.size());
  std::size_t common = 0;
  for (std::size_t k = 0; k < words; ++k)
    common += static_cast<std::size_t>(std::popcount(p.tight[k] & q.tight[k]));
  if (common + 1 < dimension_) return false;
  return std::none_of(vertices_.begin(), vertices_.end(), [&](const Vertex& r) {
    if (&r == &p || &r == &q) return false;
    for (std::size_t k = 0; k < words; ++k) {
      const std::uint64_t both = p.tight[k] & q.tight[k];
      if ((both & word(r.tight, k)) != both) return false;
    }
    return true;
  });
}

std::vector<std::size_t> Polytope::touching() const {
  std::vector<std::uint64_t> any;
  for (const Vertex& v : vertices_) {
    any.resize(std::max(any.size(), v.tight.size()), 0);
    for (std::size_t k = 0; k < v.tight.size(); ++k) any[k] |= v.tight[k];
  }
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < half_spaces_.size(); ++k)
    if (((word(any, k / kWord) >> (k % kWord)) & 1u) != 0) out.push_back(k);
  return out;
}

Polytope::Range Polytope::range(std::span<const BigInt> form) const {
  Range out;
  bool is_first = true;
  for (const Vertex& v : vertices_) {
    BigInt value = 0;
    for (std::size_t k = 0; k < dimension_; ++k) value += form[k] * v.x[k];
    if (is_first || value * out.low_divisor < out.low * v.w) {
      out.low = value;
      out.low_divisor = v.w;
    }
    if (is_first || value * out.high_divisor > out.high * v.w) {
      out.high = value;
      out.high_divisor = v.w;
    }
    is_first = false;
  }
  return out;
}

}  // namespace holdfast::exact
