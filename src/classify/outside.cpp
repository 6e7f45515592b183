#include "classify/outside.h"

#include <algorithm>
#include <map>

#include "classify/words.h"
#include "mesh/disjoint_sets.h"
#include "surface/describe.h"

namespace holdfast {
namespace {

constexpr std::size_t kListed = 3;  // more would make a message long

// Connected facets, segments of the table, and vertices.
struct Piece {
  std::vector<Index> facets, segments, vertices;
  std::size_t border = 0;  // sides at only one facet
};

// Pieces of the complex that are left out, found by uniting their vertices.
class PieceFinder {
 public:
  PieceFinder(const Complex& complex, const SegmentTable& table)
      : complex_(complex), table_(table), sets_(complex.vertices.size()) {}

  void add_facet(Index f) {
    facets_.push_back(f);
    sets_.unite(complex_.facets[f][0], complex_.facets[f][1]);
    sets_.unite(complex_.facets[f][0], complex_.facets[f][2]);
  }
  void add_segment(Index s) {
    segments_.push_back(s);
    sets_.unite(table_.segments[s][0], table_.segments[s][1]);
  }
  void add_vertex(Index v) { vertices_.push_back(v); }

  // Ordered by their first facets, then segments, then vertices.
  std::vector<Piece> pieces() {
    std::vector<Piece> pieces;
    std::map<Index, std::size_t> of_root;
    const auto piece_at = [&](Index v) -> Piece& {
      const auto [place, added] = of_root.try_emplace(sets_.root(v), pieces.size());
      if (added) pieces.emplace_back();
      return pieces[place->second];
    };
    for (const Index f : facets_) {
      Piece& piece = piece_at(complex_.facets[f][0]);
      piece.facets.push_back(f);
      for (const Index s : table_.facet_segments[f])
        if (table_.facets_of(s).size() == 1) ++piece.border;
    }
    for (const Index s : segments_) piece_at(table_.segments[s][0]).segments.push_back(s);
    for (const Index v : vertices_) piece_at(v).vertices.push_back(v);
    return pieces;
  }

 private:
  const Complex& complex_;
  const SegmentTable& table_;
  DisjointSets sets_;  // of vertices
  std::vector<Index> facets_, segments_, vertices_;
};

Defect describe(const Piece& piece, const NamedComplex& input) {
  const auto& [complex, table, names] = input;
  Defect defect{DefectKind::outside_region, {}, piece.facets, {}, {}, {}};
  for (const Index v : piece.vertices) defect.vertices.push_back(names(v));
  for (const Index s : piece.segments) defect.segments.push_back(table.input_segment[s]);
  const Index first = !piece.facets.empty()     ? complex.facets[piece.facets[0]][0]
                      : !piece.segments.empty() ? table.segments[piece.segments[0]][0]
                                                : piece.vertices[0];
  defect.where.push_back(complex.vertices[first]);
  std::string words;
  for (const std::string& part :
       {listed("triangle", "triangles", defect.facets), listed("segment", "segments", defect.segments),
        listed("isolated vertex", "isolated vertices", defect.vertices)})
    if (!part.empty()) words += (words.empty() ? "" : " with ") + part;
  const bool one = piece.facets.size() + piece.segments.size() + piece.vertices.size() == 1;
  defect.message = words + " at " + place(complex.vertices[first]) +
                   (one ? " borders on no kept region" : " border on no kept region");
  if (piece.border > 0)
    defect.message += " (" + std::to_string(piece.border) +
                      (piece.border == 1 ? " open border edge)" : " open border edges)");
  defect.message +=
      one ? ": remove it, keep more regions, or drop it" : ": remove them, keep more regions, or drop them";
  return defect;
}

// "4 edges at vertex 7 (1, 2, 3), 12 edges at vertex 0 (4, 5, 6) and 3 more".
std::string list(const std::vector<Piece>& borders, const NamedComplex& input) {
  const auto& [complex, table, names] = input;
  std::string words;
  for (std::size_t i = 0; i < std::min(borders.size(), kListed); ++i) {
    const std::vector<Index>& edges = borders[i].segments;
    const Index v = table.segments[edges[0]][0];
    words += (i > 0 ? ", " : "") + std::to_string(edges.size()) + (edges.size() == 1 ? " edge" : " edges") +
             " at vertex " + std::to_string(names(v)) + " " + place(complex.vertices[v]);
  }
  if (borders.size() > kListed) words += " and " + std::to_string(borders.size() - kListed) + " more";
  return words;
}

std::vector<bool> vertices_in_kept(const TetMesh& mesh, const Regions& regions, const Kept& kept) {
  std::vector<bool> in(mesh.vertex_count(), false);
  for (Tet t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t) || mesh.is_ghost(t) || !kept.region[regions.of_tet[t]]) continue;
    for (const Vertex v : mesh.corners(t)) in[v] = true;
  }
  return in;
}

}  // namespace

Defect encloses_nothing(const NamedComplex& input) {
  const auto& [complex, table, names] = input;
  Defect defect{DefectKind::encloses_nothing, {}, {}, {}, {}, {}};
  PieceFinder finder(complex, table);
  for (Index s = 0; s < table.segments.size(); ++s) {
    if (table.facets_of(s).size() != 1) continue;
    finder.add_segment(s);
    for (const Index v : table.segments[s]) {
      defect.vertices.push_back(names(v));
      defect.where.push_back(complex.vertices[v]);
    }
  }
  const std::vector<Piece> borders = finder.pieces();
  defect.message = "the surface encloses nothing";
  if (complex.facets.empty())
    defect.message += ": it has no triangles";
  else if (!borders.empty())
    defect.message += ": it has " + std::to_string(borders.size()) +
                      (borders.size() == 1 ? " open border, " : " open borders, ") + list(borders, input);
  defect.message += "; close it, or fill everything out to an enclosing box";
  return defect;
}

std::vector<Defect> find_outside(const TetMesh& mesh, const Regions& regions, const Kept& kept,
                                 const NamedComplex& input) {
  const auto& [complex, table, names] = input;
  PieceFinder finder(complex, table);
  for (Index f = 0; f < complex.facets.size(); ++f)
    if (!kept.facet(regions, f)) finder.add_facet(f);
  std::vector<bool> isolated(complex.vertices.size(), true);
  for (Index s = 0; s < table.segments.size(); ++s) {
    for (const Index v : table.segments[s]) isolated[v] = false;
    if (table.facets_of(s).empty() && !kept.segment[s]) finder.add_segment(s);
  }
  if (std::find(isolated.begin(), isolated.end(), true) != isolated.end()) {
    const std::vector<bool> in = vertices_in_kept(mesh, regions, kept);
    for (Index v = 0; v < complex.vertices.size(); ++v)
      if (isolated[v] && !in[v]) finder.add_vertex(v);
  }
  std::vector<Defect> defects;
  for (const Piece& piece : finder.pieces()) defects.push_back(describe(piece, input));
  return defects;
}

}  // namespace holdfast
