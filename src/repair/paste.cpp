// The common triangles of patches: a plane patch is cut as a whole, a curved one facet by facet.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "numbers/sorted.h"
#include "plane/triangulate.h"
#include "repair/cut_facet.h"
#include "repair/patches.h"
#include "repair/round_chain.h"
#include "surface/box_pairs.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

constexpr double kFlat = 8;  // times the rounding error: the largest thickness of a plane patch

using Side = std::array<Index, 2>;

bool is_flat(const PartFacets& facets, const std::vector<Index>& patch, double rounding) {
  const Index widest = facets.widest(patch);
  const Point& origin = facets.at(facets.corners(widest)[0]);
  return std::all_of(patch.begin(), patch.end(), [&](Index f) {
    const Triangle& t = facets.corners(f);
    return std::all_of(t.begin(), t.end(), [&](Index v) {
      return std::fabs(dot(facets.at(v) - origin, facets.plane(widest)->normal)) <= kFlat * rounding;
    });
  });
}

/// A plane patch in two of the three coordinates, with the pieces of all sides of its facets.
struct FlatPatch {
  std::size_t axis;  ///< the coordinate that is left out
  Plane plane;
  std::vector<Index> vertices;  ///< by point of the plane
  /// For each facet of the patch, the steps round it, counterclockwise.
  std::vector<std::vector<RoundChain::Step>> chains;

  FlatPatch(const PartFacets& facets, const LedSides& sides, const std::vector<Index>& patch)
      : axis(facets.plane(facets.widest(patch))->axis) {
    std::unordered_map<Index, Index> number;
    const auto number_of = [&](Index v) {
      const auto [found, is_new] = number.try_emplace(v, static_cast<Index>(vertices.size()));
      if (is_new) {
        vertices.push_back(v);
        plane.points.push_back(facets.flat(v, axis));
      }
      return found->second;
    };
    std::vector<Side> pieces;
    for (const Index f : patch) {
      chains.push_back(sides.round(facets.corners(f)));
      for (RoundChain::Step& step : chains.back()) {
        if (facets.area(facets.corners(f), axis) < 0) std::swap(step[0], step[1]);
        step = {number_of(step[0]), number_of(step[1])};
        pieces.push_back(ascending(step));
      }
    }
    sort_unique(pieces);
    plane.segments.assign(pieces.begin(), pieces.end());
  }
};

/// Cuts one patch after the other.
class PatchCutter {
 public:
  PatchCutter(const PartFacets& facets, const LedSides& sides, double gap, const Step& step)
      : facets_(facets), sides_(sides), gap_(gap), step_(step) {}

  /// Cuts a plane patch as a whole. False if this fails.
  bool cut_flat(const std::vector<Index>& patch);

  /// Cuts a patch that is not plane: each facet is cut in its own plane into cells. Cells of several facets
  /// with the same border share the triangles of one of them.
  void cut_curved(const std::vector<Index>& patch);

  [[nodiscard]] std::vector<Pasted> pasted() && { return std::move(pasted_); }
  /// The largest distance of a corner of a triangle from a facet that the triangle replaces.
  [[nodiscard]] double most() const { return most_; }

 private:
  [[nodiscard]] std::map<Index, std::vector<Index>> vertices_inside(const std::vector<Index>& patch) const;
  [[nodiscard]] std::vector<Side> sides_of_others(Index f, const std::vector<Index>& patch,
                                                  const std::vector<Box>& boxes) const;
  void take(const Triangle& corners, const std::vector<Index>& facets);
  void take(const std::vector<Cell>& cells);

  const PartFacets& facets_;
  const LedSides& sides_;
  const double gap_;
  const Step& step_;
  std::vector<Pasted> pasted_;
  double most_ = 0;
};

bool PatchCutter::cut_flat(const std::vector<Index>& patch) {
  const FlatPatch flat(facets_, sides_, patch);
  PlaneOptions options;
  options.delaunay = true;
  const PlaneResult result = plane::triangulate(flat.plane, options, [&](double) { step_(0.7); });
  if (result.outcome != Outcome::done || result.mesh.points.size() != flat.plane.points.size()) return false;

  const RoundChain round(result.mesh.triangles);
  std::vector<std::vector<Index>> facets_at(result.mesh.triangles.size());
  for (std::size_t k = 0; k < patch.size(); ++k) {
    step_(0.7);
    const std::vector<Index> inside = round.inside(flat.chains[k]);
    if (inside.empty()) return false;
    for (const Index t : inside) facets_at[t].push_back(patch[k]);
  }
  for (std::size_t t = 0; t < facets_at.size(); ++t) {
    const std::vector<Index>& of = facets_at[t];
    if (of.empty()) continue;
    Triangle corners = result.mesh.triangles[t];
    for (Index& v : corners) v = flat.vertices[v];
    if (facets_.area(facets_.corners(of[0]), flat.axis) < 0) std::swap(corners[1], corners[2]);
    take(corners, of);
  }
  return true;
}

