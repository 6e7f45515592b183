// A few numbers that the processor computes with at once.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace holdfast {

/// Two doubles in one register, on every processor for which the compiler supports this. Arithmetic and
/// comparisons work elementwise and are written as for one number, so that the same code serves one number
/// and two.
using Pair = double __attribute__((vector_size(16)));

[[nodiscard]] inline Pair load_pair(const double* from) {
  Pair pair;
  std::memcpy(&pair, from, sizeof(pair));
  return pair;
}

/// The result of a comparison of pairs, as bits 0 and 1.
using PairOfBools = decltype(Pair{} < Pair{});
[[nodiscard]] inline std::uint32_t bits(PairOfBools pair) {
#if defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(pair)));
#else
  return static_cast<std::uint32_t>((pair[0] & 1) | (pair[1] & 2));
#endif
}

/// Four doubles, available if `has_fours` says so, in functions marked by HOLDFAST_WITH_FOURS. Each result
/// has the same bits as if it were computed alone.
using Four = double __attribute__((vector_size(32)));

#if defined(__x86_64__) && defined(__GNUC__)
#define HOLDFAST_WITH_FOURS [[gnu::target("avx2")]]
[[nodiscard]] inline bool has_fours() { return __builtin_cpu_supports("avx2") != 0; }
#else
#define HOLDFAST_WITH_FOURS
[[nodiscard]] inline bool has_fours() { return false; }
#endif

}  // namespace holdfast
