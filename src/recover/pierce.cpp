#include "recover/pierce.h"

#include <algorithm>

#include "mesh/traverse.h"
#include "recover/tuning.h"

namespace holdfast {
namespace {

constexpr std::size_t next3(std::size_t k) { return k == 2 ? 0 : k + 1; }

Crossing face_opposite(const TetMesh& mesh, Tet t, Vertex v) {
  return {t, mesh.face_vertices(face_code(t, mesh.index_of(t, v))), 3};
}

Face code_of(const TetMesh& mesh, const Crossing& face) {
  for (int i = 0; i < 4; ++i) {
    const Vertex v = mesh.corner(face.tet, i);
    if (v != face.corners[0] && v != face.corners[1] && v != face.corners[2]) return face_code(face.tet, i);
  }
  return kNone;
}

}  // namespace

// Signs of b against the three planes through a of the cone (f0 f1 f2 a). All are >= 0 if the ray ab is in
// the cone; zeros name the sides of the cone that contain the ray.
std::array<int, 3> Piercing::cone_signs(const std::array<Vertex, 3>& f, Vertex a, Vertex b) const {
  const auto [of_1, of_2] = mesh_.orient_both(a, b, f[0], f[1], f[2]);
  return {-mesh_.orient(a, b, f[1], f[2]), of_2, -of_1};
}

// The same if b is known to lie beyond the plane of the cone's side opposite d, a corner of f.
std::array<int, 3> Piercing::cone_signs_beyond(const std::array<Vertex, 3>& f, Vertex d, Vertex a,
                                               Vertex b) const {
  const std::size_t k = f[0] == d ? 0 : f[1] == d ? 1 : 2, l = next3(k), m = next3(l);
  const auto [of_l, of_m] = mesh_.orient_both(a, b, d, f[l], f[m]);
  std::array<int, 3> signs{};
  signs[k] = 1;
  signs[l] = of_m;
  signs[m] = -of_l;
  return signs;
}

Piercing::Exit Piercing::leave_by_face(Tet t, Vertex a, const std::array<int, 3>& signs) const {
  const auto f = mesh_.face_vertices(face_code(t, mesh_.index_of(t, a)));
  Exit exit;
  exit.tet = t;
  for (std::size_t k = 0; k < 3; ++k)
    if (signs[k] > 0) exit.corners[static_cast<std::size_t>(exit.count++)] = f[k];
  return exit;
}

// A visibility walk in the star of a, which chooses at random among the sides it may cross (Devillers, Pion,
// Teillaud 2002). Where the walk meets the hull or takes too long, all of the ball is searched.
Piercing::Exit Piercing::leave_vertex(Vertex a, Vertex b) {
  Tet t = mesh_.incident(a);
  if (t == kNone) return {};
  Vertex d = kNone;  // the corner that the last step added
  for (int step = 0; step < tuning::kMostWalk && !mesh_.is_ghost(t); ++step) {
    const int i = mesh_.index_of(t, a);
    const auto f = mesh_.face_vertices(face_code(t, i));
    const auto signs = d == kNone ? cone_signs(f, a, b) : cone_signs_beyond(f, d, a, b);
    std::array<std::size_t, 3> beyond{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (signs[k] < 0) beyond[count++] = k;
    if (count == 0) return leave_by_face(t, a, signs);
    const std::size_t k = count == 1 ? beyond[0] : beyond[random_() % count];
    const Face across = mesh_.neighbour(t, mesh_.index_of(t, f[k]));
    t = tet_of(across);
    d = mesh_.apex(across);
  }
  tets_.clear();
  ball(mesh_, a, tets_);
  for (const Tet s : tets_) {
    if (mesh_.is_ghost(s)) continue;
    const auto signs = cone_signs(mesh_.face_vertices(face_code(s, mesh_.index_of(s, a))), a, b);
    if (signs[0] >= 0 && signs[1] >= 0 && signs[2] >= 0) return leave_by_face(s, a, signs);
  }
  return {};
}

// Seen along ab, the face (f0 f1 f2) turns left round the image of the line; the position of the apex d is
// open.
Piercing::Exit Piercing::pass_face(const Exit& in, Vertex a, Vertex b) const {
  const Face f = mesh_.neighbour(code_of(mesh_, in));
  const Tet t = tet_of(f);
  if (mesh_.is_ghost(t)) return {};
  const auto v = mesh_.face_vertices(f);
  const Vertex d = mesh_.apex(f);
  if (d == b) return {t, {b}, 1};
  const auto [of_0, of_1] = mesh_.orient_both(a, b, d, v[0], v[1]);
  if (of_0 > 0 && of_1 < 0) return face_opposite(mesh_, t, v[2]);
  const std::array<int, 3> s{-of_0, -of_1, mesh_.orient(a, b, v[2], d)};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = next3(k), m = next3(l);
    if (s[k] < 0 && s[l] > 0) return face_opposite(mesh_, t, v[m]);
    if (s[k] == 0 && s[l] > 0 && s[m] < 0) return {t, {v[k], d}, 2};
  }
  return {t, {d}, 1};
}

// Finds the wedge (c d x y) of the edge's shell that contains b, face (c d x) included; then where ab leaves
// it.
Piercing::Exit Piercing::pass_edge(const Exit& in, Vertex a, Vertex b) const {
  const Vertex c = in.corners[0], d = in.corners[1];
  Tet t = in.tet;
  do {
    const auto [x, y] = mesh_.opposite_edge(t, c, d);
    if (mesh_.is_ghost(t)) return {};
    if (mesh_.orient(c, d, b, y) > 0) {
      const int side = mesh_.orient(c, d, x, b);
      if (x == b) return {t, {b}, 1};
      if (side == 0) {  // ab lies in the plane of (c d x) and y beside it
        const int sx = mesh_.orient(a, b, y, x);
        if (sx == 0) return {t, {x}, 1};
        return {t, {x, sx == mesh_.orient(a, b, y, c) ? d : c}, 2};
      }
      if (side > 0) {
        const int s = mesh_.orient(a, b, x, y);
        if (s == 0) return {t, {x, y}, 2};
        return face_opposite(mesh_, t, s == mesh_.orient(a, b, d, x) ? c : d);
      }
    }
    t = tet_of(mesh_.neighbour(t, mesh_.index_of(t, x)));
  } while (t != in.tet);
  return {};
}

std::optional<Tet> Piercing::by_segment(Vertex a, Vertex b, std::vector<Crossing>& out, std::size_t most) {
  Exit exit = leave_vertex(a, b);
  while (exit.count > 1 && out.size() < most) {
    out.push_back(exit);
    exit = exit.count == 3 ? pass_face(exit, a, b) : pass_edge(exit, a, b);
  }
  if (exit.count > 1 || (exit.count == 1 && exit.corners[0] == b)) return exit.tet;
  return std::nullopt;
}

Tet Piercing::find_edge(Vertex a, Vertex b) {
  const Exit exit = leave_vertex(a, b);
  return exit.count == 1 && exit.corners[0] == b ? exit.tet : kNone;
}

Face Piercing::find_face(Vertex a, Vertex b, Vertex c) {
  const Tet t = find_edge(a, b);
  return t == kNone ? kNone : find_face_round(mesh_, t, a, b, c);
}

std::optional<Face> Piercing::of_facet(const std::array<Vertex, 3>& facet, std::vector<PiercingEdge>& out,
                                       std::size_t most) {
  const auto collect = [&](Tet t, const std::array<int, 4>& s) {
    for (const auto& e : kEdgeVertex) {
      const int s0 = s[static_cast<std::size_t>(e[0])], s1 = s[static_cast<std::size_t>(e[1])];
      if (s0 * s1 >= 0) continue;
      const Vertex v0 = mesh_.corner(t, e[0]), v1 = mesh_.corner(t, e[1]);
      out.push_back(s0 > 0 ? PiercingEdge{v0, v1, t} : PiercingEdge{v1, v0, t});
    }
    return out.size() < 6 * most;
  };
  const std::optional<Face> face = flood(facet, collect);
  const auto key = [](const PiercingEdge& e) { return std::pair(e.above, e.below); };
  // Of each edge the tetrahedron met first is kept, with every standard library.
  std::stable_sort(out.begin(), out.end(), [&](const auto& l, const auto& r) { return key(l) < key(r); });
  out.erase(
      std::unique(out.begin(), out.end(), [&](const auto& l, const auto& r) { return key(l) == key(r); }),
      out.end());
  return face;
}

std::optional<Face> Piercing::tets_across(const std::array<Vertex, 3>& facet, std::vector<Tet>& out) {
  return flood(facet, [&](Tet t, const std::array<int, 4>&) {
    out.push_back(t);
    return true;
  });
}

// None if a side is not an edge.
std::optional<Piercing::Start> Piercing::start_of(const std::array<Vertex, 3>& facet) {
  const auto [a, b, inside] = facet;
  const Tet start = find_edge(a, b);
  if (start == kNone) return std::nullopt;
  Start found;
  Tet t = start;
  do {
    const auto [c, d] = mesh_.opposite_edge(t, a, b);
    if (c == inside) return Start{.face = face_code(t, mesh_.index_of(t, d))};
    if (found.across == kNone && !mesh_.is_ghost(t) && d != inside && mesh_.orient(a, b, inside, d) > 0 &&
        mesh_.orient(a, b, c, inside) > 0)
      found.across = t;
    t = tet_of(mesh_.neighbour(t, mesh_.index_of(t, c)));
  } while (t != start);
  if (find_edge(b, inside) == kNone || find_edge(inside, a) == kNone) return std::nullopt;
  return found;
}

// Searches across faces with vertices strictly on both sides of the plane. The facet's sides are edges, so a
// section cell never leaves the facet (docs/concepts.md). No mesh face or edge lies inside the facet, because
// no vertex of the mesh does.
template <typename Visit>
std::optional<Face> Piercing::flood(const std::array<Vertex, 3>& facet, Visit visit) {
  const std::optional<Start> start = start_of(facet);
  if (!start) return std::nullopt;
  tets_.clear();
  if (start->across == kNone) return start->face;
  tets_.push_back(start->across);
  mesh_.mark_visited(start->across);
  for (std::size_t n = 0; n < tets_.size(); ++n) {
    const Tet t = tets_[n];
    std::array<int, 4> s{};
    for (int i = 0; i < 4; ++i) {
      const Vertex v = mesh_.corner(t, i);
      const bool corner = v == facet[0] || v == facet[1] || v == facet[2];
      s[static_cast<std::size_t>(i)] = corner ? 0 : mesh_.orient(facet[0], facet[1], facet[2], v);
    }
    if (!visit(t, s)) break;
    for (int i = 0; i < 4; ++i) {
      bool above = false, below = false;
      for (const int k : kFaceVertex[static_cast<std::size_t>(i)]) {
        above = above || s[static_cast<std::size_t>(k)] > 0;
        below = below || s[static_cast<std::size_t>(k)] < 0;
      }
      const Tet next = tet_of(mesh_.neighbour(t, i));
      if (!above || !below || mesh_.is_ghost(next) || (mesh_.flags(next) & kVisited) != 0) continue;
      mesh_.mark_visited(next);
      tets_.push_back(next);
    }
  }
  for (const Tet t : tets_) mesh_.clear_visited(t);
  return kNone;
}

}  // namespace holdfast
