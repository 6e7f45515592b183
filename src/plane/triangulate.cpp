// From points and segments to triangles: the course of a run.
#include "plane/triangulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "numbers/halving.h"
#include "numbers/random.h"
#include "plane/defects.h"
#include "plane/delaunay.h"
#include "plane/ears.h"
#include "plane/faces.h"
#include "plane/hull.h"
#include "plane/kept.h"
#include "plane/order.h"
#include "plane/partition.h"
#include "plane/refine.h"
#include "plane/regions.h"
#include "plane/sensible.h"
#include "plane/shape.h"
#include "plane/swaps.h"

namespace holdfast::plane {
namespace {

constexpr double kAngleOfSizes = 20;
constexpr std::size_t kMostDefects = 100;  // of a kind

class Run {
 public:
  Run(const Plane& plane, const PlaneOptions& options, const Poll& poll)
      : plane_(plane), options_(options), poll_(poll), random_(options.seed) {}

  PlaneResult go() {
    PlaneReport& report = result_.report;
    report.points = plane_.points.size();
    report.segments = plane_.segments.size();
    report.holes = plane_.holes.size();
    if (!is_sound() || !make()) refuse();
    report.seconds["total"] = seconds_since(start_);
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// Runs a stage, which takes the share of the work from `done_` to `until`.
  template <typename Work>
  auto stage(const char* name, double until, Work&& work) {
    const Clock::time_point start = Clock::now();
    const double from = done_;
    const Poll share = [&](double fraction) { poll_(from + fraction * (until - from)); };
    struct Note {
      PlaneReport& report;
      const char* name;
      Clock::time_point start;
      ~Note() { report.seconds[name] += seconds_since(start); }
    } note{result_.report, name, start};
    done_ = until;
    return work(share);
  }

  // What single entities need so that the stages can begin.
  [[nodiscard]] bool is_sound() const {
    const auto finite = [](const PlanePoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); };
    return std::all_of(plane_.points.begin(), plane_.points.end(), finite) &&
           std::all_of(plane_.segments.begin(), plane_.segments.end(), [&](const Segment& s) {
             return s[0] < plane_.points.size() && s[1] < plane_.points.size() && s[0] != s[1];
           });
  }

  /// False where the input turns out to be invalid.
  bool make() { return options_.method == PlaneMethod::ears ? make_by_ears() : make_by_delaunay(); }

  bool make_by_ears() {
    points_ = Points(plane_.points);
    segments_ = plane_.segments;
    if (options_.hull || segments_.empty()) add_hull(points_, segments_);
    std::optional<std::vector<Ends>> links =
        stage("sweep", 0.4, [&](const Poll& poll) { return sweep(points_, segments_, poll); });
    if (!links) return false;
    result_.report.links = links->size();
    std::vector<std::array<Vertex, 3>> triangles;
    stage("ears", 0.7, [&](const Poll& poll) {
      links->insert(links->end(), segments_.begin(), segments_.end());
      const Walks walks = find_faces(points_, *links);
      EarCounts counts;
      for (std::size_t i = 0; i < walks.count(); ++i) {
        poll(static_cast<double>(i) / static_cast<double>(walks.count()));
        cut_ears(points_,
                 std::span(walks.vertices).subspan(walks.first[i], walks.first[i + 1] - walks.first[i]),
                 options_.ears, triangles, counts);
      }
      result_.report.ears = counts.ears;
      result_.report.joined = counts.joined;
    });
    stage("join", 0.75, [&](const Poll&) { mesh_ = Triangles::joined(triangles, segments_); });
    if (is_delaunay())
      stage("lawson", kLawson, [&](const Poll& poll) {
        result_.report.delaunay_swaps = swap_to_delaunay(mesh_, points_, poll);
      });
    return keep_regions();
  }

  bool make_by_delaunay() {
    order_points();
    std::optional<Triangles> mesh =
        stage("delaunay", 0.5, [&](const Poll& poll) { return delaunay(points_, poll); });
    if (!mesh) return false;
    // Points on one line: there is nothing to make a triangle of, but they may be invalid all the same.
    if (mesh->size() == 0) return conclude_empty();
    mesh_ = std::move(*mesh);
    if (options_.stop_after == PlaneStage::delaunay) {
      tell_missing();
      keep([](std::uint32_t) { return true; });
      return true;
    }
    if (!stage("segments", 0.8, [&](const Poll& poll) { return insert_segments(poll); })) return false;
    if (options_.stop_after == PlaneStage::swap) tell_missing();
    if (options_.stop_after && options_.stop_after != PlaneStage::delaunay) {
      keep([](std::uint32_t) { return true; });
      return true;
    }
    if (is_delaunay() && options_.method == PlaneMethod::partition)
      stage("lawson", kLawson, [&](const Poll& poll) {
        result_.report.delaunay_swaps = swap_to_delaunay(mesh_, points_, poll);
      });
    return keep_regions();
  }

