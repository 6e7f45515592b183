#include "enforce/partition.h"

#include <algorithm>
#include <array>
#include <optional>

#include "enforce/collapse_within.h"
#include "enforce/cut_and_cone.h"
#include "enforce/partition_facet.h"
#include "enforce/partition_segment.h"
#include "enforce/tuning.h"

namespace holdfast {
namespace {

// Eliminates the point along its own constraint if possible: then no point is added at all.
void eliminate(TetMesh& mesh, Vertex p, std::optional<std::array<Vertex, 2>> ends, SteinerPoints& steiner) {
  const bool gone = ends ? collapse_within(mesh, p, *ends, std::span(&*ends, 1))
                         : collapse_within(mesh, p, facet_neighbours(mesh, p), {});
  if (!gone) steiner.add(cut_and_cone(mesh, p, ends));
}

}  // namespace

std::size_t Partition::cut_segment(Index s) {
  const auto [a, b] = table_.segments[s];
  chains_[s] = partition_segment(mesh_, a, b, first_free_);
  return chains_[s].size() - 2;
}

std::size_t Partition::cut_facet(Index f) {
  FacetPieces pieces = partition_facet(mesh_, frame_of(f));
  sub_facets_.push_back({f, std::move(pieces.faces), std::move(pieces.inner)});
  return pieces.added;
}

ConstraintPieces Partition::take_pieces() {
  ConstraintPieces pieces{{}, std::move(sub_facets_)};
  for (Index s = 0; s < chains_.size(); ++s)
    if (!chains_[s].empty()) pieces.chains.push_back({s, std::move(chains_[s])});
  return pieces;
}

// In random order: in sequence, the kernels shrink geometrically.
void Partition::eliminate_from_segment(Index s, SteinerPoints& steiner) {
  std::vector<Vertex>& chain = chains_[s];
  std::vector<Vertex> points(chain.begin() + 1, chain.end() - 1);
  steiner.hold(points);
  numbers::shuffle(points.begin(), points.end(), random_);
  for (std::size_t k = 0; k < points.size(); ++k) {
    tell_();
    const auto it = std::find(chain.begin(), chain.end(), points[k]);
    eliminate(mesh_, points[k], std::array<Vertex, 2>{*(it - 1), *(it + 1)}, steiner);
    steiner.release(points[k]);
    chain.erase(it);
    if ((k + 1) % tuning::kSettleEvery == 0) steiner.settle_new();
  }
  chain.clear();
  steiner.settle_new();
  steiner.settle_all_now_and_then();
}

void Partition::eliminate_from_facet(SteinerPoints& steiner) {
  std::vector<Vertex> inner = std::move(sub_facets_.back().inner);
  sub_facets_.pop_back();
  numbers::shuffle(inner.begin(), inner.end(), random_);
  for (const Vertex p : inner) {
    tell_();
    eliminate(mesh_, p, std::nullopt, steiner);
  }
  steiner.settle_new();
  steiner.settle_all_now_and_then();
}

FacetFrame Partition::frame_of(Index f) const {
  FacetFrame frame{{facets_[f][0], facets_[f][1], facets_[f][2]}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Index s = table_.facet_segments[f][i];
    const Vertex from = facets_[f][(i + 1) % 3];
    frame.sides[i] =
        chains_[s].empty() ? std::vector<Vertex>{table_.segments[s][0], table_.segments[s][1]} : chains_[s];
    if (frame.sides[i].front() != from) std::reverse(frame.sides[i].begin(), frame.sides[i].end());
  }
  return frame;
}

}  // namespace holdfast
