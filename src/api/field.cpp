#include "api/field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "api/enough_elements.h"
#include "refine/field_points.h"
#include "refine/front.h"
#include "refine/regular_elements.h"

namespace holdfast {
namespace {

// The caller's functions may be slow. Concurrent ones are not polled, since their threads have no monitor.
Sizes polling(Sizes sizes, Monitor& monitor) {
  if (sizes.concurrent) return sizes;
  if (sizes.field)
    sizes.field = [&monitor, field = std::move(sizes.field)](const Point& p) {
      monitor.poll_again();
      return field(p);
    };
  if (sizes.fields)
    sizes.fields = [&monitor, fields = std::move(sizes.fields)](std::span<const Point> points,
                                                                std::span<double> found) {
      monitor.poll_again();
      fields(points, found);
    };
  if (sizes.metric)
    sizes.metric = [&monitor, metric = std::move(sizes.metric)](const Point& p) {
      monitor.poll_again();
      return metric(p);
    };
  return sizes;
}

}  // namespace

Field::Field(const Attempt& attempt, BoxMesh& box, Division& division)
    : box_(box),
      division_(division),
      seed_(attempt.seed),
      asks_for_metric_(attempt.options.sizes && attempt.options.sizes->metric),
      size_function_(polling(attempt.input.sizes(), attempt.monitor), attempt.options.regions,
                     attempt.complex(), attempt.input.table(), division.kept, box.scale, attempt.threads) {}

void Field::set_sizes(const Attempt& attempt) {
  set_sizes_at_vertices(volume(), size_function_, attempt.threads, attempt.monitor);
}

bool Field::is_limited() const {
  if (!size_function_.has_limit()) return false;
  const std::vector<Tet> tets = division_.tets(box_.mesh);
  return std::any_of(tets.begin(), tets.end(), [&](Tet t) {
    const RegionId region = division_.regions.of_tet[t];
    const TetMesh::Corners& c = box_.mesh.corners(t);
    return std::any_of(c.begin(), c.end(), [&](Vertex v) {
      return v < sizes_.size() && size_function_.decider(sizes_[v], region) == FacetSizes::By::user;
    });
  });
}

// Each new vertex gets the largest size of its neighbours that have one.
void Field::give_sizes_to_new_vertices() {
  const TetMesh& mesh = box_.mesh;
  const std::size_t first = sizes_.size();
  if (first == mesh.vertex_count()) return;
  sizes_.resize(mesh.vertex_count(), 0);
  for (const Tet t : division_.tets(mesh))
    for (const Vertex v : mesh.corners(t))
      if (v >= first)
        for (const Vertex w : mesh.corners(t))
          if (w < first) sizes_[v] = std::max(sizes_[v], sizes_[w]);
}

VolumeData Field::volume() {
  return {box_.mesh,
          division_.regions.of_tet,
          sizes_,
          division_.kept.region,
          box_.first_free,
          nullptr,
          asks_for_metric_ ? &metrics_ : nullptr,
          seed_,
          size_function_.most_volumes().empty() ? nullptr : &size_function_.most_volumes(),
          &size_function_.limits_of_regions()};
}

namespace {

// A mesh before field points, kept for another try.
struct Unfilled {
  BoxMesh box;
  Division division;
};

void note_smaller_sizes(const SizeFunction& sizes, std::span<const double> factors, const Kept& kept,
                        int scale, Report::Field& report) {
  for (std::size_t r = 0; r < factors.size(); ++r) {
    const double asked = std::ldexp(sizes.limits_of_regions()[r], -scale);
    if (factors[r] < 1) report.smaller_sizes.push_back({kept.id[r], asked, factors[r] * asked});
  }
}

// Removal must not undo what smaller sizes have made. If only some regions have limits, points might be
// removed in the others instead.
double elements_to_be_left(std::span<const double> asked, std::span<const double> factors, const Kept& kept) {
  double elements = 0;
  bool are_all_limited = true;
  for (std::size_t r = 0; r < asked.size(); ++r) {
    elements += (factors[r] < 1 ? 1 : kNearlyEnough) * asked[r];
    are_all_limited &= !kept.region[r] || asked[r] > 0;
  }
  return are_all_limited ? elements : std::accumulate(asked.begin(), asked.end(), 0.0);
}

// Returns whether it stopped early.
bool add_points(const Attempt& attempt, Field& field) {
  FieldPoints added =
      add_field_points(field.volume(), field.size_function(), attempt.threads, attempt.monitor);
  field.parts = std::move(added.parts);
  return added.stopped_early;
}

std::vector<double> elements_made(Field& field) {
  if (!field.parts) return elements_by_region(field.volume());
  std::vector<double> elements;
  for (Part& part : field.parts->parts()) {
    const std::vector<double> own = elements_by_region(part.data(field.volume()));
    elements.resize(own.size(), 0);
    for (std::size_t r = 0; r < own.size(); ++r) elements[r] += own[r];
  }
  return elements;
}

}  // namespace

bool add_enough_points(const Attempt& attempt, BoxMesh& box, Division& division, Field& field,
                       Report::Field& report) {
  if (!WithoutField::is_asked_for(attempt.options)) return add_points(attempt, field);
  const std::vector<double> asked = regular_elements(field.volume());
  field.without = std::make_unique<WithoutField>(attempt, box, division,
                                                 std::accumulate(asked.begin(), asked.end(), 0.0));
  SizesForEnough search(asked);
  field.without->leave(elements_to_be_left(asked, search.factors(), division.kept));
  if (!field.size_function().has_limit() || !are_too_few_elements(elements_by_region(field.volume()), asked))
    return add_points(attempt, field);
  const Unfilled unfilled{box, division};
  const SizeFunction sizes = field.size_function();
  for (;;) {
    const bool stopped_early = add_points(attempt, field);
    if (!search.goes_on(elements_made(field))) {
      field.without->leave(elements_to_be_left(asked, search.factors(), division.kept));
      note_smaller_sizes(sizes, search.factors(), division.kept, box.scale, report);
      return stopped_early;
    }
    field.parts.reset();
    box = unfilled.box;
    division = unfilled.division;
    field.set_size_function(sizes.with_limits_times(search.factors(), search.part_of_most_need(),
                                                    attempt.complex(), attempt.threads));
  }
}

}  // namespace holdfast
