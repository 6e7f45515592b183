#include "manifest.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <utility>

#include "limits.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) { throw FileError(path, "", reason); }

/// A name within the folder: a foreign manifest must not lead to files elsewhere.
fs::path name_in(const fs::path& manifest, const Json& json, const char* key) {
  const fs::path name = json.at(key).get<std::string>();
  if (name.empty() || name.has_parent_path() || name == "." || name == "..")
    fail(manifest, fmt::format("\"{}\": {} is no name of a file in this folder", key, name.string()));
  return name;
}

void read_names(const Json& json, Names& names) {
  const auto read = [&](const char* key, std::map<int, std::string>& into) {
    if (!json.contains(key)) return;
    for (const auto& [id, name] : json.at(key).items()) into[std::stoi(id)] = name.get<std::string>();
  };
  read("facets", names.facets);
  read("regions", names.regions);
  read("segments", names.segments);
  read("vertices", names.vertices);
}

Manifest parse(const fs::path& folder, const fs::path& path, const Json& json) {
  if (json.at("format") != "holdfast division" || json.at("version") != 1)
    fail(path, "this is no manifest that this program knows; `holdfast split` writes one");
  Manifest manifest;
  manifest.folder = folder;
  manifest.surface = name_in(path, json.at("surface"), "file");
  manifest.checksum = json.at("surface").at("crc32").get<std::string>();
  manifest.interface_marker = json.at("interface_marker").get<int>();
  manifest.outside_dropped = json.at("options").at("drop_outside").get<bool>();
  read_names(json.at("names"), manifest.names);
  for (const Json& part : json.at("parts"))
    manifest.parts.push_back(
        {name_in(path, part, "surface"), name_in(path, part, "volume"), part.at("crc32").get<std::string>()});
  return manifest;
}

void require_checksum(const Manifest& manifest, const fs::path& file, const std::string& checksum) {
  if (checksum_of(manifest.path_of(file)) != checksum)
    throw Stale(fmt::format("{} is not the file that `holdfast split` wrote: its checksum is another",
                            manifest.path_of(file).string()));
}

std::vector<std::pair<Triangle, int>> facets_with_markers(std::span<const Triangle> facets,
                                                          std::span<const int> markers) {
  std::vector<std::pair<Triangle, int>> all(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    all[f] = {facets[f], markers.empty() ? 0 : markers[f]};
    std::sort(all[f].first.begin(), all[f].first.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// How a volume differs from what `mesh` makes of a part's surface without options, in what joining relies
/// on; empty if in nothing. The surface of a part has a seed for each of its regions.
std::string foreign_in(const Volume& volume, const Surface& surface) {
  const std::size_t n = surface.vertices.size();
  if (volume.vertices.size() < n ||
      !std::equal(surface.vertices.begin(), surface.vertices.end(), volume.vertices.begin()))
    return "it does not begin with its vertices";
  if (facets_with_markers(volume.facets, volume.facet_markers) !=
      facets_with_markers(surface.facets, surface.facet_markers))
    return fmt::format("it lists other facets, {} in place of {}", volume.facets.size(),
                       surface.facets.size());
  std::set<int> wanted;
  for (const Surface::RegionSeed& seed : surface.regions) wanted.insert(seed.id);
  const std::set<int> found(volume.regions.begin(), volume.regions.end());
  if (found != wanted)
    return fmt::format("its regions are {}, in place of {}", fmt::join(found, ", "), fmt::join(wanted, ", "));
  return "";
}

}  // namespace

std::string checksum_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be opened");
  std::array<char, 1 << 16> bytes{};
  uLong crc = crc32(0, nullptr, 0);
  while (in.read(bytes.data(), bytes.size()), in.gcount() > 0)
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(in.gcount()));
  if (in.bad()) fail(file, "cannot be read");
  return fmt::format("{:08x}", crc);
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path path = folder / manifest_name;
  std::ifstream in(path);
  if (!in) fail(path, "cannot be opened; `holdfast split` writes such a folder");
  try {
    return parse(folder, path, Json::parse(in));
  } catch (const Json::exception& error) {
    fail(path, error.what());
  } catch (const std::logic_error& error) {
    fail(path, fmt::format("an id is no number: {}", error.what()));
  }
}

Surface whole_of(const Manifest& manifest, const Limits& limits) {
  require_checksum(manifest, manifest.surface, manifest.checksum);
  Surface surface = read_surface(manifest.path_of(manifest.surface), reading(limits, {}));
  surface.names = manifest.names;
  return surface;
}

Surface surface_of_part(const Manifest& manifest, std::size_t k, const Limits& limits) {
  const ManifestPart& part = manifest.parts[k];
  require_checksum(manifest, part.surface, part.checksum);
  return read_surface(manifest.path_of(part.surface), reading(limits, {}));
}

Volume volume_of(const Manifest& manifest, std::size_t k, const Limits& limits) {
  const fs::path path = manifest.path_of(manifest.parts[k].volume);
  const Surface surface = surface_of_part(manifest, k, limits);
  Volume volume = read_volume(path, reading(limits, {}));
  if (const std::string what = foreign_in(volume, surface); !what.empty())
    throw Stale(fmt::format("{} is not a mesh of {}: {}", path.string(),
                            manifest.path_of(manifest.parts[k].surface).string(), what));
  return volume;
}

}  // namespace holdfast::cli
