#include "recover/facet_cavities.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "delaunay/delaunay.h"
#include "mesh/editor.h"
#include "mesh/keys.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "recover/far_points.h"
#include "recover/insert_vertex.h"
#include "recover/recover.h"
#include "recover/standing.h"
#include "recover/tuning.h"
#include "surface/complex.h"

namespace holdfast {
namespace {

using FaceCorners = std::array<Vertex, 3>;
using Tell = std::function<void()>;

// Tetrahedra that fill a cavity, and the points added for them: vertex kAdded + k is the k-th point.
struct Filling {
  static constexpr Vertex kAdded = 0x80000000u;
  std::vector<TetMesh::Corners> tets;
  std::vector<exact::ExactPoint> points;

  void append(const Filling& other) {
    const auto offset = static_cast<Vertex>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (TetMesh::Corners t : other.tets) {
      for (Vertex& v : t)
        if (v >= kAdded) v += offset;
      tets.push_back(t);
    }
  }
};

// One of the two cavities. Seen from its inside, the corners of its faces turn counterclockwise.
class Cavity {
 public:
  Cavity(const TetMesh& mesh, const FaceCorners& facet) : mesh_(mesh), facet_(facet) {}

  void add_vertex(Vertex v) { vertices_.push_back(v); }
  void add_face(Face f) {
    faces_.emplace(face_key(mesh_.face_vertices(f)), Outer{mesh_.face_vertices(f), mesh_.neighbour(f)});
  }
  // Adds a facet or segment that the cavity may contain: one that does not meet the facet to be recovered.
  void add_inner_facet(const FaceCorners& f) { inner_facets_.push_back(f); }
  void add_inner_segment(const Segment& s) { inner_segments_.push_back(s); }

  // Adds the tetrahedra behind the faces that no filling had. `taken` holds the tetrahedra of both cavities.
  // Returns whether any was added.
  bool grow(std::unordered_set<Tet>& taken) {
    bool grown = false;
    for (const FaceCorners& f : missing_) {
      const auto it = faces_.find(face_key(f));
      if (it != faces_.end()) grown |= take(tet_of(it->second.across), taken);
    }
    return grown;
  }
  [[nodiscard]] const std::vector<Tet>& grown() const { return grown_; }

  // Positive tetrahedra that fill the cavity, or nothing; then `missing_` holds the faces that could not be
  // recovered.
  std::optional<Filling> fill(std::uint64_t seed, const FacetCavities::Finish& finish, const Tell& tell) {
    missing_.clear();
    sort_unique(vertices_);
    const Local local(*this);
    const Complex complex{local.points, local.facets, local.segments, {}, {}};
    const SegmentTable table = segment_table(complex);
    TetMesh mesh;
    if (!triangulate(far_points(local.points, local.facets.front()), seed, mesh)) {
      mesh = {};
      if (!triangulate(far_points_all_round(local.points, local.facets.front()), seed, mesh))
        return std::nullopt;
    }
    const auto first_free = static_cast<Vertex>(mesh.vertex_count());
    tell();
    Standing standing = mark_present(mesh, table);
    const ConstraintSet constraints{table, local.facets, standing};
    FlipRecovery(mesh, constraints, seed).run([&](double) { tell(); }, tuning::kCavityPasses);
    const auto all_stands = [&] { return standing.missing_facets() + standing.missing_segments() == 0; };
    if (!all_stands() && finish) finish(mesh, constraints, first_free);
    if (all_stands()) return inside_of(mesh, first_free, seed);
    for (Index f = 0; f < local.facets.size(); ++f)
      if (standing.facets[f] == 0) missing_.push_back(global(local.facets[f]));
    return std::nullopt;
  }

 private:
  struct Outer {
    FaceCorners corners;
    Face across;
  };
  struct FaceHash {
    std::size_t operator()(const FaceCorners& f) const {
      std::uint64_t h = f[0] * 0x9E3779B97F4A7C15ull;
      h = (h ^ (h >> 29) ^ f[1]) * 0xBF58476D1CE4E5B9ull;
      h = (h ^ (h >> 31) ^ f[2]) * 0x94D049BB133111EBull;
      return static_cast<std::size_t>(h ^ (h >> 30));
    }
  };

