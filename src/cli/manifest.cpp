#include "manifest.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "limits.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) { throw FileError(path, "", reason); }

/// A member of an object of the manifest; errors name it.
template <class Value>
Value value_in(const fs::path& manifest, const Json& json, const std::string& key) {
  try {
    return json.at(key).get<Value>();
  } catch (const Json::exception&) {
    fail(manifest,
         fmt::format("\"{}\" is missing or damaged; `holdfast split` writes the manifest anew", key));
  }
}

/// A name within the folder: a foreign manifest must not lead to files elsewhere.
fs::path name_in(const fs::path& manifest, const Json& json, const char* key) {
  fs::path name = value_in<std::string>(manifest, json, key);
  if (name.empty() || name.has_parent_path() || name == "." || name == "..")
    fail(manifest, fmt::format("\"{}\": {} is no name of a file in this folder", key, name.string()));
  return name;
}

std::map<int, std::string> names_in(const fs::path& manifest, const Json& json, const char* key) {
  std::map<int, std::string> names;
  if (!json.contains(key)) return names;
  for (const auto& [text, name] : value_in<std::map<std::string, std::string>>(manifest, json, key)) {
    int id = 0;
    const char* const end = text.data() + text.size();
    if (const auto [rest, error] = std::from_chars(text.data(), end, id); error != std::errc() || rest != end)
      fail(manifest, fmt::format("\"names\", \"{}\": {} is no id, which is an integer", key, text));
    names[id] = name;
  }
  return names;
}

Manifest parse(const fs::path& folder, const fs::path& path, const Json& json) {
  if (value_in<std::string>(path, json, "format") != "holdfast division" ||
      value_in<int>(path, json, "version") != 1)
    fail(path, "this is no manifest that this program knows; `holdfast split` writes one");
  Manifest manifest;
  manifest.folder = folder;
  const Json surface = value_in<Json>(path, json, "surface");
  manifest.surface = name_in(path, surface, "file");
  manifest.checksum = value_in<std::string>(path, surface, "crc32");
  manifest.interface_marker = value_in<int>(path, json, "interface_marker");
  manifest.outside_dropped = value_in<bool>(path, value_in<Json>(path, json, "options"), "drop_outside");
  const Json names = value_in<Json>(path, json, "names");
  manifest.names = {names_in(path, names, "facets"), names_in(path, names, "regions"),
                    names_in(path, names, "segments"), names_in(path, names, "vertices")};
  for (const Json& part : value_in<std::vector<Json>>(path, json, "parts"))
    manifest.parts.push_back({name_in(path, part, "surface"), name_in(path, part, "volume"),
                              value_in<std::string>(path, part, "crc32")});
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
  } catch (const Json::parse_error& error) {
    const std::string text = error.what();  // after its name in brackets
    fail(path, text.substr(std::min(text.size(), text.find("parse error"))));
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
