#include "untangle/lbfgs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "untangle/tuning.h"

namespace holdfast {
namespace {

using Unknowns = std::vector<double>;

double product(const Unknowns& a, const Unknowns& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add(Unknowns& a, double factor, const Unknowns& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

// The last steps and changes of the gradient, which replace the second derivatives.
class History {
 public:
  void remember(Unknowns step, Unknowns change) {
    const double curvature = product(step, change);
    if (!(curvature > 0)) return;
    if (pairs_.size() == tuning::kHistory) pairs_.pop_front();
    pairs_.push_back({std::move(step), std::move(change), 1 / curvature});
  }
  void forget() { pairs_.clear(); }
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  // The direction of descent: minus the approximation of the inverse Hessian times the gradient.
  [[nodiscard]] Unknowns direction(const Unknowns& gradient) const {
    Unknowns q = gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alpha[k] = pairs_[k].rho * product(pairs_[k].step, q);
      add(q, -alpha[k], pairs_[k].change);
    }
    double scale = -1;
    if (!pairs_.empty()) {
      const Pair& last = pairs_.back();
      scale = -1 / (last.rho * product(last.change, last.change));
    }
    for (double& x : q) x *= scale;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double beta = pairs_[k].rho * product(pairs_[k].change, q);
      add(q, -alpha[k] - beta, pairs_[k].step);
    }
    return q;
  }

 private:
  struct Pair {
    Unknowns step, change;
    double rho;
  };
  std::deque<Pair> pairs_;
};

struct State {
  Unknowns x, gradient;
  double value = 0;
};

// A step along `direction` that satisfies the weak Wolfe conditions, or at least reduces the value. False if
// none is found.
bool search(const State& from, const Unknowns& direction, double first, const ValueAndGradient& function,
            State& to) {
  const double slope = product(from.gradient, direction);
  if (!(slope < 0)) return false;
  double low = 0, high = std::numeric_limits<double>::infinity(), t = first;
  bool decreased = false;
  for (int trial = 0; trial < tuning::kMostStepTrials; ++trial) {
    to.x = from.x;
    add(to.x, t, direction);
    to.value = function(to.x, to.gradient);
    decreased = to.value <= from.value + tuning::kSufficientDecrease * t * slope;
    if (!decreased) {
      high = t;
    } else if (product(to.gradient, direction) < tuning::kCurvature * slope) {
      low = t;
    } else {
      return true;
    }
    t = std::isinf(high) ? 2 * low : (low + high) / 2;
  }
  return decreased;
}

}  // namespace

double minimise(std::vector<double>& x, const ValueAndGradient& function, const LbfgsLimits& limits) {
  State now{x, Unknowns(x.size()), 0};
  now.value = function(now.x, now.gradient);
  State next{x, Unknowns(x.size()), 0};
  History history;
  for (int k = 0; k < limits.iterations; ++k) {
    const double length = std::sqrt(product(now.gradient, now.gradient));
    if (!(length > 0) || !std::isfinite(length)) break;
    const double first = history.empty() ? std::min(1.0, tuning::kFirstMove / length) : 1;
    if (!search(now, history.direction(now.gradient), first, function, next)) {
      if (history.empty()) break;
      history.forget();
      continue;
    }
    Unknowns step = next.x, change = next.gradient;
    add(step, -1, now.x);
    add(change, -1, now.gradient);
    history.remember(std::move(step), std::move(change));
    const double decrease = now.value - next.value;
    std::swap(now, next);
    if (decrease < limits.least_decrease * std::abs(now.value)) break;
  }
  x = std::move(now.x);
  return now.value;
}

}  // namespace holdfast
