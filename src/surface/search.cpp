// Surface layer: the search for elements that do not fit together.
#include "surface/search.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>
#include <tuple>
#include <utility>

#include "exact/predicates.h"
#include "mesh/parallel.h"
#include "numbers/release.h"
#include "surface/aabb_tree.h"
#include "surface/complex.h"
#include "surface/hubs.h"
#include "surface/node_skip.h"
#include "surface/sheet_pairs.h"

namespace holdfast {
namespace {

constexpr std::size_t kWorthThreads = 5000;  // elements
// Parts of the tree: many, because some take much longer than others.
constexpr std::size_t kTopsAThread = 64;

Box box_of(const Complex& complex, const Element& element) {
  const Point& p = complex.vertices[element.vertex[0]];
  Box box{p, p};
  for (unsigned i = 1; i < element.corners; ++i) {
    const Point& q = complex.vertices[element.vertex[i]];
    box.extend({q, q});
  }
  return box;
}

std::vector<Box> boxes_of(const Complex& complex, const std::vector<Element>& elements) {
  std::vector<Box> boxes;
  boxes.reserve(elements.size());
  for (const Element& element : elements) boxes.push_back(box_of(complex, element));
  return boxes;
}

// The face of an element with the given mask of corners.
Corners face_of(const Element& element, unsigned mask) {
  Corners corners{no_index, no_index, no_index};
  unsigned count = 0;
  for (unsigned i = 0; i < element.corners; ++i) {
    if ((mask >> i & 1u) != 0) corners[count++] = element.vertex[i];
  }
  std::sort(corners.begin(), corners.end());  // no_index sorts last
  return corners;
}

unsigned whole(const Element& element) { return (1u << element.corners) - 1; }

// Gathers findings from pairs of elements.
class RootCauses {
 public:
  RootCauses(const Complex& complex, const Elements& elements) : complex_(complex), elements_(elements) {}

  void add(Index i, Index j, const Contacts& contacts) {
    const Element &a = elements_.all[i], &b = elements_.all[j];
    const bool whole_pair = add_whole(i, j, contacts);
    bool at_vertex = false;
    for_each_distinct(a, b, contacts, [&](const Corners& first, const Corners& second) {
      if (count_of(first) != 1) return;
      at_vertex = true;
      const bool in_segment = count_of(second) == 2;
      add_cause(in_segment ? DefectKind::vertex_in_segment : DefectKind::vertex_in_facet, first, second,
                {i, j});
    });
    if (whole_pair || at_vertex) return;
    // Overlapping sides share an end or one is inside the other, so the remaining pairs do not overlap.
    for_each_distinct(a, b, contacts, [&](const Corners& first, const Corners& second) {
      const bool cross = count_of(second) == 2;
      add_cause(cross ? DefectKind::segments_cross : DefectKind::segment_pierces_facet, first, second,
                {i, j});
    });
  }

  [[nodiscard]] std::size_t size() const { return pairs_.size() + causes_.size(); }

