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

std::size_t hash(const FaceKey& k) {
  std::uint64_t h = k[0] * 0x9E3779B97F4A7C15ull;
  h = (h ^ (h >> 29) ^ k[1]) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 31) ^ k[2]) * 0x94D049BB133111EBull;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

// Memory of one replacement: flips are many and small, and fit the stack.
class Scratch {
 public:
  std::pmr::memory_resource* memory() { return &memory_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, 6144> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
};

// A small open-addressing map from a face to one of its codes: "new" codes index new_tets, "outer"
// codes are faces of the mesh outside the cavity.
class FaceTable {
 public:
  struct Entry {
    FaceKey key{kNone, kNone, kNone};
    Face code = kNone;
    bool outer = false;
    bool matched = false;
  };
  FaceTable(std::size_t faces, std::pmr::memory_resource* memory) : slots_(memory) {
    std::size_t n = 16;
    while (2 * n < 3 * faces) n *= 2;
    slots_.resize(n);
  }
  // The entry of a key, fresh if its code is kNone.
  Entry& operator[](const FaceKey& key) {
    std::size_t h = hash(key) & (slots_.size() - 1);
    while (slots_[h].key[0] != kNone && slots_[h].key != key) h = (h + 1) & (slots_.size() - 1);
    slots_[h].key = key;
    return slots_[h];
  }
  [[nodiscard]] const std::pmr::vector<Entry>& entries() const { return slots_; }

 private:
  std::pmr::vector<Entry> slots_;
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

constexpr Face kNewFace = 0x80000000u;  // in `links`: a code that indexes new_tets

[[noreturn]] void mismatch() { throw std::logic_error("holdfast: a cavity's new tetrahedra do not fill it"); }

struct OuterFace {
  FaceKey key;
  Face across;
};

// The faces of the cavity, in a mesh that is left as it was.
std::pmr::vector<OuterFace> outer_faces(TetMesh& mesh, std::span<const Tet> tets,
                                        std::pmr::memory_resource* memory) {
  std::pmr::vector<OuterFace> faces(memory);
  faces.reserve(2 * tets.size() + 2);
  for (const Tet t : tets) mesh.set_flags(t, kVisited);
  for (const Tet t : tets)
    for (int i = 0; i < 4; ++i) {
      const Face g = mesh.neighbour(t, i);
      if ((mesh.flags(tet_of(g)) & kVisited) == 0) faces.push_back({face_key(mesh.corners(t), i), g});
    }
  for (const Tet t : tets) mesh.clear_flags(t, kVisited);
  return faces;
}

// Pairs every face of the new tetrahedra with its partner before anything is changed.
std::pmr::vector<TetMesh::Neighbours> match_faces(TetMesh& mesh, const Replacement& r,
                                                  std::pmr::memory_resource* memory) {
  const std::pmr::vector<OuterFace> outer = outer_faces(mesh, r.old_tets, memory);
  if (outer.size() > 4 * r.new_tets.size()) mismatch();
  // Each face of a new tetrahedron is an outer one or shared by two.
  FaceTable table((outer.size() + 4 * r.new_tets.size()) / 2, memory);
  for (const OuterFace& f : outer) {
    FaceTable::Entry& e = table[f.key];
    e.code = f.across;
    e.outer = true;
  }

  std::size_t distinct = outer.size();
  std::pmr::vector<TetMesh::Neighbours> links(r.new_tets.size(), memory);
  for (std::size_t n = 0; n < r.new_tets.size(); ++n)
    for (int i = 0; i < 4; ++i) {
      FaceTable::Entry& e = table[face_key(r.new_tets[n], i)];
      const auto self = static_cast<Face>(4 * n + static_cast<std::size_t>(i));
      Face& mine = links[n][static_cast<std::size_t>(i)];
      if (e.code == kNone) {
        if (2 * ++distinct > outer.size() + 4 * r.new_tets.size()) mismatch();
        e.code = self;
      } else if (e.matched) {
        mismatch();
      } else {
        e.matched = true;
        if (e.outer) {
          mine = e.code;
        } else {
          mine = e.code | kNewFace;
          links[e.code >> 2][e.code & 3u] = self | kNewFace;
        }
      }
    }
  for (const FaceTable::Entry& e : table.entries())
    if (e.code != kNone && !e.matched) mismatch();
  return links;
}

}  // namespace

void replace(TetMesh& mesh, const Replacement& r, std::vector<Tet>* created) {
  Scratch scratch;
  const std::pmr::vector<TetMesh::Neighbours> links = match_faces(mesh, r, scratch.memory());
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
