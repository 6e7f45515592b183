// Quality of tetrahedra as the paper defines (§6.4) and measures it (§8).
//
// Thin elements are what matters, so lengths, areas and volumes are right to a few digits however much their
// terms cancel (careful.h).
#pragma once

#include <array>
#include <optional>

#include "holdfast/types.h"

namespace holdfast {

/// sqrt(6)/12: the inradius of a regular tetrahedron over its edge.
inline constexpr double kInradiusOfRegular = 0.20412414523193150;
/// Q = sqrt(6)/12 * longest edge / inradius: 1 for a regular tetrahedron, infinite for a flat one, such as
/// one whose distinct exact corners share a double.
[[nodiscard]] double quality(const Point& a, const Point& b, const Point& c, const Point& d);

/// The six dihedral angles in degrees, at the edges ab, ac, ad, bc, bd, cd of a tetrahedron that is positive
/// or flat; NaN at the sides of a face without area.
[[nodiscard]] std::array<double, 6> dihedral_angles(const Point& a, const Point& b, const Point& c,
                                                    const Point& d);

/// Q and the cosines of the six dihedral angles in plain arithmetic, right to some nine digits; nothing for a
/// tetrahedron so thin, or so large or small, that they may not be. For going through whole volumes.
struct PlainShape {
  double quality = 0;
  std::array<double, 6> cosines{};
};
[[nodiscard]] std::optional<PlainShape> plain_shape(const Point& a, const Point& b, const Point& c,
                                                    const Point& d);

/// An angle from 0 to 180 degrees by its sine and cosine, both divided by their sum; unknown where both are
/// 0. To compare and count angles takes no arctangent.
struct Angle {
  double sine = 0, cosine = 0;

  [[nodiscard]] bool is_known() const { return sine != 0 || cosine != 0; }
  [[nodiscard]] double degrees() const;
  friend bool operator<(const Angle& x, const Angle& y) {
    if (x.sine == 0 && y.sine == 0) return x.cosine > 0 && y.cosine < 0;
    return x.sine * y.cosine < x.cosine * y.sine;
  }
};

/// The same of any tetrahedron.
struct CarefulShape {
  double quality = 0;
  std::array<Angle, 6> angles{};

  [[nodiscard]] PlainShape plain() const;
};
[[nodiscard]] CarefulShape careful_shape(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace holdfast
