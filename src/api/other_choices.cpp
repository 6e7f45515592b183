#include "api/other_choices.h"

#include <cstddef>
#include <cstdint>
#include <optional>

#include "api/far_from_target.h"
#include "api/less_time.h"

namespace holdfast {
namespace {

constexpr std::size_t kOtherChoices = 8, kChoicesInVain = 4;
constexpr std::size_t kMostFacetsForChoices = 5'000;
// The seeds are fixed, so that runs with different seeds make the same choice.
constexpr std::uint64_t kFirstOtherSeed = 0x9E3779B97F4A7C15;

// The seeds to try, until the worst element is no longer far from the target or too many were in vain.
class Choices {
 public:
  Choices(double worst, double far) : worst_(worst), far_(far) {}

  [[nodiscard]] std::optional<std::uint64_t> next() {
    if (tried_ == kOtherChoices || in_vain_ >= kChoicesInVain || !(worst_ > far_)) return std::nullopt;
    return kFirstOtherSeed + tried_++;
  }

  // Takes the worst element of a mesh that is done. Returns whether it is better than all before.
  bool improves(double worst) {
    // Gains of less than a fifth are in vain. An identical worst element counts twice, because it is seldom a
    // coincidence.
    if (worst < 0.8 * worst_)
      in_vain_ = 0;
    else
      in_vain_ += worst == worst_ ? 2 : 1;
    if (!(worst < worst_)) return false;
    worst_ = worst;
    return true;
  }

 private:
  double worst_;
  const double far_;
  std::uint64_t tried_ = 0;
  std::size_t in_vain_ = 0;
};

void choose_the_best(Attempts& attempts, const Options& options, Choices choices) {
  const auto is_better = [&](const Result& other) { return choices.improves(other.report.elements.worst); };
  while (const std::optional<std::uint64_t> seed = choices.next())
    if (!attempts.run_instead(options, *seed, is_better)) return;
}

// Meshes without field points tell which order is the best, and that one is meshed with them.
void choose_for_field(Attempts& attempts, const Options& options, Choices choices) {
  Options fill = options;
  fill.sizes.reset();
  std::optional<std::uint64_t> best;
  while (const std::optional<std::uint64_t> seed = choices.next()) {
    const bool goes_on = attempts.run_instead(fill, *seed, [&](const Result& other) {
      if (choices.improves(other.report.elements.worst)) best = seed;
      return false;
    });
    if (!goes_on) return;
  }
  if (best) attempts.run_instead(options, *best, [](const Result&) { return true; });
}

}  // namespace

// Flat elements are seldom forced. With field points, the mesh without them is judged, because it is the
// standard for them; later effort does not count.
void try_other_choices(Attempts& attempts, Input& input, const Options& options, Limits& limits,
                       const Result& result) {
  const double worst = options.sizes ? attempts.worst_without_field() : result.report.elements.worst;
  const double far = targets_for_other_choices(input.complex()) * input.target();
  if (!options.optimise || !options.add_points || !options.flips || input.parts() != nullptr ||
      !(worst > far) || input.complex().facets.size() > kMostFacetsForChoices)
    return;
  const LessTime half(limits, half_of_the_time(limits));
  if (options.sizes)
    choose_for_field(attempts, options, {worst, far});
  else
    choose_the_best(attempts, options, {worst, far});
}

}  // namespace holdfast
