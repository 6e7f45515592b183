// The exact arrangement of a complex.
#include "arrange/arrange.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <thread>

#include "arrange/index_table.h"
#include "arrange/meetings.h"
#include "arrange/point_pool.h"
#include "arrange/sheet.h"
#include "mesh/disjoint_sets.h"
#include "numbers/release.h"
#include "numbers/sorted.h"

namespace holdfast::arrange {
namespace {

/// A sheet in preparation: the data that SheetInput views.
struct Gathered {
  std::vector<Index> facets, points;
  std::vector<Trace> traces;
  std::vector<PointOnSide> on_sides;
};

class Arranging {
 public:
  Arranging(const Complex& complex, const Elements& elements, const Step& step, const ArrangeOptions& options)
      : complex_(complex),
        elements_(elements),
        step_(step),
        options_(options),
        pool_(complex.vertices, elements.places.first) {}

  Arrangement run(std::vector<OffendingPair> pairs) {
    result_.pairs = pairs.size();
    tell_fitted(pairs);
    try {
      return arrange(std::move(pairs));
    } catch (TooManyPoints& many) {
      many.fitted = std::move(result_.fitted);
      throw;
    }
  }

 private:
  Arrangement arrange(std::vector<OffendingPair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    const FacetPlanes planes(complex_, elements_, facets_of(pairs), options_.threads);
    Meetings meetings = find_meetings(complex_, elements_, pairs, planes, pool_, step_, options_);
    release(pairs);
    check_size();
    gather(meetings);
    cut_sheets(planes);
    deliver_segments(meetings);
    meetings = {};
    deliver_points();
    deliver_facets();
    result_.sheets = sheets_.size();
    for (const Flaw& flaw : elements_.flaws)
      if (flaw.corners > 1) result_.left_out.push_back(flaw);
    return std::move(result_);
  }

  void check_size() const {
    if (pool_.added() > options_.most_points) throw TooManyPoints(pool_.added());
  }

  // --- Sheets

  /// The sheet of a facet; a new one if the facet has none.
  Gathered& sheet_at(Index element) {
    const Index root = roots_->root(element);
    const auto [at, is_new] = sheet_of_root_.try_emplace(root, static_cast<Index>(sheets_.size()));
    if (is_new) sheets_.emplace_back();
    return sheets_[at->second];
  }

  void gather(const Meetings& meetings) {
    roots_.emplace(elements_.all.size());
    for (const auto& [i, j] : meetings.overlapping) roots_->unite(i, j);
    for (const Meeting& meeting : meetings.all) {
      for (std::size_t e = 0; e < 2; ++e)
        if (elements_.all[meeting.elements[e]].corners == 3) gather(meeting, e);
    }
    for (const auto& [i, j] : meetings.overlapping) sheet_at(i);
    sheet_of_.assign(elements_.all.size(), no_index);
    for (Index i = 0; i < elements_.all.size() && elements_.all[i].corners == 3; ++i) {
      const auto at = sheet_of_root_.find(roots_->root(i));
      if (at == sheet_of_root_.end()) continue;
      sheet_of_[i] = at->second;
      sheets_[at->second].facets.push_back(i);
    }
  }

  /// Records the meeting's trace on the facet that is its element e.
  void gather(const Meeting& meeting, std::size_t e) {
    const unsigned mask = meeting.mask(e);
    if (std::popcount(mask) == 1) return;  // a corner
    Gathered& sheet = sheet_at(meeting.elements[e]);
    for (std::size_t k = 0; k < 2 && meeting.points[k] != no_index; ++k)
      if (const unsigned face = meeting.faces[k][e]; std::popcount(face) == 2)
        sheet.on_sides.push_back(
            {meeting.points[k], meeting.elements[e], static_cast<unsigned>(std::countr_zero(7u & ~face))});
    if (meeting.is_point() || std::popcount(mask) == 2) {
      for (std::size_t k = 0; k < 2 && meeting.points[k] != no_index; ++k)
        sheet.points.push_back(meeting.points[k]);
    } else {
      sheet.traces.push_back({meeting.points, line_of(meeting, e, elements_)});
    }
  }