  // The cavity as a complex of its own, with the facet first.
  struct Local {
    std::vector<Point> points;
    std::vector<Triangle> facets;
    std::vector<Segment> segments;

    explicit Local(const Cavity& cavity) {
      for (const Vertex v : cavity.vertices_) points.push_back(cavity.mesh_.position(v));
      facets.push_back(cavity.local(cavity.facet_));
      for (const auto& [key, face] : cavity.faces_) facets.push_back(cavity.local(face.corners));
      std::sort(facets.begin() + 1, facets.end());
      for (const FaceCorners& f : cavity.inner_facets_)
        if (!cavity.faces_.contains(face_key(f))) facets.push_back(cavity.local(f));
      for (const Segment& s : cavity.inner_segments_)
        segments.push_back({cavity.local(s[0]), cavity.local(s[1])});
    }
  };

  // Makes Delaunay tetrahedra of the vertices that have doubles and of the far points. Then it inserts the
  // other vertices. Until then they stand at a corner of the facet, so that Delaunay leaves them out as
  // duplicates. Returns whether all vertices lie inside the hull, where constraints can be enforced.
  bool triangulate(const std::vector<Point>& far, std::uint64_t seed, TetMesh& mesh) const {
    for (const Vertex v : vertices_)
      MeshEditor(mesh).add_vertex(mesh_.position(mesh_.is_explicit(v) ? v : facet_[0]));
    for (const Point& p : far) MeshEditor(mesh).add_vertex(p);
    MeshEditor(mesh).set_grid(mesh_.grid());
    if (!build_delaunay(mesh, {seed}, nullptr) || !has_all_inside(mesh)) return false;
    auto random = static_cast<std::uint32_t>(seed);
    for (Vertex k = 0; k < vertices_.size(); ++k) {
      if (mesh_.is_explicit(vertices_[k])) continue;
      MeshEditor(mesh).move_vertex(k, mesh_.exact_position(vertices_[k]));
      if (!insert_vertex(mesh, k, random)) return false;
    }
    return has_all_inside(mesh);
  }

  // Whether the hull's vertices are far points alone.
  [[nodiscard]] bool has_all_inside(const TetMesh& mesh) const {
    for (Tet t = 0; t < mesh.slot_count(); ++t) {
      if (!mesh.alive(t) || !mesh.is_ghost(t)) continue;
      const TetMesh::Corners& c = mesh.corners(t);
      if (std::any_of(c.begin(), c.end(), [&](Vertex v) { return v < vertices_.size(); })) return false;
    }
    return true;
  }

  [[nodiscard]] Vertex local(Vertex v) const {
    return static_cast<Vertex>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  }
  [[nodiscard]] FaceCorners local(const FaceCorners& f) const {
    return {local(f[0]), local(f[1]), local(f[2])};
  }
  [[nodiscard]] FaceCorners global(const FaceCorners& f) const {
    return {vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]};
  }

  bool take(Tet t, std::unordered_set<Tet>& taken) {
    if (mesh_.is_ghost(t) || taken.contains(t)) return false;
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      if (mesh_.is_facet(f) && faces_.contains(face_key(mesh_.face_vertices(f)))) return false;
    }
    taken.insert(t);
    grown_.push_back(t);
    vertices_.insert(vertices_.end(), mesh_.corners(t).begin(), mesh_.corners(t).end());
    for (int k = 0; k < 6; ++k) {
      const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
      if (mesh_.is_segment(t, k)) add_inner_segment({mesh_.corner(t, e[0]), mesh_.corner(t, e[1])});
    }
    for (int i = 0; i < 4; ++i) {
      const Face f = face_code(t, i);
      if (faces_.erase(face_key(mesh_.face_vertices(f))) == 0) add_face(f);
    }
    return true;
  }

