#include "mesh/replace.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "mesh/editor.h"
#include "mesh/scratch.h"

namespace holdfast {
namespace {

using FaceKey = std::array<Vertex, 3>;
using EdgeKey = std::uint64_t;

FaceKey face_key(FaceKey k) {
  if (k[0] > k[1]) std::swap(k[0], k[1]);
  if (k[1] > k[2]) std::swap(k[1], k[2]);
  if (k[0] > k[1]) std::swap(k[0], k[1]);
  return k;
}
FaceKey face_key(const TetMesh::Corners& c, int i) {
  const auto& k = kFaceVertex[static_cast<std::size_t>(i)];
  return face_key({c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                   c[static_cast<std::size_t>(k[2])]});
}
EdgeKey edge_key(Vertex a, Vertex b) { return EdgeKey{std::min(a, b)} << 32 | std::max(a, b); }
EdgeKey edge_key(const TetMesh::Corners& c, int edge) {
  const auto& e = kEdgeVertex[static_cast<std::size_t>(edge)];
  return edge_key(c[static_cast<std::size_t>(e[0])], c[static_cast<std::size_t>(e[1])]);
}

// Constraints that stand inside a cavity or on its edges, and those that the caller adds. Facets on its
// faces are known to the tetrahedra outside.
class Constraints {
 public:
  explicit Constraints(Scratch& memory) : facets_(memory), segments_(memory) {}

  void add_facet(const FaceKey& key) { facets_.push_back(key); }
  void add_segment(EdgeKey key) {
    segments_.push_back(key);
    seen_ |= bit_of(key);
  }
  void add_segments_of(const TetMesh& mesh, Tet t) {
    const Flags f = mesh.flags(t);
    if ((f & kSegmentBits) == 0) return;
    for (int k = 0; k < 6; ++k)
      if ((f & segment_bit(k)) != 0) add_segment(edge_key(mesh.corners(t), k));
  }
  /// Once all are added.
  void tidy() {
    std::sort(facets_.begin(), facets_.end());
    std::sort(segments_.begin(), segments_.end());
    segments_.erase(std::unique(segments_.begin(), segments_.end()), segments_.end());
  }

  [[nodiscard]] Flags bits(const TetMesh::Corners& c) const {
    unsigned bits = 0;
    if (!facets_.empty())
      for (int i = 0; i < 4; ++i)
        if (std::binary_search(facets_.begin(), facets_.end(), face_key(c, i))) bits |= facet_bit(i);
    if (!segments_.empty())
      for (int k = 0; k < 6; ++k)
        if (holds_segment(edge_key(c, k))) bits |= segment_bit(k);
    return static_cast<Flags>(bits);
  }

 private:
  // One of 64 bits, so that few edges but segments are looked for in the list.
  static std::uint64_t bit_of(EdgeKey key) { return std::uint64_t{1} << (key * 0x9E3779B97F4A7C15ull >> 58); }
  [[nodiscard]] bool holds_segment(EdgeKey key) const {
    return (seen_ & bit_of(key)) != 0 && std::binary_search(segments_.begin(), segments_.end(), key);
  }

  ScratchVector<FaceKey> facets_;
  ScratchVector<EdgeKey> segments_;
  std::uint64_t seen_ = 0;
};

[[noreturn]] void mismatch() { throw std::logic_error("holdfast: a cavity's new tetrahedra do not fill it"); }

// Faces of the cavity and of what fills it: codes of the mesh, or of the new tetrahedra by their numbers.
constexpr Face kNewFace = 0x80000000u;

// Pairs every face of the new tetrahedra with its partner before anything is changed: an outer face of the
// cavity, or another new one. Notes the constraints on the way.
class Plan {
 public:
  Plan(TetMesh& mesh, const Replacement& r, Scratch& memory)
      : mesh_(mesh),
        r_(r),
        constraints_(memory),
        outer_(memory),
        slots_(memory),
        links_(r.new_tets.size(), memory) {
    outer_.reserve(2 * r.old_tets.size() + 2);
    std::size_t n = 16;
    while (n < 3 * (r.old_tets.size() + r.new_tets.size())) n *= 2;
    slots_.resize(n);
  }

  /// Throws where the faces do not match.
  void make() {
    look_at_cavity();
    for (const auto& f : r_.facets) constraints_.add_facet(face_key(f));
    for (const auto& e : r_.segments) constraints_.add_segment(edge_key(e[0], e[1]));
    constraints_.tidy();
    for (const OuterFace& f : outer_) static_cast<void>(partner_of(f.across, f.mark));
    for (std::size_t n = 0; n < r_.new_tets.size(); ++n) {
      const Marks marks = marks_of(r_.new_tets[n]);
      for (std::size_t i = 0; i < 4; ++i) {
        const Face mine = static_cast<Face>(4 * n + i) | kNewFace;
        const Face partner = partner_of(mine, marks[i]);
        links_[n][i] = partner;
        if (partner != kNone && (partner & kNewFace) != 0) link_of(partner) = mine;
      }
    }
    if (open_ != 0) mismatch();
  }

