// Some numbers that the machine computes at once.
#pragma once

namespace holdfast {

/// Two doubles in one register, on every processor that the compiler knows how to do it for. Elementwise
/// arithmetic and comparisons as for one number, so that one and two take the same code.
using Pair = double __attribute__((vector_size(16)));

/// Four, where `has_fours` says so, in functions that HOLDFAST_WITH_FOURS marks. Each of them is what it
/// would be by itself, bit for bit.
using Four = double __attribute__((vector_size(32)));

#if defined(__x86_64__) && defined(__GNUC__)
#define HOLDFAST_WITH_FOURS [[gnu::target("avx2")]]
[[nodiscard]] inline bool has_fours() { return __builtin_cpu_supports("avx2") != 0; }
#else
#define HOLDFAST_WITH_FOURS
[[nodiscard]] inline bool has_fours() { return false; }
#endif

}  // namespace holdfast
