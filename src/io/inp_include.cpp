#include "io/inp_include.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "io/fields.h"
#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// A line that includes a file, without its end.
struct Include {
  std::size_t begin, end;
  std::string name;  ///< empty: it names none
};

std::string name_in(std::string_view line) {
  for (const std::string_view field : split(line, ',')) {
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos || lower(trimmed(field.substr(0, equals))) != "input") continue;
    std::string_view name = trimmed(field.substr(equals + 1));
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    return std::string(name);
  }
  return {};
}

/// The next one from a place on. Only stars are looked at, of which a mesh has few.
std::optional<Include> next_include(std::string_view bytes, std::size_t from) {
  constexpr const char* kLineEnds = "\r\n";
  for (std::size_t star = bytes.find('*', from); star != std::string_view::npos;
       star = bytes.find('*', star + 1)) {
    const std::size_t before = star == 0 ? std::string_view::npos : bytes.find_last_of(kLineEnds, star - 1);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    if (!trimmed(bytes.substr(begin, star - begin)).empty()) continue;
    const std::size_t end = std::min(bytes.find_first_of(kLineEnds, star), bytes.size());
    const std::string_view line = bytes.substr(star + 1, end - star - 1);
    if (lower(trimmed(line.substr(0, line.find(',')))) == "include")
      return Include{begin, end, name_in(line)};
  }
  return std::nullopt;
}

[[noreturn]] void fail_at(const std::filesystem::path& path, std::string_view bytes, std::size_t position,
                          const std::string& reason) {
  throw FileError(path, "line " + std::to_string(line_of(bytes, position)), reason);
}

}  // namespace

InpIncludes::InpIncludes(const Source& source) : source_(source) {
  if (next_include(source.bytes, 0)) add(source.path, source.bytes, 0);
}

Source InpIncludes::source() const {
  Source whole = source_;
  if (origins_.empty()) return whole;
  whole.bytes = text_;
  whole.origins = origins_;
  return whole;
}

void InpIncludes::add(const std::filesystem::path& path, std::string_view bytes, std::size_t depth) {
  constexpr std::size_t kDeepest = 20, kMostFiles = 1000;
  std::size_t done = 0;
  while (const std::optional<Include> include = next_include(bytes, done)) {
    add_text(path, bytes, done, include->begin);
    done = include->end;
    if (include->name.empty()) fail_at(path, bytes, include->begin, "*INCLUDE without INPUT");
    if (depth == kDeepest || files_.size() == kMostFiles)
      fail_at(path, bytes, include->begin, "too many files are included, or they include each other");
    files_.push_back(source_.path.parent_path() / include->name);
    const std::filesystem::path& file = files_.back();
    const FileBytes included(file, source_.watch);
    add(file, included.view(), depth + 1);
  }
  add_text(path, bytes, done, bytes.size());
}

void InpIncludes::add_text(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                           std::size_t end) {
  if (begin == end) return;
  if (!text_.empty() && text_.back() != '\n' && text_.back() != '\r' && bytes[begin] != '\n' &&
      bytes[begin] != '\r')
    text_ += '\n';
  origins_.push_back({text_.size(), path, line_of(bytes, begin)});
  text_ += bytes.substr(begin, end - begin);
}

std::vector<std::filesystem::path> inp_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{path};
  std::error_code error;
  // A pipe is read only once.
  if (!std::filesystem::is_regular_file(path, error)) return files;
  try {
    const FileBytes bytes(path);
    const InpIncludes whole({path, bytes.view()});
    files.insert(files.end(), whole.files().begin(), whole.files().end());
  } catch (const FileError&) {
    // The reader says so.
  }
  return files;
}

}  // namespace holdfast::io
