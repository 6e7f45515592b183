#include "io/includes.h"

#include "io/file_bytes.h"
#include "io/named_files.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

[[noreturn]] void fail_at(const std::filesystem::path& path, std::string_view bytes, std::size_t position,
                          const std::string& reason) {
  throw FileError(path, "line " + std::to_string(line_of(bytes, position)), reason);
}

}  // namespace

Includes::Includes(const Source& source, const IncludeRule& rule) : source_(source), rule_(rule) {
  if (rule_.next(source.bytes, 0)) add(source.path, source.bytes, 0);
}

Source Includes::source() const {
  Source whole = source_;
  if (origins_.empty()) return whole;
  whole.bytes = text_;
  whole.origins = origins_;
  return whole;
}

void Includes::add(const std::filesystem::path& path, std::string_view bytes, std::size_t depth) {
  constexpr std::size_t kDeepest = 20, kMostFiles = 1000;
  std::size_t done = 0;
  while (const std::optional<Include> include = rule_.next(bytes, done)) {
    add_text(path, bytes, done, include->begin);
    done = include->end;
    if (include->name.empty()) fail_at(path, bytes, include->begin, std::string(rule_.without_name));
    if (depth == kDeepest || files_.size() == kMostFiles)
      fail_at(path, bytes, include->begin, "too many files are included, or they include each other");
    files_.push_back(source_.path.parent_path() / include->name);
    const std::filesystem::path& file = files_.back();
    const FileBytes included(file, source_.watch);
    add(file, included.view(), depth + 1);
  }
  add_text(path, bytes, done, bytes.size());
}

void Includes::add_text(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                        std::size_t end) {
  if (begin == end) return;
  if (!text_.empty() && text_.back() != '\n' && text_.back() != '\r' && bytes[begin] != '\n' &&
      bytes[begin] != '\r')
    text_ += '\n';
  origins_.push_back({text_.size(), path, line_of(bytes, begin)});
  text_ += bytes.substr(begin, end - begin);
}

std::vector<std::filesystem::path> with_included_files(const std::filesystem::path& path,
                                                       const IncludeRule& rule) {
  return with_named_files(path, [&rule](const Source& source) {
    const Includes whole(source, rule);
    return std::vector(whole.files().begin(), whole.files().end());
  });
}

}  // namespace holdfast::io
