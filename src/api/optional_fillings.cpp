#include "api/optional_fillings.h"

#include <exception>
#include <stdexcept>

#include "api/earlier_result.h"
#include "api/less_time.h"

namespace holdfast {

std::optional<Filling> OptionalFillings::fill(const ToFill& asked, const LikelyToFill& likely) {
  try {
    if (!end_) end_ = half_of_the_time(limits_);
    const LessTime half(limits_, *end_);
    return fillings_.fill(asked, likely);
  } catch (const Interrupted& interrupted) {
    if (interrupted.outcome() != Outcome::time_limit) throw;
  } catch (const std::logic_error&) {
    warn_of(std::current_exception(), result_);
  }
  return std::nullopt;
}

}  // namespace holdfast
