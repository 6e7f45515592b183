// A sheet: facets of one plane, triangulated once together with all traces of other elements.
#include "arrange/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>

#include "arrange/arrange.h"
#include "arrange/count_crossings.h"
#include "arrange/fits_rounded.h"
#include "arrange/flat_mesh.h"
#include "exact/predicates.h"
#include "numbers/sorted.h"
#include "plane/order.h"

namespace holdfast::arrange {
namespace {

using exact::SpacePlane;
using plane::code;
using plane::Position;
using plane::Vertex;

/// The input of a sheet, projected along the axis.
struct Given {
  const SheetInput& input;
  const Complex& complex;
  const Elements& elements;
  const PointPool& pool;
  unsigned axis;
  bool is_single;  // all facets have the same corners

  [[nodiscard]] const Element& facet(Index f) const { return elements.all[f]; }
  [[nodiscard]] const double* coordinates(Index v) const { return complex.vertices[v].data(); }
  [[nodiscard]] Position flat(const Point& p) const { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

  /// The sign of a facet's area along the axis of the sheet. The facet's own axis may be another one if two
  /// components of the normal are equal except for rounding.
  [[nodiscard]] int turn(const Element& facet) const {
    if (facet.axis == axis) return facet.turn;
    std::array<Position, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = flat(complex.vertices[facet.vertex[i]]);
    return exact::orient2d(p[0].data(), p[1].data(), p[2].data());
  }
};

/// The vertices of the sheet. Each is a point of the pool, a crossing found here (these are numbered after
/// the pool's points), or a corner far away, which is neither.
class SheetPoints {
 public:
  explicit SheetPoints(const Given& given) : given_(given) {}

  [[nodiscard]] plane::Points& all() { return points_; }
  [[nodiscard]] bool has(Index p) const { return vertex_of_.count(p) != 0; }
  [[nodiscard]] Vertex vertex(Index p) const { return vertex_of_.at(p); }
  [[nodiscard]] Index point(Vertex v) const { return point_of_[v]; }

  Vertex add(Index p) {
    const PointPool& pool = given_.pool;
    const Vertex v = pool.is_vertex(p) ? points_.add(given_.flat(pool.nearest(p)))
                                       : points_.add(exact::projected(pool.exact(p), given_.axis),
                                                     given_.flat(pool.nearest(p)));
    vertex_of_.emplace(p, v);
    point_of_.push_back(p);
    return v;
  }
  Vertex add_far(exact::RationalPoint p) {
    point_of_.push_back(no_index);
    return points_.add(std::move(p));
  }
  Vertex add_crossing(CrossingPoint& crossing) {
    point_of_.push_back(given_.pool.size() + static_cast<Index>(crossings_.size()));
    crossings_.push_back(&crossing);
    return points_.add(exact::projected(crossing.point.point(), given_.axis), given_.flat(crossing.nearest));
  }
  [[nodiscard]] std::size_t crossings() const { return crossings_.size(); }
  std::vector<CrossingPoint*> take_crossings() { return std::move(crossings_); }

 private:
  const Given& given_;
  plane::Points points_;
  std::unordered_map<Index, Vertex> vertex_of_;  // of points of the pool
  std::vector<Index> point_of_;                  // of vertices
  std::vector<CrossingPoint*> crossings_;
};

/// The lines of segments, by number, and the crossings of pairs of lines.
class SheetLines {
 public:
  SheetLines(const Given& given, Crossings& crossings) : given_(given), crossings_(crossings) {}

  std::uint32_t add(const Line& line) {
    lines_.push_back(line);
    return static_cast<std::uint32_t>(lines_.size() - 1);
  }

  [[nodiscard]] CrossingPoint& crossing(std::uint32_t a, std::uint32_t b) const {
    const Line &p = lines_[a], &q = lines_[b];
    if (p.facet == no_index) return crossing(p.vertices, plane_of(q));
    if (q.facet == no_index) return crossing(q.vertices, plane_of(p));
    return crossings_.of_facets({given_.input.facets[0], p.facet, q.facet});
  }

