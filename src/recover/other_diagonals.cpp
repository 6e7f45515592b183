#include "recover/other_diagonals.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/traverse.h"
#include "surface/intersect.h"

namespace holdfast {
namespace {

/// A missing segment and the diagonal that the mesh has instead, lesser end first.
struct Exchange {
  std::pair<Vertex, Vertex> diagonal;
  Index segment;
};

class Diagonals {
 public:
  Diagonals(TetMesh& mesh, const Complex& complex, const SegmentTable& table, const Standing& standing)
      : mesh_(mesh), complex_(complex), table_(table), standing_(standing) {}

  Standing run() {
    std::vector<Exchange> found;
    for (Index s = 0; s < table_.segments.size(); ++s)
      if (const auto exchange = exchange_of(s)) found.push_back(*exchange);
    std::sort(found.begin(), found.end(),
              [](const Exchange& a, const Exchange& b) { return a.diagonal < b.diagonal; });
    Standing result = standing_;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto& cd = found[k].diagonal;
      if ((k > 0 && found[k - 1].diagonal == cd) || (k + 1 < found.size() && found[k + 1].diagonal == cd))
        continue;
      const Index s = found[k].segment;
      result.segments[s] = 1;
      for (const Index f : table_.facets_of(s)) result.facets[f] = 1;
    }
    return result;
  }

 private:
  [[nodiscard]] std::optional<Exchange> exchange_of(Index s) {
    const auto facets = table_.facets_of(s);
    if (standing_.segments[s] != 0 || facets.size() != 2) return {};
    const auto [a, b] = table_.segments[s];
    std::array<Vertex, 2> apex{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& sides = table_.facet_segments[facets[i]];
      const auto opposite = std::find(sides.begin(), sides.end(), s) - sides.begin();
      apex[i] = complex_.facets[facets[i]][static_cast<std::size_t>(opposite)];
    }
    const auto [c, d] = std::minmax(apex[0], apex[1]);
    if (c == d || table_.find(c, d) != no_index) return {};
    const auto at = [&](Vertex v) { return complex_.vertices[v].data(); };
    if (segments_meet(at(a), at(b), at(c), at(d)) != Meet::point || !has_faces(c, d, a, b)) return {};
    return Exchange{{c, d}, s};
  }

  // Whether the mesh has the faces cda and cdb.
  [[nodiscard]] bool has_faces(Vertex c, Vertex d, Vertex a, Vertex b) {
    const Tet start = find_edge(mesh_, c, d);
    if (start == kNone) return false;
    shell_.clear();
    shell(mesh_, start, c, d, shell_);
    const auto in_shell = [&](Vertex v) {
      return std::any_of(shell_.begin(), shell_.end(), [&](Tet t) { return mesh_.index_of(t, v) >= 0; });
    };
    return in_shell(a) && in_shell(b);
  }

  TetMesh& mesh_;
  const Complex& complex_;
  const SegmentTable& table_;
  const Standing& standing_;
  std::vector<Tet> shell_;
};

}  // namespace

Standing with_other_diagonals(TetMesh& mesh, const Complex& complex, const SegmentTable& table,
                              const Standing& standing) {
  return Diagonals(mesh, complex, table, standing).run();
}

}  // namespace holdfast