  // Points are numbered as they are inserted, so that those near each other are so in memory, too.
  void order_points() {
    stage("order", 0.1, [&](const Poll&) {
      order_ = insertion_order(plane_.points);
      Positions positions(order_.size());
      std::vector<Vertex> number(order_.size());
      for (Vertex i = 0; i < order_.size(); ++i) {
        positions[i] = plane_.points[order_[i]];
        number[order_[i]] = i;
      }
      points_ = Points(std::move(positions));
      for (const Segment& s : plane_.segments) segments_.push_back({number[s[0]], number[s[1]]});
    });
  }

  bool insert_segments(const Poll& poll) {
    mesh_.find_stars(points_.size());
    Passage passage;
    SegmentSwaps swaps(mesh_, points_);
    const std::vector<Index> order = laying_order();
    double share = 0;
    const Poll at_share = [&](double) { poll(share); };
    for (std::size_t laid = 0; laid < order.size(); ++laid) {
      share = static_cast<double>(laid) / static_cast<double>(order.size());
      if (laid % 256 == 0) poll(share);
      fetch_ahead(order, laid);
      const Index s = order[laid];
      const auto [a, b] = segments_[s];
      if (!find_passage(mesh_, points_, a, b, passage)) return false;
      EdgeCode edge = passage.edge;
      if (edge == kNoEdge) {
        ++result_.report.missing_segments;
        if (options_.method == PlaneMethod::partition) {
          take_apart(s, passage.crossed);
          continue;
        }
        result_.report.swaps += swaps.lay(a, b, passage.crossed, random_, swapped_, swaps_left());
        edge = mesh_.find_edge(a, b);
        if (edge == kNoEdge) return true;  // where it was to stop
      }
      if (mesh_.constrained(edge)) return false;  // by the same segment
      mesh_.constrain(edge);
      restore_delaunay(at_share);
    }
    if (options_.stop_after != PlaneStage::partition) put_together();
    if (options_.hull || segments_.empty())
      for (std::size_t t = 0; t < mesh_.size(); ++t)
        for (std::uint32_t i = 0; i < 3; ++i)
          if (mesh_[t].v[i] == kNoVertex) mesh_.constrain(code(t, i));
    return true;
  }

  [[nodiscard]] std::size_t swaps_left() const {
    return options_.stop_after == PlaneStage::swap ? options_.stop_after_swaps - result_.report.swaps
                                                   : SIZE_MAX;
  }

  [[nodiscard]] std::vector<Index> laying_order() {
    if (!options_.order) return order_by_points();
    std::vector<Index> order(segments_.size());
    std::iota(order.begin(), order.end(), Index{0});
    if (options_.order == LayingOrder::random) numbers::shuffle(order.begin(), order.end(), random_);
    return options_.order == LayingOrder::halving ? numbers::halved(order) : order;
  }

  // As their last points were inserted, so that each is near the one before.
  [[nodiscard]] std::vector<Index> order_by_points() const {
    std::vector<Index> next(points_.size() + 1, 0), order(segments_.size());
    for (const Ends& s : segments_) ++next[std::max(s[0], s[1]) + std::size_t{1}];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (Index s = 0; s < segments_.size(); ++s)
      order[next[std::max(segments_[s][0], segments_[s][1])]++] = s;
    return order;
  }

  // Its points go at once, or, as §2.3 tells it, when all segments stand.
  void take_apart(Index s, const std::vector<EdgeCode>& crossed) {
    const auto [a, b] = segments_[s];
    pieces_.push_back(partition_.insert(a, b, crossed));
    if (options_.stop_after) tell_chain(s, pieces_.back());
    result_.report.partition_points += crossed.size();
    result_.report.most_partition_points =
        std::max(result_.report.most_partition_points, points_.size() - plane_.points.size());
    if (!options_.partition_first && options_.stop_after != PlaneStage::partition) put_together();
  }

  // After Delaunay, and some swaps: segments that are no edges.
  void tell_missing() {
    mesh_.find_stars(points_.size());
    for (Index s = 0; s < segments_.size(); ++s)
      if (mesh_.find_edge(segments_[s][0], segments_[s][1]) == kNoEdge)
        result_.intermediate.missing_segments.push_back(plane_.segments[s]);
    result_.report.missing_segments = result_.intermediate.missing_segments.size();
  }

