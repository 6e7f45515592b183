#include "check_repair/closed_chains.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace holdfast::checking {
namespace {

/// A sum of unknowns modulo 2 and its value. The unknowns are listed in ascending order.
struct Equation {
  std::vector<std::size_t> unknowns;
  bool is_one = false;

  void add(const Equation& other) {
    std::vector<std::size_t> sum;
    std::set_symmetric_difference(unknowns.begin(), unknowns.end(), other.unknowns.begin(),
                                  other.unknowns.end(), std::back_inserter(sum));
    unknowns = std::move(sum);
    is_one ^= other.is_one;
  }
};

/// Equations modulo 2 in echelon form: no two have the same last unknown.
class Equations {
 public:
  /// False if the equation contradicts the earlier ones.
  bool add(Equation equation) {
    while (!equation.unknowns.empty()) {
      const std::size_t last = equation.unknowns.back();
      const auto found = with_last_.find(last);
      if (found == with_last_.end()) {
        with_last_.emplace(last, std::move(equation));
        return true;
      }
      equation.add(found->second);
    }
    return !equation.is_one;
  }

 private:
  std::map<std::size_t, Equation> with_last_;
};

}  // namespace

bool are_closed_chains(std::span<const SidedEdge> edges) {
  Equations equations;
  std::map<std::pair<Index, unsigned>, Equation> at;  // by vertex and side: an even number of edges
  std::size_t unknowns = 0;                           // whether an edge is in the chain of a side
  for (const SidedEdge& edge : edges) {
    Equation sum{{}, edge.is_odd};
    const bool is_known = std::popcount(edge.sides) == 1;
    for (unsigned side = 0; side < 3; ++side) {
      if ((edge.sides >> side & 1U) == 0) continue;
      for (const Index v : edge.ends) {
        Equation& even = at[{v, side}];
        if (is_known)
          even.is_one ^= edge.is_odd;
        else
          even.unknowns.push_back(unknowns);
      }
      if (!is_known) sum.unknowns.push_back(unknowns++);
    }
    if (!is_known && !equations.add(std::move(sum))) return false;
  }
  return std::all_of(at.begin(), at.end(), [&](const auto& even) { return equations.add(even.second); });
}

}  // namespace holdfast::checking
