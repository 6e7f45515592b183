#include "api/intermediate.h"

#include <utility>

namespace holdfast {
namespace {

// Records the inner vertices of a chain, and those inside a facet.
void tell_added(Intermediate& told, const ConstraintPieces& pieces, const SegmentTable& table,
                std::span<const Index> number) {
  for (const ConstraintPieces::Chain& chain : pieces.chains)
    for (std::size_t k = 1; k + 1 < chain.vertices.size(); ++k)
      told.added.push_back({number[chain.vertices[k]], table.segments[chain.segment], std::nullopt});
  for (const ConstraintPieces::SubFacets& facet : pieces.sub_facets)
    for (const Vertex v : facet.inner) told.added.push_back({number[v], std::nullopt, facet.facet});
}

}  // namespace

Intermediate intermediate_of(const Attempt& attempt, const BoxMesh& box, std::span<const Index> number) {
  Intermediate told;
  const SegmentTable& table = attempt.input.table();
  for (Index s = 0; s < box.standing.segments.size(); ++s)
    if (box.standing.segments[s] == 0) told.missing_segments.push_back(table.segments[s]);
  for (Index f = 0; f < box.standing.facets.size(); ++f)
    if (box.standing.facets[f] == 0) told.missing_facets.push_back(f);
  for (const ConstraintPieces::Chain& chain : box.pieces.chains) {
    Intermediate::Chain& added = told.chains.emplace_back();
    added.segment = table.segments[chain.segment];
    for (const Vertex v : chain.vertices) added.vertices.push_back(number[v]);
  }
  for (const ConstraintPieces::SubFacets& facet : box.pieces.sub_facets) {
    Intermediate::SubFacets& added = told.sub_facets.emplace_back();
    added.facet = facet.facet;
    for (const auto& [a, b, c] : facet.faces) added.faces.push_back({number[a], number[b], number[c]});
  }
  tell_added(told, box.pieces, table, number);
  return told;
}

}  // namespace holdfast
