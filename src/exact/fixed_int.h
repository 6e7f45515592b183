// Signed integers of a fixed number of 64-bit limbs: no allocation, no branches, widths known to the
// compiler. Callers leave headroom; nothing here checks for overflow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace holdfast::exact {

__extension__ using Uint128 = unsigned __int128;

/// Two's complement, least significant limb first.
template <std::size_t N>
struct FixedInt {
  std::array<std::uint64_t, N> limb;

  /// -1, 0 or +1.
  [[nodiscard]] int sign() const {
    if (static_cast<std::int64_t>(limb[N - 1]) < 0) return -1;
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < N; ++i) any |= limb[i];
    return any != 0 ? 1 : 0;
  }
};

template <std::size_t N>
[[nodiscard]] inline FixedInt<N> operator+(const FixedInt<N>& a, const FixedInt<N>& b) {
  FixedInt<N> result;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Uint128 sum = static_cast<Uint128>(a.limb[i]) + b.limb[i] + carry;
    result.limb[i] = static_cast<std::uint64_t>(sum);
    carry = static_cast<std::uint64_t>(sum >> 64);
  }
  return result;
}

template <std::size_t N>
[[nodiscard]] inline FixedInt<N> operator-(const FixedInt<N>& a, const FixedInt<N>& b) {
  FixedInt<N> result;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Uint128 difference = static_cast<Uint128>(a.limb[i]) - b.limb[i] - borrow;
    result.limb[i] = static_cast<std::uint64_t>(difference);
    borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
  }
  return result;
}

/// The full product. Two's complement limbs are multiplied as if unsigned; a negative factor then
/// counts 2^(64 A) too much, which is taken off the upper limbs.
template <std::size_t A, std::size_t B>
[[nodiscard]] inline FixedInt<A + B> operator*(const FixedInt<A>& a, const FixedInt<B>& b) {
  FixedInt<A + B> result{};
  for (std::size_t i = 0; i < A; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < B; ++j) {
      const Uint128 sum = static_cast<Uint128>(a.limb[i]) * b.limb[j] + result.limb[i + j] + carry;
      result.limb[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    result.limb[i + B] = carry;
  }
  const auto subtract_above = [&result](const auto& limbs, std::size_t offset, std::uint64_t mask) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      const Uint128 difference = static_cast<Uint128>(result.limb[offset + i]) - (limbs[i] & mask) - borrow;
      result.limb[offset + i] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
    }
  };
  subtract_above(b.limb, A, std::uint64_t{0} - (a.limb[A - 1] >> 63));
  subtract_above(a.limb, B, std::uint64_t{0} - (b.limb[B - 1] >> 63));
  return result;
}

}  // namespace holdfast::exact
