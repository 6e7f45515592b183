// Surface layer: the test of a valid input and its diagnosis.
#include "surface/diagnose.h"

#include <algorithm>

#include "holdfast/holdfast.h"
#include "surface/describe.h"

namespace holdfast {

std::vector<Defect> find_defects(const Complex& complex, std::size_t most, const Step& step,
                                 const Threads& threads, SamePlace same_place) {
  return find_defects(complex, elements_of(complex, threads, same_place), most, step, threads);
}

std::vector<Defect> find_defects(const Complex& complex, const Elements& elements, std::size_t most,
                                 const Step& step, const Threads& threads) {
  std::vector<Defect> defects;
  for (const Flaw& flaw : elements.flaws) {
    if (defects.size() == most) return defects;
    defects.push_back(describe(complex, flaw));
  }
  const std::vector<Finding> findings =
      find_root_causes(complex, elements, most - defects.size(), step, threads);
  if (findings.empty()) return defects;
  const Stars stars(complex, elements);
  for (const Finding& finding : findings) {
    step(1);
    defects.push_back(describe(complex, elements, stars, finding));
  }
  return defects;
}

std::vector<std::array<ElementRef, 2>> offending_pairs(const Complex& complex, std::size_t most,
                                                       const Step& step) {
  if (most == 0) return {};
  const Elements elements = elements_of(complex);
  std::vector<std::array<Index, 2>> found;
  const auto visit = [&](Index i, Index j, const Contacts&) {
    found.push_back({i, j});
    return found.size() < most;
  };
  for_each_offending_pair(complex, elements, visit, step);
  std::sort(found.begin(), found.end());
  std::vector<std::array<ElementRef, 2>> pairs;
  pairs.reserve(found.size());
  for (const auto& [i, j] : found) {
    const Element &a = elements.all[i], &b = elements.all[j];
    pairs.push_back({{{a.corners, a.id}, {b.corners, b.id}}});
  }
  return pairs;
}

}  // namespace holdfast
