#include "repair/proven.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "numbers/sorted.h"

namespace holdfast::repairing {

Proven::Words Proven::words_of(const Point& p) {
  return std::bit_cast<Words>(Point{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0});  // turns -0 into 0
}

Proven::Proven(const State& state, std::span<const std::uint8_t> known) {
  std::vector<Index> number(state.vertices.size(), no_index);
  Index points = 0;
  for (std::size_t f = 0; f < known.size(); ++f) {
    if (known[f] == 0) continue;
    Triangle corners = state.facets[f];
    for (Index& v : corners) {
      if (number[v] == no_index) number[v] = points_.find_or_add(words_of(state.vertices[v]), points);
      if (number[v] == points) ++points;
      v = number[v];
    }
    if (facets_.find_or_add(ascending(corners), count_) == count_) ++count_;
  }
}

void Proven::tell(State& state) const {
  std::vector<Index> number(state.vertices.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = points_.find(words_of(state.vertices[v]));
  std::vector<std::uint8_t> known(state.facets.size(), 0);
  std::vector<Index> facet_with(count_, no_index);
  for (Index f = 0; f < known.size(); ++f) {
    const auto& [a, b, c] = state.facets[f];
    const Triangle corners{number[a], number[b], number[c]};
    if (std::find(corners.begin(), corners.end(), no_entity) != corners.end()) continue;
    const Index facet = facets_.find(ascending(corners));
    if (facet == no_entity) continue;
    known[f] = facet_with[facet] == no_index ? 1 : 0;
    if (known[f] == 0) known[facet_with[facet]] = 0;  // a repeated facet does not fit
    facet_with[facet] = f;
  }
  const auto count = [](const std::vector<std::uint8_t>& of) {
    return std::count(of.begin(), of.end(), std::uint8_t{1});
  };
  if (count(known) <= count(state.known)) return;
  state.known = std::move(known);
  state.knows_vertices = false;
}

void ProvenSets::add(const State& state, std::span<const std::uint8_t> fitted) {
  constexpr std::size_t kFew = 8;  // a part of all: what is searched in no time need not be kept
  const auto unknown = std::count(state.known.begin(), state.known.end(), std::uint8_t{0});
  if (fitted.empty() || (!state.known.empty() && kFew * static_cast<std::size_t>(unknown) < fitted.size()))
    return;
  last_[0] = std::exchange(last_[1], std::make_shared<const Proven>(state, fitted));
}

void ProvenSets::tell(State& state) const {
  for (const auto& proven : {first_, last_[0], last_[1]})
    if (proven) proven->tell(state);
}

}  // namespace holdfast::repairing
