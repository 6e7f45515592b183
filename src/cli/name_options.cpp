#include "name_options.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "command.h"

namespace holdfast::cli {
namespace {

struct Kind {
  std::string_view prefix;
  std::map<int, std::string> Names::*names;
  std::set<int> Nameable::*ids;
  const char* what;
};

constexpr Kind kinds[] = {
    {"facet:", &Names::facets, &Nameable::facets, "triangle"},
    {"region:", &Names::regions, &Nameable::regions, "region"},
    {"segment:", &Names::segments, &Nameable::segments, "segment"},
    {"vertex:", &Names::vertices, &Nameable::vertices, "vertex"},
};

[[noreturn]] void refuse(const std::string& argument, const std::string& why) {
  throw UsageError("--name " + argument + ": " + why);
}

struct Naming {
  const Kind* kind;
  int id;
  std::string name;
};

Naming naming_of(const std::string& argument) {
  std::string_view rest = argument;
  Naming naming{&kinds[0], 0, {}};
  for (const Kind& kind : kinds)
    if (rest.starts_with(kind.prefix)) {
      naming.kind = &kind;
      rest.remove_prefix(kind.prefix.size());
      break;
    }
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), naming.id);
  const auto read = static_cast<std::size_t>(stop - rest.data());
  if (error != std::errc() || read == rest.size() || rest[read] != '=')
    refuse(argument, "ID=NAME, region:ID=NAME, segment:ID=NAME or vertex:ID=NAME is expected, ID an integer");
  rest.remove_prefix(read + 1);
  if (rest.empty()) refuse(argument, "the name is empty");
  for (const char c : rest)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      refuse(argument, "a control character in the name");
  naming.name = std::string(rest);
  return naming;
}

/// Entities without markers have marker 0.
void add(std::set<int>& ids, const std::vector<int>& markers, std::size_t entities) {
  if (markers.empty() && entities > 0) ids.insert(0);
  for (const int marker : markers) ids.insert(marker);
}

/// Everything that can be named in a surface or volume except its regions.
template <class Entities>
Nameable marked_in(const Entities& of) {
  Nameable ids;
  add(ids.facets, of.facet_markers, of.facets.size());
  add(ids.segments, of.segment_markers, of.segments.size());
  add(ids.vertices, of.vertex_markers, of.vertices.size());
  return ids;
}

std::string listed(const std::set<int>& ids) {
  constexpr std::size_t most = 20;
  if (ids.empty()) return "there is none at all";
  std::vector<std::string> texts;
  for (const int id : ids) {
    if (texts.size() == most)
      return fmt::format("the ids are {}, ... ({} in all)", fmt::join(texts, ", "), ids.size());
    texts.push_back(std::to_string(id));
  }
  return fmt::format("the {} {}", texts.size() == 1 ? "only id is" : "ids are", fmt::join(texts, ", "));
}

}  // namespace

void add_name_option(CLI::App& command, std::vector<std::string>& arguments) {
  command
      .add_option(
          "--name", arguments,
          "Name a facet marker (3=inlet), or region:10=core, segment:4=rim, vertex:5=tip (repeatable)")
      ->allow_extra_args(false)
      ->option_text("ID=NAME");
}

Names names_of(const std::vector<std::string>& arguments) {
  Names names;
  for (const std::string& argument : arguments) {
    Naming naming = naming_of(argument);
    const auto [given, fresh] = (names.*naming.kind->names).try_emplace(naming.id, naming.name);
    if (!fresh && given->second != naming.name)
      refuse(argument, fmt::format("it has the name '{}' by another --name", given->second));
  }
  return names;
}

Nameable nameable_in(const Volume& volume) {
  Nameable ids = marked_in(volume);
  add(ids.regions, volume.regions, volume.tetrahedra.size());
  return ids;
}

Nameable nameable_in(const Surface& surface) {
  Nameable ids = marked_in(surface);
  for (const Surface::RegionSeed& seed : surface.regions) ids.regions.insert(seed.id);
  ids.regions_are_known = !surface.regions.empty();
  return ids;
}

void tell_idle_names(const std::vector<std::string>& arguments, const Nameable& there) {
  for (const std::string& argument : arguments) {
    const Naming naming = naming_of(argument);
    const std::set<int>& ids = there.*naming.kind->ids;
    const bool is_region = naming.kind->ids == &Nameable::regions;
    if (ids.count(naming.id) > 0 || (is_region && !there.regions_are_known)) continue;
    say("holdfast: --name {} does nothing: {}; {}\n", argument,
        is_region ? std::string("there is no such region")
                  : fmt::format("no {} has the marker {}", naming.kind->what, naming.id),
        listed(ids));
  }
}

void merge(Names& into, const Names& names) {
  for (const Kind& kind : kinds)
    for (const auto& [id, name] : names.*kind.names) (into.*kind.names)[id] = name;
}

}  // namespace holdfast::cli
