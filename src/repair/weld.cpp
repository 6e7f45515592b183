// Vertices that lie near to each other, or to a side or facet, joined within the user's tolerance.
#include "repair/weld.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "repair/settle.h"

namespace holdfast::repairing {
namespace {

bool is_usable(const State& state, std::span<const Index> corners) {
  return std::all_of(corners.begin(), corners.end(), [&](Index v) {
    return v < state.vertices.size() && std::isfinite(state.vertices[v][0]) &&
           std::isfinite(state.vertices[v][1]) && std::isfinite(state.vertices[v][2]);
  });
}

}  // namespace

double weld(State& state, double tolerance, const Step& step) {
  Trouble all;
  for (Index f = 0; f < state.facets.size(); ++f)
    if (is_usable(state, state.facets[f])) all.facets.push_back(f);
  for (Index s = 0; s < state.segments.size(); ++s)
    if (is_usable(state, state.segments[s])) all.segments.push_back(s);
  constexpr double kRoomForRounding = 0x1p-20;  // of the tolerance
  const double gap = tolerance * (1 - kRoomForRounding);
  return settle(state, all, {gap, gap, true, false}, step);
}

}  // namespace holdfast::repairing
