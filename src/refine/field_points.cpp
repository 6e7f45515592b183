// Points are placed as by an advancing front, but in a mesh that is complete at any time (Rebay 1993; Marcum,
// Weatherill 1995; Engwirda 2016): a tetrahedron much larger than the size is to be refined, and it is on the
// front where its neighbour is not, or where a facet bounds it. There the best place for a point is over the
// centre of that face, so high that the new edges have the right length. So layers of good tetrahedra grow
// inward from the surface. A point too near to a vertex that it would be joined to is not inserted: the
// nearest vertex that it sees is always one of those, so that the mesh itself is the spatial index.
#include "refine/field_points.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "refine/point_cavity.h"

namespace holdfast {
namespace {

using Vector = std::array<double, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// In sizes: the circumradius from which a tetrahedron is refined (0.61 is regular), the least distance of a
// new point from others, and its least height over a facet.
constexpr double kLarge = 0.85, kNearest = 0.7, kLeastHeight = 0.4;
constexpr double kLevel = 1.3;         // of the mean of the sizes round, where sizes do not grow
constexpr double kLongestPart = 0.65;  // of an edge: the size, where the edge is to be split

Vector operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double distance(const Point& a, const Point& b) {
  const Vector d = a - b;
  return std::sqrt(dot(d, d));
}

class FieldPoints {
 public:
  FieldPoints(const FieldMesh& field, const SizeFunction& sizes, Monitor& monitor)
      : mesh_(field.mesh),
        region_of_(field.region_of),
        kept_(field.kept),
        sizes_(sizes),
        monitor_(monitor),
        cavity_(field.mesh) {}

  std::vector<double> run() {
    size_vertices();
    look_at_all();
    while ((!front_.empty() || !rest_.empty()) && !has_wasted_enough()) {
      monitor_.poll(Stage::field_points, progress());
      if (!front_.empty()) {
        prefetch_ahead();
        const Tet t = front_.front();
        front_.pop_front();
        if (!mesh_.alive(t) || (state_[t] & kQueued) == 0) continue;
        state_[t] = static_cast<std::uint8_t>(state_[t] & ~kQueued);
        if (!advance(t) && (state_[t] & kInRest) == 0) {
          state_[t] = static_cast<std::uint8_t>(state_[t] | kInRest);
          rest_.push_back(t);
        }
      } else {
        const Tet t = rest_.front();
        rest_.pop_front();
        if (!mesh_.alive(t) || (state_[t] & kInRest) == 0) continue;
        state_[t] = static_cast<std::uint8_t>(state_[t] & ~kInRest);
        split_long_edge(t);
      }
    }
    return std::move(size_);
  }

 private:
  // Bit i below these: tried from face i.
  static constexpr std::uint8_t kIsLarge = 0x10, kQueued = 0x20, kInRest = 0x40;

  // Between vertices with thousands of neighbours each attempt looks at thousands of tetrahedra, and nearly
  // all come to nothing. Elsewhere some ten tetrahedra are looked at in vain for each that is made.
  [[nodiscard]] bool has_wasted_enough() const {
    constexpr std::size_t kPatience = 60, kLeast = 1'000'000;
    return wasted_ > kPatience * mesh_.tet_count() + kLeast;
  }

  // The front runs through the whole mesh, layer by layer: what comes next is seldom in the cache.
  void prefetch_ahead() const {
    constexpr std::size_t kFar = 8, kNear = 4;
    if (front_.size() > kFar) mesh_.prefetch(front_[kFar]);
    if (front_.size() > kNear) mesh_.prefetch_neighbours(front_[kNear]);
  }

  // How much is left is known when little is: the front is large first and shrinks.
  [[nodiscard]] double progress() const {
    return 1 - static_cast<double>(front_.size()) / static_cast<double>(front_.size() + region_of_.size());
  }

