#include "classify/keep.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "mesh/traverse.h"

namespace holdfast {
namespace {

std::string text(const Point& p) {
  std::array<char, 96> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "(%.17g, %.17g, %.17g)", p[0], p[1], p[2]);
  return buffer.data();
}

std::vector<bool> bounded(const Regions& regions) {
  std::vector<bool> keep(regions.count, true);
  keep[0] = false;
  return keep;
}

std::vector<bool> by_winding(const std::vector<int>& winding) {
  std::vector<bool> keep(winding.size());
  for (std::size_t r = 0; r < winding.size(); ++r) keep[r] = r != 0 && winding[r] != 0;
  return keep;
}

std::vector<bool> by_rule(const Regions& regions, Keep rule) {
  if (rule == Keep::box) return std::vector<bool>(regions.count, true);
  if (rule == Keep::bounded) return bounded(regions);
  const auto winding = winding_numbers(regions);
  if (rule == Keep::winding && !winding)
    throw std::invalid_argument(
        "keep winding: the facets are not consistently oriented; turn them round or use keep bounded");
  if (!winding) return bounded(regions);
  std::vector<bool> keep = by_winding(*winding);
  const bool some = std::find(keep.begin(), keep.end(), true) != keep.end();
  return some || rule == Keep::winding ? keep : bounded(regions);
}

RegionId region_at(const TetMesh& mesh, const Regions& regions, const Point& p, const char* what) {
  const Located located = locate(mesh, regions, p);
  if (located.on_constraint)
    throw std::invalid_argument(std::string(what) + " " + text(p) +
                                " lies on the surface; move it inside a region");
  if (located.region == 0)
    throw std::invalid_argument(std::string(what) + " " + text(p) + " lies outside every bounded region");
  return located.region;
}

Defect encloses_nothing(const Complex& complex, const SegmentTable& table) {
  Defect defect{DefectKind::encloses_nothing, {}, {}, {}, {}, {}};
  std::size_t open = 0;
  std::string first;
  for (Index s = 0; s < table.segments.size(); ++s) {
    if (table.facets_of(s).size() != 1) continue;
    ++open;
    const auto [a, b] = table.segments[s];
    constexpr std::size_t kListed = 3;
    if (open > kListed) continue;
    first += (open > 1 ? "; " : "") + std::to_string(a) + "-" + std::to_string(b) + " from " +
             text(complex.vertices[a]) + " to " + text(complex.vertices[b]);
    defect.vertices.insert(defect.vertices.end(), {a, b});
    defect.where.insert(defect.where.end(), {complex.vertices[a], complex.vertices[b]});
  }
  defect.message = "the surface encloses nothing";
  if (open > 0)
    defect.message +=
        ": " + std::to_string(open) + " open border edges, first " + first + (open > 3 ? "; ..." : "");
  defect.message += "; close it, or use --keep box to mesh everything out to an enclosing box";
  return defect;
}

// Facets, dangling segments and isolated vertices next to no kept region.
class OutsideFinder {
 public:
  OutsideFinder(TetMesh& mesh, const Regions& regions, const std::vector<bool>& keep, const Complex& complex,
                const SegmentTable& table)
      : mesh_(mesh), regions_(regions), keep_(keep), complex_(complex), table_(table) {}

  std::vector<Defect> run() {
    for (Index f = 0; f < complex_.facets.size(); ++f)
      if (!keep_[regions_.of_facet[f][0]] && !keep_[regions_.of_facet[f][1]]) add_facet(f);
    std::vector<bool> used(complex_.vertices.size(), false);
    for (Index s = 0; s < table_.segments.size(); ++s) {
      for (const Index v : table_.segments[s]) used[v] = true;
      if (table_.facets_of(s).empty()) look_at_segment(s);
    }
    for (Index v = 0; v < complex_.vertices.size(); ++v)
      if (!used[v]) look_at_vertex(v);
    return std::move(defects_);
  }

 private:
  [[nodiscard]] bool any_kept(const std::vector<Tet>& tets) const {
    return std::any_of(tets.begin(), tets.end(), [&](Tet t) { return keep_[regions_.of_tet[t]]; });
  }
  void add_facet(Index f) {
    const Triangle& t = complex_.facets[f];
    defects_.push_back(
        {DefectKind::outside_region,
         {t[0], t[1], t[2]},
         {f},
         {},
         {complex_.vertices[t[0]]},
         "triangle " + std::to_string(f) + " at " + text(complex_.vertices[t[0]]) +
             " lies outside every kept region; remove it, use --drop-outside, or keep more (--keep)"});
  }
  void look_at_segment(Index s) {
    const auto [a, b] = table_.segments[s];
    std::vector<Tet> ring;
    shell(mesh_, find_edge(mesh_, a, b), a, b, ring);
    if (any_kept(ring)) return;
    defects_.push_back(
        {DefectKind::outside_region,
         {a, b},
         {},
         {table_.input_segment[s]},
         {complex_.vertices[a]},
         "segment " + std::to_string(table_.input_segment[s]) + " at " + text(complex_.vertices[a]) +
             " lies outside every kept region; remove it, use --drop-outside, or keep more (--keep)"});
  }
  void look_at_vertex(Index v) {
    std::vector<Tet> tets;
    ball(mesh_, v, tets);
    if (any_kept(tets)) return;
    defects_.push_back(
        {DefectKind::outside_region,
         {v},
         {},
         {},
         {complex_.vertices[v]},
         "isolated vertex " + std::to_string(v) + " at " + text(complex_.vertices[v]) +
             " lies outside every kept region; remove it, use --drop-outside, or keep more (--keep)"});
  }

  TetMesh& mesh_;
  const Regions& regions_;
  const std::vector<bool>& keep_;
  const Complex& complex_;
  const SegmentTable& table_;
  std::vector<Defect> defects_;
};

// Seeds give ids; the other kept regions take the lowest ids that are free, in order.
std::vector<int> number(const TetMesh& mesh, const Regions& regions, const std::vector<bool>& keep,
                        const std::vector<RegionSeed>& seeds) {
  std::vector<int> id(regions.count, 0);
  std::vector<bool> seeded(regions.count, false);
  for (const RegionSeed& seed : seeds) {
    const RegionId r = region_at(mesh, regions, seed.where, "region seed");
    id[r] = seed.id;
    seeded[r] = true;
  }
  const auto taken = [&](int candidate) {
    for (RegionId r = 0; r < regions.count; ++r)
      if (seeded[r] && id[r] == candidate) return true;
    return false;
  };
  int next = 1;
  for (RegionId r = 1; r < regions.count; ++r) {
    if (seeded[r] || !keep[r]) continue;
    while (taken(next)) ++next;
    id[r] = next++;
  }
  return id;
}

}  // namespace

Kept choose_regions(TetMesh& mesh, const Regions& regions, const Complex& complex, const SegmentTable& table,
                    const Options& options) {
  Kept kept;
  kept.region = by_rule(regions, options.keep);
  for (const Point& hole : options.holes) kept.region[region_at(mesh, regions, hole, "hole")] = false;
  kept.id = number(mesh, regions, kept.region, options.regions);
  if (regions.count == 1 && options.keep != Keep::box) {
    kept.defects.push_back(encloses_nothing(complex, table));
  } else if (!options.drop_outside) {
    kept.defects = OutsideFinder(mesh, regions, kept.region, complex, table).run();
  }
  return kept;
}

}  // namespace holdfast
