#include "numbers/float_environment.h"

#include <cfenv>
#include <cstdint>

#if defined(__x86_64__) || defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace holdfast {
namespace {

#if defined(__x86_64__) || defined(__SSE2__)

// Of MXCSR: exceptions that were raised, denormals as zeros, masks of exceptions, rounding, flush to zero.
constexpr unsigned long long kRaised = 0x003F, kDenormalsAreZeros = 0x0040, kMasks = 0x1F80,
                             kRounding = 0x6000, kFlushToZero = 0x8000;
unsigned long long control() { return _mm_getcsr(); }
void set_control(unsigned long long value) { _mm_setcsr(static_cast<unsigned>(value)); }
unsigned long long plain(unsigned long long value) {
  return (value | kMasks) & ~(kRaised | kDenormalsAreZeros | kRounding | kFlushToZero);
}

#elif defined(__aarch64__)

// Of FPCR: traps, rounding, flush to zero (two kinds).
constexpr unsigned long long kTraps = 0x9F00, kRounding = 0x00C00000, kFlushToZero = 0x01080000;
unsigned long long control() {
  std::uint64_t value = 0;
  asm volatile("mrs %0, fpcr" : "=r"(value));
  return value;
}
void set_control(unsigned long long value) {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<std::uint64_t>(value)));
}
unsigned long long plain(unsigned long long value) { return value & ~(kTraps | kRounding | kFlushToZero); }

#else

unsigned long long control() { return 0; }
void set_control(unsigned long long) {}
unsigned long long plain(unsigned long long value) { return value; }

#endif

}  // namespace

// The rounding of the C library's own conversions may be told by another register.
FloatEnvironment::FloatEnvironment() : rounding_(std::fegetround()), control_(control()) {
  if (rounding_ != FE_TONEAREST) std::fesetround(FE_TONEAREST);
  if (control_ != plain(control_)) set_control(plain(control_));
}

FloatEnvironment::~FloatEnvironment() {
  if (rounding_ != FE_TONEAREST && rounding_ >= 0) std::fesetround(rounding_);
  if (control_ != plain(control_)) set_control(control_);
}

}  // namespace holdfast
