#include "untangle/cavity_complex.h"

#include <algorithm>

#include "numbers/sorted.h"

namespace holdfast {

CavityComplex::CavityComplex(const Tangle& tangle, std::vector<Tet> tets)
    : tangle_(tangle), tets_(std::move(tets)) {
  std::sort(tets_.begin(), tets_.end());
  find_parts();
  take_facets();
  take_segments();
  take_points();
}

Index CavityComplex::local(Vertex v) {
  const auto [at, fresh] = number_.try_emplace(v, static_cast<Index>(vertex_.size()));
  if (fresh) {
    vertex_.push_back(v);
    surface_.vertices.push_back(tangle_.position(v));
  }
  return at->second;
}

// Finds the tetrahedra connected by faces that are not constraints.
void CavityComplex::find_parts() {
  constexpr Index kPending = kOutside - 1;
  for (const Tet t : tets_) part_[t] = kPending;
  std::vector<Tet> queue;
  for (const Tet seed : tets_) {
    if (part_[seed] != kPending) continue;
    const auto id = static_cast<Index>(region_.size());
    region_.push_back(tangle_.region(seed));
    part_[seed] = id;
    queue.assign(1, seed);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        if (tangle_.is_constraint(tangle_.face(queue[k], i))) continue;
        const Tet s = tangle_.across(queue[k], i);
        if (s == kNone || part_of(s) != kPending) continue;
        part_[s] = id;
        queue.push_back(s);
      }
  }
}

void CavityComplex::take_facets() {
  for (const Tet t : tets_)
    for (int i = 0; i < 4; ++i) {
      const auto f = tangle_.face(t, i);
      const Tet s = tangle_.across(t, i);
      const Index other = s == kNone ? kOutside : part_of(s);
      if (other != kOutside && (s < t || !tangle_.is_constraint(f))) continue;
      if (s != kNone && other == kOutside) is_whole_ = false;
      const Triangle facet{local(f[0]), local(f[1]), local(f[2])};
      surface_.facets.push_back(facet);
      sides_.push_back({part_of(t), other});
    }
}

void CavityComplex::take_segments() {
  if (tangle_.constraints().segments.empty()) return;
  for (const Tet t : tets_)
    for (int edge = 0; edge < 6; ++edge) {
      const auto [a, b] = ends_of_edge(tangle_.corners(t), edge);
      if (tangle_.is_segment(a, b)) surface_.segments.push_back(ascending(Segment{local(a), local(b)}));
    }
  sort_unique(surface_.segments);
}

// Takes the points that must stay, then the free ones that are well placed according to the signs.
void CavityComplex::take_points() {
  const auto well_placed = [this](Vertex v) {
    const auto star = tangle_.star(v);
    return std::all_of(star.begin(), star.end(), [this](Tet t) { return tangle_.sign(t) > 0; });
  };
  for (const bool fixed : {true, false}) {
    if (!fixed) first_point_ = vertex_.size();
    for (const Tet t : tets_)
      for (const Vertex v : tangle_.corners(t))
        if (tangle_.is_fixed(v) == fixed && (fixed || well_placed(v))) local(v);
  }
}

// Drops points that do not fit the boundary or each other; if these are not known, drops all.
bool CavityComplex::drop_points(const Filled& filled) {
  if (first_point_ == vertex_.size()) return false;
  std::vector<bool> drop(vertex_.size(), filled.outcome != Filled::Outcome::invalid);
  bool named = false;
  for (const Index v : filled.faulty)
    if (v >= first_point_) named = drop[v] = true;
  if (!named) std::fill(drop.begin(), drop.end(), true);
  std::size_t kept = first_point_;
  for (std::size_t v = first_point_; v < vertex_.size(); ++v) {
    if (drop[v]) continue;
    vertex_[kept] = vertex_[v];
    surface_.vertices[kept++] = surface_.vertices[v];
  }
  vertex_.resize(kept);
  surface_.vertices.resize(kept);
  return true;
}

}  // namespace holdfast
