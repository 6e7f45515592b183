#include "second_order/positive.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact/jacobian.h"
#include "holdfast/second_order.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"
#include "second_order/edges_of.h"

namespace holdfast {
namespace {

using Shape = std::array<Point, 10>;  // corners, then the nodes on the edges

Shape shape_of(const Volume& volume, std::size_t t) {
  Shape shape;
  for (std::size_t i = 0; i < 4; ++i) shape[i] = volume.vertices[volume.tetrahedra[t][i]];
  for (std::size_t e = 0; e < 6; ++e)
    shape[4 + e] = volume.mid_nodes.points[volume.mid_nodes.tetrahedra[t][e] - volume.vertices.size()];
  return shape;
}

/// The greatest distance of a node from the middle of its edge, in any coordinate.
double farthest_from_middle(const Shape& shape) {
  double most = 0, largest = 0;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kTetrahedronEdges[e];
    for (std::size_t k = 0; k < 3; ++k) {
      most = std::max(most, std::fabs(shape[4 + e][k] - (0.5 * shape[i][k] + 0.5 * shape[j][k])));
      largest = std::max(largest, std::fabs(shape[i][k]));
    }
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(shape[j][k]));
  }
  return most * (1 + 0x1p-50) + largest * 0x1p-52;
}

/// If nodes are at most d from the middles of their edges, in each coordinate, a column of the Jacobian
/// matrix changes by at most 8 d in each coordinate: the absolute values of the derivatives of the six shape
/// functions 4 u v by one barycentric coordinate add up to at most 8. Let L be the greatest edge length and h
/// = 14 d > 8 sqrt(3) d. Then the determinant differs from that of the straight element by at most 3 L^2 h +
/// 3 L h^2 + h^3.
bool is_surely_positive(const Shape& shape) {
  std::array<Point, 3> edge{};
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[i][k] = shape[i + 1][k] - shape[0][k];
      squares += edge[i][k] * edge[i][k];
    }
    longest = std::max(longest, std::sqrt(squares));
  }
  const auto& [u, v, w] = edge;
  const double determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                             u[2] * (v[0] * w[1] - v[1] * w[0]);
  const double h = 14 * farthest_from_middle(shape);
  const double change = 3 * longest * longest * h + 3 * longest * h * h + h * h * h;
  constexpr double kRounding = 0x1p-46;  // of the determinant, relative to the product of three lengths
  const double least = 1.01 * change + kRounding * longest * longest * longest;
  return determinant > least && least > 0x1p-900;  // nothing has underflowed
}

}  // namespace

bool is_positive_everywhere(const Volume& volume, std::size_t tetrahedron) {
  const Shape shape = shape_of(volume, tetrahedron);
  return is_surely_positive(shape) || exact::jacobian_of(shape) == exact::Jacobian::positive;
}

std::vector<Index> not_positive_elements(const Volume& volume, const Limits& limits) {
  const FloatEnvironment environment;
  PlainMonitor monitor(limits, {});
  std::vector<Index> found;
  for (std::size_t t = 0; t < volume.mid_nodes.tetrahedra.size(); ++t) {
    monitor.poll_again();
    if (!is_positive_everywhere(volume, t)) found.push_back(static_cast<Index>(t));
  }
  return found;
}

}  // namespace holdfast
