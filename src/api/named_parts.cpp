#include "api/named_parts.h"

#include <set>
#include <utility>

#include "io/part_names.h"

namespace holdfast {
namespace {

using NamesById = std::map<int, std::string>;

/// Region ids with one meaning in all parts.
class RegionIds {
 public:
  explicit RegionIds(std::span<const Surface> parts) {
    for (const Surface& part : parts) {
      for (const RegionSeed& seed : part.regions) used_.insert(seed.id);
      if (names_one(part)) used_.insert(part.names.regions.begin()->first);
    }
  }

  static bool names_one(const Surface& part) {
    return part.regions.empty() && part.names.regions.size() == 1;
  }

  /// The number of a region that a part calls `id`: that id, unless an earlier part has another name for it.
  int number(int id, const std::string& name) {
    const auto [there, is_new] = meaning_.try_emplace(id, name);
    if (is_new || there->second == name) return id;
    const int number = next_free(1);
    meaning_[number] = name;
    return number;
  }

  /// The number of a region without an id of its own.
  int number_of_part(std::size_t part, const std::string& name) {
    const int id = next_free(static_cast<int>(part) + 1);
    meaning_[id] = name;
    return id;
  }

  [[nodiscard]] NamesById names() const {
    NamesById names = meaning_;
    std::erase_if(names, [](const auto& entry) { return entry.second.empty(); });
    return names;
  }

 private:
  /// Returns `wanted`, or the next unused number.
  int next_free(int wanted) {
    while (!used_.insert(wanted).second) ++wanted;
    return wanted;
  }

  std::set<int> used_;
  NamesById meaning_;
};

std::vector<NamesById> region_names_apart(std::span<const Surface> parts,
                                          std::span<const std::string> names) {
  std::vector<NamesById> of_parts;
  for (const Surface& part : parts) of_parts.push_back(part.names.regions);
  return io::names_apart(std::move(of_parts), names);
}

/// The seeds of a part, with ids that are valid in the whole.
std::vector<RegionSeed> seeds_of(const Surface& part, const NamesById& names, RegionIds& ids) {
  std::vector<RegionSeed> seeds;
  std::map<int, int> number;
  for (RegionSeed seed : part.regions) {
    const auto [at, is_new] = number.try_emplace(seed.id, 0);
    if (is_new) {
      const auto named = names.find(seed.id);
      at->second = ids.number(seed.id, named == names.end() ? "" : named->second);
    }
    seed.id = at->second;
    seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace

NamedParts name_parts(std::span<const Surface> parts, std::span<const std::string> names,
                      std::span<const std::string> labels) {
  RegionIds ids(parts);
  const std::vector<NamesById> of_parts = region_names_apart(parts, names);
  NamedParts named;
  std::size_t vertices = 0, facets = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Surface& part = parts[k];
    PastedPart pasted;
    pasted.name = k < labels.size()  ? labels[k]
                  : k < names.size() ? names[k]
                                     : "part " + std::to_string(k + 1);
    pasted.first_vertex = std::exchange(vertices, vertices + part.vertices.size());
    pasted.first_facet = std::exchange(facets, facets + part.facets.size());
    pasted.holes = part.holes;
    pasted.seeds = seeds_of(part, of_parts[k], ids);
    if (!pasted.seeds.empty())
      pasted.id = pasted.seeds[0].id;
    else if (RegionIds::names_one(part))
      pasted.id = ids.number(of_parts[k].begin()->first, of_parts[k].begin()->second);
    named.parts.push_back(std::move(pasted));
  }
  // Explicit ids come first.
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].regions.empty() && !RegionIds::names_one(parts[k]))
      named.parts[k].id = ids.number_of_part(k, k < names.size() ? names[k] : "");
  named.regions = ids.names();
  return named;
}

}  // namespace holdfast