  /// By new tetrahedron.
  [[nodiscard]] const ScratchVector<TetMesh::Neighbours>& links() const { return links_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }

 private:
  using Marks = std::array<std::uint64_t, 4>;
  struct OuterFace {
    std::uint64_t mark;
    Face across;
  };
  struct Slot {
    std::uint64_t mark = 0;
    Face face = kNone;
    bool matched = false;
  };

  // Of the four faces: the same for the same three vertices, whatever their order, and nearly always another
  // for others.
  static Marks marks_of(const TetMesh::Corners& c) {
    const auto mixed = [](Vertex v) {
      const std::uint64_t h = (v + 1ull) * 0x9E3779B97F4A7C15ull;
      return h ^ (h >> 29);
    };
    const Marks of{mixed(c[0]), mixed(c[1]), mixed(c[2]), mixed(c[3])};
    const std::uint64_t all = of[0] + of[1] + of[2] + of[3];
    return {all - of[0], all - of[1], all - of[2], all - of[3]};
  }

  // In a mesh that is left as it was.
  void look_at_cavity() {
    for (const Tet t : r_.old_tets) mesh_.mark_visited(t);
    for (const Tet t : r_.old_tets) {
      const Marks marks = marks_of(mesh_.corners(t));
      for (int i = 0; i < 4; ++i) {
        const Face across = mesh_.neighbour(t, i);
        if ((mesh_.flags(tet_of(across)) & kVisited) == 0)
          outer_.push_back({marks[static_cast<std::size_t>(i)], across});
        else if (mesh_.is_facet(across))
          constraints_.add_facet(face_key(mesh_.corners(t), i));
      }
      constraints_.add_segments_of(mesh_, t);
    }
    for (const Tet t : r_.old_tets) mesh_.clear_visited(t);
  }

  // The face met before with the same vertices; none if this is the first.
  Face partner_of(Face face, std::uint64_t mark) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t h = (mark >> 32) & mask;; h = (h + 1) & mask) {
      Slot& slot = slots_[h];
      if (slot.face == kNone) {
        if (3 * ++distinct_ > 2 * slots_.size()) mismatch();
        slot = {mark, face, false};
        ++open_;
        return kNone;
      }
      if (slot.mark != mark || !are_same(slot.face, face)) continue;
      if (slot.matched) mismatch();
      slot.matched = true;
      --open_;
      return slot.face;
    }
  }

  [[nodiscard]] std::array<Vertex, 3> vertices_of(Face face) const {
    if ((face & kNewFace) == 0) return mesh_.face_vertices(face);
    const TetMesh::Corners& c = r_.new_tets[(face & ~kNewFace) >> 2];
    const auto& k = kFaceVertex[face & 3u];
    return {c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
            c[static_cast<std::size_t>(k[2])]};
  }
  [[nodiscard]] bool are_same(Face f, Face g) const {
    const auto x = vertices_of(f), y = vertices_of(g);
    return std::all_of(x.begin(), x.end(), [&](Vertex v) { return v == y[0] || v == y[1] || v == y[2]; });
  }
  Face& link_of(Face face) { return links_[(face & ~kNewFace) >> 2][face & 3u]; }

  TetMesh& mesh_;
  const Replacement& r_;
  Constraints constraints_;
  ScratchVector<OuterFace> outer_;
  ScratchVector<Slot> slots_;
  ScratchVector<TetMesh::Neighbours> links_;
  std::size_t distinct_ = 0, open_ = 0;  // faces met, and those without a partner yet
};

}  // namespace

void replace(TetMesh& mesh, const Replacement& r, std::vector<Tet>* created) {
  Scratch scratch;
  Plan plan(mesh, r, scratch);
  plan.make();

  MeshEditor editor(mesh);
  for (const Tet t : r.old_tets)
    for (const Vertex v : mesh.corners(t))
      if (v != kGhost) editor.set_incident(v, kNone);
  for (const Tet t : r.old_tets) editor.remove_tet(t);
  std::vector<Tet> local;
  std::vector<Tet>& tets = created != nullptr ? *created : local;
  const std::size_t first = tets.size();
  for (const TetMesh::Corners& c : r.new_tets) {
    const Tet t = editor.add_tet(c);
    tets.push_back(t);
    editor.set_flags(t, plan.constraints().bits(c));
    for (const Vertex v : c)
      if (v != kGhost) editor.set_incident(v, t);
  }
  for (std::size_t n = 0; n < r.new_tets.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      const Face code = plan.links()[n][static_cast<std::size_t>(i)];
      const Tet t = tets[first + n];
      if ((code & kNewFace) != 0) {
        editor.link(face_code(t, i), face_code(tets[first + ((code & ~kNewFace) >> 2)], side_of(code)));
      } else {
        editor.link(face_code(t, i), code);
        if (mesh.is_facet(code)) editor.set_flags(t, facet_bit(i));
      }
    }
  editor.finish(std::span(tets).subspan(first));
}

}  // namespace holdfast
