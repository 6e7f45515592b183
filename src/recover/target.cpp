#include "recover/target.h"

#include <algorithm>

namespace holdfast {
namespace {

// Whether the insides of two coplanar edges cross, in a projection that keeps them apart.
bool coplanar_edges_cross(const TetMesh& mesh, Vertex a, Vertex b, Vertex u, Vertex v) {
  const auto pa = mesh.point(a), pb = mesh.point(b), pu = mesh.point(u), pv = mesh.point(v);
  for (int axis = 0; axis < 3; ++axis) {
    const int su = exact::orient2d(pa, pb, pu, axis);
    if (su == 0) continue;
    return su * exact::orient2d(pa, pb, pv, axis) < 0 &&
           exact::orient2d(pu, pv, pa, axis) * exact::orient2d(pu, pv, pb, axis) < 0;
  }
  return false;
}

}  // namespace

// Rounding never reverses the order of two numbers. So exact positions are apart if the doubles nearest to
// them are apart.
bool Target::may_meet(const TetMesh& mesh, const Point& low, const Point& high) const {
  if (kind_ == Kind::none) return false;
  const Point &a = mesh.position(v_[0]), &b = mesh.position(v_[1]);
  const Point& c = kind_ == Kind::facet ? mesh.position(v_[2]) : b;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::max({a[i], b[i], c[i]}) < low[i] || high[i] < std::min({a[i], b[i], c[i]})) return false;
  return true;
}

int Target::face(const TetMesh& mesh, Vertex u, Vertex v, Vertex w) const {
  if (kind_ != Kind::segment) return 0;
  const auto [a, b, none] = v_;
  if (u == a || v == a || w == a || u == b || v == b || w == b) return 0;
  const int s = mesh.orient(a, b, u, v);
  if (s == 0 || mesh.orient(a, b, v, w) != s || mesh.orient(a, b, w, u) != s) return 0;
  return face_round(mesh, u, v, w);
}

int Target::edge(const TetMesh& mesh, Vertex u, Vertex v) const {
  if (kind_ == Kind::none) return 0;
  const auto [a, b, c] = v_;
  if (u == a || v == a || u == b || v == b) return 0;
  if (kind_ == Kind::segment)
    return mesh.orient(a, b, u, v) == 0 && coplanar_edges_cross(mesh, a, b, u, v) ? kEdgeCost : 0;
  if (u == c || v == c) return 0;
  if (mesh.orient(a, b, c, u) * mesh.orient(a, b, c, v) >= 0) return 0;
  const int s = mesh.orient(u, v, a, b);
  return s != 0 && mesh.orient(u, v, b, c) == s && mesh.orient(u, v, c, a) == s ? kEdgeCost : 0;
}

}  // namespace holdfast
