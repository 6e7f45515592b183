// What a call is asked: options, files and arrays, out of the JSON that JavaScript sends.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/repair.h"
#include "reports.h"

namespace holdfast::web {

using reports::Json;

/// Tells JavaScript how far a call is, 0 to 1; returns whether it goes on.
[[nodiscard]] bool goes_on(double share, const char* stage = "");

/// Throws std::invalid_argument for names that no option has.
void require_known(const Json& options, std::initializer_list<const char*> known);

[[nodiscard]] Limits limits_of(const Json& options);
[[nodiscard]] ReadOptions reading(const Json& request);
[[nodiscard]] WriteOptions writing(const Json& request);
/// What the program takes for the same options, so that the same bits come out. Seeds of the files come
/// behind those of the options, as the program has them. Throws std::invalid_argument, also for what would do
/// nothing.
[[nodiscard]] Options mesh_options(const Json& request, const Surface& surface);
[[nodiscard]] RepairOptions repair_options(const Json& request);

/// Of a list of seeds and of points. Throws std::invalid_argument.
[[nodiscard]] std::vector<RegionSeed> seeds_of(const Json& json);
[[nodiscard]] std::vector<Point> points_of(const Json& json, const char* what);

/// The files that are meant: those of the request without such as another one has beside it (.node of .ele).
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const Json& request);
/// The names of files without their endings.
[[nodiscard]] std::vector<std::string> stems(const std::vector<std::filesystem::path>& paths);

}  // namespace holdfast::web
