#include "api/attempt.h"

#include <memory>
#include <utility>

#include "api/course.h"
#include "api/deliver.h"
#include "api/interior.h"

namespace holdfast {

namespace {

// Finds the regions and chooses among them, and reports the choice if nothing speaks against it.
Division classify(const Attempt& attempt, BoxMesh& box, Result& result) {
  Division division = divide(attempt, box);
  PartsOfComplex* const parts = attempt.input.parts();
  if (parts != nullptr) parts->overlaps = division.kept.overlaps;
  const bool is_refused = !division.kept.defects.empty() || (parts != nullptr && parts->refuses());
  if (!is_refused) report_choice(attempt, box, division, result);
  return division;
}

}  // namespace

std::optional<Recovered> recover(const Attempt& attempt, Result& result) {
  Report& report = result.report;
  Input& input = attempt.input;
  const Course course(attempt.options, attempt.monitor, report);

  BoxMesh box = course.run(CallStep::delaunay, [&] { return delaunay_in_box(attempt); });
  if (course.reaches(CallStep::delaunay)) report.delaunay = box.missing();
  std::vector<Defect> defects =
      course.run(CallStep::validate_missing, [&] { return input.validate_missing(box.mesh, box.standing); });
  if (!defects.empty()) {
    refuse(result, std::move(defects));
    return std::nullopt;
  }

  course.run(CallStep::flips, [&] {
    if (attempt.options.flips) recover_by_flips(attempt, box);
    report.flips = box.missing();
  });
  const EnforceStats added = course.run(CallStep::partition, [&] { return enforce_missing(attempt, box); });
  report.segment_points += added.segment_points;
  report.facet_points += added.facet_points;

  Division division = course.run(CallStep::classify, [&] { return classify(attempt, box, result); });
  if (input.parts() != nullptr && input.parts()->refuses()) {
    result.outcome = Outcome::invalid_input;
    result.message = overlap_message(*input.parts());
    return std::nullopt;
  }
  if (!division.kept.defects.empty()) {
    refuse(result, std::move(division.kept.defects));
    return std::nullopt;
  }
  report.forced_points =
      course.run(CallStep::suppress, [&] { return suppress_points(attempt, box, division); });
  return Recovered{std::move(box), std::move(division)};
}

double fill(const Attempt& attempt, Recovered& recovered, Result& result) {
  BoxMesh& box = recovered.box;
  Division& division = recovered.division;
  Report& report = result.report;
  const Course course(attempt.options, attempt.monitor, report);

  std::unique_ptr<Field> field;
  if (attempt.options.sizes)
    field =
        course.run(CallStep::field_points, [&] { return add_field_points(attempt, box, division, report); });
  course.run(CallStep::optimise, [&] { improve_elements(attempt, box, division, field.get(), report); });

  course.begin(CallStep::deliver);
  deliver(attempt, box, division, field.get(), result);
  return field ? field->worst_without : 0;
}

double mesh_once(const Attempt& attempt, Result& result) {
  std::optional<Recovered> recovered = recover(attempt, result);
  return recovered ? fill(attempt, *recovered, result) : 0;
}

namespace {

std::string message_of(const std::vector<Defect>& defects) {
  // The last rules concern not the surface alone, but what is kept of it.
  switch (defects[0].kind) {
    case DefectKind::encloses_nothing:
      return "there is nothing to fill";
    case DefectKind::outside_region:
      return defects.size() == 1
                 ? "a piece of the surface borders on no kept region"
                 : std::to_string(defects.size()) + " pieces of the surface border on no kept region";
    case DefectKind::inconsistent_orientation:
      return "the surface has no winding number";
    default:
      return defects.size() == 1 ? "1 defect was found"
                                 : std::to_string(defects.size()) + " defects were found" +
                                       (defects.size() == Input::kMostDefects ? "; there may be more" : "");
  }
}

}  // namespace

void refuse(Result& result, std::vector<Defect> defects) {
  result.outcome = Outcome::invalid_input;
  result.message = message_of(defects);
  result.defects = std::move(defects);
}

}  // namespace holdfast
