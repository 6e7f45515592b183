#include "delaunay/number.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/large_array.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

// Corner i of a turned cell is corner kTurned[turn][i] of the original cell, and vice versa.
constexpr std::array<std::array<std::uint32_t, 4>, 3> kTurned{{{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}}};
constexpr std::array<std::array<std::uint32_t, 4>, 3> kTurnedFrom{{{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}}};

// The turn that makes the lowest of corners 1, 2, 3 corner 1. It has no branch, because the lowest corner is
// random.
std::uint32_t turn_of(const std::array<Vertex, 4>& v) {
  const Vertex lowest = std::min(v[1], std::min(v[2], v[3]));
  return static_cast<std::uint32_t>(v[2] == lowest) + 2 * static_cast<std::uint32_t>(v[3] == lowest);
}

std::array<std::uint32_t, 4> turned(const std::array<std::uint32_t, 4>& a, std::uint32_t turn) {
  const auto& k = kTurned[turn];
  return {a[k[0]], a[k[1]], a[k[2]], a[k[3]]};
}

// Cells with a common highest vertex, as they are sorted: by corners alone, or with all their data.
using BareCell = std::array<Vertex, 4>;
struct FullCell {
  std::array<Vertex, 4> v;
  std::array<Face, 4> n;
  std::uint32_t origin;  // 4 * slot + turn
};

const std::array<Vertex, 4>& corners_of(const BareCell& cell) { return cell; }
const std::array<Vertex, 4>& corners_of(const FullCell& cell) { return cell.v; }
void set(BareCell& out, const Cell& cell, Tet, std::uint32_t turn) { out = turned(cell.v, turn); }
void set(FullCell& out, const Cell& cell, Tet slot, std::uint32_t turn) {
  out = {turned(cell.v, turn), turned(cell.n, turn), slot << 2 | turn};
}

// Two cells with common corners 0, 1, 2 turn in opposite ways round that face, so the second one has these
// corners in another order.
template <class C>
std::uint64_t key_of(const C& cell) {
  return std::uint64_t{corners_of(cell)[1]} << 32 | corners_of(cell)[2];
}

// Half of the cells may share one vertex of the box.
template <class C>
void sort_many_cells(C* first, C* last, const Threads& threads) {
  constexpr std::ptrdiff_t kAtOnce = 1 << 15;  // some milliseconds' work
  const auto less = [](const C& a, const C& b) { return key_of(a) < key_of(b); };
  for (; last - first > kAtOnce; threads.poll()) {
    C* const middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, less);
    sort_many_cells(first, middle, threads);
    first = middle;
  }
  std::sort(first, last, less);
}

template <class C>
void sort_cells(C* first, C* last, const Threads& threads) {
  constexpr std::ptrdiff_t kMany = 32;
  if (last - first > kMany) return sort_many_cells(first, last, threads);
  for (C* i = first + 1; i < last; ++i) {
    const C cell = *i;
    const std::uint64_t key = key_of(cell);
    C* j = i;
    for (; j > first && key < key_of(j[-1]); --j) *j = j[-1];
    *j = cell;
  }
}

// Sorts the cells by vertices; cells with the same highest vertex are adjacent.
template <class C>
class Numbering {
 public:
  Numbering(Triangulation& triangulation, const Threads& threads)
      : triangulation_(triangulation), threads_(threads) {
    cells_.resize(make_room());
    triangulation.drop_sites();
    distribute();
    triangulation.cells().clear();
  }

  /// Number of cells without the ghost.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The ghosts, in no order.
  [[nodiscard]] std::vector<C>& ghosts() { return ghosts_; }

  /// Calls put(place, cell) for every cell without the ghost.
  template <class Put>
  void for_each(const Put& put) {
    const std::size_t parts = parts_of(size());
    std::vector<std::size_t> starts(parts + 1, size());
    for (std::size_t part = 0; part < parts; ++part) starts[part] = start_of_run(size() * part / parts);
    parallel(threads_, parts, [&](std::size_t part) {
      // Another thread is sorting the cells beyond this part.
      const std::size_t last = starts[part + 1];
      std::size_t poll_at = starts[part] + kPollCells;
      for (std::size_t place = starts[part]; place < last;) {
        if (place >= poll_at) {
          threads_.poll();
          poll_at = place + kPollCells;
        }
        const std::size_t end = end_of_run(place, last);
        sort_cells(&cells_[place], &cells_[end], threads_);
        for (; place < end; ++place) put(place, cells_[place]);
      }
    });
  }

 private:
  static constexpr std::size_t kPollCells = std::size_t{1} << 15;  // some milliseconds' work

  // The number of parts into which so many cells are cut, one part per thread.
  [[nodiscard]] std::size_t parts_of(std::size_t cells) const {
    constexpr std::size_t kLeastPart = 8192;  // cells that are worth a thread
    return std::clamp<std::size_t>(cells / kLeastPart, 1, threads_.count());
  }

