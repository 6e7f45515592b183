#include "untangle/connectivity.h"

#include <algorithm>
#include <cmath>

#include "exact/volume.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

using Key = std::array<Vertex, 3>;

struct HalfFace {
  Key key;
  Face code;
  bool odd;  // the listed tetrahedron sees the corners, in ascending order, from behind
};

std::string text(std::span<const Vertex> corners) {
  std::string words;
  for (const Vertex v : corners) words += (words.empty() ? "(" : ", ") + std::to_string(v);
  return words + ")";
}

bool odd_permutation(const std::array<Vertex, 3>& f) {
  return ((f[0] > f[1]) != (f[1] > f[2])) != (f[0] > f[2]);
}

class Reader {
 public:
  Reader(const Volume& volume, std::span<const Index> fixed) : volume_(volume), fixed_(fixed) {}

  Connectivity read() {
    if (indices_fit() && list_faces() && pair_faces() && take_facets() && take_segments()) {
      mark_fixed();
      turn_alike();
    }
    return std::move(out_);
  }

 private:
  bool fail(std::string why) {
    out_.fault = std::move(why);
    return false;
  }

  template <std::size_t N>
  bool fits(const char* noun, std::size_t i, const std::array<Vertex, N>& corners) {
    const auto sorted = ascending(corners);
    if (sorted.back() >= volume_.vertices.size())
      return fail(std::string(noun) + " " + std::to_string(i) + " names vertex " +
                  std::to_string(sorted.back()) + ", which does not exist");
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return fail(std::string(noun) + " " + std::to_string(i) + " " + text(corners) +
                  " names a vertex twice");
    return true;
  }

  bool indices_fit() {
    if (volume_.tetrahedra.empty()) return fail("there are no tetrahedra");
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
      if (!fits("tetrahedron", i, volume_.tetrahedra[i])) return false;
    for (std::size_t i = 0; i < volume_.facets.size(); ++i)
      if (!fits("triangle", i, volume_.facets[i])) return false;
    for (std::size_t i = 0; i < volume_.segments.size(); ++i)
      if (!fits("segment", i, volume_.segments[i])) return false;
    out_.tets = volume_.tetrahedra;
    out_.regions = volume_.regions;
    out_.regions.resize(out_.tets.size(), 0);
    return true;
  }

  bool list_faces() {
    halves_.reserve(4 * out_.tets.size());
    for (Tet t = 0; t < out_.tets.size(); ++t)
      for (int i = 0; i < 4; ++i) {
        const Key f = corners_of_face(out_.tets[t], i);
        halves_.push_back({ascending(f), face_code(t, i), odd_permutation(f)});
      }
    std::sort(halves_.begin(), halves_.end(), [](const HalfFace& a, const HalfFace& b) {
      return a.key != b.key ? a.key < b.key : a.code < b.code;
    });
    return true;
  }

  [[nodiscard]] Vertex apex(const HalfFace& half) const {
    return out_.tets[tet_of(half.code)][static_cast<std::size_t>(side_of(half.code))];
  }

  // Finds partners, and the faces that must stay.
  bool pair_faces() {
    partner_.assign(4 * out_.tets.size(), {kNone, false});
    for (std::size_t i = 0, end = 0; i < halves_.size(); i = end) {
      end = i + 1;
      while (end < halves_.size() && halves_[end].key == halves_[i].key) ++end;
      if (end - i > 2)
        return fail("face " + text(halves_[i].key) + " belongs to " + std::to_string(end - i) +
                    " tetrahedra, and two are the most");
      if (end - i == 1) {
        out_.constraints.faces.push_back(halves_[i].key);
        continue;
      }
      const HalfFace &a = halves_[i], &b = halves_[i + 1];
      if (apex(a) == apex(b))
        return fail("tetrahedra " + std::to_string(tet_of(a.code)) + " and " +
                    std::to_string(tet_of(b.code)) + " have the same vertices");
      partner_[a.code] = {b.code, a.odd == b.odd};
      partner_[b.code] = {a.code, a.odd == b.odd};
      if (out_.regions[tet_of(a.code)] != out_.regions[tet_of(b.code)])
        out_.constraints.faces.push_back(a.key);
    }
    return true;
  }

