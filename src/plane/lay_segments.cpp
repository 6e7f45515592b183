// Inserts segments one after the other: find the passage, clear it, constrain the edge.
#include "plane/lay_segments.h"

#include <algorithm>
#include <numeric>

#include "numbers/halving.h"
#include "numbers/random.h"
#include "plane/partition.h"
#include "plane/sensible.h"
#include "plane/swaps.h"

namespace holdfast::plane {
namespace {

// In the order in which their last points were inserted, so that each segment is near the one before.
std::vector<Index> order_by_points(const Draft& draft) {
  const std::vector<Ends>& segments = draft.segments;
  std::vector<Index> next(draft.points.size() + 1, 0), order(segments.size());
  for (const Ends& s : segments) ++next[std::max(s[0], s[1]) + std::size_t{1}];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (Index s = 0; s < segments.size(); ++s) order[next[std::max(segments[s][0], segments[s][1])]++] = s;
  return order;
}

std::vector<Index> laying_order(const Draft& draft, std::optional<LayingOrder> asked_for,
                                numbers::Random& random) {
  if (!asked_for) return order_by_points(draft);
  std::vector<Index> order(draft.segments.size());
  std::iota(order.begin(), order.end(), Index{0});
  if (asked_for == LayingOrder::random) numbers::shuffle(order.begin(), order.end(), random);
  return asked_for == LayingOrder::halving ? numbers::halved(order) : order;
}

// The order of segments has no locality, so each starts at memory that is not cached.
void fetch_ahead(const Draft& draft, const std::vector<Index>& order, std::size_t laid) {
  constexpr std::size_t kStars = 24, kTriangles = 16, kCorners = 8;
  const Triangles& mesh = draft.mesh;
  const auto start = [&](std::size_t ahead) { return draft.segments[order[laid + ahead]][0]; };
  if (laid + kStars < order.size()) mesh.fetch_star(start(kStars));
  if (laid + kTriangles < order.size()) mesh.fetch_triangle(start(kTriangles));
  if (laid + kCorners >= order.size()) return;
  const EdgeCode e = mesh.edge_from(start(kCorners));
  if (e == kNoEdge) return;
  for (const Vertex v : mesh[triangle_of(e)].v)
    if (v != kNoVertex) draft.points.fetch(v);
  for (const EdgeCode across : mesh[triangle_of(e)].across) mesh.fetch(triangle_of(across));
}

/// Inserts segments by swaps. Between two of them the triangles are constrained Delaunay, if this is asked
/// for.
class BySwaps {
 public:
  BySwaps(Draft& draft, const PlaneOptions& options, PlaneReport& report)
      : mesh_(draft.mesh),
        points_(draft.points),
        options_(options),
        report_(report),
        swaps_(mesh_, points_) {}

  /// Returns the edge that the segment becomes, or kNoEdge if the run stops after some swaps.
  EdgeCode lay(const Ends& ab, const std::vector<EdgeCode>& crossed, numbers::Random& random) {
    const std::size_t left =
        options_.stop_after == PlaneStage::swap ? options_.stop_after_swaps - report_.swaps : SIZE_MAX;
    report_.swaps += swaps_.lay(ab[0], ab[1], crossed, random, swapped_, left);
    return mesh_.find_edge(ab[0], ab[1]);
  }

  // Done after each segment, while the triangles that swaps have changed are still cached.
  void restore_delaunay(const Poll& poll) {
    if (options_.delaunay || refines(options_)) {
      pending_.clear();
      for (const EdgeCode e : swapped_) pending_.insert(pending_.end(), {e, next_edge(e), previous_edge(e)});
      report_.delaunay_swaps += swap_to_delaunay(mesh_, points_, pending_, poll);
    }
    swapped_.clear();
  }

