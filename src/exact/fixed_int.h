// Signed integers of a fixed number of 64-bit limbs: no allocation, no branches, widths known to the
// compiler. Callers leave headroom; nothing here checks for overflow.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace holdfast::exact {

__extension__ using Uint128 = unsigned __int128;
__extension__ using Int128 = __int128;

/// A limb and the carry (or borrow) out of it, 0 or 1.
struct LimbAndCarry {
  std::uint64_t limb;
  unsigned char carry;
};

namespace detail {

// Everywhere; the x86 instructions below are a third faster on whole determinants with g++ 12.
[[nodiscard]] inline LimbAndCarry portable_add(std::uint64_t a, std::uint64_t b, unsigned char carry) {
  const Uint128 sum = static_cast<Uint128>(a) + b + carry;
  return {static_cast<std::uint64_t>(sum), static_cast<unsigned char>(sum >> 64)};
}

[[nodiscard]] inline LimbAndCarry portable_subtract(std::uint64_t a, std::uint64_t b, unsigned char borrow) {
  const Uint128 difference = static_cast<Uint128>(a) - b - borrow;
  return {static_cast<std::uint64_t>(difference), static_cast<unsigned char>((difference >> 64) & 1)};
}

}  // namespace detail

/// a + b + carry.
[[nodiscard]] inline LimbAndCarry add_limbs(std::uint64_t a, std::uint64_t b, unsigned char carry) {
#if defined(__x86_64__)
  unsigned long long sum = 0;
  const unsigned char out = _addcarry_u64(carry, a, b, &sum);
  return {sum, out};
#else
  return detail::portable_add(a, b, carry);
#endif
}

/// a - b - borrow.
[[nodiscard]] inline LimbAndCarry subtract_limbs(std::uint64_t a, std::uint64_t b, unsigned char borrow) {
#if defined(__x86_64__)
  unsigned long long difference = 0;
  const unsigned char out = _subborrow_u64(borrow, a, b, &difference);
  return {difference, out};
#else
  return detail::portable_subtract(a, b, borrow);
#endif
}

/// Two's complement, least significant limb first.
template <std::size_t N>
struct FixedInt {
  std::array<std::uint64_t, N> limb;

  [[nodiscard]] bool negative() const { return limb[N - 1] >> 63 != 0; }
  /// -1, 0 or +1.
  [[nodiscard]] int sign() const {
    if (negative()) return -1;
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < N; ++i) any |= limb[i];
    return any != 0 ? 1 : 0;
  }
};

template <std::size_t N>
[[nodiscard]] inline FixedInt<N> operator+(const FixedInt<N>& a, const FixedInt<N>& b) {
  FixedInt<N> result;
  LimbAndCarry step{0, 0};
  for (std::size_t i = 0; i < N; ++i) {
    step = add_limbs(a.limb[i], b.limb[i], step.carry);
    result.limb[i] = step.limb;
  }
  return result;
}

template <std::size_t N>
[[nodiscard]] inline FixedInt<N> operator-(const FixedInt<N>& a, const FixedInt<N>& b) {
  FixedInt<N> result;
  LimbAndCarry step{0, 0};
  for (std::size_t i = 0; i < N; ++i) {
    step = subtract_limbs(a.limb[i], b.limb[i], step.carry);
    result.limb[i] = step.limb;
  }
  return result;
}

template <std::size_t N>
[[nodiscard]] inline FixedInt<N> operator-(const FixedInt<N>& a) {
  return FixedInt<N>{} - a;
}

namespace detail {

/// Takes factor * 2^(64 offset) off `from` where `flag`, modulo its width.
template <std::size_t Offset, std::size_t N, std::size_t M>
inline void subtract_above(FixedInt<N>& from, const FixedInt<M>& factor, bool flag) {
  static_assert(Offset + M == N);
  const std::uint64_t mask = std::uint64_t{0} - static_cast<std::uint64_t>(flag);
  LimbAndCarry step{0, 0};
  for (std::size_t i = 0; i < M; ++i) {
    step = subtract_limbs(from.limb[Offset + i], factor.limb[i] & mask, step.carry);
    from.limb[Offset + i] = step.limb;
  }
}

}  // namespace detail

/// The full product. Two's complement limbs are multiplied as if unsigned; a negative factor then
/// counts 2^(64 width) times the other too much, which is taken off the upper limbs.
template <std::size_t A, std::size_t B>
[[nodiscard]] inline FixedInt<A + B> operator*(const FixedInt<A>& a, const FixedInt<B>& b) {
  if constexpr (A == 1 && B == 1) {
    const Int128 product =
        static_cast<Int128>(static_cast<std::int64_t>(a.limb[0])) * static_cast<std::int64_t>(b.limb[0]);
    return {{static_cast<std::uint64_t>(product), static_cast<std::uint64_t>(product >> 64)}};
  } else {
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
    detail::subtract_above<A>(result, b, a.negative());
    detail::subtract_above<B>(result, a, b.negative());
    return result;
  }
}

}  // namespace holdfast::exact