 private:
  [[nodiscard]] CrossingPoint& crossing(const std::array<Index, 2>& ends, const SpacePlane& plane) const {
    return crossings_.add(exact::crossing(given_.coordinates(ends[0]), given_.coordinates(ends[1]), plane));
  }
  [[nodiscard]] SpacePlane plane_of(const Line& line) const {
    if (line.facet != no_index) return crossings_.plane_of(line.facet);
    return exact::upright_plane(given_.coordinates(line.vertices[0]), given_.coordinates(line.vertices[1]),
                                given_.axis);
  }

  const Given& given_;
  Crossings& crossings_;
  std::vector<Line> lines_;
};

// --- Points

/// A triangle round all facets; its corners are not points of the pool.
FlatMesh begin_beyond(const Given& given, SheetPoints& points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Position low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  double largest = 0;
  for (const Index f : given.input.facets)
    for (const Index v : given.facet(f).vertex) {
      const Position p = given.flat(given.complex.vertices[v]);
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
        largest = std::max(largest, std::fabs(p[k]));
      }
    }
  // Far enough that rounding does not matter, and still an integer at the limits of doubles. Halves of
  // denormals may be zero.
  const double margin =
      std::max({largest * 0x1p-20, std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2) * 2,
                std::numeric_limits<double>::min()});
  const auto far = [&](double x, double y) {
    exact::RationalPoint p = exact::rational_point(low.data());
    const Position step{margin, margin};
    const exact::RationalPoint m = exact::rational_point(step.data());
    const auto sum = [&](const exact::BigInt& a, const exact::BigInt& b, double times) {
      return exact::BigInt(a * m.w + b * p.w * static_cast<int>(times));
    };
    return points.add_far({sum(p.x, m.x, x), sum(p.y, m.y, y), p.w * m.w});
  };
  const Vertex a = far(-1, -1), b = far(5, -1), c = far(-1, 5);
  return {points.all(), a, b, c};
}

/// The facet itself, if it is the only one.
FlatMesh begin(const Given& given, SheetPoints& points) {
  if (!given.is_single) return begin_beyond(given, points);
  const Element& facet = given.facet(given.input.facets[0]);
  std::array<Vertex, 3> corner{};
  for (std::size_t i = 0; i < 3; ++i) corner[i] = points.add(facet.vertex[i]);
  if (facet.turn < 0) std::swap(corner[1], corner[2]);
  return {points.all(), corner[0], corner[1], corner[2]};
}

/// The order in which insertion is fastest.
std::vector<Index> in_order(const Given& given, const std::vector<Index>& points) {
  std::vector<Position> positions;
  positions.reserve(points.size());
  for (const Index p : points) positions.push_back(given.flat(given.pool.nearest(p)));
  std::vector<Index> ordered;
  ordered.reserve(points.size());
  for (const Vertex k : plane::insertion_order(positions)) ordered.push_back(points[k]);
  return ordered;
}

/// For points that are known to lie on sides of the only facet: these sides, in the order of the points. Bit
/// i stands for the side opposite corner i of the mesh's first triangle, which turns left.
std::vector<std::array<Index, 2>> sides_of_points(const Given& given) {
  std::vector<std::array<Index, 2>> sides;
  if (!given.is_single) return sides;
  const bool is_turned = given.facet(given.input.facets[0]).turn < 0;
  for (const PointOnSide& on : given.input.on_sides)
    if (on.facet == given.input.facets[0])
      sides.push_back({on.point, 1u << (is_turned ? (3 - on.opposite) % 3 : on.opposite)});
  sort_unique(sides);
  return sides;
}

void insert_points(const Given& given, SheetPoints& all, FlatMesh& mesh, const plane::Poll& poll) {
  std::vector<Index> points(given.input.points.begin(), given.input.points.end());
  for (const Index f : given.input.facets)
    points.insert(points.end(), given.facet(f).vertex.begin(), given.facet(f).vertex.end());
  for (const Trace& trace : given.input.traces)
    points.insert(points.end(), trace.ends.begin(), trace.ends.end());
  sort_unique(points);
  std::erase_if(points, [&](Index p) { return all.has(p); });
  constexpr std::size_t kFew = 16;  // for fewer, an order along a curve does not pay
  if (points.size() > kFew) points = in_order(given, points);
  const std::vector<std::array<Index, 2>> sides = sides_of_points(given);
  for (std::size_t k = 0; k < points.size(); ++k) {
    poll(static_cast<double>(k) / static_cast<double>(points.size()));
    const auto on = std::lower_bound(sides.begin(), sides.end(), std::array<Index, 2>{points[k], 0});
    const bool is_on_side = on != sides.end() && (*on)[0] == points[k];
    mesh.insert(all.add(points[k]), is_on_side ? (*on)[1] : 0);
  }
}

// --- Traces

/// The ends of the sides of the facets, if there are several, and of the traces, each once.
std::vector<std::array<Index, 2>> ends_of_lines(const Given& given) {
  std::vector<std::array<Index, 2>> ends;
  if (!given.is_single)
    for (const Index f : given.input.facets)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<Index, 3>& v = given.facet(f).vertex;
        ends.push_back(ascending(std::array<Index, 2>{v[i], v[(i + 1) % 3]}));
      }
  for (const Trace& trace : given.input.traces) ends.push_back(ascending(trace.ends));
  sort_unique(ends);
  return ends;
}

