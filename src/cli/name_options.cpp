#include "name_options.h"

#include <charconv>
#include <string_view>
#include <utility>

#include "command.h"

namespace holdfast::cli {
namespace {

struct Kind {
  std::string_view prefix;
  std::map<int, std::string> Names::*names;
};

constexpr Kind kinds[] = {{"facet:", &Names::facets},
                          {"region:", &Names::regions},
                          {"segment:", &Names::segments},
                          {"vertex:", &Names::vertices}};

[[noreturn]] void refuse(const std::string& argument, const char* why) {
  throw UsageError("--name " + argument + ": " + why);
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
    std::string_view rest = argument;
    auto of = &Names::facets;
    for (const Kind& kind : kinds)
      if (rest.starts_with(kind.prefix)) {
        of = kind.names;
        rest.remove_prefix(kind.prefix.size());
        break;
      }
    int id = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), id);
    const auto read = static_cast<std::size_t>(stop - rest.data());
    if (error != std::errc() || read == rest.size() || rest[read] != '=')
      refuse(argument,
             "ID=NAME, region:ID=NAME, segment:ID=NAME or vertex:ID=NAME is expected, ID an integer");
    rest.remove_prefix(read + 1);
    if (rest.empty()) refuse(argument, "the name is empty");
    for (const char c : rest)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
        refuse(argument, "a control character in the name");
    (names.*of)[id] = std::string(rest);
  }
  return names;
}

void merge(Names& into, const Names& names) {
  for (const Kind& kind : kinds)
    for (const auto& [id, name] : names.*kind.names) (into.*kind.names)[id] = name;
}

}  // namespace holdfast::cli
