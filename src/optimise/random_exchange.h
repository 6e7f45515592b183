// Random exchanges that make nothing as bad as a limit: steps among meshes none of which is worse than the
// first.
#pragma once

#include <random>
#include <vector>

#include "mesh/exchange.h"
#include "mesh/tet_mesh.h"
#include "optimise/nothing_bad.h"

namespace holdfast {

/// The objective: of the exchanges that make nothing as bad as the limit each is as likely as the others.
class AnyExchange : public ExchangesInMesh {
 public:
  using Cost = double;  // the worst Q
  using Link = NothingBad;

  AnyExchange(const TetMesh& mesh, double bad_from, std::mt19937_64& random);

  static std::optional<double> before(std::span<const Tet>) { return 0; }
  [[nodiscard]] std::optional<double> after(const std::array<TetMesh::Corners, 3>& three, double) const;
  bool gains(double, double) { return random_() % ++met_ == 0; }
  static bool take(double, double, std::span<const TetMesh::Corners>) { return true; }
  [[nodiscard]] Link link(const EdgeShell& shell, double) const { return {mesh_, shell, bad_from_}; }

 private:
  const double bad_from_;
  std::mt19937_64& random_;
  std::size_t met_ = 0;
};

class RandomExchanger {
 public:
  explicit RandomExchanger(TetMesh& mesh) : mesh_(mesh) {}

  /// Makes one of the ten exchanges at t that make nothing as bad as `bad_from`. Constraints stand.
  /// Returns whether there is any. `created` receives the new tetrahedra.
  bool exchange(Tet t, double bad_from, std::mt19937_64& random, std::vector<Tet>& created);

 private:
  TetMesh& mesh_;
  ExchangeSearch<AnyExchange> search_;
};

}  // namespace holdfast
