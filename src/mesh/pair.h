// Two numbers that the machine computes at once.
#pragma once

namespace holdfast {

/// Two doubles in one register, on every processor that the compiler knows how to do it for. Elementwise
/// arithmetic and comparisons as for one number, so that one and two take the same code.
using Pair = double __attribute__((vector_size(16)));

}  // namespace holdfast
