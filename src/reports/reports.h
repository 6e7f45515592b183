// Reports: the results of the library as JSON with stable keys, for the program and the Python module.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "holdfast/paste.h"
#include "holdfast/repair.h"
#include "holdfast/statistics.h"
#include "holdfast/summary.h"
#include "holdfast/untangle.h"

namespace holdfast::reports {

using Json = nlohmann::ordered_json;

[[nodiscard]] Json to_json(const std::vector<Defect>& defects);
[[nodiscard]] Json to_json(const std::vector<Remark>& remarks);
[[nodiscard]] Json to_json(const DefectSummary& summary);

/// Keys "facets", "regions", "segments" and "vertices", each an object of names by id.
[[nodiscard]] Json to_json(const Names& names);

/// The intermediate state of a run that `stop_after` stopped.
[[nodiscard]] Json to_json(const Intermediate& intermediate);

/// The whole report of `mesh`; `options` is what the user asked for.
[[nodiscard]] Json to_json(const Result& result, Json options);
[[nodiscard]] Json to_json(const UntangleResult& result, Json options);
[[nodiscard]] Json to_json(const RepairResult& result, Json options);
[[nodiscard]] Json to_json(const PasteResult& result, Json options);
[[nodiscard]] Json to_json(const PastedVolumes& result, Json options);
[[nodiscard]] Json to_json(const CheckResult& result);
[[nodiscard]] Json to_json(const Statistics& statistics);

/// The parts of a pasted surface, as reports list them under `parts`.
[[nodiscard]] Json parts_of(const PasteResult& pasted);

/// The text on one line, or indented. Bytes that are not UTF-8, which paths may contain, are replaced.
[[nodiscard]] std::string text_of(const Json& json, int indent = -1);

}  // namespace holdfast::reports
