// Splines of a DXF file.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/dxf_text.h"

namespace holdfast::io {

/// A rational B-spline (Piegl, Tiller 1997).
class DxfSpline {
 public:
  /// No value for a spline that is given only by points through which it runs: how is not said. Throws
  /// FileError.
  [[nodiscard]] static std::optional<DxfSpline> read(DxfText& text, const DxfEntity& entity);

  /// Points on the spline, those at its knots among them. Between two it turns by at most so many degrees,
  /// except at a cusp.
  [[nodiscard]] std::vector<Point> points(double degrees) const;

 private:
  using Homogeneous = std::array<double, 4>;

  /// Why there is no such spline; empty if there is.
  [[nodiscard]] std::string fault_with(std::span<const double> weights) const;
  void weigh(std::span<const double> weights);
  void add_between(double from, double to, double degrees, int depth, std::vector<Point>& points) const;
  [[nodiscard]] Point at(double parameter) const;
  [[nodiscard]] double turn(double from, double to) const;

  std::size_t degree_ = 0;
  double magnitude_ = 0;  // of the coordinates
  std::vector<double> knots_;
  std::vector<Homogeneous> controls_;
};

}  // namespace holdfast::io
