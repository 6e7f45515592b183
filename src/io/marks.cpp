// Writes the places of defects as points and lines for a viewer.
#include <algorithm>
#include <cmath>

#include "io/vtu_arrays.h"
#include "numbers/float_environment.h"

namespace holdfast {
namespace {

bool finite(const Point& point) {
  return std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); });
}

/// The points and cells of the marks.
struct Marks {
  std::vector<Point> points;
  io::VtuCells cells;
  std::vector<std::int32_t> kinds, defects;

  /// Adds a point (1 place) or a line (2 places). A place that is not finite cannot be shown.
  void add(std::span<const Point> places, DefectKind kind, std::size_t defect) {
    if (!std::all_of(places.begin(), places.end(), finite)) return;
    std::array<Index, 2> corners{};
    for (std::size_t i = 0; i < places.size(); ++i) {
      corners[i] = static_cast<Index>(points.size());
      points.push_back(places[i]);
    }
    cells.add(places.size() == 1 ? io::VtkCell::vertex : io::VtkCell::line,
              std::span<const Index>(corners).first(places.size()));
    kinds.push_back(static_cast<std::int32_t>(kind));
    defects.push_back(static_cast<std::int32_t>(defect));
  }
};

/// Marks the entities of a defect without places: its vertices as points, its segments and the sides of its
/// facets as lines. Indices out of range, which may be the defect itself, are skipped.
void add_entities(Marks& marks, const Complex& complex, const Defect& defect, std::size_t number) {
  const auto add = [&](std::span<const Index> corners) {
    std::vector<Point> places;
    for (const Index corner : corners) {
      if (corner >= complex.vertices.size()) return;
      places.push_back(complex.vertices[corner]);
    }
    marks.add(places, defect.kind, number);
  };
  for (const Index vertex : defect.vertices) add({&vertex, 1});
  for (const Index segment : defect.segments)
    if (segment < complex.segments.size()) add(complex.segments[segment]);
  for (const Index facet : defect.facets) {
    if (facet >= complex.facets.size()) continue;
    const Triangle& corners = complex.facets[facet];
    for (std::size_t side = 0; side < 3; ++side) add(Segment{corners[side], corners[(side + 1) % 3]});
  }
}

}  // namespace

void write_marks(const std::filesystem::path& path, const Complex& complex, std::span<const Defect> defects) {
  const FloatEnvironment environment;
  Marks marks;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    const std::vector<Point>& where = defects[i].where;
    if (where.empty()) add_entities(marks, complex, defects[i], i);
    for (std::size_t k = 0; k < where.size(); k += 2)
      marks.add(std::span(where).subspan(k, std::min<std::size_t>(where.size() - k, 2)), defects[i].kind, i);
  }
  io::AtomicWriter out(path);
  io::write_vtu_arrays(out,
                       marks.cells.arrays(marks.points, {io::vtu_array("kind", marks.kinds),
                                                         io::vtu_array("defect", marks.defects)}),
                       {});
  out.commit();
}

}  // namespace holdfast
