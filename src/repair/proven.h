// The facets that an exact search has found to fit together. Attempts that start again use them, since most
// of a surface comes out of each attempt unchanged.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "arrange/index_table.h"
#include "repair/state.h"

namespace holdfast::repairing {

class Proven {
 public:
  /// The facets of a state that `known`, such as State::known, says fit together.
  Proven(const State& state, std::span<const std::uint8_t> known);

  /// Marks these facets as known in another state, unless that state knows of more facets by itself. The two
  /// sets are never merged: facets of one are not known to fit together with facets of the other.
  void tell(State& state) const;

 private:
  using Words = std::array<Index, 6>;  // of a point

  [[nodiscard]] static Words words_of(const Point& p);

  arrange::IndexTable<6> points_;
  arrange::IndexTable<3> facets_;  // by the numbers of their corners, ascending
  Index count_ = 0;                // of facets
};

/// Several such sets. The cuts of one attempt have most in common with those of the last one. Copies share
/// the sets.
class ProvenSets {
 public:
  [[nodiscard]] bool empty() const { return !first_; }
  void begin(const State& state) { first_ = std::make_shared<const Proven>(state, state.known); }
  /// Adds what a cut has found to fit together. Only the last two are kept: those of one attempt.
  void add(const State& state, std::span<const std::uint8_t> fitted);
  /// Marks the facets of the set that knows most of this state.
  void tell(State& state) const;

 private:
  std::shared_ptr<const Proven> first_;
  std::array<std::shared_ptr<const Proven>, 2> last_;
};

}  // namespace holdfast::repairing
