// The floating-point environment that all arithmetic here rests on, and what would break it when compiled.
//
// Error bounds of filters, expansions (Shewchuk 1997) and the same bits everywhere hold if every operation is
// rounded to the nearest double, once, and denormals are kept. A program may have set another rounding mode,
// let the processor flush denormals to zero (code linked with -ffast-math does so as it starts), or let
// exceptions trap.
#pragma once

#include <cfloat>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "Holdfast cannot be compiled with -ffast-math or parts of it: its predicates would be wrong."
#endif
#if FLT_EVAL_METHOD != 0
#error "Holdfast needs arithmetic in doubles: on 32-bit x86, compile with -msse2 -mfpmath=sse."
#endif

namespace holdfast {

/// While an object lives, its thread rounds to nearest, keeps denormals and traps nothing; the destructor
/// restores the caller's settings. Every public function begins with one, and so does every thread.
class FloatEnvironment {
 public:
  FloatEnvironment();
  ~FloatEnvironment();
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  int rounding_;
  unsigned long long control_;  // the processor's control word, if denormals and traps are set there
};

}  // namespace holdfast
