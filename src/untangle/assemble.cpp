#include "untangle/assemble.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace holdfast {
namespace {

class Assembly {
 public:
  Assembly(const Volume& before, Tangle& tangle) : before_(before), tangle_(tangle) {}

  Assembled run() {
    find_gaps();
    fill_gaps();
    out_.volume = before_;
    write_vertices();
    write_tetrahedra();
    return std::move(out_);
  }

 private:
  using Entry = std::pair<double, Tet>;

  void find_gaps() {
    std::vector<bool> was_used(before_.vertices.size(), false);
    for (const Tetrahedron& t : before_.tetrahedra)
      for (const Index v : t) was_used[v] = true;
    for (Vertex v = 0; v < before_.vertices.size(); ++v)
      if (was_used[v] && tangle_.star(v).empty()) gaps_.push_back(v);
    for (auto v = static_cast<Vertex>(before_.vertices.size()); v < tangle_.vertex_count(); ++v)
      if (!tangle_.star(v).empty()) added_.push_back(v);
    out_.removed = gaps_.size();
  }

  // Gaps at the very end need no filling.
  void fill_gaps() {
    std::size_t needed = gaps_.size();
    for (auto end = static_cast<Vertex>(before_.vertices.size()); needed > 0 && gaps_[needed - 1] == end - 1;
         --end)
      --needed;
    if (needed > added_.size()) split_largest(needed - added_.size());
    out_.added = added_.size();
  }

  void split_largest(std::size_t count) {
    std::priority_queue<Entry> largest;
    for (Tet t = 0; t < tangle_.slot_count(); ++t)
      if (tangle_.alive(t)) largest.push({tangle_.determinant(tangle_.corners(t)).value, t});
    while (count > 0 && !largest.empty()) {
      const Tet t = largest.top().second;
      largest.pop();
      if (!split(t)) continue;
      --count;
      for (const Tet s : tangle_.star(added_.back()))
        largest.push({tangle_.determinant(tangle_.corners(s)).value, s});
    }
  }

  // Splits a tetrahedron into four round its centroid, unless the centroid is not strictly inside in doubles.
  bool split(Tet t) {
    const Tangle::Corners c = tangle_.corners(t);
    Point centre{};
    for (const Vertex v : c)
      for (std::size_t k = 0; k < 3; ++k) centre[k] += tangle_.position(v)[k] / 4;
    if (!std::isfinite(centre[0] + centre[1] + centre[2])) return false;
    centre = tangle_.points().on_grid(centre);
    const exact::PointRef p{centre.data(), nullptr};
    for (int i = 0; i < 4; ++i) {
      const auto f = tangle_.face(t, i);
      if (tangle_.points().orient(f[0], f[1], f[2], p) <= 0) return false;
    }
    const Vertex v = tangle_.add_vertex(centre);
    std::vector<Tangle::Corners> tets;
    for (int i = 0; i < 4; ++i) {
      const auto f = tangle_.face(t, i);
      tets.push_back({f[0], f[1], f[2], v});
    }
    const Tet old[] = {t};
    tangle_.exchange(old, tets);
    added_.push_back(v);
    return true;
  }

  void write_vertices() {
    std::vector<Point>& points = out_.volume.vertices;
    index_.resize(tangle_.vertex_count());
    for (Vertex v = 0; v < before_.vertices.size(); ++v) {
      index_[v] = v;
      if (tangle_.star(v).empty() || tangle_.is_fixed(v)) continue;
      if (points[v] != tangle_.position(v)) ++out_.moved;
      points[v] = tangle_.position(v);
    }
    std::size_t k = 0;
    for (const Vertex v : added_) {
      index_[v] = k < gaps_.size() ? gaps_[k++] : static_cast<Vertex>(points.size());
      if (index_[v] == points.size()) points.emplace_back();
      points[index_[v]] = tangle_.position(v);
    }
    while (k < gaps_.size() && gaps_.back() + std::size_t{1} == points.size()) {
      gaps_.pop_back();
      points.pop_back();
    }
    write_vertex_markers();
  }

  void write_vertex_markers() {
    std::vector<int>& markers = out_.volume.vertex_markers;
    if (markers.empty()) return;
    markers.resize(out_.volume.vertices.size(), 0);
    for (const Vertex v : added_) markers[index_[v]] = 0;
  }

  void write_tetrahedra() {
    Volume& volume = out_.volume;
    volume.tetrahedra.clear();
    volume.regions.clear();
    for (Tet t = 0; t < tangle_.slot_count(); ++t) {
      if (!tangle_.alive(t)) continue;
      Tetrahedron corners{};
      for (std::size_t i = 0; i < 4; ++i) corners[i] = index_[tangle_.corners(t)[i]];
      volume.tetrahedra.push_back(corners);
      volume.regions.push_back(tangle_.region(t));
    }
  }

  const Volume& before_;
  Tangle& tangle_;
  std::vector<Vertex> gaps_;   // numbers of removed vertices, ascending
  std::vector<Vertex> added_;  // vertices of the tangle, ascending
  std::vector<Index> index_;   // by vertex of the tangle
  Assembled out_;
};

}  // namespace

Assembled assemble(const Volume& before, Tangle& tangle) { return Assembly(before, tangle).run(); }

}  // namespace holdfast
