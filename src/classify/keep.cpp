#include "classify/keep.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "classify/outside.h"
#include "classify/words.h"
#include "surface/describe.h"

namespace holdfast {
namespace {

Defect not_oriented(const Complex& complex, const std::array<Index, 2>& facets) {
  Defect defect{DefectKind::inconsistent_orientation, {}, {facets[0]}, {}, {}, {}};
  if (facets[1] != facets[0]) defect.facets.push_back(facets[1]);
  defect.where.push_back(complex.vertices[complex.facets[facets[0]][0]]);
  const bool one = defect.facets.size() == 1;
  defect.message =
      "the surface has no winding number: " +
      (one ? "triangle " + std::to_string(facets[0]) + " is"
           : "triangles " + std::to_string(facets[0]) + " and " + std::to_string(facets[1]) + " are") +
      " not turned consistently with the rest at " + place(defect.where[0]) +
      "; turn the triangles of every shell the same way, or keep every bounded region";
  return defect;
}

class Chooser {
 public:
  Chooser(const TetMesh& mesh, const Regions& regions, const NamedComplex& input, const Wanted& wanted,
          int scale)
      : mesh_(mesh),
        regions_(regions),
        input_(input),
        complex_(input.complex),
        table_(input.table),
        wanted_(wanted),
        scale_(scale) {}

  Kept run() {
    if (regions_.count == 1 && wanted_.keep != Keep::box) {
      kept_.defects.push_back(encloses_nothing(input_));
      return std::move(kept_);
    }
    if (wanted_.parts != nullptr)
      apply_parts();
    else
      apply_rule();
    if (!kept_.defects.empty() || is_refused()) return std::move(kept_);
    for (const Point& hole : wanted_.holes) kept_.region[region_at(hole, "hole")] = false;
    if (std::find(kept_.region.begin(), kept_.region.end(), true) == kept_.region.end()) {
      kept_.defects.push_back(nothing_left());
      return std::move(kept_);
    }
    number();
    find_kept_segments();
    if (!wanted_.drop_outside) kept_.defects = find_outside(mesh_, regions_, kept_, input_);
    return std::move(kept_);
  }

 private:
  void apply_rule() {
    kept_.region.assign(regions_.count, true);
    kept_.rule = wanted_.keep;
    if (wanted_.keep == Keep::box) return;
    kept_.region[0] = false;
    if (wanted_.keep == Keep::bounded) return;
    const Winding winding = winding_numbers(regions_);
    if (winding.conflict && wanted_.keep == Keep::winding) {
      kept_.defects.push_back(not_oriented(complex_, *winding.conflict));
      return;
    }
    kept_.rule = winding.conflict ? Keep::bounded : Keep::winding;
    if (winding.conflict) {
      kept_.conflict = winding.conflict;
      kept_.turned = turned_facets(regions_);
      return;
    }
    for (RegionId r = 1; r < regions_.count; ++r) kept_.region[r] = winding.number[r] != 0;
    if (wanted_.keep == Keep::winding) return;
    for (const RegionSeed& seed : wanted_.seeds)
      kept_.region[region_at(seed.where, "region seed")] = true;  // never that outside
  }

  void apply_parts() {
    const PartsOfComplex& parts = *wanted_.parts;
    const bool box = wanted_.keep == Keep::box;
    Holders holders = find_holders(regions_, parts, box ? Keep::automatic : wanted_.keep,
                                   [&](const Point& p, const char* what) { return region_at(p, what); });
    if (holders.conflict && wanted_.keep == Keep::winding) {
      kept_.defects.push_back(not_oriented(complex_, *holders.conflict));
      return;
    }
    kept_.rule = box ? Keep::box : holders.conflict ? Keep::bounded : Keep::winding;
    kept_.conflict = holders.conflict;
    kept_.turned = holders.turned;
    const std::vector<double> thickness = thickness_of_common(regions_, holders, complex_, scale_);
    if (parts.gap > 0) settle_thin_regions(thickness, parts, holders);
    kept_.overlaps = find_overlaps(regions_, holders, complex_, thickness);
    of_parts_ = ids_of_held(holders, parts);
    kept_.region.assign(regions_.count, box);
    for (RegionId r = 0; r < regions_.count; ++r) kept_.region[r] = box || of_parts_[r].has_value();
  }

  [[nodiscard]] Defect nothing_left() const {
    Defect defect{DefectKind::encloses_nothing, {}, {}, {}, {}, {}};
    if (!wanted_.holes.empty()) defect.where.push_back(wanted_.holes[0]);
    defect.message = wanted_.parts != nullptr && wanted_.holes.empty()
                         ? "no part encloses anything: close its borders"
                         : "nothing is left to fill: every region is a hole; leave out a hole";
    return defect;
  }

  [[nodiscard]] bool is_refused() const {
    return wanted_.parts != nullptr && wanted_.parts->overlap == Overlap::refuse && !kept_.overlaps.empty();
  }

