#include "repair/cut_facet.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "numbers/sorted.h"
#include "plane/triangulate.h"
#include "repair/round_chain.h"

namespace holdfast::repairing {
namespace {

using Side = std::array<Index, 2>;

void take(const Triangle& corners, Cell& cell) {
  cell.triangles.push_back(corners);
  for (std::size_t i = 0; i < 3; ++i)
    cell.border.push_back(ascending(Side{corners[i], corners[(i + 1) % 3]}));
}

class FacetCut {
 public:
  FacetCut(const PartFacets& facets, const LedSides& sides, Index f, const Step& step)
      : facets_(facets),
        sides_(sides),
        f_(f),
        axis_(facets.plane(f)->axis),
        is_turned_(facets.area(facets.corners(f), axis_) < 0),
        step_(step),
        chain_(sides.round(facets.corners(f))) {
    if (is_turned_)
      for (Side& side : chain_) std::swap(side[0], side[1]);
    for (const Side& side : chain_) {
      round_.insert(side[0]);
      own_.insert(ascending(side));
    }
  }

  std::vector<Cell> run(std::span<const Index> inside, std::span<const Side> pieces) {
    std::set<Index> points(inside.begin(), inside.end());
    std::set<Side> segments;
    for (const Side& piece : pieces)
      if (is_on(piece[0], points) && is_on(piece[1], points) && own_.count(ascending(piece)) == 0)
        segments.insert(ascending(piece));
    // Everything that crosses something is removed at once; then the rest is tried.
    constexpr int kMostTrials = 4;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const PlaneResult result = triangulate(points, segments);
      if (result.outcome == Outcome::done && result.mesh.points.size() == vertices_.size())
        return cells_of(result.mesh);
      if (!leave_out(result.defects, points, segments)) break;
    }
    Cell whole;
    for (const Triangle& t : sides_.split(facets_.corners(f_))) take(t, whole);
    return finished({std::move(whole)});
  }

 private:
  [[nodiscard]] bool is_on(Index v, const std::set<Index>& points) const {
    return round_.count(v) != 0 || points.count(v) != 0;
  }

  [[nodiscard]] PlaneResult triangulate(const std::set<Index>& points, const std::set<Side>& segments) {
    Plane plane;
    vertices_.clear();
    number_.clear();
    listed_.clear();
    const auto number = [&](Index v) {
      const auto [there, is_new] = number_.try_emplace(v, static_cast<Index>(vertices_.size()));
      if (is_new) {
        vertices_.push_back(v);
        plane.points.push_back(facets_.flat(v, axis_));
      }
      return there->second;
    };
    for (const Index v : points) number(v);
    for (const std::set<Side>* sides : std::array<const std::set<Side>*, 2>{&own_, &segments})
      for (const Side& side : *sides) {
        plane.segments.push_back({number(side[0]), number(side[1])});
        listed_.push_back(side);
      }
    PlaneOptions options;
    options.delaunay = true;
    return plane::triangulate(plane, options, [&](double) { step_(0.7); });
  }

  /// False if nothing that is in the way may be left out.
  [[nodiscard]] bool leave_out(const std::vector<Defect>& defects, std::set<Index>& points,
                               std::set<Side>& segments) const {
    const std::size_t before = points.size() + segments.size();
    for (const Defect& defect : defects) {
      for (const Index s : defect.segments)
        if (s < listed_.size()) segments.erase(listed_[s]);
      for (const Index p : defect.vertices)
        if (p < vertices_.size() && points.erase(vertices_[p]) != 0)
          std::erase_if(segments, [&](const Side& side) {
            return (side[0] == vertices_[p] || side[1] == vertices_[p]) && round_.count(vertices_[p]) == 0;
          });
    }
    return points.size() + segments.size() < before;
  }

  [[nodiscard]] std::vector<Cell> cells_of(const PlaneMesh& mesh) const {
    std::vector<Side> chain = chain_;
    for (Side& side : chain) side = {number_.at(side[0]), number_.at(side[1])};
    std::map<int, Cell> by_region;
    for (const Index t : RoundChain(mesh.triangles).inside(chain)) {
      Triangle corners = mesh.triangles[t];
      for (Index& v : corners) v = vertices_[v];
      if (is_turned_) std::swap(corners[1], corners[2]);
      take(corners, by_region[mesh.regions[t]]);
    }
    std::vector<Cell> cells;
    cells.reserve(by_region.size());
    for (auto& [region, cell] : by_region) cells.push_back(std::move(cell));
    return finished(std::move(cells));
  }

  [[nodiscard]] std::vector<Cell> finished(std::vector<Cell> cells) const {
    for (Cell& cell : cells) {
      cell.facet = f_;
      sort_odd(cell.border);
    }
    std::erase_if(cells, [](const Cell& cell) { return cell.triangles.empty(); });
    return cells;
  }

  const PartFacets& facets_;
  const LedSides& sides_;
  const Index f_;
  const std::size_t axis_;
  const bool is_turned_;
  const Step& step_;
  std::vector<Side> chain_;  // a left turn in the projection
  std::set<Index> round_;    // its vertices
  std::set<Side> own_;       // its sides, ascending
  // Of the last trial.
  std::vector<Index> vertices_;
  std::unordered_map<Index, Index> number_;
  std::vector<Side> listed_;
};

}  // namespace

std::vector<Cell> cut_facet(const PartFacets& facets, const LedSides& sides, Index f,
                            std::span<const Index> inside, std::span<const std::array<Index, 2>> pieces,
                            const Step& step) {
  return FacetCut(facets, sides, f, step).run(inside, pieces);
}

}  // namespace holdfast::repairing