  bool take_facets() {
    std::vector<Key> facets;
    for (std::size_t i = 0; i < volume_.facets.size(); ++i) {
      const Key key = ascending(volume_.facets[i]);
      const auto at = std::lower_bound(halves_.begin(), halves_.end(), key,
                                       [](const HalfFace& half, const Key& k) { return half.key < k; });
      if (at == halves_.end() || at->key != key)
        return fail("triangle " + std::to_string(i) + " " + text(volume_.facets[i]) +
                    " is not a face of any tetrahedron");
      facets.push_back(key);
    }
    std::sort(facets.begin(), facets.end());
    std::vector<Key>& faces = out_.constraints.faces;
    for (const Key& key : faces)
      if (!std::binary_search(facets.begin(), facets.end(), key)) out_.outer_faces.push_back(key);
    faces.insert(faces.end(), facets.begin(), facets.end());
    sort_unique(faces);
    return true;
  }

  bool take_segments() {
    using Edge = std::array<Vertex, 2>;
    std::vector<Edge>& segments = out_.constraints.segments;
    for (const Segment& s : volume_.segments) segments.push_back(ascending(s));
    sort_unique(segments);
    std::vector<bool> found(segments.size(), false);
    if (!segments.empty())
      for (const Tetrahedron& c : out_.tets)
        for (int k = 0; k < 6; ++k) {
          const Edge edge = ascending(ends_of_edge(c, k));
          const auto at = std::lower_bound(segments.begin(), segments.end(), edge);
          if (at != segments.end() && *at == edge)
            found[static_cast<std::size_t>(at - segments.begin())] = true;
        }
    const auto missing = std::find(found.begin(), found.end(), false);
    if (missing != found.end())
      return fail("segment " + text(segments[static_cast<std::size_t>(missing - found.begin())]) +
                  " is not an edge of any tetrahedron");
    return true;
  }

  void mark_fixed() {
    std::vector<bool>& fixed = out_.constraints.fixed;
    fixed.assign(volume_.vertices.size(), false);
    for (const Key& face : out_.constraints.faces)
      for (const Vertex v : face) fixed[v] = true;
    for (const auto& segment : out_.constraints.segments)
      for (const Vertex v : segment) fixed[v] = true;
    for (const Index v : fixed_) fixed[v] = true;
  }

  void turn_alike() {
    out_.component.assign(out_.tets.size(), no_component);
    std::vector<bool> turn(out_.tets.size(), false);
    std::vector<Tet> queue;
    for (Tet seed = 0; seed < out_.tets.size(); ++seed) {
      if (out_.component[seed] != no_component) continue;
      out_.component[seed] = static_cast<Index>(out_.component_count);
      queue.assign(1, seed);
      for (std::size_t k = 0; k < queue.size(); ++k)
        if (!visit_neighbours(queue[k], turn, queue)) return;
      // The right orientation is not known yet; keeping the listed one of most is cheapest.
      const auto turned =
          static_cast<std::size_t>(std::count_if(queue.begin(), queue.end(), [&](Tet t) { return turn[t]; }));
      if (2 * turned > queue.size())
        for (const Tet t : queue) turn[t] = !turn[t];
      out_.turned += std::min(turned, queue.size() - turned);
      ++out_.component_count;
    }
    for (Tet t = 0; t < out_.tets.size(); ++t)
      if (turn[t]) std::swap(out_.tets[t][2], out_.tets[t][3]);
  }