/// The places of the points that the sheet has before lines cross.
std::vector<Position> places_given(const Given& given, std::span<const std::array<Index, 2>> ends) {
  std::vector<Index> points(given.input.points.begin(), given.input.points.end());
  for (const auto& of_line : ends) points.insert(points.end(), of_line.begin(), of_line.end());
  sort_unique(points);
  std::vector<Position> places;
  places.reserve(points.size());
  for (const Index p : points) places.push_back(given.flat(given.pool.nearest(p)));
  return places;
}

/// Ends a sheet that certainly gets too many crossings before it is triangulated: to count them takes a
/// hundredth of the time.
void check_crossings(const Given& given) {
  const SheetInput& input = given.input;
  const std::size_t most = input.most_crossings;
  const auto are_few = [&](std::size_t lines) { return lines / 2 * lines <= most || most > SIZE_MAX / 2; };
  if (are_few(input.traces.size() + (given.is_single ? 0 : 3 * input.facets.size()))) return;
  const std::vector<std::array<Index, 2>> ends = ends_of_lines(given);
  if (are_few(ends.size())) return;
  std::vector<Piece> pieces;
  pieces.reserve(ends.size());
  for (const auto& [a, b] : ends)
    pieces.push_back({given.flat(given.pool.nearest(a)), given.flat(given.pool.nearest(b))});
  const std::size_t found = count_crossings(pieces, places_given(given, ends), most + 1);
  if (found > most) throw TooManyPoints(given.pool.added() + found);
}

/// Inserts the traces and, if there are several facets, their sides.
void insert_traces(const Given& given, SheetPoints& points, FlatMesh& mesh, Crossings& crossings,
                   const plane::Poll& poll) {
  SheetLines lines(given, crossings);
  const std::size_t pool_size = given.pool.added();
  const FlatMesh::Crossing cross = [&](std::uint32_t a, std::uint32_t b) {
    if (points.crossings() >= given.input.most_crossings)
      throw TooManyPoints(pool_size + points.crossings() + 1);
    return points.add_crossing(lines.crossing(a, b));
  };
  const auto insert = [&](const std::array<Index, 2>& ends, const Line& line) {
    poll(1);
    mesh.insert_segment(points.vertex(ends[0]), points.vertex(ends[1]), lines.add(line), cross);
  };
  if (!given.is_single)
    for (const Index f : given.input.facets)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<Index, 3>& v = given.facet(f).vertex;
        const std::array<Index, 2> ends{v[i], v[(i + 1) % 3]};
        insert(ends, {ends, no_index});
      }
  for (const Trace& trace : given.input.traces) insert(trace.ends, trace.line);
}

