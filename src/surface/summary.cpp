// Surface layer: defects grouped by their probable cause.
#include "holdfast/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "numbers/elementary.h"
#include "surface/complex.h"
#include "surface/describe.h"
#include "surface/gaps.h"
#include "surface/places.h"
#include "surface/separation.h"
#include "text/decimal.h"

namespace holdfast {
namespace {

constexpr int kDigits = 3;  // of distances

/// The complex with all vertices at one place as one, without elements that name a missing vertex or one
/// twice.
struct Identified {
  std::vector<Index> first;  ///< for each vertex the first at its place
  std::vector<Triangle> facets;
  std::vector<Segment> segments;
  Complex view;

  explicit Identified(const Complex& complex) : first(first_at_places(complex.vertices)) {
    const auto in_range = [&](Index v) { return v < first.size(); };
    for (const Triangle& f : complex.facets) {
      if (!std::all_of(f.begin(), f.end(), in_range)) continue;
      const Triangle t{first[f[0]], first[f[1]], first[f[2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) facets.push_back(t);
    }
    for (const Segment& s : complex.segments)
      if (std::all_of(s.begin(), s.end(), in_range) && first[s[0]] != first[s[1]])
        segments.push_back({first[s[0]], first[s[1]]});
    view = {complex.vertices, facets, segments, {}, {}};
  }
  Identified(const Identified&) = delete;
  Identified& operator=(const Identified&) = delete;
};

/// Parts of the surface, connected by sides and segments.
class Parts {
 public:
  Parts(const Identified& identified, const SegmentTable& table) : parent_(identified.first.size()) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    for (const auto& [a, b] : table.segments) parent_[of(a)] = of(b);
    std::set<Index> roots;
    for (const Triangle& f : identified.facets) roots.insert(of(f[0]));
    count_ = roots.size();
  }
  Index of(Index v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::vector<Index> parent_;
  std::size_t count_ = 0;
};

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// How a group is described: what it is, singular and plural, and what to do.
struct Words {
  const char *one, *many, *cure;
};

Words words_of(Cause cause) {
  switch (cause) {
    case Cause::not_finite:
      return {"coordinate that is not finite", "vertices with coordinates that are not finite",
              "correct them, or remove these vertices"};
    case Cause::bad_index:
      return {"element that names a vertex which does not exist",
              "elements that name vertices which do not exist", "correct the indices"};
    case Cause::repeated_vertex:
      return {"vertex at the place of another", "vertices at the places of others", "merge them"};
    case Cause::no_extent:
      return {"triangle without area, or segment without length",
              "triangles without area, or segments without length",
              "remove them, and split the sides that they leave behind at the vertex in the middle"};
    case Cause::repeated_facet:
      return {"repeated triangle", "repeated triangles", "keep one of each"};
    case Cause::unwelded:
      return {"misfit at vertices that are almost one", "misfits at vertices that are almost one",
              "where they are meant to be one, merge them, as the 'merge by distance' of modelling programs "
              "does"};
    case Cause::t_junction:
      return {"T-junction (a vertex inside a side)", "T-junctions (a vertex inside a side)",
              "split the sides at these vertices"};
    case Cause::vertex_in_facet:
      return {"vertex inside a triangle", "vertices inside triangles",
              "split the triangles at these vertices, or move them apart"};
    case Cause::overlap:
      return {"overlap of triangles in one plane or sides in one line",
              "overlaps of triangles in one plane or sides in one line",
              "if a wall is doubled, remove one copy; else split both along each other's sides"};
    case Cause::parts_cross:
      return {"crossing of separate parts", "crossings of separate parts",
              "unite the parts (boolean union), leave out what is hidden inside, or move them apart"};
    case Cause::self_crossing:
      return {"place where a part passes through itself", "places where a part passes through itself",
              "move vertices there, or split the triangles along the lines where they cross"};
    case Cause::encloses_nothing:
      return {"surface that encloses nothing", "surfaces that enclose nothing", "close it"};
    case Cause::outside:
      return {"piece of the surface that borders on no kept region",
              "pieces of the surface that border on no kept region",
              "remove them, drop them, or keep more regions"};
    case Cause::orientation:
      return {"triangle turned against the others", "triangles turned against the others",
              "turn the triangles of every shell the same way"};
    case Cause::crack:
      return {"vertex of an open border that lies almost on another border",
              "vertices of open borders that lie almost on another border",
              "merge such vertices, as the 'merge by distance' of modelling programs does, and split sides "
              "at vertices "
              "that lie on them"};
    case Cause::open_border:
      return {"side of one triangle alone", "sides of one triangle alone",
              "fill the holes, unless the surface is meant to be open"};
  }
  return {"defect", "defects", "see each"};
}

/// "triangles 4 and 7", "vertex 3": the entities by which a defect is found again.
std::string entities(const Defect& defect) {
  const auto list = [](const char* one, const char* many, const std::vector<Index>& ids) {
    constexpr std::size_t kShown = 2;
    std::string text = ids.size() == 1 ? one : many;
    for (std::size_t i = 0; i < std::min(ids.size(), kShown); ++i)
      text += (i == 0 ? " " : ids.size() == 2 ? " and " : ", ") + std::to_string(ids[i]);
    return ids.size() > kShown ? text + ", ..." : text;
  };
  if (defect.kind == DefectKind::vertex_in_segment || defect.kind == DefectKind::vertex_in_facet ||
      defect.facets.empty()) {
    if (!defect.vertices.empty()) return list("vertex", "vertices", {defect.vertices[0]});
    return defect.segments.empty() ? "" : list("segment", "segments", defect.segments);
  }
  return list("triangle", "triangles", defect.facets);
}

std::string place_of(const std::vector<Point>& where) {
  if (where.empty()) return "";
  return where.size() == 2 ? " along " + place(where[0]) + " - " + place(where[1]) : " at " + place(where[0]);
}

double extent(const Defect& defect) {
  if (defect.where.size() != 2) return 0;
  const auto &a = defect.where[0], &b = defect.where[1];
  const double length = numbers::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return std::isfinite(length) ? length : 0;
}

class Summariser {
 public:
  Summariser(const Complex& complex, std::span<const Defect> defects)
      : complex_(complex),
        defects_(defects),
        identified_(complex),
        table_(segment_table(identified_.view)),
        parts_(identified_, table_),
        finder_(identified_.view, table_) {}

  DefectSummary run() {
    summary_.parts = parts_.count();
    for (std::size_t i = 0; i < defects_.size(); ++i) group(cause_of(defects_[i])).defects.push_back(i);
    for (Index s = 0; s < table_.segments.size(); ++s)
      if (table_.facets_of(s).size() == 1) summary_.border.push_back(table_.segments[s]);
    for (const Nearness& gap : finder_.between_borders()) add(gap, true);
    if (std::all_of(defects_.begin(), defects_.end(),
                    [](const Defect& d) { return d.kind >= DefectKind::encloses_nothing; }))
      summary_.enclosed = Separation(table_).enclosed();
    tell();
    return std::move(summary_);
  }

 private:
  DefectGroup& group(Cause cause) {
    DefectGroup& found = groups_[cause];
    found.cause = cause;
    return found;
  }

  Cause cause_of(const Defect& defect) {
    switch (defect.kind) {
      case DefectKind::non_finite_coordinate:
        return Cause::not_finite;
      case DefectKind::index_out_of_range:
        return Cause::bad_index;
      case DefectKind::repeated_vertex:
        return Cause::repeated_vertex;
      case DefectKind::degenerate_facet:
      case DefectKind::degenerate_segment:
        return Cause::no_extent;
      case DefectKind::repeated_facet:
        return Cause::repeated_facet;
      case DefectKind::encloses_nothing:
        return Cause::encloses_nothing;
      case DefectKind::outside_region:
        return Cause::outside;
      case DefectKind::inconsistent_orientation:
        return Cause::orientation;
      default:
        return cause_of_misfit(defect);
    }
  }

  Cause cause_of_misfit(const Defect& defect) {
    const std::vector<Index> vertices = vertices_of(defect);
    if (const std::optional<Nearness> gap = finder_.among(vertices)) {
      add(*gap, false);
      return Cause::unwelded;
    }
    switch (defect.kind) {
      case DefectKind::vertex_in_segment:
        return Cause::t_junction;
      case DefectKind::vertex_in_facet:
        return Cause::vertex_in_facet;
      case DefectKind::facets_overlap:
      case DefectKind::segments_overlap:
        return Cause::overlap;
      default:
        break;
    }
    const auto other = [&](Index v) { return parts_.of(v) != parts_.of(vertices[0]); };
    return std::any_of(vertices.begin(), vertices.end(), other) ? Cause::parts_cross : Cause::self_crossing;
  }

  /// Vertices of everything that the defect names; of stars as large as those of hubs, the first ones.
  [[nodiscard]] std::vector<Index> vertices_of(const Defect& defect) const {
    constexpr std::size_t kMost = 32;
    std::vector<Index> all;
    const auto add_vertex = [&](Index v) {
      if (v >= identified_.first.size()) return;
      const Index first = identified_.first[v];
      if (all.size() < kMost && std::find(all.begin(), all.end(), first) == all.end()) all.push_back(first);
    };
    for (const Index v : defect.vertices) add_vertex(v);
    // From both ends: the elements of the first simplex precede those of the second.
    for (std::size_t i = 0; i < defect.facets.size(); ++i) {
      const std::size_t k = i % 2 == 0 ? i / 2 : defect.facets.size() - 1 - i / 2;
      for (const Index v : complex_.facets[defect.facets[k]]) add_vertex(v);
    }
    for (const Index s : defect.segments)
      for (const Index v : complex_.segments[s]) add_vertex(v);
    return all;
  }

  void add(const Nearness& near, bool open) {
    const bool is_vertex = near.other[0] == near.other[1];
    if (!told_.insert({near.vertex, near.other}).second) return;
    Gap gap{near.vertex, near.other, near.distance, open, {}};
    gap.message =
        "vertex " + std::to_string(gap.vertex) + " " + place(complex_.vertices[gap.vertex]) + " lies " +
        decimal(gap.distance, kDigits) + " from " +
        (is_vertex ? "vertex " + std::to_string(gap.other[0]) + ": merge the two, if they are meant to be one"
                   : "the side " + std::to_string(gap.other[0]) + "-" + std::to_string(gap.other[1]) +
                         ": split it at this vertex, if that is meant to lie on it");
    if (open) {
      ++group(Cause::crack).count;
    } else {
      ++pairs_;
    }
    summary_.gaps.push_back(std::move(gap));
  }

  void tell() {
    std::stable_sort(summary_.gaps.begin(), summary_.gaps.end(),
                     [](const Gap& a, const Gap& b) { return a.distance > b.distance; });
    if (!summary_.border.empty()) {
      DefectGroup& border = group(Cause::open_border);
      border.count = summary_.border.size();
      const auto longest =
          std::max_element(summary_.border.begin(), summary_.border.end(),
                           [&](const Segment& a, const Segment& b) { return length(a) < length(b); });
      border.worst = {complex_.vertices[(*longest)[0]], complex_.vertices[(*longest)[1]]};
    }
    for (auto& [cause, group] : groups_) {
      if (group.count == 0) group.count = group.defects.size();
      const Words words = words_of(cause);
      group.message = counted(group.count, words.one, words.many) + worst_of(group) + ": " + words.cure;
      summary_.groups.push_back(std::move(group));
    }
  }

  [[nodiscard]] double length(const Segment& s) const {
    const Point &a = complex_.vertices[s[0]], &b = complex_.vertices[s[1]];
    return numbers::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }

  /// Finds the worst defect of a group and tells where it is.
  [[nodiscard]] std::string worst_of(DefectGroup& group) const {
    if (group.cause == Cause::open_border)
      return group.count == 1 ? place_of(group.worst) : ", the longest" + place_of(group.worst);
    if (group.cause == Cause::crack || group.cause == Cause::unwelded) {
      const bool open = group.cause == Cause::crack;
      const auto widest = std::find_if(summary_.gaps.begin(), summary_.gaps.end(),
                                       [&](const Gap& gap) { return gap.open == open; });
      if (widest == summary_.gaps.end()) return "";
      group.worst = {complex_.vertices[widest->vertex]};
      const bool is_vertex = widest->other[0] == widest->other[1];
      const std::string which = "vertex " + std::to_string(widest->vertex) + " from " +
                                (is_vertex ? "vertex " + std::to_string(widest->other[0])
                                           : "the side " + std::to_string(widest->other[0]) + "-" +
                                                 std::to_string(widest->other[1])) +
                                " at " + place(group.worst[0]);
      const std::string count = open ? "" : " (" + counted(pairs_, "pair", "pairs") + " of these)";
      return count + ", at most " + decimal(widest->distance, kDigits) + " apart (" + which + ")";
    }
    const auto& ids = group.defects;
    const auto worst = std::max_element(ids.begin(), ids.end(), [&](std::size_t a, std::size_t b) {
      return extent(defects_[a]) < extent(defects_[b]);
    });
    const Defect& defect = defects_[*worst];
    group.worst.assign(
        defect.where.begin(),
        defect.where.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, defect.where.size())));
    const std::string which = entities(defect);
    if (group.count == 1) return (which.empty() ? "" : ", " + which) + place_of(group.worst);
    return std::string(extent(defect) > 0 ? ", the longest: " : ", the first: ") + which +
           place_of(group.worst);
  }

  const Complex& complex_;
  const std::span<const Defect> defects_;
  const Identified identified_;
  const SegmentTable table_;
  Parts parts_;
  const GapFinder finder_;
  std::map<Cause, DefectGroup> groups_;
  std::set<std::pair<Index, Segment>> told_;
  std::size_t pairs_ = 0;
  DefectSummary summary_;
};

}  // namespace

DefectSummary summarise(const Complex& complex, std::span<const Defect> defects) {
  return Summariser(complex, defects).run();
}

}  // namespace holdfast
