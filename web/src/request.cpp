#include "request.h"

#include <emscripten.h>

#include <algorithm>
#include <cmath>

#include "holdfast/names.h"

// Of JavaScript; "progress" is that of the call that runs.
EM_JS(int, holdfast_goes_on, (double share, const char* stage),
      { return Number(!Module["progress"] || Module["progress"](share, UTF8ToString(stage))); });

namespace holdfast::web {
namespace {

constexpr const char* kLimits[] = {"time_limit", "memory_limit"};

const Json& options_of(const Json& request) {
  static const Json none = Json::object();
  const auto found = request.find("options");
  return found == request.end() ? none : *found;
}

double number(const Json& options, const char* key, double usual) {
  const auto found = options.find(key);
  if (found == options.end()) return usual;
  if (!found->is_number()) throw std::invalid_argument(std::string(key) + ": a number is expected");
  return found->get<double>();
}

double positive(const Json& options, const char* key, double usual) {
  const double value = number(options, key, usual);
  if (options.contains(key) && !(value > 0 && std::isfinite(value)))
    throw std::invalid_argument(std::string(key) + ": a positive number is expected");
  return value;
}

bool flag(const Json& options, const char* key) {
  const auto found = options.find(key);
  if (found == options.end()) return false;
  if (!found->is_boolean()) throw std::invalid_argument(std::string(key) + ": true or false is expected");
  return found->get<bool>();
}

template <typename Enum>
Enum named(const Json& options, const char* key, Enum usual) {
  const auto found = options.find(key);
  if (found == options.end()) return usual;
  const std::string text = found->is_string() ? found->get<std::string>() : found->dump();
  const std::optional<Enum> value = from_name<Enum>(text);
  if (!value) throw std::invalid_argument(std::string(key) + ": there is no '" + text + "'");
  return *value;
}

Point point_of(const Json& json, const char* what) {
  if (!json.is_array() || json.size() != 3 ||
      !std::all_of(json.begin(), json.end(), [](const Json& x) { return x.is_number(); }))
    throw std::invalid_argument(std::string(what) + ": three numbers are expected");
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

RegionSeed seed_of(const Json& json) {
  if (!json.is_object() || !json.contains("where") || !json.contains("id") || !json["id"].is_number_integer())
    throw std::invalid_argument("regions: each has where and an integer id");
  require_known(json, {"where", "id", "size", "max_volume"});
  RegionSeed seed{point_of(json["where"], "regions: where"), json["id"].get<int>()};
  seed.size = positive(json, "size", 0);
  seed.max_volume = positive(json, "max_volume", 0);
  return seed;
}

void refuse_beside_fill(const Json& options) {
  for (const char* key : {"size", "gradation", "no_growth", "quality", "max_volume", "max_ratio"})
    if (options.contains(key))
      throw std::invalid_argument(std::string(key) +
                                  " does nothing with fill: it is for field points, and fill adds none");
}

Sizes sizes_of(const Json& options) {
  Sizes sizes;
  sizes.size = positive(options, "size", 0);
  if (options.contains("gradation")) sizes.gradation = number(options, "gradation", 0);
  if (sizes.gradation && !(*sizes.gradation >= 0 && *sizes.gradation <= 1))
    throw std::invalid_argument("gradation: a number from 0 to 1 is expected");
  sizes.grow = !flag(options, "no_growth");
  sizes.max_volume = positive(options, "max_volume", 0);
  sizes.max_ratio = positive(options, "max_ratio", 0);
  return sizes;
}

}  // namespace

bool goes_on(double share, const char* stage) { return holdfast_goes_on(share, stage) != 0; }

void require_known(const Json& options, std::initializer_list<const char*> known) {
  if (!options.is_object()) throw std::invalid_argument("options: an object is expected");
  for (const auto& item : options.items()) {
    const auto is_key = [&](const char* other) { return item.key() == other; };
    if (std::none_of(known.begin(), known.end(), is_key) &&
        std::none_of(std::begin(kLimits), std::end(kLimits), is_key))
      throw std::invalid_argument("there is no option '" + item.key() + "' here");
  }
}

Limits limits_of(const Json& options) {
  Limits limits;
  limits.time_limit = positive(options, "time_limit", 0);
  limits.memory_limit = static_cast<std::uint64_t>(std::min(positive(options, "memory_limit", 0), 0x1p53));
  return limits;
}

ReadOptions reading(const Json& request) {
  ReadOptions options;
  static_cast<Limits&>(options) = limits_of(options_of(request));
  options.progress = [](double share) { return goes_on(share, "read"); };
  return options;
}

WriteOptions writing(const Json& request) {
  WriteOptions options;
  static_cast<Limits&>(options) = limits_of(options_of(request));
  options.progress = [](double share) { return goes_on(share, "write"); };
  return options;
}

Options mesh_options(const Json& request, const Surface& surface) {
  const Json& given = options_of(request);
  require_known(given, {"fill", "size", "gradation", "no_growth", "max_volume", "max_ratio", "quality",
                        "keep", "box_margin", "holes", "regions", "drop_outside", "seed"});
  Options options;
  static_cast<Limits&>(options) = limits_of(given);
  if (flag(given, "fill"))
    refuse_beside_fill(given);
  else
    options.sizes = sizes_of(given);
  options.effort = named(given, "quality", options.effort);
  options.keep = named(given, "keep", options.keep);
  options.drop_outside = flag(given, "drop_outside");
  options.seed = static_cast<std::uint64_t>(number(given, "seed", 1));
  if (given.contains("box_margin") && options.keep != Keep::box)
    throw std::invalid_argument("box_margin does nothing unless keep is box");
  options.box_margin = positive(given, "box_margin", options.box_margin);
  options.holes = points_of(given.value("holes", Json::array()), "holes");
  options.regions = seeds_of(given.value("regions", Json::array()));
  options.holes.insert(options.holes.end(), surface.holes.begin(), surface.holes.end());
  options.regions.insert(options.regions.end(), surface.regions.begin(), surface.regions.end());
  options.progress = [](const Progress& at) { return goes_on(at.overall, name(at.stage)); };
  return options;
}

RepairOptions repair_options(const Json& request) {
  const Json& given = options_of(request);
  require_known(given, {"weld", "union", "fill_holes"});
  RepairOptions options;
  static_cast<Limits&>(options) = limits_of(given);
  options.weld = number(given, "weld", 0);
  options.unite = flag(given, "union");
  if (const auto holes = given.find("fill_holes"); holes != given.end()) {
    if (holes->is_boolean()) {
      if (holes->get<bool>()) options.fill_holes = SIZE_MAX;
    } else {
      const double most = number(given, "fill_holes", 0);
      if (!(most >= 3)) throw std::invalid_argument("fill_holes: true, or a number of sides from 3 on");
      options.fill_holes = static_cast<std::size_t>(std::min(most, 4e9));
    }
  }
  options.progress = [](double share) { return goes_on(share, "repair"); };
  return options;
}

std::vector<RegionSeed> seeds_of(const Json& json) {
  if (!json.is_array()) throw std::invalid_argument("regions: a list is expected");
  std::vector<RegionSeed> seeds;
  for (const Json& seed : json) seeds.push_back(seed_of(seed));
  return seeds;
}

std::vector<Point> points_of(const Json& json, const char* what) {
  if (!json.is_array()) throw std::invalid_argument(std::string(what) + ": a list is expected");
  std::vector<Point> points;
  for (const Json& point : json) points.push_back(point_of(point, what));
  return points;
}

std::vector<std::filesystem::path> inputs_of(const Json& request) {
  std::vector<std::filesystem::path> given, kept;
  for (const auto& file : request.at("inputs")) given.emplace_back(file.get<std::string>());
  std::vector<bool> beside(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (beside[i]) continue;
    std::vector<std::filesystem::path> files = files_of_surface(given[i]);
    for (const auto& file : files_of_volume(given[i])) files.push_back(file);
    for (std::size_t k = 0; k < given.size(); ++k)
      if (k != i && given[k] != given[i] && std::find(files.begin(), files.end(), given[k]) != files.end())
        beside[k] = true;
  }
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!beside[i]) kept.push_back(given[i]);
  if (kept.empty()) throw std::invalid_argument("a file is expected");
  return kept;
}

std::vector<std::string> stems(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> names;
  for (const auto& path : paths)
    names.push_back((path.extension() == ".gz" ? path.stem() : path).stem().string());
  return names;
}

}  // namespace holdfast::web
