#include "recover/standing.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/editor.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

std::size_t zeros(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{0}));
}

class Marker {
 public:
  Marker(TetMesh& mesh, const SegmentTable& table)
      : mesh_(mesh),
        table_(table),
        standing_{std::vector<std::uint8_t>(table.segments.size(), 0),
                  std::vector<std::uint8_t>(table.facet_segments.size(), 0)} {}

  Standing run(const Threads& threads) {
    parallel_ranges(threads, mesh_.slot_count(), [&](std::size_t first, std::size_t last) {
      for (auto t = static_cast<Tet>(first); t < last; ++t)
        if (mesh_.alive(t) && !mesh_.is_ghost(t)) mark(t);
    });
    return std::move(standing_);
  }

 private:
  void mark(Tet t) {
    Flags flags = 0;
    std::array<Index, 6> segment{};
    for (int k = 0; k < 6; ++k) {
      const auto& e = kEdgeVertex[static_cast<std::size_t>(k)];
      const Index s = table_.find(mesh_.corner(t, e[0]), mesh_.corner(t, e[1]));
      segment[static_cast<std::size_t>(k)] = s;
      if (s == no_index) continue;
      flags |= segment_bit(k);
      stands(standing_.segments[s]);
    }
    for (int i = 0; i < 4; ++i) {
      const auto& v = kFaceVertex[static_cast<std::size_t>(i)];
      const auto side = [&](std::size_t a, std::size_t b) {
        const auto from = static_cast<std::size_t>(v[a]), to = static_cast<std::size_t>(v[b]);
        return segment[static_cast<std::size_t>(kEdgeOf[from][to])];
      };
      const Index f = facet_between({side(0, 1), side(1, 2), side(2, 0)});
      if (f == no_index) continue;
      flags |= facet_bit(i);
      stands(standing_.facets[f]);
    }
    if (flags != 0) MeshEditor(mesh_).mark_constraints(t, flags);
  }

  // Threads share the flag, because several may look at its tetrahedra.
  // (std::atomic_ref, which libc++ lacks before version 19.)
  static void stands(std::uint8_t& flag) { __atomic_store_n(&flag, std::uint8_t{1}, __ATOMIC_RELAXED); }

  // The facet with these sides. It is looked for at the side with the fewest facets, because some sides have
  // thousands. Two sides identify a facet.
  [[nodiscard]] Index facet_between(std::array<Index, 3> sides) const {
    if (std::find(sides.begin(), sides.end(), no_index) != sides.end()) return no_index;
    const auto count = [&](std::size_t k) { return table_.facets_of(sides[k]).size(); };
    std::size_t least = count(1) < count(0) ? 1 : 0;
    if (count(2) < count(least)) least = 2;
    const Index other = sides[(least + 1) % 3];
    for (const Index f : table_.facets_of(sides[least])) {
      const auto& of_facet = table_.facet_segments[f];
      if (of_facet[0] == other || of_facet[1] == other || of_facet[2] == other) return f;
    }
    return no_index;
  }

  TetMesh& mesh_;
  const SegmentTable& table_;
  Standing standing_;
};

}  // namespace

std::size_t Standing::missing_segments() const { return zeros(segments); }
std::size_t Standing::missing_facets() const { return zeros(facets); }

Standing mark_present(TetMesh& mesh, const SegmentTable& table, const Threads& threads) {
  Standing standing = Marker(mesh, table).run(threads);
  MeshEditor(mesh).finish();
  return standing;
}

}  // namespace holdfast
