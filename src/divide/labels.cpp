#include "divide/labels.h"

#include <algorithm>

#include "divide/centre.h"

namespace holdfast::division {
namespace {

constexpr int kMostRounds = 8;

/// The part to which most of a tetrahedron's neighbours belong, if they are at least three.
Index most_common(const Neighbours& sides, std::span<const Index> labels, Index own) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (sides[i] == no_entity) continue;
    const Index candidate = labels[sides[i]];
    std::size_t count = 0;
    for (const Index n : sides)
      if (n != no_entity && labels[n] == candidate) ++count;
    if (count >= 3) return candidate;
  }
  return own;
}

/// Renumbers without gaps, in the same order.
void renumber(std::vector<Index>& labels, std::size_t most) {
  std::vector<Index> number(most, no_entity);
  for (const Index l : labels) number[l] = 0;
  Index next = 0;
  for (Index& n : number)
    if (n != no_entity) n = next++;
  for (Index& l : labels) l = number[l];
}

}  // namespace

std::vector<Index> label(const Volume& volume, std::span<const Neighbours> neighbours,
                         const Bisection& cells) {
  std::vector<Index> labels(volume.tetrahedra.size());
  for (std::size_t t = 0; t < labels.size(); ++t)
    labels[t] = static_cast<Index>(cells.cell_of(centre(volume, volume.tetrahedra[t])));
  bool changed = true;
  for (int round = 0; round < kMostRounds && changed; ++round) {
    changed = false;
    for (std::size_t t = 0; t < labels.size(); ++t) {
      const Index most = most_common(neighbours[t], labels, labels[t]);
      changed |= most != labels[t];
      labels[t] = most;
    }
  }
  renumber(labels, cells.cells());
  return labels;
}

}  // namespace holdfast::division
