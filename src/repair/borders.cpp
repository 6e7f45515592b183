#include "repair/borders.h"

#include <algorithm>
#include <map>

#include "numbers/sorted.h"
#include "surface/complex.h"

namespace holdfast::repairing {
namespace {

/// Border sides, each directed against its facet, as the hole's border runs.
class Borders {
 public:
  explicit Borders(const Complex& surface) {
    const SegmentTable table = segment_table(surface);
    for (Index s = 0; s < table.segments.size(); ++s) {
      if (table.facets_of(s).size() != 1) continue;
      const Triangle& t = surface.facets[table.facets_of(s)[0]];
      for (std::size_t i = 0; i < 3; ++i) {
        const Segment side{t[(i + 1) % 3], t[i]};
        if (ascending(side) != ascending(Segment(table.segments[s]))) continue;
        at_[side[0]].push_back(static_cast<Index>(sides_.size()));
        at_[side[1]].push_back(static_cast<Index>(sides_.size()));
        sides_.push_back(side);
      }
    }
    used_.assign(sides_.size(), 0);
  }

  /// Every side is in at most one loop, and no loop visits a vertex twice.
  [[nodiscard]] std::vector<Loop> loops() {
    std::vector<Loop> found;
    for (Index s = 0; s < sides_.size(); ++s) {
      if (used_[s] != 0) continue;
      used_[s] = 1;
      Loop path{sides_[s][0]};
      Index at = sides_[s][1];
      for (;;) {
        if (const auto before = std::find(path.begin(), path.end(), at); before != path.end()) {
          found.emplace_back(before, path.end());
          path.erase(before, path.end());
        }
        path.push_back(at);
        const Index next = next_from(at);
        if (next == no_index) break;
        used_[next] = 1;
        at = sides_[next][0] == at ? sides_[next][1] : sides_[next][0];
      }
    }
    std::erase_if(found, [](const Loop& loop) { return loop.size() < 3; });
    return found;
  }

 private:
  /// An unused side, preferably one that leaves the vertex.
  [[nodiscard]] Index next_from(Index v) const {
    Index next = no_index;
    for (const Index s : at_.at(v)) {
      if (used_[s] != 0) continue;
      if (sides_[s][0] == v) return s;
      if (next == no_index) next = s;
    }
    return next;
  }

  std::vector<Segment> sides_;
  std::map<Index, std::vector<Index>> at_;
  std::vector<std::uint8_t> used_;
};

}  // namespace

std::vector<Loop> border_loops(const Complex& surface) { return Borders(surface).loops(); }

}  // namespace holdfast::repairing