  // Vertices of the surface have their sizes; others, Steiner points and corners of a box, get what the
  // vertices round them allow.
  void size_vertices() {
    size_.assign(mesh_.vertex_count(), kInfinity);
    for (Vertex v = 0; v < sizes_.vertex_count(); ++v) size_[v] = sizes_.of_vertex(v);
    for (bool changed = true; changed;) {
      changed = false;
      for (Tet t = 0; t < mesh_.slot_count(); ++t) {
        if (!is_inside(t)) continue;
        for (const Vertex v : mesh_.corners(t)) {
          if (v < sizes_.vertex_count() && sizes_.of_vertex(v) < kInfinity) continue;
          for (const Vertex w : mesh_.corners(t)) {
            const double h = size_[w] + sizes_.gradation() * distance(mesh_.position(v), mesh_.position(w));
            if (!(h < size_[v] * (1 - 1e-9))) continue;
            size_[v] = h;
            changed = true;
          }
        }
      }
    }
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_inside(t))
        for (const Vertex v : mesh_.corners(t))
          size_[v] = std::min(size_[v], sizes_.limit(mesh_.position(v), region_of_[t]));
  }

  [[nodiscard]] bool is_inside(Tet t) const {
    return mesh_.alive(t) && !mesh_.is_ghost(t) && kept_[region_of_[t]];
  }

  void look_at_all() {
    state_.assign(mesh_.slot_count(), 0);
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_inside(t) && is_large(t)) queue(t, kIsLarge);
  }

  void queue(Tet t, std::uint8_t state) {
    if ((state & kQueued) == 0) front_.push_back(t);
    state_[t] = static_cast<std::uint8_t>(state | kQueued);
  }

  // Whether the radius of its sphere is. Per tetrahedron made, so without roots and divisions.
  [[nodiscard]] bool is_large(Tet t) const {
    const auto& c = mesh_.corners(t);
    const Point& p = mesh_.position(c[0]);
    const Vector u = mesh_.position(c[1]) - p, v = mesh_.position(c[2]) - p, w = mesh_.position(c[3]) - p;
    const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    Vector centre;  // from p, times twelve volumes
    for (std::size_t k = 0; k < 3; ++k) centre[k] = uu * vw[k] + vv * wu[k] + ww * uv[k];
    const double limit = 2 * dot(u, vw) * largest_radius(t);
    return !(dot(centre, centre) < limit * limit);
  }

  // Sizes grow with the distance: r = kLarge (h + gradation r).
  [[nodiscard]] double largest_radius(Tet t) const {
    const auto& c = mesh_.corners(t);
    const std::array<double, 4> h{size_[c[0]], size_[c[1]], size_[c[2]], size_[c[3]]};
    double allowed = *std::min_element(h.begin(), h.end()) / (1 - kLarge * sizes_.gradation());
    if (!sizes_.grows()) allowed = std::min(allowed, kLevel * 0.25 * (h[0] + h[1] + h[2] + h[3]));
    if (sizes_.has_limit()) {
      Point middle{};
      for (const Vertex v : c)
        for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * mesh_.position(v)[k];
      allowed = std::min(allowed, sizes_.limit(middle, region_of_[t]));
    }
    return kLarge * allowed;
  }

  // Tries a point over each face of t that is on the front.
  bool advance(Tet t) {
    for (int i = 0; i < 4; ++i) {
      const auto bit = static_cast<std::uint8_t>(1u << i);
      if ((state_[t] & bit) != 0 || !is_on_front(face_code(t, i))) continue;
      state_[t] = static_cast<std::uint8_t>(state_[t] | bit);
      Point p;
      if (place_over(face_code(t, i), p) && try_insert(p, t)) return true;
    }
    return false;
  }