// --- Triangles

/// Adds a triangle with the facets that contain it.
void take(const Given& given, const SheetPoints& points, const std::array<Vertex, 3>& v,
          std::span<const Index> parents, SheetTriangles& result) {
  Triangle t{points.point(v[0]), points.point(v[1]), points.point(v[2])};
  if (given.turn(given.facet(parents[0])) < 0) std::swap(t[1], t[2]);
  result.triangles.push_back(t);
  result.parents.insert(result.parents.end(), parents.begin(), parents.end());
  result.first_parent.push_back(static_cast<Index>(result.parents.size()));
}

/// The edges along the sides of a facet, seen from its inside, in ascending order. Records the points there.
std::vector<plane::EdgeCode> edges_of_sides(const Given& given, const SheetPoints& points,
                                            const FlatMesh& mesh, const Element& facet,
                                            SheetTriangles& result) {
  std::array<Vertex, 3> corner{};
  for (std::size_t i = 0; i < 3; ++i) corner[i] = points.vertex(facet.vertex[i]);
  if (given.turn(facet) < 0) std::swap(corner[1], corner[2]);
  std::vector<plane::EdgeCode> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<Vertex> chain = mesh.chain(corner[i], corner[(i + 1) % 3]);
    std::vector<Index>& side = result.sides.emplace_back();
    for (const Vertex v : chain) side.push_back(points.point(v));
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      edges.push_back(mesh.edge_between(chain[k], chain[k + 1]));
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The triangles of a facet are those that can be reached from inside its sides without crossing them.
void take_covered(const Given& given, const SheetPoints& points, const FlatMesh& mesh, SheetTriangles& result,
                  const plane::Poll& poll) {
  const plane::Triangles& triangles = mesh.triangles();
  std::vector<std::vector<Index>> parents(triangles.size());
  std::vector<std::uint32_t> seen(triangles.size(), 0), pending;
  std::uint32_t mark = 0;
  for (const Index f : given.input.facets) {
    poll(1);
    ++mark;
    const std::vector<plane::EdgeCode> sides = edges_of_sides(given, points, mesh, given.facet(f), result);
    for (const plane::EdgeCode e : sides) pending.push_back(plane::triangle_of(e));
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
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!parents[t].empty()) take(given, points, triangles[t].v, parents[t], result);
}

void take_all(const Given& given, const SheetPoints& points, const FlatMesh& mesh, SheetTriangles& result) {
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    take(given, points, mesh.triangles()[t].v, given.input.facets, result);
}

}  // namespace

SheetTriangles triangulate(const SheetInput& input, const Complex& complex, const Elements& elements,
                           const PointPool& pool, Crossings& crossings, const plane::Poll& poll) {
  const Element& first = elements.all[input.facets[0]];
  const bool is_single = std::all_of(input.facets.begin(), input.facets.end(), [&](Index f) {
    return ascending(elements.all[f].vertex) == ascending(first.vertex);
  });
  const Given given{input, complex, elements, pool, first.axis, is_single};
  check_crossings(given);
  SheetPoints points(given);
  FlatMesh mesh = begin(given, points);
  insert_points(given, points, mesh, poll);
  insert_traces(given, points, mesh, crossings, poll);
  SheetTriangles result;
  result.first_parent.push_back(0);
  if (given.is_single)
    take_all(given, points, mesh, result);
  else
    take_covered(given, points, mesh, result, poll);
  result.points = points.take_crossings();
  result.fits_rounded = arrange::fits_rounded(mesh.triangles(), points.all());
  return result;
}

}  // namespace holdfast::arrange
