// Exchanges (mesh/exchange.h) where the worst Q counts.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "mesh/exchange.h"
#include "optimise/badness.h"
#include "optimise/qualities.h"

namespace holdfast {

/// The objective of one choice among exchanges: all new tetrahedra must be better than the worst old one.
/// Among several exchanges, the best removes most null elements, then most hopeless, then most flat ones;
/// else it has the lowest ratio of the new worst Q to the old.
class LeastBadness : public ExchangesInMesh {
 public:
  using Cost = Badness;

  LeastBadness(const TetMesh& mesh, Qualities& qualities, const BadFrom& bad_from);

  std::optional<Badness> before(std::span<const Tet> tets) { return qualities_.badness_of(tets, bad_from_); }
  [[nodiscard]] std::optional<Badness> after(const std::array<TetMesh::Corners, 3>& three,
                                             const Badness& before) const;
  [[nodiscard]] bool gains(const Badness& before, const Badness& after) const {
    return after.is_worthwhile_after(before) && (!best_ || gain_of(before, after) < *best_);
  }
  bool take(const Badness& before, const Badness& after, std::span<const TetMesh::Corners>) {
    best_ = gain_of(before, after);
    return true;
  }

  class Link;
  [[nodiscard]] Link link(const EdgeShell& shell, const Badness& before) const;

 private:
  // The changes: numbers of null, hopeless and flat elements, then the ratio of the worst Q.
  using Gain = std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t, double>;
  static Gain gain_of(const Badness& before, const Badness& after);

  Qualities& qualities_;
  const BadFrom& bad_from_;
  std::optional<Gain> best_;
};

/// Triangulations of a link by the badness of their tetrahedra, none with more flat ones than go.
class LeastBadness::Link {
 public:
  Link(const TetMesh& mesh, const EdgeShell& shell, const Badness& before, const BadFrom& bad_from)
      : mesh_(mesh), shell_(shell), before_(before), bad_from_(bad_from) {}

  static Badness none() { return {}; }
  static Badness join(const Badness& x, const Badness& y) { return holdfast::join(x, y); }
  static bool better(const Badness& x, const Badness& y) { return x < y; }
  static Badness diagonal(std::size_t, std::size_t) { return {}; }
  [[nodiscard]] std::optional<Badness> triangle(std::size_t i, std::size_t k, std::size_t j) const;

 private:
  const TetMesh& mesh_;
  const EdgeShell& shell_;
  const Badness before_;
  const BadFrom& bad_from_;
};

class Exchanger {
 public:
  Exchanger(TetMesh& mesh, Qualities& qualities, const BadFrom& bad_from)
      : mesh_(mesh), qualities_(qualities), bad_from_(bad_from) {}

  /// Makes the best of the ten exchanges at a tetrahedron, if the new tetrahedra are better than the old
  /// ones. Constraints stand. `created` receives the new tetrahedra, whose qualities the caller has to
  /// forget. Returns whether an exchange was made.
  bool improve(Tet t, std::vector<Tet>& created);

 private:
  TetMesh& mesh_;
  Qualities& qualities_;
  const BadFrom bad_from_;
  ExchangeSearch<LeastBadness> search_;
};

}  // namespace holdfast
