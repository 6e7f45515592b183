#include "api/without_field.h"

#include <algorithm>
#include <utility>

#include "optimise/optimise.h"

namespace holdfast {
namespace {

// Larger meshes take much memory, and no optimisation makes them good.
constexpr std::size_t kMostCompared = 300'000;  // tetrahedra
// If this many times as many elements are asked for, the comparison is of no use, and if as many as the
// second, there is hardly anything to thin out: the size determines the mesh, not the surface.
constexpr double kManyTimes = 8, kManyMoreTimes = 32;
// In meshes above kManyTets the optimisation changes only a small part, so the mean Q does not halve. In
// smaller ones above kTets it may change much, but not remove such a share of elements below 10 degrees.
constexpr std::size_t kManyTets = 10'000, kTets = 500;
constexpr double kManyBelow10 = 0.3;  // share of the elements
// More work removes this part of the excess of the mean Q over that of a mesh without bad elements.
constexpr double kMended = 0.3, kWithoutBad = 3;

// Whether no figure of the optimised mesh can be better than those of a mesh with field points that has no
// element below 10 degrees.
bool is_plainly_worse(const Figures& before, const Figures& with_field) {
  if (with_field.below_10_deg() > 0 || before.mean_quality() <= 2 * with_field.mean_quality()) return false;
  const auto below = static_cast<double>(before.below_10_deg()),
             elements = static_cast<double>(before.elements());
  return (before.elements() > kManyTets && below > 0) ||
         (before.elements() > kTets && below > kManyBelow10 * elements);
}

}  // namespace

bool WithoutField::is_asked_for(const Options& options) {
  const Sizes& s = *options.sizes;
  return s.vertex_sizes.empty() && !s.field && !s.fields && !s.metric && s.max_volume == 0 &&
         s.max_ratio == 0 && s.layers <= 1 &&
         std::all_of(options.regions.begin(), options.regions.end(),
                     [](const RegionSeed& r) { return r.max_volume == 0; });
}

WithoutField::WithoutField(const Attempt& attempt, const BoxMesh& box, const Division& division,
                           double elements_asked_for)
    : attempt_(attempt),
      first_free_(box.first_free),
      asked_for_(elements_asked_for),
      to_be_left_(elements_asked_for) {
  const std::vector<Tet> tets = division.tets(box.mesh);
  if (tets.size() > kMostCompared) return;
  if (asked_for_ > kManyMoreTimes * static_cast<double>(tets.size())) return;
  elements_ = tets.size();
  if (asked_for_ > kManyTimes * static_cast<double>(tets.size())) return;
  mesh_ = box.mesh;
  division_ = division;
  before_ = figures_of(mesh_, tets, attempt.threads);
}

bool WithoutField::is_better_somewhere(const Figures& with_field) {
  if (!is_given()) return false;
  if (!optimised_) {
    if (is_plainly_worse(before_, with_field)) return false;
    optimise(mesh_, division_.tets(mesh_), first_free_, attempt_.input.target(), attempt_.threads,
             attempt_.monitor,
             {.add_points = attempt_.options.add_points,
              .remove = PointsToRemove::all,
              .seed = attempt_.seed,
              .fill_anew = attempt_.fill_anew});
    find_regions_again(mesh_, attempt_.complex().facets, division_.regions, attempt_.threads);
    optimised_ = figures_of(mesh_, division_.tets(mesh_), attempt_.threads);
  }
  return !with_field.is_no_worse_than(*optimised_);
}

bool WithoutField::is_within_reach(const Figures& with_field) const {
  const double now = with_field.tempered_quality();
  return now - kMended * std::max(now - kWithoutBad, 0.0) <= optimised_->tempered_quality();
}

void WithoutField::take(BoxMesh& box, Division& division) {
  box.mesh = std::move(mesh_);
  division = std::move(division_);
}

}  // namespace holdfast
