// Meshes a repaired surface that had no mesh, after joining sheets that are a few last bits apart.
#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include "holdfast/repair.h"
#include "mesh/limit_message.h"
#include "repair/bounds.h"

namespace holdfast {
namespace {

/// In last bits of the largest coordinate. Vertices that are only joined do not move.
struct Merging {
  double join, weld;
};
constexpr std::array kAttempts{Merging{0x1p3, 0}, Merging{0x1p6, 0}, Merging{0x1p6, 0x1p6}};

/// Whether a limit ended a call; if so, it is the outcome of the mesh, too.
bool ends(Outcome outcome, const std::string& message, Result& result) {
  if (!is_interruption(outcome)) return false;
  result.outcome = outcome;
  result.message = message;
  return true;
}

}  // namespace

bool mesh_joined(const Complex& given, const Options& options, RepairOptions& repairing,
                 RepairResult& repaired, Result& result) {
  if (result.outcome != Outcome::not_representable || result.report.unrounded_points == 0) return false;
  const auto begin = std::chrono::steady_clock::now();
  Options meshing = options;
  meshing.started = options.started.value_or(begin);
  const double bit = repairing::last_bit(given.vertices);
  for (const Merging& attempt : kAttempts) {
    RepairOptions joining = repairing;
    joining.exact = false;
    joining.started = repairing.started.value_or(begin);
    joining.join = std::max(repairing.join, attempt.join * bit);
    joining.weld = std::max(repairing.weld, attempt.weld * bit);
    RepairResult joined = repair(given, joining);
    if (ends(joined.outcome, joined.message, result)) return false;
    if (joined.outcome != Outcome::done) continue;
    Result now;
    try {
      now = mesh(joined.surface.view(), meshing);
    } catch (const std::invalid_argument&) {  // for instance sizes by vertex, whose number has changed
      continue;
    }
    if (ends(now.outcome, now.message, result)) return false;
    if (now.outcome != Outcome::done) continue;
    repairing.join = joining.join;
    repairing.weld = joining.weld;
    repaired = std::move(joined);
    result = std::move(now);
    return true;
  }
  return false;
}

}  // namespace holdfast
