// Names of the enumerations: one table each, used in both directions.
#include "holdfast/names.h"

#include <array>

namespace holdfast {
namespace {

template <class Enum>
struct Named {
  Enum value;
  const char* name;
};
template <class Enum>
Named(Enum, const char*) -> Named<Enum>;  // clang++ 14 does not deduce it for aggregates

constexpr std::array kOutcomes{Named{Outcome::done, "done"},
                               Named{Outcome::invalid_input, "invalid_input"},
                               Named{Outcome::time_limit, "time_limit"},
                               Named{Outcome::memory_limit, "memory_limit"},
                               Named{Outcome::cancelled, "cancelled"},
                               Named{Outcome::not_representable, "not_representable"}};

constexpr std::array kStages{Named{Stage::validate, "validate"},   Named{Stage::delaunay, "delaunay"},
                             Named{Stage::flips, "flips"},         Named{Stage::partition, "partition"},
                             Named{Stage::eliminate, "eliminate"}, Named{Stage::classify, "classify"},
                             Named{Stage::suppress, "suppress"},   Named{Stage::field_points, "field_points"},
                             Named{Stage::optimise, "optimise"}};

constexpr std::array kLayingOrders{Named{LayingOrder::given, "given"}, Named{LayingOrder::random, "random"},
                                   Named{LayingOrder::halving, "halving"}};

constexpr std::array kKeeps{Named{Keep::automatic, "auto"}, Named{Keep::bounded, "bounded"},
                            Named{Keep::winding, "winding"}, Named{Keep::box, "box"}};

constexpr std::array kEfforts{Named{Effort::fast, "fast"}, Named{Effort::good, "good"},
                              Named{Effort::best, "best"}};

constexpr std::array kWarningKinds{
    Named{WarningKind::orientation, "orientation"},   Named{WarningKind::open_interface, "open_interface"},
    Named{WarningKind::field_points, "field_points"}, Named{WarningKind::attempt_failed, "attempt_failed"},
    Named{WarningKind::parts_apart, "parts_apart"},   Named{WarningKind::sizes, "sizes"}};

constexpr std::array kRemarkKinds{
    Named{RemarkKind::left_out, "left_out"},       Named{RemarkKind::polygons_cut, "polygons_cut"},
    Named{RemarkKind::size_limits, "size_limits"}, Named{RemarkKind::not_held, "not_held"},
    Named{RemarkKind::renumbered, "renumbered"},   Named{RemarkKind::cells_split, "cells_split"}};

constexpr std::array kDefectKinds{Named{DefectKind::non_finite_coordinate, "non-finite coordinate"},
                                  Named{DefectKind::index_out_of_range, "index out of range"},
                                  Named{DefectKind::repeated_vertex, "repeated vertex"},
                                  Named{DefectKind::degenerate_facet, "degenerate facet"},
                                  Named{DefectKind::degenerate_segment, "degenerate segment"},
                                  Named{DefectKind::repeated_facet, "repeated facet"},
                                  Named{DefectKind::vertex_in_segment, "vertex in segment"},
                                  Named{DefectKind::vertex_in_facet, "vertex in facet"},
                                  Named{DefectKind::segments_cross, "segments cross"},
                                  Named{DefectKind::segment_pierces_facet, "segment pierces facet"},
                                  Named{DefectKind::facets_cross, "facets cross"},
                                  Named{DefectKind::facets_overlap, "facets overlap"},
                                  Named{DefectKind::segments_overlap, "segments overlap"},
                                  Named{DefectKind::encloses_nothing, "encloses nothing"},
                                  Named{DefectKind::outside_region, "outside every region"},
                                  Named{DefectKind::inconsistent_orientation, "inconsistent orientation"}};

constexpr std::array kRuleKinds{Named{RuleKind::input_vertices_kept, "input vertices kept"},
                                Named{RuleKind::well_formed, "well formed"},
                                Named{RuleKind::no_vertex_unused, "no vertex unused"},
                                Named{RuleKind::volumes_positive, "volumes positive"},
                                Named{RuleKind::facets_kept, "facets kept"},
                                Named{RuleKind::segments_kept, "segments kept"},
                                Named{RuleKind::faces_matched, "faces matched"},
                                Named{RuleKind::boundary_is_input, "boundary is input"},
                                Named{RuleKind::no_overlap, "no overlap"},
                                Named{RuleKind::steiner_points_inside, "Steiner points inside regions"},
                                Named{RuleKind::regions_numbered, "regions numbered"},
                                Named{RuleKind::markers_kept, "markers kept"},
                                Named{RuleKind::nothing_dropped, "nothing dropped"},
                                Named{RuleKind::mid_nodes_placed, "mid-edge nodes placed"},
                                Named{RuleKind::jacobians_positive, "Jacobians positive"}};

constexpr std::array kUntangleSteps{
    Named{UntangleStep::validate, "validate"}, Named{UntangleStep::relocate, "relocate"},
    Named{UntangleStep::swap, "swap"},         Named{UntangleStep::smooth, "smooth"},
    Named{UntangleStep::refill, "refill"},     Named{UntangleStep::check, "check"},
    Named{UntangleStep::improve, "improve"}};

constexpr std::array kCauses{Named{Cause::not_finite, "coordinates that are not finite"},
                             Named{Cause::bad_index, "indices out of range"},
                             Named{Cause::repeated_vertex, "repeated vertices"},
                             Named{Cause::no_extent, "no extent"},
                             Named{Cause::repeated_facet, "repeated triangles"},
                             Named{Cause::unwelded, "unwelded vertices"},
                             Named{Cause::t_junction, "T-junctions"},
                             Named{Cause::vertex_in_facet, "vertices in triangles"},
                             Named{Cause::overlap, "overlaps"},
                             Named{Cause::parts_cross, "parts cross"},
                             Named{Cause::self_crossing, "self-crossings"},
                             Named{Cause::encloses_nothing, "encloses nothing"},
                             Named{Cause::outside, "outside every region"},
                             Named{Cause::orientation, "orientation"},
                             Named{Cause::crack, "cracks"},
                             Named{Cause::open_border, "open borders"}};

constexpr std::array kPlaneMethods{Named{PlaneMethod::ears, "ears"}, Named{PlaneMethod::swaps, "swaps"},
                                   Named{PlaneMethod::partition, "partition"}};

constexpr std::array kPlaneEars{Named{PlaneEars::first, "first"}, Named{PlaneEars::best, "best"},
                                Named{PlaneEars::join, "join"}};

constexpr std::array kPlaneStages{Named{PlaneStage::delaunay, "delaunay"},
                                  Named{PlaneStage::partition, "partition"}, Named{PlaneStage::swap, "swap"}};

constexpr std::array kRungs{Named{Rung::none, "none"}, Named{Rung::nearest, "nearest"},
                            Named{Rung::again, "again"}, Named{Rung::coarser, "coarser"},
                            Named{Rung::snapped, "snapped"}};

constexpr std::array kDropReasons{Named{DropReason::not_finite, "not finite"},
                                  Named{DropReason::no_area, "no area"},
                                  Named{DropReason::vanished, "vanished"}, Named{DropReason::inner, "inner"}};

constexpr std::array kOpenReasons{Named{OpenReason::too_many_sides, "too many sides"},
                                  Named{OpenReason::meets_surface, "meets surface"},
                                  Named{OpenReason::no_filling, "no filling"}};

constexpr std::array kCureKinds{Named{CureKind::weld, "weld"}, Named{CureKind::cut, "cut"},
                                Named{CureKind::fill_holes, "fill holes"}, Named{CureKind::unite, "unite"},
                                Named{CureKind::join, "join"}};

constexpr std::array kRepairRuleKinds{Named{RepairRuleKind::output_valid, "output valid"},
                                      Named{RepairRuleKind::vertices_kept, "vertices kept"},
                                      Named{RepairRuleKind::distances_right, "distances right"},
                                      Named{RepairRuleKind::parents_named, "parents named"},
                                      Named{RepairRuleKind::children_near, "children near"},
                                      Named{RepairRuleKind::parents_covered, "parents covered"},
                                      Named{RepairRuleKind::segments_covered, "segments covered"},
                                      Named{RepairRuleKind::losses_listed, "losses listed"},
                                      Named{RepairRuleKind::repeats_listed, "repeats listed"},
                                      Named{RepairRuleKind::fillings_bounded, "fillings bounded"},
                                      Named{RepairRuleKind::markers_kept, "markers kept"},
                                      Named{RepairRuleKind::valid_unchanged, "valid unchanged"}};

constexpr std::array kFitKinds{
    Named{FitKind::facets_there, "facets there"}, Named{FitKind::segments_there, "segments there"},
    Named{FitKind::vertices_there, "vertices there"},
    Named{FitKind::interfaces_matched, "interfaces matched"}, Named{FitKind::nothing_twice, "nothing twice"}};

constexpr std::array kOverlaps{Named{Overlap::refuse, "refuse"}, Named{Overlap::first, "first"},
                               Named{Overlap::last, "last"}, Named{Overlap::fresh, "new"}};

constexpr std::array kScalars{Named{Scalar::float32, "float32"}, Named{Scalar::float64, "float64"},
                              Named{Scalar::int32, "int32"},     Named{Scalar::uint32, "uint32"},
                              Named{Scalar::int64, "int64"},     Named{Scalar::uint64, "uint64"}};

template <const auto& table>
const char* name_in(decltype(table[0].value) value) {
  for (const auto& entry : table)
    if (entry.value == value) return entry.name;
  return "unknown";
}

template <const auto& table>
auto value_in(std::string_view text) -> std::optional<decltype(table[0].value)> {
  for (const auto& entry : table)
    if (text == entry.name) return entry.value;
  return std::nullopt;
}

template <const auto& table>
constexpr auto kValues = [] {
  std::array<decltype(table[0].value), table.size()> values{};
  for (std::size_t i = 0; i < table.size(); ++i) values[i] = table[i].value;
  return values;
}();

}  // namespace

#define HOLDFAST_NAMED(Enum, table)                              \
  const char* name(Enum value) { return name_in<table>(value); } \
  template <>                                                    \
  std::optional<Enum> from_name<Enum>(std::string_view text) {   \
    return value_in<table>(text);                                \
  }                                                              \
  template <>                                                    \
  std::span<const Enum> values_of<Enum>() {                      \
    return kValues<table>;                                       \
  }
HOLDFAST_NAMED(Outcome, kOutcomes)
HOLDFAST_NAMED(Stage, kStages)
HOLDFAST_NAMED(LayingOrder, kLayingOrders)
HOLDFAST_NAMED(Keep, kKeeps)
HOLDFAST_NAMED(Effort, kEfforts)
HOLDFAST_NAMED(WarningKind, kWarningKinds)
HOLDFAST_NAMED(RemarkKind, kRemarkKinds)
HOLDFAST_NAMED(DefectKind, kDefectKinds)
HOLDFAST_NAMED(RuleKind, kRuleKinds)
HOLDFAST_NAMED(UntangleStep, kUntangleSteps)
HOLDFAST_NAMED(Cause, kCauses)
HOLDFAST_NAMED(PlaneMethod, kPlaneMethods)
HOLDFAST_NAMED(PlaneEars, kPlaneEars)
HOLDFAST_NAMED(PlaneStage, kPlaneStages)
HOLDFAST_NAMED(Rung, kRungs)
HOLDFAST_NAMED(DropReason, kDropReasons)
HOLDFAST_NAMED(OpenReason, kOpenReasons)
HOLDFAST_NAMED(CureKind, kCureKinds)
HOLDFAST_NAMED(RepairRuleKind, kRepairRuleKinds)
HOLDFAST_NAMED(FitKind, kFitKinds)
HOLDFAST_NAMED(Overlap, kOverlaps)
HOLDFAST_NAMED(Scalar, kScalars)
#undef HOLDFAST_NAMED

const char* version() { return HOLDFAST_VERSION; }

const char* Interrupted::what() const noexcept {
  switch (outcome_) {
    case Outcome::time_limit:
      return "the time limit ran out";
    case Outcome::memory_limit:
      return "the memory limit was reached";
    default:
      return "cancelled";
  }
}

}  // namespace holdfast