  // After partition: a segment in pieces.
  void tell_chain(Index s, const Pieces& pieces) {
    Intermediate& told = result_.intermediate;
    const Segment& segment = plane_.segments[s];
    told.missing_segments.push_back(segment);
    Intermediate::Chain chain{segment, {}};
    for (const Vertex v : pieces) chain.vertices.push_back(number(v));
    for (std::size_t i = 1; i + 1 < pieces.size(); ++i)
      told.added.push_back({chain.vertices[i], segment, std::nullopt});
    told.chains.push_back(std::move(chain));
  }

  void put_together() {
    for (const Pieces& pieces : pieces_) result_.report.swaps += partition_.remove(pieces);
    pieces_.clear();
    points_.shrink(plane_.points.size());
    mesh_.drop_stars(points_.size());
  }

  // At once, while the triangles that swaps have changed are still at hand.
  void restore_delaunay(const Poll& poll) {
    if (is_delaunay()) {
      pending_.clear();
      for (const EdgeCode e : swapped_) pending_.insert(pending_.end(), {e, next_edge(e), previous_edge(e)});
      result_.report.delaunay_swaps += swap_to_delaunay(mesh_, points_, pending_, poll);
    }
    swapped_.clear();
  }

  // Segments come in any order, so that each begins where nothing has been lately.
  void fetch_ahead(const std::vector<Index>& order, std::size_t laid) const {
    constexpr std::size_t kStars = 24, kTriangles = 16, kCorners = 8;
    if (laid + kStars < order.size()) mesh_.fetch_star(segments_[order[laid + kStars]][0]);
    if (laid + kTriangles < order.size()) mesh_.fetch_triangle(segments_[order[laid + kTriangles]][0]);
    if (laid + kCorners >= order.size()) return;
    const EdgeCode e = mesh_.edge_from(segments_[order[laid + kCorners]][0]);
    if (e == kNoEdge) return;
    for (const Vertex v : mesh_[triangle_of(e)].v)
      if (v != kNoVertex) points_.fetch(v);
    for (const EdgeCode across : mesh_[triangle_of(e)].across) mesh_.fetch(triangle_of(across));
  }

  [[nodiscard]] bool is_delaunay() const { return options_.delaunay || refines(options_); }

  /// False where a hole or seed lies on a segment.
  bool keep_regions() {
    Regions regions;
    std::vector<int> ids;
    std::vector<bool> kept;
    RefineOptions wanted;
    if (!stage("regions", kRegions,
               [&](const Poll&) { return choose_regions(regions, ids, kept, wanted.areas); }))
      return false;
    if (refines(options_)) {
      mesh_ = kept_part(mesh_, regions, kept);
      stage("refine", 1, [&](const Poll& poll) { refine_kept(wanted, poll); });
      keep([](std::uint32_t) { return true; }, [&](std::uint32_t t) { return ids[mesh_[t].mark]; });
      cut_segments(plane_, refined_, result_.mesh);
    } else {
      keep([&](std::uint32_t t) { return kept[regions.of_triangle[t]]; },
           [&](std::uint32_t t) { return ids[regions.of_triangle[t]]; });
    }
    if (result_.mesh.triangles.empty()) encloses_nothing();
    return true;
  }

  bool choose_regions(Regions& regions, std::vector<int>& ids, std::vector<bool>& kept,
                      std::vector<double>& areas) {
    regions = find_regions(mesh_);
    ids.assign(regions.count + std::size_t{1}, 0);
    kept.assign(ids.size(), true);
    areas.assign(ids.size(), 0);
    kept[kOutside] = false;
    bool on_constraints = false;  // perhaps: ears leave segments out that bound nothing
    const auto locate = [&](const std::vector<Position>& places, auto&& use) {
      const std::vector<Found> found = find_triangles(mesh_, points_, places);
      for (std::size_t i = 0; i < found.size(); ++i) {
        on_constraints = on_constraints || found[i].on_constraint ||
                         (options_.method == PlaneMethod::ears && found[i].triangle == kNoVertex);
        if (found[i].triangle != kNoVertex && !found[i].on_constraint)
          use(i, regions.of_triangle[found[i].triangle]);
      }
    };
    locate(plane_.holes, [&](std::size_t, std::uint32_t region) { kept[region] = false; });
    std::vector<Position> seeds;
    for (const Plane::Seed& seed : plane_.regions) seeds.push_back(seed.where);
    locate(seeds, [&](std::size_t i, std::uint32_t region) {
      ids[region] = plane_.regions[i].id;
      areas[region] = plane_.regions[i].area;
    });
    number_regions(kept, ids);
    // On sides of the hull that are no segments they are in no region, as those outside.
    if (on_constraints) result_.defects = find_defects(plane_, kMostDefects, poll_);
    return result_.defects.empty();
  }

