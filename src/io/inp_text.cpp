#include "io/inp_text.h"

#include <span>

namespace holdfast::io {

bool InpText::next() {
  while (!text_.remaining().empty()) {
    line_ = trimmed(text_.rest_of_line());
    beat(text_.source().watch);
    if (!line_.empty() && !line_.starts_with("**")) return true;
    if (line_.empty()) continue;
    if (!read_id_comment(line_.substr(2), std::array{&names_.regions, &names_.markers}))
      exact_nodes_.read(line_.substr(2));
  }
  line_ = {};
  return false;
}

bool InpText::is_keyword(std::string_view name) const {
  std::string word = lower(line_.substr(0, line_.find(',')));
  std::erase_if(word, [](char c) { return c == ' ' || c == '\t'; });
  return word.starts_with('*') && std::string_view(word).substr(1) == name;
}

std::int64_t InpText::number(std::string_view field, std::string_view what) const {
  const std::int64_t number = integer_of(text_, field, what);
  if (number < 0 || number >= kNumbersOfAnInstance)
    text_.fail(std::string(what) + " is out of range: " + std::to_string(number));
  return scope_.offset + number;
}

std::int64_t InpText::increment(const std::vector<std::string_view>& fields, std::size_t k,
                                std::string_view what) const {
  if (k >= fields.size() || fields[k].empty()) return 1;
  const std::int64_t increment = integer_of(text_, fields[k], what);
  if (increment < -kMostIncrement || increment > kMostIncrement)
    text_.fail(std::string(what) + " is out of range: " + std::to_string(increment));
  return increment;
}

InpRange InpText::range(const std::vector<std::string_view>& fields, const std::string& what) const {
  if (fields.size() < 2) text_.fail("GENERATE needs a first and a last " + what);
  const InpRange range{number(fields[0], "the first " + what), number(fields[1], "the last " + what),
                       increment(fields, 2, "a step")};
  if (range.step < 1 || range.last < range.first) text_.fail("a range that does not go up");
  return range;
}

InpKeyword InpText::keyword() {
  if (line_[0] != '*') text_.fail("expected a keyword, found " + in_quotes(line_));
  const std::size_t begin = place();
  std::string all(line_.substr(1));
  while (all.ends_with(',') && next()) all += line_;
  const std::vector<std::string_view> fields = split(all, ',');
  InpKeyword result{lower(fields[0]), {}, begin};
  for (const std::string_view field : std::span(fields).subspan(1)) {
    const std::size_t equals = field.find('=');
    std::string_view value = equals == std::string_view::npos ? "" : trimmed(field.substr(equals + 1));
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    result.values[lower(trimmed(field.substr(0, equals)))] = std::string(value);
  }
  next();
  return result;
}

}  // namespace holdfast::io