  [[nodiscard]] std::vector<Finding> sorted() const {
    std::vector<Finding> findings = pairs_;
    for (const auto& [key, pair] : causes_) {
      findings.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), pair, false});
    }
    std::sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
      return std::tie(a.pair, a.kind, a.first, a.second) < std::tie(b.pair, b.kind, b.first, b.second);
    });
    return findings;
  }

 private:
  using Key = std::tuple<DefectKind, Corners, Corners>;

  // Calls visit(first, second) for pairs of different faces that meet; the one with fewer corners first.
  template <class Visit>
  static void for_each_distinct(const Element& a, const Element& b, const Contacts& contacts, Visit&& visit) {
    for (unsigned mask_a = 1; mask_a <= whole(a); ++mask_a) {
      for (unsigned mask_b = 1; mask_b <= whole(b); ++mask_b) {
        if ((contacts.distinct & Contacts::bit(mask_a, mask_b)) == 0) continue;
        Corners first = face_of(a, mask_a), second = face_of(b, mask_b);
        if (std::pair(count_of(second), second) < std::pair(count_of(first), first)) std::swap(first, second);
        visit(first, second);
      }
    }
  }

  // Adds the pair itself if it is one facet twice or if the interiors meet; elements are not vertices.
  bool add_whole(Index i, Index j, const Contacts& contacts) {
    const Element &a = elements_.all[i], &b = elements_.all[j];
    const std::uint64_t bit = Contacts::bit(whole(a), whole(b));
    if (((contacts.common | contacts.distinct) & bit) == 0 || a.corners == 1 || b.corners == 1) return false;
    const Simplex p = Elements::simplex(a, complex_), q = Elements::simplex(b, complex_);
    DefectKind kind = DefectKind::segment_pierces_facet;
    if ((contacts.common & bit) != 0) {
      kind = DefectKind::repeated_facet;
    } else if (a.corners == 3 && b.corners == 3) {
      kind = facets_meet(p, q) == Meet::area ? DefectKind::facets_overlap : DefectKind::facets_cross;
    } else if (a.corners == 2 && b.corners == 2) {
      const Meet meet = segments_meet(p.point[0], p.point[1], q.point[0], q.point[1]);
      kind = meet == Meet::length ? DefectKind::segments_overlap : DefectKind::segments_cross;
    }
    Corners first = face_of(a, whole(a)), second = face_of(b, whole(b));
    if (b.corners < a.corners) std::swap(first, second);
    pairs_.push_back({kind, first, second, {i, j}, true});
    return true;
  }

  void add_cause(DefectKind kind, const Corners& first, const Corners& second, std::array<Index, 2> pair) {
    const auto [at, is_new] = causes_.try_emplace(Key{kind, first, second}, pair);
    if (!is_new) at->second = std::min(at->second, pair);
  }

  const Complex& complex_;
  const Elements& elements_;
  std::vector<Finding> pairs_;
  std::map<Key, std::array<Index, 2>> causes_;
};

// One search.
class PairSearch {
 public:
  PairSearch(const Complex& complex, const Elements& elements, Known known, const VisitPair& visit,
             const Step& step, const SearchTuning& tuning)
      : complex_(complex),
        elements_(elements),
        known_(known),
        visit_(visit),
        step_(step),
        patience_((known.sheet.empty() ? tuning.patience : tuning.sheet_patience) * elements.all.size()),
        threads_(tuning.threads),
        hubs_(complex, elements, tuning.hub_degree) {}

  void run() {
    if (elements_.all.empty()) return;
    if (!known_.sheet.empty()) {
      SheetPairs sheets(complex_, elements_, known_.sheet, known_.each);
      if (!sheets.are_too_many()) {
        if (!search_sheets(sheets)) return;
        done_ = known_.sheet;
        if (std::find(done_.begin(), done_.end(), no_index) == done_.end()) return;
      }
    }
    if (search_space()) {
      for (Index hub = 0; hub < hubs_.all().size(); ++hub) {
        if (!search_hub(hub)) return;
      }
    }
  }

 private:
  // Searches the pairs of facets of sheets. False: stopped.
  bool search_sheets(SheetPairs& sheets) {
    const std::size_t count = sheets.all().size();
    if (threads_.count() > 1 && elements_.all.size() >= kWorthThreads && all_sheets_fit(sheets)) return true;
    const SheetPairs::Visit visit = [&](Index i, Index j) { return test(i, j, visit_); };
    for (const SheetPairs::Batch& batch : sheets.batches()) {
      sheets.prepare(batch, threads_);
      for (std::size_t k = batch.first; k < batch.last; ++k) {
        if (k % 64 == 0) step_(static_cast<double>(k) / static_cast<double>(count));
        if (!sheets.for_each(sheets.all()[k], visit)) return false;
      }
    }
    return true;
  }

