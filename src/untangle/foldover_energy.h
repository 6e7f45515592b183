// The energy of tetrahedra that grows without bound as they flatten, regularised where they are inverted.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/anatomy.h"

namespace holdfast {

/// J maps a regular tetrahedron of the size that a tetrahedron had at first to what it is. With D = det J and
/// chi(D) = (D + sqrt(eps^2 + D^2)) / 2, which is positive, and D or nearly 0 for eps near 0,
///   f = |J|^2 / (3 chi^(2/3)), g = (D^2 + 1) / (2 chi), energy = sum of f + lambda g
/// (equations 2 to 4 of the paper): f keeps the shape, g the size.
class FoldoverEnergy {
 public:
  /// A corner is the index of a variable vertex, or of a fixed one counted from `variable`.
  using Corners = std::array<std::uint32_t, 4>;

  FoldoverEnergy(std::vector<Corners> tets, std::size_t variable, std::vector<std::array<double, 3>> fixed)
      : tets_(std::move(tets)), variable_(variable), fixed_(std::move(fixed)) {}

  /// Takes the sizes of the tetrahedra as they are now for those to keep.
  void take_sizes(std::span<const double> x);
  void set_epsilon(double epsilon) { epsilon_ = epsilon; }

  /// The least D.
  [[nodiscard]] double least_determinant(std::span<const double> x) const;
  [[nodiscard]] double value(std::span<const double> x) const;
  /// The energy; writes its gradient.
  double operator()(std::span<const double> x, std::span<double> gradient) const;

 private:
  using Matrix = std::array<std::array<double, 3>, 3>;  // by column

  [[nodiscard]] const double* corner(std::span<const double> x, std::uint32_t v) const {
    return v < variable_ ? x.data() + 3 * std::size_t{v} : fixed_[v - variable_].data();
  }
  [[nodiscard]] Matrix jacobian(std::span<const double> x, std::size_t t) const;
  void add_to_corners(std::size_t t, const Matrix& dj, std::span<double> gradient) const;

  std::vector<Corners> tets_;
  std::size_t variable_;
  std::vector<std::array<double, 3>> fixed_;
  std::vector<double> inverse_size_;
  double epsilon_ = 1;
};

}  // namespace holdfast
