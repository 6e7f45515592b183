// Exchanges (mesh/exchange.h) that make the sum of energies less.
#pragma once

#include <optional>
#include <vector>

#include "mesh/exchange.h"
#include "optimise/volume.h"

namespace holdfast {

/// The objective of one choice among exchanges: the largest fall of the energy.
class LeastEnergy : public ExchangesInMesh {
 public:
  using Cost = double;

  /// No tetrahedron with more energy than `most` is removed.
  LeastEnergy(const ImprovedVolume& volume, double most);

  [[nodiscard]] std::optional<double> before(std::span<const Tet> tets) const {
    double sum = 0;
    for (const Tet t : tets) {
      if (volume_.energy(t) > most_) return std::nullopt;
      sum += volume_.energy(t);
    }
    return sum <= gain_ ? std::nullopt : std::optional(sum);
  }
  [[nodiscard]] std::optional<double> after(const std::array<TetMesh::Corners, 3>& three,
                                            double before) const {
    const Pair e = volume_.energies_of(three[0], three[1]);
    const double two = e[0] + e[1];
    if (!(two < before)) return std::nullopt;
    return two + volume_.energy_of(three[2]);
  }
  [[nodiscard]] bool gains(double before, double after) const {
    return is_less(after, before) && before - after > gain_;
  }
  bool take(double before, double after, std::span<const TetMesh::Corners> tets) {
    for (const TetMesh::Corners& c : tets)
      if (!volume_.is_positive(c)) return false;
    gain_ = before - after;
    return true;
  }

  /// Triangulations of a link by the sum of energies.
  struct Link {
    const ImprovedVolume& volume;
    const EdgeShell& shell;
    double before;

    static double none() { return 0; }
    static double join(double x, double y) { return x + y; }
    static bool better(double x, double y) { return x < y; }
    static double diagonal(std::size_t, std::size_t) { return 0; }
    [[nodiscard]] std::optional<double> triangle(std::size_t i, std::size_t k, std::size_t j) const {
      const Vertex pi = shell.link[i], pk = shell.link[k], pj = shell.link[j];
      const Pair e = volume.energies_of({pi, pk, pj, shell.b}, {pj, pk, pi, shell.a});
      const double both = e[0] + e[1];
      if (!(both < before)) return std::nullopt;
      return both;
    }
  };
  [[nodiscard]] Link link(const EdgeShell& shell, double before) const { return {volume_, shell, before}; }

 private:
  const ImprovedVolume& volume_;
  const double most_;
  double gain_ = 0;
};

class EnergySwapper {
 public:
  explicit EnergySwapper(ImprovedVolume& volume) : volume_(volume) {}

  /// Makes the best of the ten exchanges at a tetrahedron if it makes the energy less. Constraints stand.
  /// With `as_worst`, only exchanges in which it is the worst element; the others are tried from their own
  /// worst element. Returns the new tetrahedra, none if there was no such exchange.
  std::span<const Tet> improve(Tet t, bool as_worst = false);

 private:
  ImprovedVolume& volume_;
  ExchangeSearch<LeastEnergy> search_;
};

}  // namespace holdfast