  // Holes and seeds in the complex's units. A scale that suits the complex may not suit them, so they are
  // scaled exactly.
  [[nodiscard]] RegionId region_at(const Point& p, const std::string& what) const {
    exact::ExactPoint moved = exact::lift(p.data());
    for (exact::Dyadic& x : moved.c) x = x.scaled(scale_);
    const Point approx{moved.c[0].to_double(), moved.c[1].to_double(), moved.c[2].to_double()};
    const Located located = locate(mesh_, regions_, {approx.data(), &moved});
    if (located.on_facet) throw on_the_surface(what, p);
    if (!located.in_mesh || (located.region == 0 && wanted_.keep != Keep::box)) throw in_no_region(what, p);
    return located.region;
  }

  // A segment at which an open border may have merged two regions into one.
  [[nodiscard]] std::optional<Index> open_border_in(RegionId r) const {
    for (Index f = 0; f < complex_.facets.size(); ++f) {
      if (regions_.of_facet[f] != std::array<RegionId, 2>{r, r}) continue;
      for (const Index s : table_.facet_segments[f])
        if (table_.facets_of(s).size() == 1) return table_.segments[s][0];
    }
    return std::nullopt;
  }

  void number() {
    kept_.id.assign(regions_.count, 0);
    std::vector<bool> seeded(regions_.count, false);
    std::set<int> taken;
    for (const RegionSeed& seed : wanted_.seeds) {
      const RegionId r = region_at(seed.where, "region seed");
      if (!kept_.region[r]) throw in_region_not_kept(seed.where);
      if (seeded[r] && kept_.id[r] != seed.id)
        throw with_two_ids(seed, kept_.id[r], complex_, open_border_in(r), input_.names);
      kept_.id[r] = seed.id;
      seeded[r] = true;
      taken.insert(seed.id);
    }
    for (RegionId r = 0; r < of_parts_.size(); ++r) {
      if (seeded[r] || !of_parts_[r]) continue;
      kept_.id[r] = *of_parts_[r];
      taken.insert(*of_parts_[r]);
      seeded[r] = true;
    }
    int next = 1;
    for (RegionId r = 1; r < regions_.count; ++r) {
      if (seeded[r] || !kept_.region[r]) continue;
      while (taken.contains(next)) ++next;
      kept_.id[r] = next++;
    }
  }

  // Nearly all segments are sides of facets at a kept region; only the others need a search.
  void find_kept_segments() {
    kept_.segment.assign(table_.segments.size(), false);
    for (Index f = 0; f < complex_.facets.size(); ++f) {
      const auto& [front, back] = regions_.of_facet[f];
      if (!kept_.region[front] && !kept_.region[back]) continue;
      for (const Index s : table_.facet_segments[f]) kept_.segment[s] = true;
    }
    if (std::find(kept_.segment.begin(), kept_.segment.end(), false) == kept_.segment.end()) return;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!mesh_.alive(t) || mesh_.is_ghost(t) || (mesh_.flags(t) & kSegmentBits) == 0) continue;
      if (!kept_.region[regions_.of_tet[t]]) continue;
      for (int k = 0; k < 6; ++k) {
        if (!mesh_.is_segment(t, k)) continue;
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        const Index s = table_.find(mesh_.corner(t, e[0]), mesh_.corner(t, e[1]));
        if (s == no_index) throw std::logic_error("holdfast: an edge with a segment bit is no segment");
        kept_.segment[s] = true;
      }
    }
  }

  const TetMesh& mesh_;
  const Regions& regions_;
  const NamedComplex& input_;
  const Complex& complex_;
  const SegmentTable& table_;
  const Wanted& wanted_;
  const int scale_;
  std::vector<std::optional<int>> of_parts_;  // ids, by region, if there are parts
  Kept kept_;
};

}  // namespace

Kept choose_regions(const TetMesh& mesh, const Regions& regions, const NamedComplex& input,
                    const Wanted& wanted, int scale) {
  return Chooser(mesh, regions, input, wanted, scale).run();
}

std::invalid_argument on_the_surface(const std::string& what, const Point& p) {
  return std::invalid_argument("the " + what + " at " + place(p) +
                               " lies on the surface; move it inside a region");
}

std::invalid_argument in_no_region(const std::string& what, const Point& p) {
  return std::invalid_argument("the " + what + " at " + place(p) +
                               " lies in no bounded region; move it inside one");
}

std::invalid_argument in_region_not_kept(const Point& seed) {
  return std::invalid_argument("the region seed at " + place(seed) +
                               " lies in a region that is not kept; move it, or keep more regions");
}

std::invalid_argument with_two_ids(const RegionSeed& seed, int id, const Complex& complex,
                                   std::optional<Index> border, const VertexNames& names) {
  std::string message = "the region seed at " + place(seed.where) + " gives id " + std::to_string(seed.id) +
                        " to a region that another seed calls " + std::to_string(id) +
                        "; leave out one of them";
  if (border)
    message += ", or close the open border of the triangles inside this region, at vertex " +
               std::to_string(names(*border)) + " " + place(complex.vertices[*border]);
  return std::invalid_argument(message);
}

Warning warn_of_turned(const Complex& complex, const std::vector<Index>& turned) {
  Warning warning{WarningKind::orientation, turned, {}, {complex.vertices[complex.facets[turned[0]][0]]}, {}};
  warning.message = "every bounded region was kept: there are no winding numbers, since " +
                    listed("triangle", "triangles", turned) + (turned.size() == 1 ? " is" : " are") +
                    " turned against the rest, at " + place(warning.where[0]);
  return warning;
}

}  // namespace holdfast
