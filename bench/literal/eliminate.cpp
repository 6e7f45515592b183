#include "literal/eliminate.h"

#include <algorithm>
#include <deque>
#include <set>
#include <stdexcept>
#include <string>

#include "enforce/polygon.h"

namespace holdfast::literal {
namespace {

using Edge = std::array<Vertex, 2>;
using Corner3 = std::array<Vertex, 3>;

Edge sorted(Vertex a, Vertex b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Faces round P that lie in one polygon: (P, rim[j], rim[j+1]). The rim of a point inside a facet is closed;
// that of a point of a segment leads from one neighbour on the chain to the other.
struct Fan {
  std::vector<Vertex> rim;
  bool closed = false;
  std::optional<Index> facet;           // none where the mesh's faces emulate one
  std::vector<Corner3> triangles = {};  // the polygon without P, turned as the fan is

  [[nodiscard]] std::vector<Edge> edges() const {
    std::vector<Edge> edges;
    for (std::size_t j = 0; j + 1 < rim.size(); ++j) edges.push_back({rim[j], rim[j + 1]});
    if (closed) edges.push_back({rim.back(), rim.front()});
    return edges;
  }
};

class Eliminator {
 public:
  Eliminator(Soup& soup, std::span<const Triangle> facets) : soup_(soup), facets_(facets) {}

  EliminationCounts counts;

  // False where a polygon without P would repeat an edge that stands (Fig. 12).
  bool from_facet(Vertex p) {
    std::vector<Fan> fans = fans_of_facets(p, std::nullopt);
    if (fans.size() != 1)
      throw std::logic_error("a point inside a facet has " + std::to_string(fans.size()) + " fans");
    if (repeats_an_edge(fans)) return false;
    cut(p, fans, 2);
    ++counts.in_facets;
    return true;
  }

  // The same; false also where no faces emulate the facets that are missing.
  bool from_segment(Vertex p, Vertex a, Vertex b) {
    std::vector<Fan> fans = fans_of_facets(p, Edge{a, b});
    const std::size_t k = fans.size();
    while (fans.size() < 2) {
      std::optional<Fan> fan = emulated(p, a, b, fans);
      if (!fan) return false;
      fans.push_back(std::move(*fan));
    }
    if (repeats_an_edge(fans)) return false;
    counts.emulated += fans.size() - k;
    cut(p, fans, fans.size());
    counts.on_segments.resize(std::max(counts.on_segments.size(), k + 1));
    ++counts.on_segments[k];
    return true;
  }

 private:
  [[nodiscard]] bool repeats_an_edge(const std::vector<Fan>& fans) const {
    return std::any_of(fans.begin(), fans.end(), [&](const Fan& fan) {
      std::set<Edge> rim;
      for (const auto& [u, v] : fan.edges()) rim.insert(sorted(u, v));
      return std::any_of(fan.triangles.begin(), fan.triangles.end(), [&](const Corner3& t) {
        for (std::size_t i = 0; i < 3; ++i)
          if (!rim.contains(sorted(t[i], t[(i + 1) % 3])) && soup_.has_edge(t[i], t[(i + 1) % 3]))
            return true;
        return false;
      });
    });
  }

  // The polygon of each facet through P.
  std::vector<Fan> fans_of_facets(Vertex p, std::optional<Edge> ends) {
    std::map<Index, std::set<Edge>> rims;
    for (const Soup::Number t : soup_.ball(p))
      for_faces(p, t, [&](Vertex x, Vertex y) {
        if (const std::optional<Index> f = soup_.facet_of({p, x, y})) rims[*f].insert(sorted(x, y));
      });
    std::vector<Fan> fans;
    for (const auto& [facet, edges] : rims) {
      Fan fan{chained(edges, ends), !ends, facet};
      triangulate(p, fan);
      fans.push_back(std::move(fan));
    }
    return fans;
  }

  template <typename Use>
  void for_faces(Vertex p, Soup::Number t, Use&& use) const {
    std::array<Vertex, 3> others{};
    std::size_t n = 0;
    for (const Vertex v : soup_.tets()[t])
      if (v != p) others[n++] = v;
    for (std::size_t i = 0; i < 3; ++i) use(others[i], others[(i + 1) % 3]);
  }

  static std::vector<Vertex> chained(const std::set<Edge>& edges, std::optional<Edge> ends) {
    std::map<Vertex, std::vector<Vertex>> next;
    for (const auto& [a, b] : edges) {
      next[a].push_back(b);
      next[b].push_back(a);
    }
    std::vector<Vertex> rim{ends ? (*ends)[0] : next.begin()->first};
    Vertex before = kNone;
    while (rim.size() <= edges.size() + 1) {
      const std::vector<Vertex>& choice = next[rim.back()];
      const auto step = std::find_if(choice.begin(), choice.end(), [&](Vertex v) { return v != before; });
      if (step == choice.end() || (!ends && *step == rim.front())) break;
      before = rim.back();
      rim.push_back(*step);
    }
    if (rim.size() != edges.size() + (ends ? 1 : 0) || (ends && rim.back() != (*ends)[1]))
      throw std::logic_error("faces of a facet round a point are no fan");
    return rim;
  }

  // Exactly, in the facet's plane.
  void triangulate(Vertex p, Fan& fan) const {
    const TetMesh& mesh = soup_.mesh();
    const auto [a, b, c] = facets_[*fan.facet];
    Vertex above = 0;
    while (mesh.orient(a, b, c, above) == 0) ++above;
    int turn = 0;
    for (const auto& [u, v] : fan.edges())
      if (turn == 0) turn = mesh.orient(p, u, v, above);
    std::vector<Vertex> polygon = fan.rim;
    if (turn < 0) std::reverse(polygon.begin(), polygon.end());
    for (const auto& [x, y, z] : triangulate_polygon(mesh, polygon, above))
      fan.triangles.push_back(turn > 0 ? Corner3{x, y, z} : Corner3{x, z, y});
  }

  // "Among the element facets, we guess those which can emulate a polygon on the other side" (§6.3.2): the
  // shortest way on P's link from one neighbour to the other, off the polygons that there are. A way over one
  // vertex is a triangle; a longer one gets one more copy of P inside, since edges between its vertices may
  // stand already, now or when a facet's polygon needs them.
  std::optional<Fan> emulated(Vertex p, Vertex a, Vertex b, const std::vector<Fan>& fans) {
    std::set<Vertex> closed;
    for (const Fan& fan : fans) closed.insert(fan.rim.begin() + 1, fan.rim.end() - 1);
    std::map<Vertex, std::set<Vertex>> link;
    for (const Soup::Number t : soup_.ball(p))
      for_faces(p, t, [&](Vertex x, Vertex y) {
        link[x].insert(y);
        link[y].insert(x);
      });
    const std::vector<Vertex> way = shortest_way(link, a, b, closed);
    if (way.empty() || soup_.has_edge(a, b)) return std::nullopt;
    if (way.size() == 3) return Fan{way, false, std::nullopt, {{way[0], way[1], way[2]}}};
    return filled_round(soup_.copy(p), way);
  }

  static std::vector<Vertex> shortest_way(const std::map<Vertex, std::set<Vertex>>& link, Vertex a, Vertex b,
                                          const std::set<Vertex>& closed) {
    std::map<Vertex, Vertex> from{{a, a}};
    for (std::deque<Vertex> queue{a}; !queue.empty(); queue.pop_front())
      for (const Vertex v : link.at(queue.front()))
        if (!closed.contains(v) && from.try_emplace(v, queue.front()).second) queue.push_back(v);
    if (!from.contains(b)) return {};
    std::vector<Vertex> way{b};
    while (way.back() != a) way.push_back(from[way.back()]);
    std::reverse(way.begin(), way.end());
    return way;
  }

  // The polygon of the way and of the edge between its ends, with a vertex of its own inside.
  static Fan filled_round(Vertex inside, const std::vector<Vertex>& way) {
    Fan fan{way, false, std::nullopt};
    for (std::size_t j = 0; j + 1 < way.size(); ++j) fan.triangles.push_back({inside, way[j], way[j + 1]});
    fan.triangles.push_back({inside, way.back(), way.front()});
    return fan;
  }

  // Cuts P's ball along the fans and gives each part a copy of P, joined to the polygons without P: these new
  // tetrahedra are null as long as P does not move.
  void cut(Vertex p, const std::vector<Fan>& fans, std::size_t expected) {
    const std::vector<Soup::Number> ball = soup_.ball(p);
    std::map<Edge, std::vector<std::size_t>> sides;  // of each face at P, places in the ball
    for (std::size_t i = 0; i < ball.size(); ++i)
      for_faces(p, ball[i], [&](Vertex x, Vertex y) { sides[sorted(x, y)].push_back(i); });
    for (const auto& [edge, tets] : sides)
      if (tets.size() != 2) throw std::logic_error("the ball of a point is no ball");
    std::set<Edge> blocked;
    for (const Fan& fan : fans)
      for (const auto& [u, v] : fan.edges()) blocked.insert(sorted(u, v));
    const std::vector<std::size_t> part = parts(p, ball, sides, blocked);
    const std::size_t count = *std::max_element(part.begin(), part.end()) + 1;
    if (count != expected)
      throw std::logic_error("a ball falls into " + std::to_string(count) + " parts, not " +
                             std::to_string(expected));

    std::vector<Vertex> apex{p};
    while (apex.size() < count) apex.push_back(soup_.copy(p));
    counts.copies += count - 1;
    std::vector<Soup::Corners> fresh;
    for (std::size_t i = 0; i < ball.size(); ++i) {
      Soup::Corners corners = soup_.tets()[ball[i]];
      std::replace(corners.begin(), corners.end(), p, apex[part[i]]);
      fresh.push_back(corners);
    }
    for (const Fan& fan : fans) close(p, fan, ball, sides, part, apex, fresh);
    for (const Soup::Number t : ball) soup_.remove(t);
    for (const Soup::Corners& corners : fresh) soup_.add(corners);
    for (const Fan& fan : fans) {
      if (!fan.facet) continue;
      for (const auto& [u, v] : fan.edges()) soup_.clear_facet({p, u, v});
      for (const Corner3& triangle : fan.triangles) soup_.set_facet(triangle, *fan.facet);
    }
  }

  [[nodiscard]] std::vector<std::size_t> parts(Vertex p, const std::vector<Soup::Number>& ball,
                                               const std::map<Edge, std::vector<std::size_t>>& sides,
                                               const std::set<Edge>& blocked) const {
    std::vector<std::size_t> part(ball.size(), SIZE_MAX);
    std::size_t count = 0;
    for (std::size_t start = 0; start < ball.size(); ++start) {
      if (part[start] != SIZE_MAX) continue;
      part[start] = count;
      for (std::vector<std::size_t> stack{start}; !stack.empty();) {
        const std::size_t i = stack.back();
        stack.pop_back();
        for_faces(p, ball[i], [&](Vertex x, Vertex y) {
          if (blocked.contains(sorted(x, y))) return;
          for (const std::size_t j : sides.at(sorted(x, y)))
            if (part[j] == SIZE_MAX) {
              part[j] = count;
              stack.push_back(j);
            }
        });
      }
      ++count;
    }
    return part;
  }

  // On either side of a polygon, its triangles joined to the copy of P there. On the face (P, u, v) of a fan
  // the new tetrahedron lies beyond it, so that it lists its corners the other way round.
  void close(Vertex p, const Fan& fan, const std::vector<Soup::Number>& ball,
             const std::map<Edge, std::vector<std::size_t>>& sides, const std::vector<std::size_t>& part,
             const std::vector<Vertex>& apex, std::vector<Soup::Corners>& fresh) const {
    std::map<std::size_t, int> turn;  // by part
    for (const auto& [u, v] : fan.edges())
      for (const std::size_t i : sides.at(sorted(u, v))) {
        const Soup::Corners& t = soup_.tets()[ball[i]];
        const Vertex x =
            *std::find_if(t.begin(), t.end(), [&](Vertex w) { return w != p && w != u && w != v; });
        const int sign = parity(t, {p, u, v, x});
        if (turn.try_emplace(part[i], sign).first->second != sign)
          throw std::logic_error("a polygon has a part on both of its sides");
      }
    for (const auto& [number, sign] : turn)
      for (const auto& [a, b, c] : fan.triangles)
        fresh.push_back(sign < 0 ? Soup::Corners{apex[number], a, b, c}
                                 : Soup::Corners{a, apex[number], b, c});
  }

  Soup& soup_;
  std::span<const Triangle> facets_;
};

}  // namespace

EliminationCounts eliminate(Soup& soup, const ConstraintPieces& pieces, std::span<const Triangle> facets,
                            numbers::Random& random) {
  Eliminator eliminator(soup, facets);
  // What is refused may be possible when others are gone.
  const auto take_all = [&](std::vector<Vertex> points, auto&& take) {
    numbers::shuffle(points.begin(), points.end(), random);
    while (std::erase_if(points, take) > 0) {
    }
    eliminator.counts.left += points.size();
  };
  std::vector<Vertex> inner;
  for (const ConstraintPieces::SubFacets& facet : pieces.sub_facets)
    inner.insert(inner.end(), facet.inner.begin(), facet.inner.end());
  take_all(inner, [&](Vertex p) { return eliminator.from_facet(p); });

  std::vector<std::vector<Vertex>> chains;
  std::map<Vertex, std::size_t> chain_of;
  std::vector<Vertex> on_segments;
  for (const ConstraintPieces::Chain& chain : pieces.chains) {
    for (std::size_t k = 1; k + 1 < chain.vertices.size(); ++k) {
      on_segments.push_back(chain.vertices[k]);
      chain_of[chain.vertices[k]] = chains.size();
    }
    chains.push_back(chain.vertices);
  }
  take_all(on_segments, [&](Vertex p) {
    std::vector<Vertex>& chain = chains[chain_of.at(p)];
    const auto it = std::find(chain.begin(), chain.end(), p);
    if (!eliminator.from_segment(p, *(it - 1), *(it + 1))) return false;
    chain.erase(it);
    return true;
  });
  return eliminator.counts;
}

}  // namespace holdfast::literal
