// A sheet: facets of one plane, triangulated once with all that other elements leave in it.
#include "arrange/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "arrange/flat_mesh.h"
#include "exact/predicates.h"
#include "numbers/sorted.h"
#include "plane/order.h"

namespace holdfast::arrange {
namespace {

using exact::SpacePlane;
using plane::code;
using plane::kNoEdge;
using plane::kNoVertex;
using plane::Position;
using plane::Vertex;

class Sheet {
 public:
  Sheet(const SheetInput& input, const Complex& complex, const Elements& elements, const PointPool& pool,
        const plane::Poll& poll)
      : input_(input),
        complex_(complex),
        elements_(elements),
        pool_(pool),
        poll_(poll),
        first_(elements.all[input.facets[0]]),
        axis_(first_.axis) {
    const Index f = input.facets[0];
    is_single_ = std::all_of(input.facets.begin(), input.facets.end(), [&](Index g) {
      return ascending(elements.all[g].vertex) == ascending(elements.all[f].vertex);
    });
  }

  SheetTriangles run() {
    FlatMesh mesh = begin();
    insert_points(mesh);
    insert_traces(mesh);
    is_single_ ? take_all(mesh) : take_covered(mesh);
    return std::move(result_);
  }

 private:
  // --- Points -----------------------------------------------------------------------------------------

  [[nodiscard]] Position flat(const Point& p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }

  /// The sign of a facet's area along the axis of the sheet: that of the facet itself may be another one,
  /// where two components of the normal are equal but for rounding.
  [[nodiscard]] int turn(const Element& facet) const {
    if (facet.axis == axis_) return facet.turn;
    std::array<Position, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = flat(complex_.vertices[facet.vertex[i]]);
    return exact::orient2d(p[0].data(), p[1].data(), p[2].data());
  }

  /// The vertex here of a point of the pool, new or not.
  Vertex add(Index p) {
    const Vertex v = pool_.is_vertex(p)
                         ? points_.add(flat(pool_.nearest(p)))
                         : points_.add(exact::projected(pool_.exact(p), axis_), flat(pool_.nearest(p)));
    vertex_of_.emplace(p, v);
    point_of_.push_back(p);
    return v;
  }

  FlatMesh begin() {
    if (!is_single_) return begin_beyond();
    std::array<Vertex, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) corner[i] = add(first_.vertex[i]);
    if (first_.turn < 0) std::swap(corner[1], corner[2]);
    return {points_, corner[0], corner[1], corner[2]};
  }

