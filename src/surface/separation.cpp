#include "surface/separation.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

namespace holdfast {
namespace {

/// Facets, joined across segments with exactly two remaining facets.
class Patches {
 public:
  explicit Patches(std::size_t facets) : parent_(facets) { std::iota(parent_.begin(), parent_.end(), 0u); }
  Index of(Index f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }
  void join(Index a, Index b) { parent_[of(a)] = of(b); }

 private:
  std::vector<Index> parent_;
};

/// Vectors over Z/2 as ascending lists of their ones.
using Row = Separation::Region;

// The patches that occur an odd number of times.
Row odd_ones(std::vector<Index> patches) {
  std::sort(patches.begin(), patches.end());
  Row odd;
  for (const Index p : patches) {
    if (!odd.empty() && odd.back() == p)
      odd.pop_back();
    else
      odd.push_back(p);
  }
  return odd;
}

Row sum(const Row& a, const Row& b) {
  Row ones;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(ones));
  return ones;
}

std::map<Index, Row> echelon_form(const std::set<Row>& rows) {
  std::map<Index, Row> by_first;
  for (Row row : rows) {
    while (!row.empty()) {
      const auto [at, is_new] = by_first.try_emplace(row[0]);
      if (is_new) {
        at->second = std::move(row);
        break;
      }
      row = sum(row, at->second);
    }
  }
  return by_first;
}

}  // namespace

Separation::Separation(const SegmentTable& table) {
  const std::vector<char> gone = peeled_from_borders(table);
  const auto count = static_cast<Index>(gone.size());
  Patches patches(count);
  std::vector<std::vector<Index>> junctions;
  for (Index s = 0; s < table.segments.size(); ++s) {
    std::vector<Index> left;
    for (const Index f : table.facets_of(s))
      if (!gone[f]) left.push_back(f);
    if (left.size() == 2) patches.join(left[0], left[1]);
    if (left.size() > 2) junctions.push_back(std::move(left));
  }
  std::set<Row> equations;
  for (std::vector<Index>& facets : junctions) {
    for (Index& f : facets) f = patches.of(f);
    if (Row odd = odd_ones(std::move(facets)); !odd.empty()) equations.insert(std::move(odd));
  }
  equations_ = echelon_form(equations);
  patch_.assign(count, no_index);
  for (Index f = 0; f < count; ++f) {
    if (gone[f]) continue;
    patch_[f] = patches.of(f);
    unknowns_ += patch_[f] == f;
  }
}

// Reduced by the equations: no patch is left that is the first of an equation; so the result is unique.
Separation::Region Separation::beyond(std::span<const Index> facets) const {
  std::vector<Index> patches;
  for (const Index f : facets)
    if (patch_[f] != no_index) patches.push_back(patch_[f]);
  Row row = odd_ones(std::move(patches));
  for (std::size_t i = 0; i < row.size();) {
    const auto equation = equations_.find(row[i]);
    if (equation == equations_.end())
      ++i;
    else
      row = sum(row, equation->second);
  }
  return row;
}

}  // namespace holdfast