  void refine_kept(RefineOptions& wanted, const Poll& poll) {
    wanted.size = options_.size;
    wanted.angle = options_.angle.value_or(kAngleOfSizes);
    wanted.keep_boundary = options_.keep_boundary;
    wanted.most_points = std::min(options_.max_points, kMostPoints - points_.size());
    refined_ = refine(mesh_, points_, segments_, wanted, poll);
    PlaneReport& report = result_.report;
    report.field_points = refined_.inside;
    report.segment_points = refined_.on_segments.size() + refined_.on_others;
    report.small_angles = refined_.small_input;
    report.small_angles_left = refined_.small_left;
    report.large_left = refined_.large_left;
    report.capped = refined_.capped;
  }

  // Kept regions without a seed get the numbers from 1 on that no seed has.
  void number_regions(const std::vector<bool>& kept, std::vector<int>& ids) {
    std::vector<int> taken;
    for (const Plane::Seed& seed : plane_.regions) taken.push_back(seed.id);
    std::sort(taken.begin(), taken.end());
    int next = 1;
    for (std::size_t region = 1; region < ids.size(); ++region) {
      if (!kept[region]) continue;
      ++result_.report.regions;
      if (ids[region] != 0) continue;
      while (std::binary_search(taken.begin(), taken.end(), next)) ++next;
      ids[region] = next++;
    }
  }

  // The number of a point in the input; of one that is added, behind these.
  [[nodiscard]] Index number(Vertex v) const { return v < order_.size() ? order_[v] : v; }

  template <typename Kept, typename Id>
  void keep(Kept&& kept, Id&& id) {
    PlaneMesh& mesh = result_.mesh;
    mesh.triangles.reserve(mesh_.size());
    mesh.regions.reserve(mesh_.size());
    LeastAngle least(points_.positions());
    for (std::uint32_t t = 0; t < mesh_.size(); ++t) {
      if (mesh_.is_ghost(t) || !kept(t)) continue;
      const std::array<Vertex, 3>& v = mesh_[t].v;
      mesh.triangles.push_back({number(v[0]), number(v[1]), number(v[2])});
      mesh.regions.push_back(id(t));
      least.take(points_[v[0]], points_[v[1]], points_[v[2]]);
    }
    if (!mesh.triangles.empty()) result_.report.least_angle = least.degrees();
    mesh.points = plane_.points;
    mesh.point_markers = plane_.point_markers;
    mesh.segments = plane_.segments;
    mesh.segment_markers = plane_.segment_markers;
    // Points that are added, those of the partition to the nearest doubles.
    for (std::size_t v = plane_.points.size(); v < points_.size(); ++v)
      mesh.points.push_back(points_[static_cast<Vertex>(v)]);
    if (!mesh.point_markers.empty()) mesh.point_markers.resize(mesh.points.size(), 0);
    result_.report.triangles = mesh.triangles.size();
  }
  template <typename Kept>
  void keep(Kept&& kept) {
    keep(kept, [](std::uint32_t) { return 1; });
  }

  bool conclude_empty() {
    result_.defects = find_defects(plane_, kMostDefects, poll_);
    if (!result_.defects.empty()) return false;
    encloses_nothing();
    return true;
  }

  void encloses_nothing() {
    result_.mesh = {};
    result_.outcome = Outcome::invalid_input;
    result_.message = plane_.segments.empty() ? "all points lie on one line, so that there is no triangle"
                                              : "the segments enclose nothing, or nothing but holes";
    result_.defects.push_back({DefectKind::encloses_nothing, {}, {}, {}, {}, result_.message});
  }

  void refuse() {
    if (result_.defects.empty()) result_.defects = find_defects(plane_, kMostDefects, poll_);
    if (result_.defects.empty()) throw std::logic_error("holdfast: a plane input fails without a defect");
    result_.mesh = {};
    result_.intermediate = {};
    result_.outcome = Outcome::invalid_input;
    result_.message = "the points and segments are not valid";
  }

  static constexpr double kLawson = 0.85, kRegions = 0.9;  // shares of the work when a stage ends

  const Plane& plane_;
  const PlaneOptions& options_;
  const Poll& poll_;
  const Clock::time_point start_ = Clock::now();
  double done_ = 0;
  numbers::Random random_;
  std::vector<Vertex> order_;  // of each point here, its number in the input
  Points points_;
  std::vector<std::array<Vertex, 2>> segments_;
  Triangles mesh_;
  std::vector<EdgeCode> swapped_, pending_;
  Partition partition_{mesh_, points_};
  std::vector<Pieces> pieces_;  // of segments whose points are still there
  Refined refined_;
  PlaneResult result_;
};

}  // namespace

PlaneResult triangulate(const Plane& plane, const PlaneOptions& options, const Poll& poll) {
  require_sensible(plane, options);
  return Run(plane, options, poll).go();
}

}  // namespace holdfast::plane