  // Whether no pair of facets of sheets is offending; works on all threads, like all_fit_in.
  [[nodiscard]] bool all_sheets_fit(SheetPairs& sheets) const {
    std::atomic<bool> stop = false;
    const std::thread::id calling_thread = std::this_thread::get_id();
    const VisitPair found = [&](Index, Index, const Contacts&) {
      stop = true;
      return false;
    };
    const SheetPairs::Visit visit = [&](Index i, Index j) { return !stop && test(i, j, found); };
    const std::size_t count = sheets.all().size();
    for (const SheetPairs::Batch& batch : sheets.batches()) {
      sheets.prepare(batch, threads_);
      parallel_ranges(threads_, batch.last - batch.first, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = batch.first + first; k < batch.first + last && !stop; ++k) {
          if (k % 64 == 0 && std::this_thread::get_id() == calling_thread)
            step_(static_cast<double>(k) / static_cast<double>(count));
          sheets.for_each(sheets.all()[k], visit);
        }
      });
      if (stop) break;
    }
    return !stop;
  }

  // Searches the pairs that share no hub. False: stopped.
  bool search_space() {
    std::vector<Box> boxes = boxes_of(complex_, elements_.all);
    const AabbTree tree(boxes, hubs_.fans(), threads_);
    Box all = boxes[0];
    for (const Box& box : boxes) all.extend(box);
    release(boxes);  // the tree has its own
    if (threads_.count() > 1 && elements_.all.size() >= kWorthThreads && all_fit_in(tree, all)) return true;
    NodeSkip skip(complex_, elements_, known_.each, done_, hubs_, tree, all, patience_);
    bool go_on = true;
    tree.for_each_overlap(
        {0, 0},
        [&](Index i, Index j) {
          skip.count_pair();
          return go_on = test_in_space(i, j, visit_);
        },
        skip, step_);
    return go_on;
  }

  // Whether no pair that shares no hub is offending. Which pair is found first depends on the threads; so if
  // there is one, the search starts again on one thread.
  [[nodiscard]] bool all_fit_in(const AabbTree& tree, const Box& all) const {
    const std::vector<AabbTree::NodePair> tops = tree.divided(kTopsAThread * threads_.count());
    const std::thread::id calling_thread = std::this_thread::get_id();
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stop = false;
    const auto step = [&](double) {
      if (std::this_thread::get_id() == calling_thread)
        step_(static_cast<double>(next) / static_cast<double>(tops.size() + threads_.count()));
    };
    const VisitPair visit = [&](Index, Index, const Contacts&) {
      stop = true;
      return false;
    };
    step(0);  // the other threads may leave nothing to do for this one
    parallel(threads_, threads_.count(), [&](std::size_t) {
      NodeSkip skip(complex_, elements_, known_.each, done_, hubs_, tree, all, patience_ / threads_.count());
      try {
        for (std::size_t k = next++; k < tops.size() && !stop; k = next++) {
          step(0);
          tree.for_each_overlap(
              tops[k],
              [&](Index i, Index j) {
                skip.count_pair();
                return !stop && test_in_space(i, j, visit);
              },
              skip, step);
        }
      } catch (...) {
        stop = true;
        throw;
      }
    });
    return !stop;
  }

  [[nodiscard]] bool test_in_space(Index i, Index j, const VisitPair& visit) const {
    return (!hubs_.all().empty() && hubs_.shared(i, j) != no_index) || are_done(i, j) || test(i, j, visit);
  }

  // Searches the pairs whose least common hub this is.
  bool search_hub(Index index) {
    const Hub& hub = hubs_.all()[index];
    const AabbTree tree(hubs_.directions(hub));
    bool go_on = true;
    tree.for_each_overlap(
        [&](Index i, Index j) {
          const Index a = hub.elements[i], b = hub.elements[j];
          return hubs_.shared(a, b) != index || are_done(a, b) || (go_on = test(a, b, visit_));
        },
        [](Index, Index) { return false; }, step_);
    return go_on;
  }

  // Whether i and j are facets of sheets whose pairs have been searched.
  [[nodiscard]] bool are_done(Index i, Index j) const {
    return !done_.empty() && done_[i] != no_index && done_[j] != no_index;
  }

  [[nodiscard]] bool test(Index i, Index j, const VisitPair& visit) const {
    if (!known_.each.empty() && known_.each[i] != 0 && known_.each[j] != 0) return true;
    if (!known_.found.empty() && known_.found[i] != 0 && known_.found[j] != 0) return true;
    if (!known_.sheet.empty() && fit_as_sheets(i, j)) return true;
    if (i > j) std::swap(i, j);
    const Element &a = elements_.all[i], &b = elements_.all[j];
    const Simplex p = Elements::simplex(a, complex_), q = Elements::simplex(b, complex_);
    if (surely_fit(p, q)) return true;
    const Contacts found = contacts(p, q);
    const bool repeated = a.corners == b.corners && (found.common & Contacts::bit(whole(a), whole(b))) != 0;
    return (found.distinct == 0 && !repeated) || visit(i, j, found);
  }

  // Facets of one sheet fit; a facet of one sheet is mostly on one side of a facet of another.
  [[nodiscard]] bool fit_as_sheets(Index i, Index j) const {
    if (known_.sheet[i] == no_index || known_.sheet[j] == no_index) return false;
    return known_.sheet[i] == known_.sheet[j] || is_on_one_side(i, j) || is_on_one_side(j, i);
  }

  // Whether all corners of j that are not corners of i are surely strictly on one side of i's plane.
  [[nodiscard]] bool is_on_one_side(Index i, Index j) const {
    const std::array<Index, 3>& t = elements_.all[i].vertex;
    const auto at = [&](Index v) { return complex_.vertices[v].data(); };
    const exact::OrientFilter side(at(t[0]), at(t[1]), at(t[2]));
    int sides = 0, count = 0;
    for (const Index v : elements_.all[j].vertex) {
      if (v == t[0] || v == t[1] || v == t[2]) continue;
      sides += side(at(v));
      ++count;
    }
    return count > 0 && (sides == count || sides == -count);
  }

  const Complex& complex_;
  const Elements& elements_;
  const Known known_;
  const VisitPair& visit_;
  const Step& step_;
  std::size_t patience_;
  Threads threads_;
  Hubs hubs_;
  std::span<const Index> done_;  // sheets, once their pairs are searched
};