  /// A triangle round all facets, whose corners are no points of the pool.
  FlatMesh begin_beyond() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Position low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    double largest = 0;
    for (const Index f : input_.facets)
      for (const Index v : elements_.all[f].vertex) {
        const Position p = flat(complex_.vertices[v]);
        for (std::size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], p[k]);
          high[k] = std::max(high[k], p[k]);
          largest = std::max(largest, std::fabs(p[k]));
        }
      }
    // Far enough that roundings do not matter; as integers where doubles end.
    const double margin =
        std::max(largest * 0x1p-20, std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2) * 2);
    const auto far = [&](double x, double y) {
      exact::RationalPoint p = exact::rational_point(low.data());
      const Position step{margin, margin};
      const exact::RationalPoint m = exact::rational_point(step.data());
      const auto sum = [&](const exact::BigInt& a, const exact::BigInt& b, double times) {
        return exact::BigInt(a * m.w + b * p.w * static_cast<int>(times));
      };
      point_of_.push_back(no_index);
      return points_.add(exact::RationalPoint{sum(p.x, m.x, x), sum(p.y, m.y, y), p.w * m.w});
    };
    const Vertex a = far(-1, -1), b = far(5, -1), c = far(-1, 5);
    return {points_, a, b, c};
  }

  void insert_points(FlatMesh& mesh) {
    std::vector<Index> points(input_.points.begin(), input_.points.end());
    if (!is_single_)
      for (const Index f : input_.facets)
        points.insert(points.end(), elements_.all[f].vertex.begin(), elements_.all[f].vertex.end());
    for (const Trace& trace : input_.traces)
      points.insert(points.end(), trace.ends.begin(), trace.ends.end());
    sort_unique(points);
    std::erase_if(points, [&](Index p) { return vertex_of_.count(p) != 0; });
    constexpr std::size_t kFew = 16;
    if (points.size() > kFew) points = in_order(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      poll_(static_cast<double>(k) / static_cast<double>(points.size()));
      mesh.insert(add(points[k]));
    }
  }

  [[nodiscard]] std::vector<Index> in_order(const std::vector<Index>& points) const {
    std::vector<Position> positions;
    positions.reserve(points.size());
    for (const Index p : points) positions.push_back(flat(pool_.nearest(p)));
    std::vector<Index> ordered;
    ordered.reserve(points.size());
    for (const Vertex k : plane::insertion_order(positions)) ordered.push_back(points[k]);
    return ordered;
  }

  // --- Traces -----------------------------------------------------------------------------------------

  void insert_traces(FlatMesh& mesh) {
    const FlatMesh::Crossing crossing = [&](std::uint32_t a, std::uint32_t b) {
      return cross(lines_[a], lines_[b]);
    };
    const auto insert = [&](const std::array<Index, 2>& ends, const Line& line) {
      poll_(1);
      lines_.push_back(line);
      mesh.insert_segment(vertex_of_.at(ends[0]), vertex_of_.at(ends[1]),
                          static_cast<std::uint32_t>(lines_.size() - 1), crossing);
    };
    if (!is_single_)
      for (const Index f : input_.facets)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::array<Index, 3>& v = elements_.all[f].vertex;
          const std::array<Index, 2> ends{v[i], v[(i + 1) % 3]};
          insert(ends, {ends, no_index});
        }
    for (const Trace& trace : input_.traces) insert(trace.ends, trace.line);
  }

  const SpacePlane& plane_of(Index facet) {
    const auto [at, is_new] = planes_.try_emplace(facet);
    if (is_new) {
      const std::array<Index, 3>& v = elements_.all[facet].vertex;
      at->second = exact::plane_through(coordinates(v[0]), coordinates(v[1]), coordinates(v[2]));
    }
    return at->second;
  }
  [[nodiscard]] SpacePlane plane_of(const Line& line) {
    if (line.facet != no_index) return plane_of(line.facet);
    return exact::upright_plane(coordinates(line.vertices[0]), coordinates(line.vertices[1]), axis_);
  }
  [[nodiscard]] const double* coordinates(Index v) const { return complex_.vertices[v].data(); }

  Vertex cross(const Line& p, const Line& q) {
    exact::SpacePoint point;
    if (p.facet == no_index)
      point = exact::crossing(coordinates(p.vertices[0]), coordinates(p.vertices[1]), plane_of(q));
    else if (q.facet == no_index)
      point = exact::crossing(coordinates(q.vertices[0]), coordinates(q.vertices[1]), plane_of(p));
    else
      point = exact::crossing(plane_of(input_.facets[0]), plane_of(p), plane_of(q));
    const Point nearest = exact::nearest(point);
    point_of_.push_back(pool_.size() + static_cast<Index>(result_.points.size()));
    const Vertex v = points_.add(exact::projected(point, axis_), flat(nearest));
    result_.points.push_back(std::move(point));
    result_.nearest.push_back(nearest);
    return v;
  }

  // --- Triangles --------------------------------------------------------------------------------------

  void take(const std::array<Vertex, 3>& v, std::span<const Index> parents) {
    Triangle t{point_of_[v[0]], point_of_[v[1]], point_of_[v[2]]};
    if (turn(elements_.all[parents[0]]) < 0) std::swap(t[1], t[2]);
    result_.triangles.push_back(t);
    result_.parents.insert(result_.parents.end(), parents.begin(), parents.end());
    result_.first_parent.push_back(static_cast<Index>(result_.parents.size()));
  }

  void take_all(const FlatMesh& mesh) {
    result_.first_parent.push_back(0);
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) take(mesh.triangles()[t].v, input_.facets);
  }

  /// Each facet's triangles are those that can be reached from inside its sides without crossing them.
  void take_covered(const FlatMesh& mesh) {
    const plane::Triangles& triangles = mesh.triangles();
    std::vector<std::vector<Index>> parents(triangles.size());
    std::vector<std::uint32_t> seen(triangles.size(), 0), pending;
    std::uint32_t mark = 0;
    for (const Index f : input_.facets) {
      poll_(1);
      ++mark;
      const Element& facet = elements_.all[f];
      std::array<Vertex, 3> corner{};
      for (std::size_t i = 0; i < 3; ++i) corner[i] = vertex_of_.at(facet.vertex[i]);
      if (turn(facet) < 0) std::swap(corner[1], corner[2]);
      std::vector<plane::EdgeCode> sides;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<Vertex> chain = mesh.chain(corner[i], corner[(i + 1) % 3]);
        std::vector<Index>& points = result_.sides.emplace_back();
        for (const Vertex v : chain) points.push_back(point_of_[v]);
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
          const plane::EdgeCode e = mesh.edge_between(chain[k], chain[k + 1]);
          sides.push_back(e);
          pending.push_back(plane::triangle_of(e));
        }
      }
      std::sort(sides.begin(), sides.end());
      while (!pending.empty()) {
        const std::uint32_t t = pending.back();
        pending.pop_back();
        if (seen[t] == mark) continue;
        seen[t] = mark;
        parents[t].push_back(f);
        for (std::uint32_t i = 0; i < 3; ++i)
          if (!std::binary_search(sides.begin(), sides.end(), code(t, i)))
            pending.push_back(plane::triangle_of(triangles[t].across[i]));
      }
    }
    result_.first_parent.push_back(0);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!parents[t].empty()) take(triangles[t].v, parents[t]);
  }

  const SheetInput& input_;
  const Complex& complex_;
  const Elements& elements_;
  const PointPool& pool_;
  const plane::Poll& poll_;
  const Element& first_;
  const unsigned axis_;
  bool is_single_ = true;  // all facets have the same corners

  plane::Points points_;
  std::unordered_map<Index, Vertex> vertex_of_;  // of points of the pool
  std::vector<Index> point_of_;                  // of vertices
  std::vector<Line> lines_;
  std::unordered_map<Index, SpacePlane> planes_;
  SheetTriangles result_;
};

}  // namespace

SheetTriangles triangulate(const SheetInput& input, const Complex& complex, const Elements& elements,
                           const PointPool& pool, const plane::Poll& poll) {
  return Sheet(input, complex, elements, pool, poll).run();
}

}  // namespace holdfast::arrange