  void tell_fitted(std::span<const OffendingPair> pairs) {
    result_.fitted.assign(complex_.facets.size(), 1);
    for (const OffendingPair& pair : pairs)
      for (const Index e : pair.elements)
        if (elements_.all[e].corners == 3) result_.fitted[elements_.all[e].id] = 0;
    for (const Flaw& flaw : elements_.flaws)
      if (flaw.corners == 3) result_.fitted[flaw.id] = 0;
  }

  /// For each element, whether it is a facet of some pair.
  [[nodiscard]] std::vector<std::uint8_t> facets_of(std::span<const OffendingPair> pairs) const {
    std::vector<std::uint8_t> is_facet(elements_.all.size(), 0);
    for (const OffendingPair& pair : pairs)
      for (const Index e : pair.elements)
        if (elements_.all[e].corners == 3) is_facet[e] = 1;
    return is_facet;
  }

  void cut_sheets(const FacetPlanes& planes) {
    Crossings crossings(planes);
    triangulate_sheets(crossings);
    number_points();
  }

  void triangulate_sheets(Crossings& crossings) {
    cut_.resize(sheets_.size());
    const std::thread::id caller = std::this_thread::get_id();
    std::size_t done = 0;
    // No crossing of a sheet is a point that was there before.
    const std::size_t most = options_.far_too_many() - std::min(options_.far_too_many(), pool_.added());
    parallel_ranges(options_.threads, sheets_.size(), [&](std::size_t first, std::size_t last) {
      const bool tells = std::this_thread::get_id() == caller;
      std::size_t polls = 0;
      const plane::Poll poll = [&](double) {
        if (!tells || (++polls & 63) != 0) return;
        step_(0.5 + 0.4 * static_cast<double>(done) / static_cast<double>(sheets_.size()));
      };
      for (std::size_t k = first; k < last; ++k) {
        const Gathered& sheet = sheets_[k];
        cut_[k] = triangulate({sheet.facets, sheet.points, sheet.traces, sheet.on_sides, most}, complex_,
                              elements_, pool_, crossings, poll);
        cut_[k].triangles.shrink_to_fit();
        cut_[k].parents.shrink_to_fit();
        cut_[k].first_parent.shrink_to_fit();
        if (tells) done = k;
      }
    });
  }

  /// Crossings of traces are numbered in the order of the sheets.
  void number_points() {
    const Index before = pool_.size();
    for (SheetTriangles& cut : cut_) {
      std::vector<Index> number;
      for (CrossingPoint* crossing : std::exchange(cut.points, {})) {
        if (crossing->number == no_index)
          crossing->number = pool_.add(std::move(crossing->point), crossing->nearest);
        number.push_back(crossing->number);
      }
      const auto renumber = [&](auto& lists) {
        for (auto& list : lists)
          for (Index& v : list)
            if (v >= before) v = number[v - before];
      };
      renumber(cut.triangles);
      renumber(cut.sides);
      step_(0.9);
      check_size();
    }
  }

  // --- Results

  void deliver_points() {
    result_.nearest = pool_.take_nearest();
    std::vector<exact::PackedPoint> points = pool_.take_exact();
    result_.distances.resize(points.size());
    parallel_ranges(options_.threads, points.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        result_.distances[k] = exact::distance_bound(points[k].point(), result_.nearest[k].data());
    });
    if (options_.keeps_points) result_.points = std::move(points);
  }

  /// {first parent, triangle} of a sheet, by the first parents, which are elements.
  [[nodiscard]] static std::vector<std::array<Index, 2>> by_first_parents(const SheetTriangles& cut) {
    std::vector<std::array<Index, 2>> all;
    all.reserve(cut.triangles.size());
    for (Index t = 0; t < cut.triangles.size(); ++t) all.push_back({cut.parents[cut.first_parent[t]], t});
    std::sort(all.begin(), all.end());
    return all;
  }

