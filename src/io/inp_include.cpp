#include "io/inp_include.h"

#include <algorithm>
#include <optional>

#include "io/fields.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr const char* kLineEnds = "\r\n";

std::string_view without_ends(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// The value of the parameter INPUT of a keyword.
std::string name_in(std::string_view keyword) {
  for (const std::string_view field : split(keyword, ',')) {
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos || lower(without_ends(field.substr(0, equals))) != "input") continue;
    std::string_view name = without_ends(field.substr(equals + 1));
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    return std::string(name);
  }
  return {};
}

/// The end of a keyword that begins at `begin`: it continues after a line that ends with a comma.
std::size_t end_of_keyword(std::string_view bytes, std::size_t begin) {
  for (;;) {
    const std::size_t end = std::min(bytes.find_first_of(kLineEnds, begin), bytes.size());
    const std::size_t next = bytes.find_first_not_of(kLineEnds, end);
    if (next == std::string_view::npos || !trimmed(bytes.substr(begin, end - begin)).ends_with(','))
      return end;
    begin = next;
  }
}

/// The next inclusion from a position on. Only asterisks are examined, of which a mesh has few.
std::optional<Include> next_inp_include(std::string_view bytes, std::size_t from) {
  for (std::size_t star = bytes.find('*', from); star != std::string_view::npos;
       star = bytes.find('*', star + 1)) {
    const std::size_t before = star == 0 ? std::string_view::npos : bytes.find_last_of(kLineEnds, star - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    if (!trimmed(bytes.substr(begin, star - begin)).empty()) continue;
    const std::size_t end = std::min(bytes.find_first_of(kLineEnds, star), bytes.size());
    const std::string_view line = bytes.substr(star + 1, end - star - 1);
    const std::string keyword = lower(trimmed(line.substr(0, line.find(','))));
    if (keyword == "include") return Include{begin, end, name_in(line)};
    if (keyword != "node" && keyword != "element") continue;
    // The file contains the data lines; the keyword itself stays.
    const std::size_t behind = end_of_keyword(bytes, star);
    const std::string name = name_in(bytes.substr(star, behind - star));
    if (!name.empty()) return Include{behind, behind, name};
  }
  return std::nullopt;
}

}  // namespace

const IncludeRule& inp_includes() {
  static constexpr IncludeRule kRule{next_inp_include, "*INCLUDE without INPUT"};
  return kRule;
}

std::vector<std::filesystem::path> inp_files(const std::filesystem::path& path) {
  return with_included_files(path, inp_includes());
}

}  // namespace holdfast::io