// The unknown elements, and those whose boxes overlap the box of an unknown one.
struct NearUnknown {
  Elements elements;
  std::vector<std::uint8_t> known;
  std::vector<Index> sheet;   // if there are any
  std::vector<Index> number;  // of each element, among all elements

  NearUnknown(const Complex& complex, const Elements& all, const Known& of_all, const Threads& threads) {
    const std::span known_of_all = of_all.each;
    std::vector<Box> boxes;
    for (Index e = 0; e < all.all.size(); ++e)
      if (known_of_all[e] == 0) boxes.push_back(box_of(complex, all.all[e]));
    const AabbTree tree(boxes);
    std::vector<std::uint8_t> is_near(all.all.size());
    parallel_ranges(threads, all.all.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e)
        is_near[e] = known_of_all[e] == 0 || tree.overlaps_any(box_of(complex, all.all[e]));
    });
    for (Index e = 0; e < all.all.size(); ++e) {
      if (is_near[e] == 0) continue;
      elements.all.push_back(all.all[e]);
      known.push_back(known_of_all[e]);
      if (!of_all.sheet.empty()) sheet.push_back(of_all.sheet[e]);
      number.push_back(e);
    }
  }
};

}  // namespace

void for_each_offending_pair(const Complex& complex, const Elements& elements, const VisitPair& visit,
                             const Step& step, const SearchTuning& tuning, Known known) {
  constexpr std::size_t kFew = 4;  // a part of all
  const auto unknown =
      static_cast<std::size_t>(std::count(known.each.begin(), known.each.end(), std::uint8_t{0}));
  if (known.each.empty() || unknown >= elements.all.size() / kFew)
    return PairSearch(complex, elements, known, visit, step, tuning).run();
  const NearUnknown near(complex, elements, known, tuning.threads);
  std::vector<std::uint8_t> found(known.found.empty() ? 0 : near.number.size());
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = known.found[near.number[k]];
  const VisitPair visit_near = [&](Index i, Index j, const Contacts& contacts) {
    const bool go_on = visit(near.number[i], near.number[j], contacts);
    if (!found.empty())
      for (const Index k : {i, j}) found[k] = known.found[near.number[k]];
    return go_on;
  };
  PairSearch(complex, near.elements, {near.known, near.sheet, found}, visit_near, step, tuning).run();
}

bool all_fit(const Complex& complex, const Elements& elements, Known known, const Step& step,
             const Threads& threads) {
  bool fit = true;
  const auto visit = [&](Index, Index, const Contacts&) { return fit = false; };
  SearchTuning tuning;
  tuning.threads = threads;
  for_each_offending_pair(complex, elements, visit, step, tuning, known);
  return fit;
}

std::vector<Finding> find_root_causes(const Complex& complex, const Elements& elements, std::size_t most,
                                      const Step& step, const Threads& threads) {
  if (most == 0) return {};
  RootCauses causes(complex, elements);
  const auto visit = [&](Index i, Index j, const Contacts& contacts) {
    causes.add(i, j, contacts);
    return causes.size() < most;
  };
  SearchTuning tuning;
  tuning.threads = threads;
  for_each_offending_pair(complex, elements, visit, step, tuning);
  std::vector<Finding> findings = causes.sorted();
  if (findings.size() > most) findings.resize(most);
  return findings;
}

}  // namespace holdfast