// A triangle that replaces parts of facets.
void PatchCutter::take(const Triangle& corners, const std::vector<Index>& facets) {
  for (const Index f : facets) most_ = std::max(most_, facets_.distance(corners, f));
  pasted_.push_back({corners, facets});
}

void PatchCutter::cut_curved(const std::vector<Index>& patch) {
  std::vector<Index> in_order = patch;
  std::stable_sort(in_order.begin(), in_order.end(),
                   [&](Index f, Index g) { return facets_.part_of(f) < facets_.part_of(g); });
  std::map<Index, std::vector<Index>> inside = vertices_inside(patch);
  std::vector<Box> boxes;
  boxes.reserve(in_order.size());
  for (const Index f : in_order) boxes.push_back(box_round(facets_.state(), facets_.corners(f), gap_));
  std::vector<Cell> cells;
  for (const Index f : in_order) {
    step_(0.7);
    const std::vector<Cell> own =
        cut_facet(facets_, sides_, f, inside[f], sides_of_others(f, in_order, boxes), step_);
    cells.insert(cells.end(), own.begin(), own.end());
  }
  take(cells);
}

// Of cells with one border, takes the triangles of the first cell with the most triangles, so that no vertex
// is lost.
void PatchCutter::take(const std::vector<Cell>& cells) {
  std::map<std::vector<Side>, std::vector<const Cell*>> with_border;
  std::vector<const std::vector<const Cell*>*> in_order;
  for (const Cell& cell : cells) {
    auto& same = with_border[cell.border];
    if (same.empty()) in_order.push_back(&same);
    same.push_back(&cell);
  }
  for (const auto* same : in_order) {
    const Cell& best = **std::max_element(same->begin(), same->end(), [](const Cell* a, const Cell* b) {
      return a->triangles.size() < b->triangles.size();
    });
    std::vector<Index> of;
    for (const Cell* cell : *same) of.push_back(cell->facet);
    sort_unique(of);
    for (const Triangle& corners : best.triangles) take(corners, of);
  }
}

// For each facet, the vertices of other parts that lie on it and on no side of its part.
std::map<Index, std::vector<Index>> PatchCutter::vertices_inside(const std::vector<Index>& patch) const {
  std::vector<Index> vertices;
  for (const Index f : patch)
    vertices.insert(vertices.end(), facets_.corners(f).begin(), facets_.corners(f).end());
  sort_unique(vertices);
  std::vector<Box> round_vertices, round_facets;
  for (const Index v : vertices) round_vertices.push_back(box_round(facets_.state(), std::array{v}, gap_));
  for (const Index f : patch) round_facets.push_back(box_round(facets_.state(), facets_.corners(f), 0));
  std::map<std::pair<Index, Index>, std::pair<double, Index>> best;  // by vertex and part
  const auto compare = [&](Index i, Index j) {
    const Index v = vertices[i], f = patch[j], part = facets_.part_of(f);
    if (std::binary_search(facets_.parts_at(v).begin(), facets_.parts_at(v).end(), part)) return true;
    if (sides_.is_on_side(v, part)) return true;
    const auto& [a, b, c] = facets_.corners(f);
    const std::pair near{beside_facet(facets_.at(v), facets_.at(a), facets_.at(b), facets_.at(c)).distance,
                         f};
    if (!(near.first <= gap_)) return true;
    const auto [there, is_new] = best.try_emplace({v, part}, near);
    if (!is_new) there->second = std::min(there->second, near);
    return true;
  };
  for_each_overlap_between(std::move(round_vertices), round_facets, compare, step_);

  std::map<Index, std::vector<Index>> inside;
  for (const auto& [key, near] : best) inside[near.second].push_back(key.first);
  return inside;
}

// The pieces of sides near a facet, from the facets of other parts.
std::vector<Side> PatchCutter::sides_of_others(Index f, const std::vector<Index>& patch,
                                               const std::vector<Box>& boxes) const {
  std::vector<Side> pieces;
  const Box box = box_round(facets_.state(), facets_.corners(f), gap_);
  for (std::size_t k = 0; k < patch.size(); ++k) {
    if (facets_.part_of(patch[k]) == facets_.part_of(f) || !boxes[k].overlaps(box)) continue;
    const std::vector<Side> round = sides_.round(facets_.corners(patch[k]));
    pieces.insert(pieces.end(), round.begin(), round.end());
  }
  return pieces;
}

}  // namespace

std::vector<Pasted> paste(const PartFacets& facets, const LedSides& sides, const Patches& patches, double gap,
                          double rounding, const Step& step, double& most) {
  PatchCutter cutter(facets, sides, gap, step);
  for (const std::vector<Index>& patch : patches.facets) {
    step(0.6);
    if (!is_flat(facets, patch, rounding) || !cutter.cut_flat(patch)) cutter.cut_curved(patch);
  }
  most = std::max(most, cutter.most());
  return std::move(cutter).pasted();
}

}  // namespace holdfast::repairing
