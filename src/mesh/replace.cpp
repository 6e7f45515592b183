#include "mesh/replace.h"

#include <algorithm>
#include <cstddef>
#include <memory_resource>
#include <stdexcept>
#include <utility>

#include "mesh/validate.h"

namespace holdfast {
namespace {

using FaceKey = std::array<Vertex, 3>;
using EdgeKey = std::array<Vertex, 2>;

FaceKey sorted(FaceKey k) {
  if (k[0] > k[1]) std::swap(k[0], k[1]);
  if (k[1] > k[2]) std::swap(k[1], k[2]);
  if (k[0] > k[1]) std::swap(k[0], k[1]);
  return k;
}
EdgeKey sorted(EdgeKey k) {
  if (k[0] > k[1]) std::swap(k[0], k[1]);
  return k;
}

FaceKey face_key(const TetMesh::Corners& c, int i) {
  const auto& k = kFaceVertex[static_cast<std::size_t>(i)];
  return sorted(FaceKey{c[static_cast<std::size_t>(k[0])], c[static_cast<std::size_t>(k[1])],
                        c[static_cast<std::size_t>(k[2])]});
}

// Memory of one replacement: flips are many and small, and fit the stack.
class Scratch {
 public:
  std::pmr::memory_resource* memory() { return &memory_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, 6144> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
};

// Constraint bits that stood in the cavity, and those that the caller adds.
struct Constraints {
  std::pmr::vector<FaceKey> facets;
  std::pmr::vector<EdgeKey> segments;

  Constraints(const TetMesh& mesh, const Replacement& r, std::pmr::memory_resource* memory)
      : facets(memory), segments(memory) {
    for (const Tet t : r.old_tets) {
      const Flags f = mesh.flags(t);
      if ((f & (kFacetBits | kSegmentBits)) == 0) continue;
      for (int i = 0; i < 4; ++i)
        if ((f & facet_bit(i)) != 0) facets.push_back(face_key(mesh.corners(t), i));
      for (int k = 0; k < 6; ++k)
        if ((f & segment_bit(k)) != 0) {
          const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
          segments.push_back(sorted(EdgeKey{mesh.corner(t, e[0]), mesh.corner(t, e[1])}));
        }
    }
    for (const auto& f : r.facets) facets.push_back(sorted(f));
    for (const auto& e : r.segments) segments.push_back(sorted(e));
    tidy(facets);
    tidy(segments);
  }
  [[nodiscard]] Flags bits(const TetMesh::Corners& c) const {
    unsigned bits = 0;
    if (!facets.empty())
      for (int i = 0; i < 4; ++i)
        if (std::binary_search(facets.begin(), facets.end(), face_key(c, i))) bits |= facet_bit(i);
    if (!segments.empty())
      for (int k = 0; k < 6; ++k) {
        const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
        const EdgeKey key =
            sorted(EdgeKey{c[static_cast<std::size_t>(e[0])], c[static_cast<std::size_t>(e[1])]});
        if (std::binary_search(segments.begin(), segments.end(), key)) bits |= segment_bit(k);
      }
    return static_cast<Flags>(bits);
  }

 private:
  template <typename Keys>
  static void tidy(Keys& keys) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  }
};

[[noreturn]] void mismatch() { throw std::logic_error("holdfast: a cavity's new tetrahedra do not fill it"); }

// Faces of the cavity and of what fills it: codes of the mesh, or of the new tetrahedra by their numbers.
constexpr Face kNewFace = 0x80000000u;

// Pairs every face of the new tetrahedra with its partner before anything is changed: an outer face of the
// cavity, or another new one.
class FaceMatcher {
 public:
  FaceMatcher(TetMesh& mesh, const Replacement& r, std::pmr::memory_resource* memory)
      : mesh_(mesh), r_(r), outer_(memory), slots_(memory), links_(r.new_tets.size(), memory) {
    outer_.reserve(2 * r.old_tets.size() + 2);
    std::size_t n = 16;
    while (n < 3 * (r.old_tets.size() + r.new_tets.size())) n *= 2;
    slots_.resize(n);
  }

  std::pmr::vector<TetMesh::Neighbours> links() {
    list_outer_faces();
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
    return std::move(links_);
  }

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
  void list_outer_faces() {
    for (const Tet t : r_.old_tets) mesh_.set_flags(t, kVisited);
    for (const Tet t : r_.old_tets) {
      const Marks marks = marks_of(mesh_.corners(t));
      for (int i = 0; i < 4; ++i) {
        const Face across = mesh_.neighbour(t, i);
        if ((mesh_.flags(tet_of(across)) & kVisited) == 0)
          outer_.push_back({marks[static_cast<std::size_t>(i)], across});
      }
    }
    for (const Tet t : r_.old_tets) mesh_.clear_flags(t, kVisited);
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
  std::pmr::vector<OuterFace> outer_;
  std::pmr::vector<Slot> slots_;
  std::pmr::vector<TetMesh::Neighbours> links_;  // by new tetrahedron
  std::size_t distinct_ = 0, open_ = 0;          // faces met, and those without a partner yet
};

}  // namespace

void replace(TetMesh& mesh, const Replacement& r, std::vector<Tet>* created) {
  Scratch scratch;
  const std::pmr::vector<TetMesh::Neighbours> links = FaceMatcher(mesh, r, scratch.memory()).links();
  const Constraints constraints(mesh, r, scratch.memory());

  for (const Tet t : r.old_tets)
    for (const Vertex v : mesh.corners(t))
      if (v != kGhost) mesh.set_incident(v, kNone);
  for (const Tet t : r.old_tets) mesh.remove_tet(t);
  std::vector<Tet> local;
  std::vector<Tet>& tets = created != nullptr ? *created : local;
  const std::size_t first = tets.size();
  for (const TetMesh::Corners& c : r.new_tets) {
    const Tet t = mesh.add_tet(c);
    tets.push_back(t);
    mesh.set_flags(t, constraints.bits(c));
    for (const Vertex v : c)
      if (v != kGhost) mesh.set_incident(v, t);
  }
  for (std::size_t n = 0; n < r.new_tets.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      const Face code = links[n][static_cast<std::size_t>(i)];
      const Face mine = face_code(tets[first + n], i);
      const Face partner =
          (code & kNewFace) == 0 ? code : face_code(tets[first + ((code & ~kNewFace) >> 2)], side_of(code));
      mesh.link(mine, partner);
    }
  validate_after_operation(mesh, std::span(tets).subspan(first));
}

}  // namespace holdfast
