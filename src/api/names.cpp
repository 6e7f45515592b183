// Names of the enumerations: one table each, which both directions read.
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
Named(Enum, const char*) -> Named<Enum>;  // clang++ 14 deduces none for aggregates

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
    Named{WarningKind::orientation, "orientation"}, Named{WarningKind::open_interface, "open_interface"},
    Named{WarningKind::field_points, "field_points"}, Named{WarningKind::attempt_failed, "attempt_failed"},
    Named{WarningKind::parts_apart, "parts_apart"}};

constexpr std::array kRemarkKinds{
    Named{RemarkKind::left_out, "left_out"}, Named{RemarkKind::polygons_cut, "polygons_cut"},
    Named{RemarkKind::size_limits, "size_limits"}, Named{RemarkKind::not_held, "not_held"},
    Named{RemarkKind::renumbered, "renumbered"}};

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
