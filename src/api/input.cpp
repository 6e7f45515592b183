#include "api/input.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "api/report.h"
#include "api/scale.h"
#include "classify/outside.h"
#include "mesh/target_quality.h"
#include "recover/other_diagonals.h"
#include "surface/diagnose.h"
#include "surface/search.h"

namespace holdfast {

std::vector<Defect> Input::validate(Report::Input& counts) {
  const Stage last = options_.stop_after.value_or(Stage::optimise);
  counts = describe_input(given_, nullptr);
  const Report::Input all_counts = list_elements_and_segments();
  count_places(counts);
  if (!elements_.flaws.empty() || last == Stage::validate)
    if (std::vector<Defect> found = defects(); !found.empty()) return found;
  counts = all_counts;
  // Dangling facets enclose nothing wherever their vertices are, so this is reported before the long work.
  const bool encloses = counts.dangling_facets < complex().facets.size();
  const bool must_enclose = options_.keep != Keep::box && last >= Stage::classify;
  if (encloses || !must_enclose) return {};
  std::vector<Defect> found = defects();
  if (found.empty()) found.push_back(encloses_nothing({complex(), table_, names()}));
  return found;
}

// Elements and the segment table are independent of each other. The table needs indices in range.
Report::Input Input::list_elements_and_segments() {
  constexpr std::size_t kWorthThreads = 10'000;
  const Threads shared = threads_.at_most(given_.facets.size() < kWorthThreads ? 1 : threads_.count());
  Report::Input counts;
  bool in_range = true;
  parallel(shared, 2, [&](std::size_t task) {
    if (task == 0) {
      elements_ = elements_of(given_, shared, same_place_);
    } else if (in_range = has_indices_in_range(given_); in_range) {
      table_ = segment_table(given_, threads_);
      counts = describe_input(given_, &table_);
    }
  });
  if (in_range && !elements_.places.all_distinct()) {
    distinct_.merge(given_, elements_.places);
    table_ = segment_table(complex(), threads_);
    counts = describe_input(complex(), &table_);
  }
  count_places(counts);
  return counts;
}

void Input::count_places(Report::Input& counts) const {
  const Places& places = elements_.places;
  counts.merged_vertices = places.merged;
  counts.left_out_vertices = places.left_out;
  counts.vertices = given_.vertices.size() - places.merged - places.left_out;
}

// Constraints that exist in the Delaunay mesh meet properly, as faces of one triangulation. So only the
// missing ones need the exact test: on a fine surface, very few.
std::vector<Defect> Input::validate_missing(TetMesh& mesh, const Standing& standing) {
  if (std::exchange(elements_fit_, true)) return {};
  const Standing fitting = with_other_diagonals(mesh, complex(), table_, standing);
  std::vector<std::uint8_t> fits(elements_.all.size());
  std::transform(elements_.all.begin(), elements_.all.end(), fits.begin(), [&](const Element& e) {
    if (e.corners == 3) return fitting.facets[e.id];
    return e.corners == 1 ? std::uint8_t{1}
                          : fitting.segments[table_.find(distinct_(e.vertex[0]), distinct_(e.vertex[1]))];
  });
  if (!all_fit(given_, elements_, fits, poll(), threads_)) {
    std::vector<Defect> found = defects();
    if (found.empty()) throw std::logic_error("holdfast: a misfit without a defect");
    return found;
  }
  elements_ = {};
  return {};
}

Sizes Input::sizes() const {
  Sizes sizes = options_.sizes.value();
  sizes.vertex_sizes = distinct_.sizes(sizes.vertex_sizes);
  return sizes;
}

double Input::target() {
  if (!target_) {
    const int scale = choose_scale(complex().vertices);  // at other scales measures overflow or underflow
    target_ = scale == 0 ? target_quality(complex().vertices, complex().facets, threads_)
                         : target_quality(scaled(complex().vertices, scale), complex().facets, threads_);
  }
  return *target_;
}

std::vector<Defect> Input::defects() const {
  return find_defects(given_, elements_, kMostDefects, poll(), threads_);
}

std::function<void(double)> Input::poll() const {
  return [this](double fraction) { monitor_.poll(Stage::validate, fraction); };
}

}  // namespace holdfast