  void reserve_facets() {
    std::size_t facets = complex_.facets.size(), parents = facets;
    for (const SheetTriangles& cut : cut_) {
      facets += cut.triangles.size();
      parents += cut.parents.size();
    }
    result_.facets.reserve(facets);
    result_.facet_sheet.reserve(facets);
    result_.facet_parents.first.reserve(facets + 1);
    result_.facet_parents.all.reserve(parents);
  }

  /// A sheet ends as soon as its last triangle is delivered.
  void deliver_facets() {
    reserve_facets();
    std::vector<std::vector<std::array<Index, 2>>> of_sheet(sheets_.size());  // once it begins
    std::vector<std::size_t> next(sheets_.size(), 0);
    std::vector<Index> parents;
    for (Index i = 0; i < elements_.all.size() && elements_.all[i].corners == 3; ++i) {
      const Index s = sheet_of_[i];
      if (s == no_index) {
        deliver(elements_.all[i].vertex, std::array{elements_.all[i].id}, no_index);
        continue;
      }
      SheetTriangles& cut = cut_[s];
      if (next[s] == 0) of_sheet[s] = by_first_parents(cut);
      for (auto& k = next[s]; k < of_sheet[s].size() && of_sheet[s][k][0] == i; ++k) {
        const Index t = of_sheet[s][k][1];
        parents.clear();
        for (Index p = cut.first_parent[t]; p < cut.first_parent[t + 1]; ++p)
          parents.push_back(elements_.all[cut.parents[p]].id);
        deliver(cut.triangles[t], parents, cut.fits_rounded ? s : no_index);
      }
      if (next[s] < of_sheet[s].size()) continue;
      release(of_sheet[s]);
      cut = {};
    }
  }

  void deliver(const Triangle& corners, std::span<const Index> parents, Index sheet) {
    result_.facets.push_back(corners);
    result_.facet_sheet.push_back(sheet);
    result_.facet_parents.add(parents);
  }

  /// Segments by their ends, and the points on each segment.
  struct PointsOn {
    IndexTable<2> number;  // by the ends, ascending
    std::vector<std::vector<Index>> all;

    std::vector<Index>* find(const std::array<Index, 2>& ends) {
      const Index k = number.find(ascending(ends));
      return k == no_entity ? nullptr : &all[k];
    }
  };

  /// Cuts segments at the points that meetings leave on them, or on the sides with which they coincide.
  void deliver_segments(const Meetings& meetings) {
    if (complex_.segments.empty()) return;
    PointsOn points_on;
    const auto first = [&](Index v) { return elements_.places.first[v]; };
    std::vector<std::array<Index, 2>> ends(complex_.segments.size(), {no_index, no_index});
    for (std::size_t s = 0; s < ends.size(); ++s) {
      const auto [a, b] = complex_.segments[s];
      if (a >= complex_.vertices.size() || b >= complex_.vertices.size()) continue;
      if (!is_element_vertex(a) || !is_element_vertex(b) || first(a) == first(b)) continue;
      ends[s] = {first(a), first(b)};
      const auto fresh = static_cast<Index>(points_on.all.size());
      if (points_on.number.find_or_add(ascending(ends[s]), fresh) == fresh) points_on.all.emplace_back();
    }
    for (const Meeting& meeting : meetings.all)
      for (std::size_t e = 0; e < 2; ++e) note_points(meeting, e, points_on);
    note_sides_in_sheets(points_on);
    IndexTable<2> piece_of;
    std::vector<std::vector<Index>> parents;
    for (Index s = 0; s < ends.size(); ++s) {
      if (ends[s][0] == no_index) continue;
      const std::vector<Index> chain = chain_of(ends[s], *points_on.find(ends[s]));
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const std::array<Index, 2> piece{chain[k], chain[k + 1]};
        const auto fresh = static_cast<Index>(parents.size());
        const Index number = piece_of.find_or_add(ascending(piece), fresh);
        if (number == fresh) {
          result_.segments.push_back(piece);
          parents.emplace_back();
        }
        parents[number].push_back(s);
      }
    }
    for (const std::vector<Index>& p : parents) result_.segment_parents.add(p);
  }

