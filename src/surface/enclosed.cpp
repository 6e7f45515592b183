// Surface layer: how many regions a valid surface encloses, by counting alone.
#include "surface/enclosed.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace holdfast {
namespace {

/// Patches: facets joined across segments of two facets that are left.
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

/// Rows over Z/2 as ascending lists of their ones.
using Row = std::vector<Index>;

std::size_t rank_of(const std::set<Row>& rows) {
  std::map<Index, Row> by_first;
  for (Row row : rows) {
    while (!row.empty()) {
      const auto [at, is_new] = by_first.try_emplace(row[0]);
      if (is_new) {
        at->second = std::move(row);
        break;
      }
      Row sum;
      std::set_symmetric_difference(row.begin(), row.end(), at->second.begin(), at->second.end(),
                                    std::back_inserter(sum));
      row = std::move(sum);
    }
  }
  return by_first.size();
}

}  // namespace

std::size_t enclosed_regions(const SegmentTable& table) {
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
    std::sort(facets.begin(), facets.end());
    Row odd;
    for (const Index p : facets) {
      if (!odd.empty() && odd.back() == p)
        odd.pop_back();
      else
        odd.push_back(p);
    }
    if (!odd.empty()) equations.insert(std::move(odd));
  }
  std::size_t unknowns = 0;
  for (Index f = 0; f < count; ++f) unknowns += !gone[f] && patches.of(f) == f;
  return unknowns - rank_of(equations);
}

}  // namespace holdfast
