// Surface layer: sorting out the elements of a complex.
#include "surface/elements.h"

#include <algorithm>

#include "mesh/parallel.h"
#include "numbers/finite.h"

namespace holdfast {
namespace {

// A segment of the complex by the first vertices at the places of its ends, the lesser first.
struct Candidate {
  Segment ends;
  Index id;
  bool side = false;  // of some facet

  bool operator<(const Candidate& other) const {
    return std::pair(ends, id) < std::pair(other.ends, other.id);
  }
};

class Sorter {
 public:
  Sorter(const Complex& complex, const Threads& threads, SamePlace same_place)
      : complex_(complex), threads_(threads), same_place_(same_place) {}

  Elements run() {
    find_places();
    used_.assign(complex_.vertices.size(), 0);
    add_facets();
    add_segments();
    add_vertices();
    return std::move(result_);
  }

 private:
  void find_places() {
    const auto& points = complex_.vertices;
    Places& places = result_.places;
    if (same_place_ == SamePlace::one_vertex)
      places = places_of(complex_);
    else
      places.first = first_at_places(points);
    for (Index v = 0; v < points.size(); ++v) {
      const Index first = places.first[v];
      if (first == no_index) continue;
      if (!is_finite(points[v]))
        result_.flaws.push_back({DefectKind::non_finite_coordinate, 1, v});
      else if (first != v && same_place_ == SamePlace::defect)
        result_.flaws.push_back({DefectKind::repeated_vertex, 1, v, first});
    }
  }

  // Replaces the corners by the first vertices at their places; false, with or without a flaw, if the element
  // is invalid.
  template <std::size_t N>
  bool resolve(std::array<Index, N>& corners, Index id, std::vector<Flaw>& flaws) const {
    for (const Index v : corners) {
      if (v >= complex_.vertices.size()) {
        flaws.push_back({DefectKind::index_out_of_range, N, id});
        return false;
      }
    }
    bool good = true;
    for (Index& v : corners) {
      good = good && is_finite(complex_.vertices[v]);
      v = result_.places.first[v];
    }
    return good;
  }

  // In blocks, so that a thread that has finished other work can join.
  void add_facets() {
    constexpr std::size_t kBlock = 16384;
    const std::size_t count = complex_.facets.size();
    result_.all.reserve(count + complex_.segments.size());
    result_.all.resize(count);
    std::vector<std::vector<Flaw>> flaws(1 + count / kBlock);
    parallel(threads_, flaws.size(), [&](std::size_t block) {
      for (std::size_t f = block * kBlock; f < std::min(count, (block + 1) * kBlock); ++f)
        result_.all[f] = facet_element(static_cast<Index>(f), flaws[block]);
    });
    std::erase_if(result_.all, [](const Element& element) { return element.corners == 0; });
    for (const Element& element : result_.all)
      for (const Index v : element.vertex) used_[v] = 1;
    for (const auto& own : flaws) result_.flaws.insert(result_.flaws.end(), own.begin(), own.end());
  }

  // Without corners if the facet is invalid.
  Element facet_element(Index f, std::vector<Flaw>& flaws) const {
    Triangle corners = complex_.facets[f];
    if (!resolve(corners, f, flaws)) return {};
    Element element{corners, f, 3};
    Simplex simplex = Elements::simplex(element, complex_);
    const bool repeats = corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    if (repeats || !set_projection(simplex)) {
      flaws.push_back({DefectKind::degenerate_facet, 3, f});
      return {};
    }
    element.axis = static_cast<std::uint8_t>(simplex.axis);
    element.turn = static_cast<std::int16_t>(simplex.turn);
    return element;
  }

  void add_segments() {
    std::vector<Candidate> candidates;
    for (Index s = 0; s < complex_.segments.size(); ++s) {
      Segment ends = complex_.segments[s];
      if (!resolve(ends, s, result_.flaws)) continue;
      if (ends[0] == ends[1]) {
        result_.flaws.push_back({DefectKind::degenerate_segment, 2, s});
      } else {
        candidates.push_back({{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])}, s});
      }
    }
    std::sort(candidates.begin(), candidates.end());
    const auto repeats = [](const Candidate& a, const Candidate& b) { return a.ends == b.ends; };
    candidates.erase(std::unique(candidates.begin(), candidates.end(), repeats), candidates.end());
    mark_sides(candidates);
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    for (const Candidate& c : candidates) {
      if (!c.side) add({{c.ends[0], c.ends[1], 0}, c.id, 2});
    }
  }

  // Marks the candidates that are a facet's side; so far `all` holds only facets.
  void mark_sides(std::vector<Candidate>& candidates) const {
    if (candidates.empty()) return;
    std::vector<char> is_end(complex_.vertices.size(), 0);
    for (const Candidate& c : candidates) is_end[c.ends[0]] = is_end[c.ends[1]] = 1;
    for (const Element& facet : result_.all) {
      for (unsigned i = 0; i < 3; ++i) {
        const Index a = facet.vertex[i], b = facet.vertex[(i + 1) % 3];
        if (!is_end[a] || !is_end[b]) continue;
        const Candidate side{{std::min(a, b), std::max(a, b)}, 0};
        const auto at = std::lower_bound(candidates.begin(), candidates.end(), side);
        if (at != candidates.end() && at->ends == side.ends) at->side = true;
      }
    }
  }

  void add_vertices() {
    for (Index v = 0; v < complex_.vertices.size(); ++v) {
      if (!used_[v] && result_.places.first[v] == v && is_finite(complex_.vertices[v]))
        add({{v, 0, 0}, v, 1});
    }
  }

  void add(const Element& element) {
    result_.all.push_back(element);
    for (unsigned i = 0; i < element.corners; ++i) used_[element.vertex[i]] = 1;
  }

  const Complex& complex_;
  const Threads threads_;
  const SamePlace same_place_;
  Elements result_;
  std::vector<char> used_;  // by some element
};

}  // namespace

Simplex Elements::simplex(const Element& element, const Complex& complex) {
  Simplex simplex;
  simplex.corners = element.corners;
  simplex.vertex = element.vertex;
  for (unsigned i = 0; i < element.corners; ++i)
    simplex.point[i] = complex.vertices[element.vertex[i]].data();
  simplex.axis = element.axis;
  simplex.turn = element.turn;
  return simplex;
}

Elements elements_of(const Complex& complex, const Threads& threads, SamePlace same_place) {
  return Sorter(complex, threads, same_place).run();
}

}  // namespace holdfast