 private:
  Triangles& mesh_;
  const Points& points_;
  const PlaneOptions& options_;
  PlaneReport& report_;
  SegmentSwaps swaps_;
  std::vector<EdgeCode> swapped_, pending_;
};

/// Inserts segments by points where they cross edges. The points are removed at once or, as in §2.3, after
/// all segments are present.
class ByPartition {
 public:
  ByPartition(Draft& draft, const PlaneOptions& options, PlaneReport& report)
      : mesh_(draft.mesh),
        points_(draft.points),
        input_points_(draft.points.size()),
        options_(options),
        report_(report),
        partition_(mesh_, points_) {}

  /// The pieces of the segment ab.
  const Pieces& lay(const Ends& ab, const std::vector<EdgeCode>& crossed) {
    pieces_.push_back(partition_.insert(ab[0], ab[1], crossed));
    report_.partition_points += crossed.size();
    report_.most_partition_points = std::max(report_.most_partition_points, points_.size() - input_points_);
    return pieces_.back();
  }

  /// Removes the points that are left, unless the run stops before.
  void remove_points() {
    if (options_.stop_after == PlaneStage::partition) return;
    for (const Pieces& pieces : pieces_) report_.swaps += partition_.remove(pieces);
    pieces_.clear();
    points_.shrink(input_points_);
    mesh_.drop_stars(points_.size());
  }

 private:
  Triangles& mesh_;
  Points& points_;
  const std::size_t input_points_;
  const PlaneOptions& options_;
  PlaneReport& report_;
  Partition partition_;
  std::vector<Pieces> pieces_;  // of segments whose points are not removed yet
};

// After partition: records a segment in pieces.
void tell_chain(const Draft& draft, const Ends& ab, const Pieces& pieces, Intermediate& told) {
  const Segment segment{draft.number(ab[0]), draft.number(ab[1])};
  told.missing_segments.push_back(segment);
  Intermediate::Chain chain{segment, {}};
  for (const Vertex v : pieces) chain.vertices.push_back(draft.number(v));
  for (std::size_t i = 1; i + 1 < pieces.size(); ++i)
    told.added.push_back({chain.vertices[i], segment, std::nullopt});
  told.chains.push_back(std::move(chain));
}

void constrain_hull(Triangles& mesh) {
  for (std::size_t t = 0; t < mesh.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (mesh[t].v[i] == kNoVertex) mesh.constrain(code(t, i));
}

}  // namespace

bool lay_segments(Draft& draft, const PlaneOptions& options, PlaneResult& result, const Poll& poll) {
  Triangles& mesh = draft.mesh;
  mesh.find_stars(draft.points.size());
  BySwaps by_swaps(draft, options, result.report);
  ByPartition by_partition(draft, options, result.report);
  numbers::Random random(options.seed);
  const std::vector<Index> order = laying_order(draft, options.order, random);
  Passage passage;
  double share = 0;
  const Poll at_share = [&](double) { poll(share); };
  for (std::size_t laid = 0; laid < order.size(); ++laid) {
    share = static_cast<double>(laid) / static_cast<double>(order.size());
    if (laid % 256 == 0) poll(share);
    fetch_ahead(draft, order, laid);
    const Ends ab = draft.segments[order[laid]];
    if (!find_passage(mesh, draft.points, ab[0], ab[1], passage)) return false;
    if (passage.edge == kNoEdge) {
      ++result.report.missing_segments;
      if (options.method == PlaneMethod::partition) {
        const Pieces& pieces = by_partition.lay(ab, passage.crossed);
        if (options.stop_after) tell_chain(draft, ab, pieces, result.intermediate);
        if (!options.partition_first) by_partition.remove_points();
        continue;
      }
      passage.edge = by_swaps.lay(ab, passage.crossed, random);
      if (passage.edge == kNoEdge) return true;
    }
    if (mesh.constrained(passage.edge)) return false;  // by the same segment
    mesh.constrain(passage.edge);
    by_swaps.restore_delaunay(at_share);
  }
  by_partition.remove_points();
  if (options.hull || draft.segments.empty()) constrain_hull(mesh);
  return true;
}

}  // namespace holdfast::plane
