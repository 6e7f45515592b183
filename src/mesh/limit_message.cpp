#include "mesh/limit_message.h"

#include "text/decimal.h"

namespace holdfast {

std::string limit_message(Outcome outcome, const Limits& limits) {
  constexpr int kDigits = 6;
  if (outcome == Outcome::time_limit)
    return "the time limit of " + decimal(limits.time_limit, kDigits) + " s ran out";
  if (outcome != Outcome::memory_limit) return "cancelled";
  return "the memory limit of " + decimal(static_cast<double>(limits.memory_limit) * 1e-9, kDigits) +
         " GB was reached";
}

}  // namespace holdfast
