#include "io/bdf_card.h"

#include <algorithm>

#include "io/fields.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kBetweenFields = " \t";
constexpr std::size_t kColumns = 8;  // of a field, and between tab stops

bool has_blanks(std::string_view text) {
  return text.find_first_of(kBetweenFields) != std::string_view::npos;
}

bool is_wide(std::string_view head) { return head.find('*') != std::string_view::npos; }

/// The parts of a line that are cut at columns 8, 8 + width, ..., at most `count` of them.
std::vector<std::string_view> in_columns(std::string_view line, std::size_t width, std::size_t count) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0, column = 0, end = kColumns;
  for (std::size_t i = 0; i < line.size() && parts.size() < count; ++i) {
    if (column >= end) {
      parts.push_back(trimmed(line.substr(begin, i - begin)));
      begin = i;
      end += width;
    }
    column += line[i] == '\t' ? kColumns - column % kColumns : 1;
  }
  if (parts.size() < count) parts.push_back(trimmed(line.substr(begin)));
  return parts;
}

std::vector<std::string_view> between_blanks(std::string_view line) {
  std::vector<std::string_view> parts;
  // A continued line may have an empty first field.
  if (line.empty() || has_blanks(line.substr(0, 1))) parts.emplace_back();
  for (line = trimmed(line); !line.empty();) {
    const std::size_t end = std::min(line.find_first_of(kBetweenFields), line.size());
    parts.push_back(line.substr(0, end));
    line = trimmed(line.substr(end));
  }
  return parts;
}

}  // namespace

bool BdfCard::continues(std::string_view line) {
  return line[0] == '+' || line[0] == '*' || line[0] == ' ' || line[0] == ',' || line[0] == '\t';
}

void BdfCard::add(std::string_view line) {
  if (line.find(',') != std::string_view::npos)
    add_free(split(line, ','));
  else if (between_blanks_)
    add_free(between_blanks(line));
  else
    add_columns(line);
  begun_ = true;
}

void BdfCard::add_columns(std::string_view line) {
  const bool wide = is_wide(in_columns(line, kColumns, 1)[0]);
  const std::size_t count = wide ? 4 : 8;
  std::vector<std::string_view> parts = in_columns(line, wide ? 2 * kColumns : kColumns, count + 1);
  if (!begun_) {
    set_name(parts[0]);
    // A value contains no blank, so these fields are not in columns.
    between_blanks_ = has_blanks(name_) || std::any_of(parts.begin() + 1, parts.end(), has_blanks);
    if (between_blanks_) return add_free(between_blanks(line));
  }
  parts.resize(count + 1);
  fields_.insert(fields_.end(), parts.begin() + 1, parts.end());
}

void BdfCard::add_free(const std::vector<std::string_view>& parts) {
  if (!begun_) set_name(parts[0]);
  const std::size_t count = is_wide(parts[0]) ? 4 : 8;
  // A last part that is no value is a continuation mark.
  const bool joined = parts.size() <= count + 1 || parts[count + 1].empty() || is_wide(parts[count + 1]) ||
                      parts[count + 1][0] == '+';
  const std::size_t end = joined ? std::min(parts.size(), count + 1) : parts.size();
  fields_.insert(fields_.end(), parts.begin() + 1, parts.begin() + static_cast<std::ptrdiff_t>(end));
  fields_.resize((fields_.size() + count - 1) / count * count);
}

void BdfCard::set_name(std::string_view head) {
  name_ = lower(trimmed(head));
  while (name_.ends_with('*') || name_.ends_with(' ') || name_.ends_with('\t')) name_.pop_back();
}

}  // namespace holdfast::io
