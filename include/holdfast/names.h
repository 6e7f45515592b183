// Holdfast: names of all enumerations, as the command line and the reports spell them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "holdfast/arrays.h"
#include "holdfast/check.h"
#include "holdfast/check_repair.h"
#include "holdfast/cures.h"
#include "holdfast/divide.h"
#include "holdfast/holdfast.h"
#include "holdfast/paste.h"
#include "holdfast/plane.h"
#include "holdfast/repair.h"
#include "holdfast/summary.h"
#include "holdfast/untangle.h"

namespace holdfast {

// The others are declared beside their enumerations, as `name(Stage)` is in holdfast/holdfast.h.

/// "unknown" for a value outside the enumeration.
[[nodiscard]] HOLDFAST_API const char* name(Outcome outcome);
[[nodiscard]] HOLDFAST_API const char* name(Keep keep);
[[nodiscard]] HOLDFAST_API const char* name(Effort effort);
[[nodiscard]] HOLDFAST_API const char* name(WarningKind kind);
[[nodiscard]] HOLDFAST_API const char* name(RemarkKind kind);
[[nodiscard]] HOLDFAST_API const char* name(DefectKind kind);
[[nodiscard]] HOLDFAST_API const char* name(Overlap overlap);
[[nodiscard]] HOLDFAST_API const char* name(Scalar scalar);

/// The value with a name, or nullopt: `from_name<Keep>("winding")`. For every enumeration that has names.
template <class Enum>
[[nodiscard]] std::optional<Enum> from_name(std::string_view text);

/// All values of an enumeration, in order: `values_of<Stage>()`.
template <class Enum>
[[nodiscard]] std::span<const Enum> values_of();

// The library holds these for each enumeration.
#define HOLDFAST_NAMED(Enum)                                               \
  template <>                                                              \
  HOLDFAST_API std::optional<Enum> from_name<Enum>(std::string_view text); \
  template <>                                                              \
  HOLDFAST_API std::span<const Enum> values_of<Enum>();
HOLDFAST_NAMED(Outcome)
HOLDFAST_NAMED(Stage)
HOLDFAST_NAMED(LayingOrder)
HOLDFAST_NAMED(Keep)
HOLDFAST_NAMED(Effort)
HOLDFAST_NAMED(WarningKind)
HOLDFAST_NAMED(RemarkKind)
HOLDFAST_NAMED(DefectKind)
HOLDFAST_NAMED(RuleKind)
HOLDFAST_NAMED(UntangleStep)
HOLDFAST_NAMED(Cause)
HOLDFAST_NAMED(PlaneMethod)
HOLDFAST_NAMED(PlaneEars)
HOLDFAST_NAMED(PlaneStage)
HOLDFAST_NAMED(Rung)
HOLDFAST_NAMED(DropReason)
HOLDFAST_NAMED(OpenReason)
HOLDFAST_NAMED(CureKind)
HOLDFAST_NAMED(RepairRuleKind)
HOLDFAST_NAMED(FitKind)
HOLDFAST_NAMED(Overlap)
HOLDFAST_NAMED(Scalar)
#undef HOLDFAST_NAMED

}  // namespace holdfast
