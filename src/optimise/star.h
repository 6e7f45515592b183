// The star of a point: the tetrahedra that join it to faces that all see it, and where their energy is least.
#pragma once

#include <cstddef>
#include <vector>

#include "optimise/energy.h"

namespace holdfast {

class Star {
 public:
  void clear();
  /// A face that a point x of the star sees with orient(a, b, c, x) > 0. The heavier it weighs the more it
  /// says about where x should be.
  void add(const Point& a, const Point& b, const Point& c, double weight);
  /// By which energies are computed from now on.
  void follow(const EnergyRule& rule) { rule_ = rule; }

  /// Starts the search for a place at x, where the energy is known or computed.
  void start_at(const Point& x, double energy) {
    at_ = x;
    energy_ = energy;
  }
  void start_at(const Point& x) { start_at(x, energy_at(x, kNoEnergy)); }
  [[nodiscard]] const Point& at() const { return at_; }
  [[nodiscard]] double energy() const { return energy_; }

  /// Goes to where the faces would have the point, or part of the way, if the energy is less there.
  bool step_to_ideal_place();
  /// Descends along the gradient while that pays.
  void descend();

  /// Calls act(k, e) with the energy, at at(), of the tetrahedron on the k-th face that was added.
  template <typename Act>
  void for_each_energy(Act&& act) const {
    for (const TwoFaces& two : faces_) {
      const Pair e = energies_at(two, at_);
      for (std::size_t i = 0; i < two.count; ++i) act(two.index[i], e[i]);
    }
  }

 private:
  // Or one face, twice.
  struct TwoFaces {
    PointOf<Pair> a, b, c;
    Pair weight;
    std::array<std::size_t, 2> index;
    std::size_t count;
  };

  [[nodiscard]] Pair energies_at(const TwoFaces& two, const Point& x) const {
    return holdfast::energy<Pair>(two.a, two.b, two.c, {Pair{} + x[0], Pair{} + x[1], Pair{} + x[2]}, rule_);
  }
  [[nodiscard]] double energy_at(const Point& x, double limit);
  [[nodiscard]] double energy_by_pairs(const Point& x, double limit);
  HOLDFAST_WITH_FOURS [[nodiscard]] double energy_by_fours(const Point& x, double limit);
  [[nodiscard]] bool reaches(double limit, std::size_t k, const double* energies, double& sum);
  [[nodiscard]] Point ideal_place() const;
  [[nodiscard]] double size() const;
  bool step_to(const Point& x);
  bool step_down(double size);

  std::vector<TwoFaces> faces_;
  std::size_t face_count_ = 0;
  Point at_{};
  double energy_ = kNoEnergy;
  EnergyRule rule_;
};

}  // namespace holdfast
