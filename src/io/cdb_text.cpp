#include "io/cdb_text.h"

#include <charconv>

namespace holdfast::io {
namespace {

/// A number at the begin of a text, which is removed from it; 1 if there is none.
std::size_t leading_number(std::string_view& text) {
  std::size_t value = 1;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  return value;
}

std::string_view column(std::string_view line, std::size_t begin, std::size_t width) {
  return begin < line.size() ? trimmed(line.substr(begin, width)) : std::string_view();
}

}  // namespace

bool CdbText::next() {
  beat(text_.source().watch);
  line_ = {};
  if (text_.remaining().empty()) return false;
  line_ = text_.rest_of_line();
  return true;
}

CdbColumns CdbText::read_format() {
  if (!next()) fail_truncated("the format of a block");
  CdbColumns columns;
  std::string packed = lower(line_);
  std::erase(packed, ' ');
  for (std::string_view rest = packed; !rest.empty();) {
    if (rest[0] == '(' || rest[0] == ',') {
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t count = leading_number(rest);
    if (rest.empty() ||
        (rest[0] != 'i' && rest[0] != 'e' && rest[0] != 'f' && rest[0] != 'd' && rest[0] != 'g'))
      break;
    const bool is_integer = rest[0] == 'i';
    rest.remove_prefix(1);
    const std::size_t width = leading_number(rest);
    if (is_integer) columns.integers = count;
    (is_integer ? columns.integer_width : columns.real_width) = width;
    rest.remove_prefix(std::min(rest.find_first_of(",)"), rest.size()));
  }
  if (columns.integers < 1 || columns.integers > 99 || columns.integer_width < 2 ||
      columns.integer_width > 99 || columns.real_width > 99)
    fail("expected the format of a block, such as (3i9,6e21.13e3), found " + in_quotes(line_));
  return columns;
}

std::int64_t CdbText::integer(const CdbColumns& columns, std::size_t i, std::string_view what) const {
  const std::string_view field = column(line_, i * columns.integer_width, columns.integer_width);
  return field.empty() ? 0 : integer_of(text_, field, what);
}

double CdbText::real(const CdbColumns& columns, std::size_t i, std::string_view what) const {
  const std::size_t begin = columns.integers * columns.integer_width + i * columns.real_width;
  const std::string_view field = column(line_, begin, columns.real_width);
  return field.empty() ? 0 : real_of(text_, field, what);
}

bool CdbText::ends_block(const CdbColumns& columns) const {
  const std::string_view first = column(line_, 0, columns.integer_width);
  return first == "-1" ||
         (!first.empty() && first.find_first_not_of("0123456789+-") != std::string_view::npos);
}

}  // namespace holdfast::io