  // Where the front does not get on, as over a facet much larger than the size: a point on the longest edge,
  // one size away from one of its ends.
  bool split_long_edge(Tet t) {
    int longest = -1;
    double length = 0;
    for (int k = 0; k < 6; ++k) {
      const auto& ends = kEdgeVertex[static_cast<std::size_t>(k)];
      const double d =
          distance(mesh_.position(mesh_.corner(t, ends[0])), mesh_.position(mesh_.corner(t, ends[1])));
      if (mesh_.is_segment(t, k) || d <= length) continue;
      length = d;
      longest = k;
    }
    if (longest < 0) return false;
    const auto& ends = kEdgeVertex[static_cast<std::size_t>(longest)];
    for (std::size_t i = 0; i < 2; ++i) {
      const Vertex v = mesh_.corner(t, ends[i]);
      const Point &a = mesh_.position(v), &b = mesh_.position(mesh_.corner(t, ends[1 - i]));
      const double part = size_[v] / length;
      if (part > kLongestPart) continue;
      Point p;
      for (std::size_t j = 0; j < 3; ++j) p[j] = a[j] + part * (b[j] - a[j]);
      if (try_insert(p, t)) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_on_front(Face f) const {
    if (mesh_.is_facet(f)) return true;
    const Tet n = tet_of(mesh_.neighbour(f));
    return mesh_.is_ghost(n) || (state_[n] & kIsLarge) == 0;
  }

  bool place_over(Face f, Point& p) const {
    const auto v = mesh_.face_vertices(f);
    const Point &a = mesh_.position(v[0]), &b = mesh_.position(v[1]), &c = mesh_.position(v[2]);
    const Vector u = b - a, w = c - a;
    const Vector n = cross(u, w);
    const double nn = dot(n, n);
    if (!(nn > 0)) return false;
    const double area = std::sqrt(nn);
    double length = (size_[v[0]] + size_[v[1]] + size_[v[2]]) / 3 * (1 + 0.4 * sizes_.gradation());
    // The centre of the circle through the corners, or where that is far away, of the triangle.
    const double uu = dot(u, u), ww = dot(w, w), uw = dot(u, w);
    const double s = 0.5 * ww * (uu - uw) / nn, r = 0.5 * uu * (ww - uw) / nn;
    Vector foot;
    for (std::size_t k = 0; k < 3; ++k) foot[k] = s * u[k] + r * w[k];
    const double radius2 = dot(foot, foot);
    const bool round = radius2 < 0.6 * length * length;
    const double top = mesh_apex_height(f, n, area);
    double height = round ? std::sqrt(length * length - radius2) : 0.75 * length;
    if (round) {
      // The centre of the tetrahedron's sphere lies over the foot, too.
      const double over = sphere_height(f, a, foot, n, area);
      if (over < 0.3 * height) return false;
      height = std::min(height, over);
    } else {
      for (std::size_t k = 0; k < 3; ++k) foot[k] = (u[k] + w[k]) / 3;
      if (top < height) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + foot[k] + height * n[k] / area;
    return true;
  }

  [[nodiscard]] double mesh_apex_height(Face f, const Vector& n, double area) const {
    return dot(n, mesh_.position(mesh_.apex(f)) - mesh_.position(mesh_.face_vertices(f)[0])) / area;
  }

  // Height over the plane of f of the centre of the tetrahedron's sphere: of equal distance from a and the
  // apex.
  [[nodiscard]] double sphere_height(Face f, const Point& a, const Vector& foot, const Vector& n,
                                     double area) const {
    const Vector d = mesh_.position(mesh_.apex(f)) - a;
    return (dot(d, d) - 2 * dot(d, foot)) * area / (2 * dot(d, n));
  }

  bool try_insert(const Point& x, Tet start) {
    const RegionId region = region_of_[start];
    const Vertex p = mesh_.add_vertex(x);
    const Tet base = cavity_.locate(p, start);
    if (base == kNone || region_of_[base] != region || !is_far_from(p, vertices_round(base), region)) {
      mesh_.remove_last_vertex();
      return false;
    }
    const bool found = cavity_.find(p, base);
    if (!found || !is_far_from(p, cavity_.ring(), region) || is_near_a_facet(p) || is_near_beyond(p)) {
      wasted_ += cavity_.work();
      if (found) cavity_.abandon();
      mesh_.remove_last_vertex();
      return false;
    }
    size_.push_back(wanted_);
    cavity_.insert();
    for (const Tet t : cavity_.created()) {
      if (t >= state_.size()) {
        state_.resize(t + 1, 0);
        region_of_.resize(t + 1, kNone);
      }
      state_[t] = 0;
      region_of_[t] = region;
      if (is_large(t)) queue(t, kIsLarge);
    }
    // A neighbour may have come to be on the front.
    for (const PointCavity::Rim& rim : cavity_.rim()) {
      const Tet n = tet_of(rim.outer);
      if ((state_[n] & kIsLarge) != 0 && (rim.flags & facet_bit(3)) == 0 && (state_[n] & kQueued) == 0)
        queue(n, state_[n]);
    }
    return true;
  }

  // Of t and the tetrahedra next to it: to be too near to one of these saves finding the cavity.
  std::span<const Vertex> vertices_round(Tet t) {
    const auto& c = mesh_.corners(t);
    std::copy(c.begin(), c.end(), round_.begin());
    std::size_t count = c.size();
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      const Vertex v = mesh_.apex(mesh_.neighbour(f));
      if (!mesh_.is_facet(f) && v != kGhost) round_[count++] = v;
    }
    return {round_.data(), count};
  }

  // Whether p keeps its distance from these vertices. Leaves the size there in wanted_.
  bool is_far_from(Vertex p, std::span<const Vertex> vertices, RegionId region) {
    const Point& x = mesh_.position(p);
    double nearest = kInfinity;
    wanted_ = sizes_.limit(x, region);
    double mean = 0, weights = 0;  // of the sizes, the nearer the more
    for (const Vertex v : vertices) {
      const double d = distance(mesh_.position(v), x);
      nearest = std::min(nearest, d);
      wanted_ = std::min(wanted_, size_[v] + sizes_.gradation() * d);
      mean += size_[v] / d;
      weights += 1 / d;
    }
    if (!sizes_.grows() && weights > 0) wanted_ = std::min(wanted_, mean / weights);
    return nearest >= kNearest * wanted_;
  }

  // Where constraints cut the cavity, or the mesh is not Delaunay, a near vertex may stand just beyond it.
  [[nodiscard]] bool is_near_beyond(Vertex p) const {
    const double least = kNearest * wanted_;
    for (const PointCavity::Rim& rim : cavity_.rim()) {
      const Vertex v = mesh_.apex(rim.outer);
      if ((rim.flags & facet_bit(3)) == 0 && v != kGhost &&
          distance(mesh_.position(v), mesh_.position(p)) < least)
        return true;
    }
    return false;
  }

  [[nodiscard]] bool is_near_a_facet(Vertex p) const {
    for (const PointCavity::Rim& rim : cavity_.rim()) {
      if ((rim.flags & facet_bit(3)) == 0) continue;
      const Point& a = mesh_.position(rim.v[0]);
      const Vector n = cross(mesh_.position(rim.v[1]) - a, mesh_.position(rim.v[2]) - a);
      const double height = dot(n, mesh_.position(p) - a);
      if (height * height < kLeastHeight * kLeastHeight * wanted_ * wanted_ * dot(n, n)) return true;
    }
    return false;
  }

  TetMesh& mesh_;
  std::vector<RegionId>& region_of_;
  const std::vector<bool>& kept_;
  const SizeFunction& sizes_;
  Monitor& monitor_;
  PointCavity cavity_;
  std::vector<double> size_;         // by vertex
  std::vector<std::uint8_t> state_;  // by slot
  std::deque<Tet> front_;
  std::deque<Tet> rest_;  // large ones that the front did not get on with
  std::array<Vertex, 8> round_{};
  double wanted_ = 0;
  std::size_t wasted_ = 0;  // tetrahedra of cavities that were not filled
};

}  // namespace

std::vector<double> add_field_points(const FieldMesh& field, const SizeFunction& sizes, Monitor& monitor) {
  return FieldPoints(field, sizes, monitor).run();
}

}  // namespace holdfast