  // Searches from the facet through all faces except the cavity's own.
  [[nodiscard]] std::optional<Filling> inside_of(TetMesh& mesh, Vertex first_free, std::uint64_t seed) const {
    const auto is_boundary = [&](Face f) {
      if (!mesh.is_facet(f)) return false;
      const FaceCorners key = face_key(global(mesh.face_vertices(f)));
      return key == face_key(facet_) || faces_.contains(key);
    };
    const FaceCorners start = local(facet_);
    Random random(seed);
    Face f = Piercing(mesh, random).find_face(start[0], start[1], start[2]);
    if (f == kNone) return std::nullopt;
    if (mesh.orient(start[0], start[1], start[2], mesh.apex(f)) <= 0) f = mesh.neighbour(f);
    Filling filling;
    std::vector<Vertex> number(mesh.vertex_count() - first_free, kNone);
    const auto added_vertex = [&](Vertex v) {
      Vertex& n = number[v - first_free];
      if (n == kNone) {
        n = Filling::kAdded + static_cast<Vertex>(filling.points.size());
        filling.points.push_back(mesh.exact_position(v));
      }
      return n;
    };
    std::vector<Tet> stack{tet_of(f)};
    mesh.mark_visited(stack.front());
    while (!stack.empty()) {
      const Tet t = stack.back();
      stack.pop_back();
      TetMesh::Corners c = mesh.corners(t);
      for (Vertex& v : c) {
        const bool is_far = v >= vertices_.size() && v < first_free;
        if (is_far || v == kGhost) return std::nullopt;
        v = v < first_free ? vertices_[v] : added_vertex(v);
      }
      filling.tets.push_back(c);
      for (int i = 0; i < 4; ++i) {
        const Tet n = tet_of(mesh.neighbour(t, i));
        if ((mesh.flags(n) & kVisited) != 0 || is_boundary(face_code(t, i))) continue;
        mesh.mark_visited(n);
        stack.push_back(n);
      }
    }
    return filling;
  }

  const TetMesh& mesh_;
  const FaceCorners facet_;  // as seen from the cavity's inside
  std::vector<Vertex> vertices_;
  std::unordered_map<FaceCorners, Outer, FaceHash> faces_;  // without the facet
  std::vector<FaceCorners> inner_facets_;
  std::vector<Segment> inner_segments_;
  std::vector<Tet> grown_;
  std::vector<FaceCorners> missing_;
};

// The two cavities of a facet: above (from where its corners turn counterclockwise) and below.
class TwoCavities {
 public:
  TwoCavities(const TetMesh& mesh, const FaceCorners& facet, const std::vector<Tet>& crossing)
      : mesh_(mesh),
        facet_(facet),
        halves_{Cavity(mesh, facet), Cavity(mesh, {facet[0], facet[2], facet[1]})},
        taken_(crossing.begin(), crossing.end()) {}

  // Returns the vertices that lie in the facet. A tetrahedron's section is inside the facet
  // (docs/concepts.md), so all of its vertices in the plane are in the facet. If there are any, the cavities
  // cannot be filled.
  std::vector<Vertex> split(const std::vector<Tet>& crossing) {
    std::vector<Vertex> in_the_way;
    for (const Tet t : crossing) {
      std::array<int, 4> signs{};
      for (int i = 0; i < 4; ++i) {
        const Vertex v = mesh_.corner(t, i);
        const bool corner = v == facet_[0] || v == facet_[1] || v == facet_[2];
        const int s = corner ? 0 : mesh_.orient(facet_[0], facet_[1], facet_[2], v);
        if (s == 0 && !corner) in_the_way.push_back(v);
        signs[static_cast<std::size_t>(i)] = s;
        if (s >= 0) halves_[0].add_vertex(v);
        if (s <= 0) halves_[1].add_vertex(v);
      }
      for (int i = 0; i < 4; ++i) split_face(face_code(t, i), signs);
      for (int k = 0; k < 6; ++k) split_segment(t, k, signs);
    }
    sort_unique(in_the_way);
    return in_the_way;
  }

