#include "io/dyna_text.h"

#include <algorithm>
#include <optional>

#include "io/fields.h"
#include "io/formats.h"

namespace holdfast::io {
namespace {

constexpr const char* kDynaLineEnds = "\r\n";

/// The line that begins at a position, without its end.
std::string_view line_at(std::string_view bytes, std::size_t begin) {
  return bytes.substr(begin, std::min(bytes.find_first_of(kDynaLineEnds, begin), bytes.size()) - begin);
}

std::size_t behind_line(std::string_view bytes, std::size_t begin) {
  const std::size_t end = bytes.find('\n', begin);
  return end == std::string_view::npos ? bytes.size() : end + 1;
}

bool is_comment(std::string_view line) { return line.starts_with('$') || trimmed(line).empty(); }

/// The next line from a position on that is no comment.
std::size_t no_comment(std::string_view bytes, std::size_t from) {
  while (from < bytes.size() && is_comment(line_at(bytes, from))) from = behind_line(bytes, from);
  return from;
}

/// A file's name, from a line on; it continues after a line that ends with " +".
Include named_at(std::string_view bytes, std::size_t begin, std::size_t line) {
  Include include{begin, line, {}};
  for (bool goes_on = true; goes_on && include.end < bytes.size();) {
    const std::string_view part = trimmed(line_at(bytes, include.end));
    if (part.starts_with('*')) break;
    goes_on = part.ends_with(" +");
    include.name += goes_on ? trimmed(part.substr(0, part.size() - 1)) : part;
    include.end = behind_line(bytes, include.end);
  }
  return include;
}

bool is_include(std::string_view line) { return lower(trimmed(line)) == "*include"; }

std::optional<Include> next_dyna_include(std::string_view bytes, std::size_t from) {
  // More names may follow the one before.
  if (const std::size_t line = no_comment(bytes, from);
      from > 0 && line < bytes.size() && bytes[line] != '*') {
    const std::size_t star = bytes.rfind("\n*", from - 1);
    const std::size_t keyword = star == std::string_view::npos ? 0 : star + 1;
    if (is_include(line_at(bytes, keyword))) return named_at(bytes, from, line);
  }
  for (std::size_t star = bytes.find('*', from); star != std::string_view::npos;
       star = bytes.find('*', star + 1)) {
    if (star > 0 && bytes[star - 1] != '\n' && bytes[star - 1] != '\r') continue;
    if (is_include(line_at(bytes, star)))
      return named_at(bytes, star, no_comment(bytes, behind_line(bytes, star)));
  }
  return std::nullopt;
}

bool has_blank(std::string_view text) { return text.find_first_of(" \t") != std::string_view::npos; }

}  // namespace

const IncludeRule& dyna_includes() {
  static constexpr IncludeRule kRule{next_dyna_include, "*INCLUDE without a file's name"};
  return kRule;
}

std::vector<std::filesystem::path> dyna_files(const std::filesystem::path& path) {
  return with_included_files(path, dyna_includes());
}

void DynaText::next_line() {
  text_.seek(behind_);
  for (;;) {
    beat(text_.source().watch);
    line_ = {};
    line_at_ = behind_ = text_.position();
    if (text_.remaining().empty()) return;
    const std::string_view line = text_.rest_of_line();
    behind_ = text_.position();
    if (line.starts_with('$'))
      exact_nodes_.read(line.substr(1));
    else if (!trimmed(line).empty())
      return void(line_ = line);
  }
}

void DynaText::read_keyword() {
  place_ = line_at_;
  if (line_[0] != '*') reader().fail("expected a keyword, found " + in_quotes(line_));
  const std::string whole = lower(trimmed(line_.substr(1)));
  keyword_ = whole.substr(0, whole.find_first_of(" \t(,+%-"));
  const char last = whole.empty() ? ' ' : whole.back();
  if (keyword_ == "keyword") {
    std::string packed = whole;
    std::erase(packed, ' ');
    all_wide_ = all_wide_ || packed.find("long=y") != std::string::npos;
    all_long_ = all_long_ || packed.find("i10=y") != std::string::npos;
  }
  wide_ = last == '+' || (all_wide_ && last != '-');
  long_numbers_ = last == '%' || all_long_;
  next_line();
}

bool DynaText::options_after(std::string_view stem, std::set<std::string>& options) const {
  options.clear();
  if (!keyword_.starts_with(stem)) return false;
  const std::string_view rest = std::string_view(keyword_).substr(stem.size());
  if (rest.empty()) return true;
  if (rest[0] != '_') return false;
  for (const std::string_view option : split(rest.substr(1), '_')) options.emplace(option);
  return true;
}

std::span<const std::string_view> DynaText::card(const DynaColumns& columns) {
  place_ = line_at_;
  fields_.clear();
  if (line_.find(',') != std::string_view::npos) {
    std::string_view line = line_;
    next_line();
    for (;;) {
      // Gmsh writes ten nodes in two lines, the first with a comma at its end.
      constexpr std::size_t kMostOnLine = 10;
      const std::vector<std::string_view> parts = split(line, ',');
      const bool goes_on = parts.size() > kMostOnLine && parts.back().empty() && is_data();
      fields_.insert(fields_.end(), parts.begin(), parts.end() - (goes_on ? 1 : 0));
      if (!goes_on) return fields_;
      line = line_;
      next_line();
    }
  }
  for (std::size_t begin = 0; begin < line_.size();) {
    const std::size_t width = fields_.empty()      ? columns.first
                              : fields_.size() < 4 ? columns.next
                                                   : columns.other;
    fields_.push_back(trimmed(line_.substr(begin, width)));
    begin += width;
  }
  // A value contains no blank, so these fields are not in columns.
  if (line_.find('\t') != std::string_view::npos || std::any_of(fields_.begin(), fields_.end(), has_blank))
    fields_ = words_of(trimmed(line_));
  next_line();
  return fields_;
}

std::string_view DynaText::title() {
  place_ = line_at_;
  const std::string_view text = trimmed(line_);
  next_line();
  return text;
}

void DynaText::skip_cards(std::size_t count) {
  for (; count > 0 && is_data(); --count) next_line();
}

void DynaText::skip_keyword() {
  while (is_data()) next_line();
}

void DynaText::end_of_file() {
  const std::span<const Origin> origins = text_.source().origins;
  const auto behind = std::find_if(origins.begin(), origins.end(),
                                   [&](const Origin& origin) { return origin.begin > place_; });
  behind_ = behind == origins.end() ? text_.source().bytes.size() : behind->begin;
  next_line();
}

std::int64_t dyna_integer(DynaText& text, std::span<const std::string_view> fields, std::size_t i,
                          std::string_view what) {
  if (i >= fields.size() || fields[i].empty()) return 0;
  return integer_of(text.reader(), fields[i], what);
}

}  // namespace holdfast::io
