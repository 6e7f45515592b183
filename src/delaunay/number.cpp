#include "delaunay/number.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "delaunay/large_array.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

constexpr Vertex kChunk = 4096;  // vertices that are numbered by one thread in one go

// A cell of those with the same highest vertex. The lowest of its other corners and the one after that tell
// it from the rest: only two cells share a face, and they see it turn in different ways.
struct Member {
  std::uint64_t key;
  Tet slot;
  std::uint32_t turn;  // corner 1 + turn becomes corner 1
};

// Where a slot's cell goes and how it is turned, in 30 and 2 bits.
std::uint32_t packed(std::size_t place, std::uint32_t turn) {
  return static_cast<std::uint32_t>(place << 2 | turn);
}

// Corner i of a turned cell is corner kTurned[turn][i] of the cell in its slot.
constexpr std::array<std::array<std::uint32_t, 4>, 3> kTurned{{{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}}};
constexpr std::array<std::array<std::uint32_t, 4>, 3> kTurnedFrom{{{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}}};

class Numbering {
 public:
  Numbering(Triangulation& triangulation, unsigned threads, bool with_ghosts)
      : triangulation_(triangulation),
        threads_(threads),
        with_ghosts_(with_ghosts),
        first_(triangulation.size()),
        link_(triangulation.cells().size()),
        chunk_begin_(triangulation.size() / kChunk + 2) {
    group();
  }

  [[nodiscard]] std::size_t size() const { return chunk_begin_.back(); }

  /// Calls put(place, cell, turn) for every cell.
  template <class Put>
  void for_each(const Put& put) {
    const std::size_t parts = std::min<std::size_t>(threads_, chunk_begin_.size() - 1);
    parallel(threads_, parts, [&](std::size_t k) {
      const std::size_t chunks = chunk_begin_.size() - 1;
      number_chunks(chunks * k / parts, chunks * (k + 1) / parts, put);
    });
  }

  /// After for_each: a neighbour code, which names a slot, as the code that names a place.
  [[nodiscard]] Face placed(Face f) const {
    const std::uint32_t link = link_[tet_of(f)];
    return (link & ~3u) | kTurnedFrom[link & 3u][f & 3u];
  }

 private:
  // Chains the cells of each highest vertex through link_.
  void group() {
    const LargeArray<Cell>& cells = triangulation_.cells();
    const Vertex ghost = triangulation_.ghost();
    parallel_ranges(threads_, first_.size(), [&](std::size_t first, std::size_t last) {
      std::fill(first_.data() + first, first_.data() + last, kNone);
    });
    std::vector<std::atomic<std::size_t>> counts(chunk_begin_.size());
    parallel_ranges(threads_, cells.size(), [&](std::size_t first, std::size_t last) {
      std::vector<std::uint32_t> count(counts.size(), 0);
      for (std::size_t t = first; t < last; ++t) {
        const Cell& cell = cells[t];
        if (std::signbit(cell.reach) || (!with_ghosts_ && cell.v[3] == ghost)) continue;
        ++count[cell.v[0] / kChunk + 1];
        link_[t] = chain(cell.v[0], static_cast<Tet>(t));
      }
      for (std::size_t k = 0; k < count.size(); ++k) counts[k] += count[k];
    });
    for (std::size_t k = 1; k < chunk_begin_.size(); ++k) chunk_begin_[k] = chunk_begin_[k - 1] + counts[k];
  }

  Tet chain(Vertex v, Tet t) {
    if (threads_ == 1) return std::exchange(first_[v], t);
    return std::atomic_ref(first_[v]).exchange(t, std::memory_order_relaxed);
  }

  template <class Put>
  void number_chunks(std::size_t first, std::size_t last, const Put& put) {
    constexpr std::size_t kAhead = 8;
    const Cell* const cells = triangulation_.cells().data();
    std::vector<Member> members;
    const std::size_t end = std::min(first_.size(), last * kChunk);
    std::size_t place = chunk_begin_[first];
    for (std::size_t v = first * kChunk; v < end; ++v) {
      if (v + kAhead < end && first_[v + kAhead] != kNone) __builtin_prefetch(&cells[first_[v + kAhead]]);
      members.clear();
      for (Tet t = first_[v]; t != kNone; t = link_[t]) members.push_back(member(cells[t], t));
      std::sort(members.begin(), members.end(),
                [](const Member& a, const Member& b) { return a.key < b.key; });
      for (const Member& m : members) {
        link_[m.slot] = packed(place, m.turn);
        put(place, cells[m.slot], kTurned[m.turn]);
        ++place;
      }
    }
  }

  [[nodiscard]] Member member(const Cell& cell, Tet t) const {
    const auto& v = cell.v;
    std::uint32_t turn = 0;
    if (v[3] != triangulation_.ghost()) turn = v[1] < v[2] ? (v[1] < v[3] ? 0 : 2) : (v[2] < v[3] ? 1 : 2);
    const auto& order = kTurned[turn];
    return {std::uint64_t{v[order[1]]} << 32 | v[order[2]], t, turn};
  }

  Triangulation& triangulation_;
  const unsigned threads_;
  const bool with_ghosts_;
  LargeArray<std::uint32_t> first_;  // slot of the first cell of a vertex, or kNone
  LargeArray<std::uint32_t> link_;   // slot of the next one; in the end place and turn
  std::vector<std::size_t> chunk_begin_;
};

// A vector whose memory several threads have taken from the system.
template <class T>
std::vector<T> sized_vector(std::size_t size, unsigned threads) {
  std::vector<T> vector;
  vector.reserve(size);
  advise_huge_pages(vector.data(), size * sizeof(T));
  if (threads > 1)
    parallel_ranges(threads, size, [&](std::size_t first, std::size_t last) {
      populate(vector.data() + first, (last - first) * sizeof(T));
    });
  vector.resize(size);
  return vector;
}

}  // namespace

std::vector<Tetrahedron> finite_cells(Triangulation& triangulation, unsigned threads) {
  Numbering numbering(triangulation, threads, false);
  auto tets = sized_vector<Tetrahedron>(numbering.size(), threads);
  const std::uint32_t* const point = triangulation.order().points.data();
  numbering.for_each([&](std::size_t place, const Cell& cell, const auto& turned) {
    for (std::size_t i = 0; i < 4; ++i) tets[place][i] = point[cell.v[turned[i]]];
  });
  return tets;
}

NumberedCells all_cells(Triangulation& triangulation, unsigned threads) {
  Numbering numbering(triangulation, threads, true);
  NumberedCells out;
  out.corners = sized_vector<TetMesh::Corners>(numbering.size(), threads);
  out.neighbours = sized_vector<TetMesh::Neighbours>(numbering.size(), threads);
  const std::uint32_t* const point = triangulation.order().points.data();
  const Vertex ghost = triangulation.ghost();
  numbering.for_each([&](std::size_t place, const Cell& cell, const auto& turned) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vertex v = cell.v[turned[i]];
      out.corners[place][i] = v == ghost ? kGhost : point[v];
      out.neighbours[place][i] = cell.n[turned[i]];
    }
  });
  triangulation.cells().clear();
  parallel_ranges(threads, numbering.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (Face& f : out.neighbours[t]) f = numbering.placed(f);
  });
  return out;
}

}  // namespace holdfast