  // Computes the place of each vertex's cells, and the number of all cells.
  std::size_t make_room() {
    const Triangulation::Site* const sites = triangulation_.sites();
    const std::size_t vertices = triangulation_.size();
    front_.resize(vertices);
    if (threads_.count() > 1) back_.resize(vertices);
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
      front_[v] = sum;
      sum += sites[v].cells;
      if (threads_.count() > 1) back_[v] = sum;
    }
    return sum;
  }

  // Puts every cell next to the others with the same highest vertex. Two threads fill the room of a vertex
  // from its two ends. A counter for more threads would have to be atomic: then the processor cannot wait for
  // several cells at once, and two threads take as long as one.
  void distribute() {
    const std::size_t count = triangulation_.cells().size();
    const std::size_t parts = std::min<std::size_t>(parts_of(count), 2);
    std::array<std::vector<C>, 2> ghosts;
    parallel(threads_, parts, [&](std::size_t part) {
      const std::size_t first = count * part / parts, last = count * (part + 1) / parts;
      if (part == 0)
        distribute(first, last, ghosts[0], [&](Vertex v) { return front_[v]++; });
      else
        distribute(first, last, ghosts[1], [&](Vertex v) { return --back_[v]; });
    });
    ghosts_ = std::move(ghosts[0]);
    ghosts_.insert(ghosts_.end(), ghosts[1].begin(), ghosts[1].end());
  }

  template <class NextPlace>
  void distribute(std::size_t first, std::size_t last, std::vector<C>& ghosts, const NextPlace& next_place) {
    constexpr std::size_t kBlock = (std::size_t{1} << 21) / sizeof(Cell);
    // Each of the first cells may be the first on its huge page, which the system clears.
    constexpr std::size_t kFirstCells = std::size_t{1} << 16, kPolledFirst = 16, kPolled = 256;
    LargeArray<Cell>& cells = triangulation_.cells();
    const Vertex ghost = triangulation_.ghost();
    for (std::size_t t = first; t < last; ++t) {
      const Cell& cell = cells[t];
      if (std::signbit(cell.reach)) continue;
      const auto slot = static_cast<Tet>(t);
      if (cell.v[3] == ghost)
        set(ghosts.emplace_back(), cell, slot, 0);
      else
        set(cells_[next_place(cell.v[0])], cell, slot, turn_of(cell.v));
      if ((t + 1 - first) % (t - first < kFirstCells ? kPolledFirst : kPolled) == 0) threads_.poll();
      if ((t + 1 - first) % kBlock == 0) give_back(&cells[t + 1 - kBlock], kBlock * sizeof(Cell));
    }
  }

  [[nodiscard]] Vertex highest(std::size_t place) const { return corners_of(cells_[place])[0]; }
  // The start of the first run of cells with one highest vertex at or after `place`.
  [[nodiscard]] std::size_t start_of_run(std::size_t place) const {
    return place == 0 || place == size() ? place : end_of_run(place - 1, size());
  }
  [[nodiscard]] std::size_t end_of_run(std::size_t place, std::size_t last) const {
    const Vertex v = highest(place);
    do ++place;
    while (place < last && highest(place) == v);
    return place;
  }

  Triangulation& triangulation_;
  const Threads threads_;
  LargeArray<std::uint32_t> front_, back_;  // first free place of a vertex; after the last one
  LargeArray<C> cells_;
  std::vector<C> ghosts_;
};

// Reserves room, so that changes of the mesh can add some slots without a copy of all.
template <class T>
std::vector<T> sized_vector(std::size_t size, const Threads& threads) {
  std::vector<T> vector;
  vector.reserve(size + size / 32);
  advise_huge_pages(vector.data(), size * sizeof(T));
  parallel_ranges(threads, size, [&](std::size_t first, std::size_t last) {
    populate(vector.data() + first, (last - first) * sizeof(T));
  });
  vector.resize(size);
  return vector;
}

}  // namespace

std::vector<Tetrahedron> finite_cells(Triangulation& triangulation, const Threads& threads) {
  Numbering<BareCell> numbering(triangulation, threads);
  auto tets = sized_vector<Tetrahedron>(numbering.size(), threads);
  const std::uint32_t* const point = triangulation.order().points.data();
  numbering.for_each([&](std::size_t place, const BareCell& v) {
    tets[place] = {point[v[0]], point[v[1]], point[v[2]], point[v[3]]};
  });
  return tets;
}

std::vector<TetMesh::Cell> all_cells(Triangulation& triangulation, const Threads& threads) {
  LargeArray<std::uint32_t> placed(triangulation.cells().size());  // by slot: 4 * place + turn
  Numbering<FullCell> numbering(triangulation, threads);
  std::vector<FullCell>& ghosts = numbering.ghosts();
  std::sort(ghosts.begin(), ghosts.end(), [](const FullCell& a, const FullCell& b) { return a.v < b.v; });

  const std::size_t size = numbering.size() + ghosts.size();
  auto out = sized_vector<TetMesh::Cell>(size, threads);
  const std::uint32_t* const point = triangulation.order().points.data();
  const Vertex ghost = triangulation.ghost();
  const auto put = [&](std::size_t place, const FullCell& cell) {
    const auto& v = cell.v;
    out[place] = {{point[v[0]], point[v[1]], point[v[2]], v[3] == ghost ? kGhost : point[v[3]]}, cell.n};
    placed[cell.origin >> 2] = static_cast<std::uint32_t>(place << 2) | (cell.origin & 3u);
  };
  numbering.for_each(put);
  for (std::size_t k = 0; k < ghosts.size(); ++k) put(numbering.size() + k, ghosts[k]);

  parallel_ranges(threads, size, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (Face& f : out[t].neighbours) {
        const std::uint32_t where = placed[tet_of(f)];
        f = (where & ~3u) | kTurnedFrom[where & 3u][f & 3u];
      }
  });
  return out;
}

}  // namespace holdfast