  /// Records the points that a meeting leaves on a side of its element e.
  void note_points(const Meeting& meeting, std::size_t e, PointsOn& points_on) const {
    const Element& element = elements_.all[meeting.elements[e]];
    for (std::size_t k = 0; k < 2 && meeting.points[k] != no_index; ++k) {
      const unsigned mask = meeting.faces[k][e];
      if (std::popcount(mask) != 2) continue;
      std::array<Index, 2> side{};
      std::size_t count = 0;
      for (unsigned i = 0; i < element.corners; ++i)
        if ((mask >> i & 1u) != 0) side[count++] = element.vertex[i];
      if (std::vector<Index>* points = points_on.find(side)) points->push_back(meeting.points[k]);
    }
  }

  /// Sides of facets that share area with other facets cross the sides of these within the sheet, without a
  /// meeting.
  void note_sides_in_sheets(PointsOn& points_on) const {
    for (const SheetTriangles& cut : cut_)
      for (const std::vector<Index>& side : cut.sides)
        if (std::vector<Index>* points = points_on.find({side.front(), side.back()}))
          points->insert(points->end(), side.begin() + 1, side.end() - 1);
  }

  /// The points of a segment, in order from its first end to its second.
  [[nodiscard]] std::vector<Index> chain_of(const std::array<Index, 2>& ends,
                                            std::span<const Index> between) const {
    std::vector<Index> chain(between.begin(), between.end());
    chain.insert(chain.end(), ends.begin(), ends.end());
    if (chain.size() == 2) return {ends[0], ends[1]};
    const Point &a = pool_.nearest(ends[0]), &b = pool_.nearest(ends[1]);
    const int direction = pool_.compare(ends[0], ends[1]);
    std::sort(chain.begin(), chain.end(), [&](Index p, Index q) {
      if (p == q) return false;
      // Each coordinate is monotonic along the segment, and so is rounding to nearest.
      for (std::size_t k = 0; k < 3; ++k)
        if (const double x = pool_.nearest(p)[k], y = pool_.nearest(q)[k]; x != y)
          return (x < y) == (a[k] < b[k]);
      const int sign = pool_.compare(p, q);
      return sign != 0 ? sign == direction : p < q;
    });
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
    return chain;
  }

  [[nodiscard]] bool is_element_vertex(Index v) const {
    const Point& p = complex_.vertices[v];
    return elements_.places.first[v] != no_index && std::isfinite(p[0]) && std::isfinite(p[1]) &&
           std::isfinite(p[2]);
  }

  const Complex& complex_;
  const Elements& elements_;
  const Step& step_;
  const ArrangeOptions& options_;
  PointPool pool_;
  std::optional<DisjointSets> roots_;
  std::map<Index, Index> sheet_of_root_;
  std::vector<Gathered> sheets_;
  std::vector<Index> sheet_of_;  // by element
  std::vector<SheetTriangles> cut_;
  Arrangement result_;
};

}  // namespace

Arrangement arrange(const Complex& complex, const Elements& elements, const Step& step,
                    const ArrangeOptions& options) {
  std::vector<OffendingPair> pairs;
  SearchTuning tuning;
  tuning.threads = options.threads;
  const VisitPair visit = [&](Index i, Index j, const Contacts& contacts) {
    pairs.push_back({{i, j}, contacts.part});
    return pairs.size() <= options.most_pairs;
  };
  for_each_offending_pair(
      complex, elements, visit, [&](double fraction) { step(0.3 * fraction); }, tuning, options.known);
  if (pairs.size() > options.most_pairs) throw TooManyPoints(pairs.size());
  // An entity with a corner that is not finite is not an element; only the flaw of the corner reports it.
  const bool whole = std::all_of(elements.flaws.begin(), elements.flaws.end(), [](const Flaw& flaw) {
    return flaw.corners == 1 && flaw.kind != DefectKind::non_finite_coordinate;
  });
  if (pairs.empty() && whole && elements.places.merged == 0) {
    Arrangement same;
    same.is_same = true;
    return same;
  }
  return Arranging(complex, elements, step, options).run(std::move(pairs));
}

}  // namespace holdfast::arrange