  std::optional<Filling> fill(std::uint64_t seed, const FacetCavities::Finish& finish, const Tell& tell) {
    Filling all;
    for (Cavity& half : halves_) {
      std::optional<Filling> filling;
      for (int round = 0; round <= tuning::kMostGrowth; ++round) {
        filling = half.fill(seed, finish, tell);
        if (filling || round == tuning::kMostGrowth || !half.grow(taken_)) break;
      }
      if (!filling) return std::nullopt;
      all.append(*filling);
    }
    return all;
  }

  [[nodiscard]] std::vector<Tet> tets() const {
    std::vector<Tet> all(taken_.begin(), taken_.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  // A face with vertices on both sides crosses the facet, so it lies inside the cavity.
  void split_face(Face f, const std::array<int, 4>& signs) {
    bool above = false, below = false;
    for (const int k : kFaceVertex[static_cast<std::size_t>(side_of(f))]) {
      above = above || signs[static_cast<std::size_t>(k)] > 0;
      below = below || signs[static_cast<std::size_t>(k)] < 0;
    }
    if (above == below) return;
    Cavity& half = halves_[above ? 0 : 1];
    if (!taken_.contains(tet_of(mesh_.neighbour(f))))
      half.add_face(f);
    else if (mesh_.is_facet(f) && f < mesh_.neighbour(f))
      half.add_inner_facet(mesh_.face_vertices(f));
  }

  void split_segment(Tet t, int edge, const std::array<int, 4>& signs) {
    if (!mesh_.is_segment(t, edge)) return;
    const auto& e = kEdgeVertex[static_cast<std::size_t>(edge)];
    const int sum = signs[static_cast<std::size_t>(e[0])] + signs[static_cast<std::size_t>(e[1])];
    if (sum != 0) halves_[sum > 0 ? 0 : 1].add_inner_segment({mesh_.corner(t, e[0]), mesh_.corner(t, e[1])});
  }

  const TetMesh& mesh_;
  const FaceCorners facet_;
  std::array<Cavity, 2> halves_;
  std::unordered_set<Tet> taken_;
};

}  // namespace

std::size_t FacetCavities::crossing(const FaceCorners& facet) {
  tets_.clear();
  piercing_.tets_across(facet, tets_);
  return tets_.size();
}

// If nothing crosses a missing facet next to its first side, a vertex lies in the facet there.
bool FacetCavities::list_coplanar(const FaceCorners& facet) {
  const auto [a, b, inside] = facet;
  tets_.clear();
  shell(mesh_, piercing_.find_edge(a, b), a, b, tets_);
  for (const Tet t : tets_)
    for (const Vertex v : mesh_.corners(t))
      if (v != kGhost && v != a && v != b && mesh_.orient(a, b, inside, v) == 0) in_the_way_.push_back(v);
  sort_unique(in_the_way_);
  return false;
}

bool FacetCavities::recover(const FaceCorners& facet, const Tell& tell, const Finish& finish) {
  tets_.clear();
  added_.clear();
  in_the_way_.clear();
  const std::optional<Face> face = piercing_.tets_across(facet, tets_);
  if (!face) return false;
  if (*face != kNone) {
    MeshEditor(mesh_).set_facet(*face);
    return true;
  }
  if (tets_.empty()) return list_coplanar(facet);
  TwoCavities cavities(mesh_, facet, tets_);
  in_the_way_ = cavities.split(tets_);
  if (!in_the_way_.empty()) return false;
  std::optional<Filling> filling = cavities.fill(random_(), finish, tell);
  if (!filling) return false;
  for (const exact::ExactPoint& p : filling->points) added_.push_back(MeshEditor(mesh_).add_vertex(p));
  for (TetMesh::Corners& t : filling->tets)
    for (Vertex& v : t)
      if (v >= Filling::kAdded) v = added_[v - Filling::kAdded];
  MeshEditor(mesh_).replace(
      {.old_tets = cavities.tets(), .new_tets = filling->tets, .facets = std::span(&facet, 1)});
  return true;
}

}  // namespace holdfast