  bool visit_neighbours(Tet t, std::vector<bool>& turn, std::vector<Tet>& queue) {
    for (int i = 0; i < 4; ++i) {
      const auto [code, alike] = partner_[face_code(t, i)];
      if (code == kNone) continue;
      const Tet s = tet_of(code);
      const bool wanted = turn[t] != alike;  // seen from the same side: one of the two must turn
      if (out_.component[s] == no_component) {
        out_.component[s] = out_.component[t];
        turn[s] = wanted;
        queue.push_back(s);
      } else if (turn[s] != wanted) {
        return fail("the tetrahedra cannot all be turned alike, as tetrahedra " + std::to_string(t) +
                    " and " + std::to_string(s) + " show: they do not form a mesh of a part of space");
      }
    }
    return true;
  }

  struct Partner {
    Face code;
    bool alike;  // both see the face from one side, as listed
  };
  static constexpr Index no_component = ~Index{0};

  const Volume& volume_;
  std::span<const Index> fixed_;
  std::vector<HalfFace> halves_;
  std::vector<Partner> partner_;
  Connectivity out_;
};

exact::Dyadic exact_volume(const Connectivity& connectivity, std::span<const Point> p, Index component) {
  exact::Dyadic sum;
  for (Tet t = 0; t < connectivity.tets.size(); ++t) {
    if (connectivity.component[t] != component) continue;
    const Tetrahedron& c = connectivity.tets[t];
    sum += exact::determinant(exact::lift(p[c[0]].data()), exact::lift(p[c[1]].data()),
                              exact::lift(p[c[2]].data()), exact::lift(p[c[3]].data()));
  }
  return sum;
}

}  // namespace

Connectivity read_connectivity(const Volume& volume, std::span<const Index> fixed) {
  return Reader(volume, fixed).read();
}

void turn_outwards(Connectivity& connectivity, std::span<const Point> p) {
  std::vector<exact::Bounded> sum(connectivity.component_count);
  std::vector<std::size_t> size(connectivity.component_count, 0);
  for (Tet t = 0; t < connectivity.tets.size(); ++t) {
    const Tetrahedron& c = connectivity.tets[t];
    sum[connectivity.component[t]] += exact::bounded_determinant(p[c[0]], p[c[1]], p[c[2]], p[c[3]]);
    ++size[connectivity.component[t]];
  }
  std::vector<bool> turn(connectivity.component_count, false);
  for (Index i = 0; i < connectivity.component_count; ++i) {
    const bool sure = std::abs(sum[i].value) > sum[i].error;
    turn[i] = sure ? sum[i].value < 0 : exact_volume(connectivity, p, i).sign() < 0;
    if (turn[i]) connectivity.turned += size[i];
  }
  for (Tet t = 0; t < connectivity.tets.size(); ++t)
    if (turn[connectivity.component[t]]) std::swap(connectivity.tets[t][2], connectivity.tets[t][3]);
}

Surface boundary_surface(const Volume& volume, const Connectivity& connectivity) {
  Surface surface;
  surface.vertices = volume.vertices;
  surface.facets = volume.facets;
  surface.facets.insert(surface.facets.end(), connectivity.outer_faces.begin(),
                        connectivity.outer_faces.end());
  surface.segments = volume.segments;
  double reach = 1e-280;
  const std::vector<bool>& fixed = connectivity.constraints.fixed;
  for (std::size_t v = 0; v < fixed.size(); ++v)
    if (fixed[v])
      for (const double x : volume.vertices[v])
        if (std::isfinite(x)) reach = std::max(reach, std::abs(x));
  // Puts points on a line outside the box of the fixed ones. Near the end of the range the steps get smaller
  // instead.
  const double step = std::min(reach, (1.7e308 - reach) / (2.0 + static_cast<double>(fixed.size())));
  double x = reach;
  for (std::size_t v = 0; v < fixed.size(); ++v)
    if (!fixed[v]) surface.vertices[v] = {x += step, reach, reach};
  return surface;
}

}  // namespace holdfast
