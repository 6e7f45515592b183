// Minimising a smooth function of many variables: the L-BFGS method (Nocedal 1980; Nocedal, Wright 2006,
// §7.2) with a line search by bisection to the weak Wolfe conditions (Lewis, Overton 2013). A guide: decides
// nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace holdfast {

struct LbfgsLimits {
  int iterations = 100;
  double least_decrease = 1e-5;  ///< ends where one iteration lessens the value by a smaller share
};

/// The value at x; writes the gradient, which is as long as x. May be infinite or NaN: such an x is too far.
using ValueAndGradient = std::function<double(std::span<const double> x, std::span<double> gradient)>;

/// Improves x in place; returns the value reached.
double minimise(std::vector<double>& x, const ValueAndGradient& function, const LbfgsLimits& limits);

}  // namespace holdfast
