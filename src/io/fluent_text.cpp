#include "io/fluent_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/byte_reader.h"
#include "text/parse.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kEndOfBinary = "End of Binary Section";

bool ends_word(char c) { return static_cast<unsigned char>(c) <= ' ' || c == '(' || c == ')' || c == '"'; }

template <typename Number>
Number number_of(const TextReader& text, std::string_view word, int base, std::string_view what) {
  Number value = 0;
  const char* const end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value, base);
  if (result.ec != std::errc() || result.ptr != end)
    text.fail("expected " + std::string(what) + ", found " + in_quotes(word));
  return value;
}

}  // namespace

char FluentText::peek() { return text_.at_end() ? '\0' : text_.remaining()[0]; }

void FluentText::expect(char sign, std::string_view what) {
  if (text_.at_end()) text_.fail_truncated(what);
  const std::size_t at = text_.position();
  text_.seek(at);
  const char found = text_.remaining()[0];
  if (found != sign)
    text_.fail("expected '" + std::string(1, sign) + "' of " + std::string(what) + ", found " +
               in_quotes(std::string_view(&found, 1)));
  text_.seek(at + 1);
}

std::string_view FluentText::word(std::string_view what) {
  beat(text_.source().watch);
  if (text_.at_end()) text_.fail_truncated(what);
  const std::size_t begin = text_.position();
  text_.seek(begin);
  const std::string_view rest = text_.remaining();
  if (rest[0] == '"') {
    std::size_t end = 1;
    while (end < rest.size() && rest[end] != '"') end += rest[end] == '\\' ? 2 : 1;
    if (end >= rest.size()) text_.fail("a text that does not end; the file is truncated");
    text_.seek(begin + end + 1);
    return rest.substr(1, end - 1);
  }
  const auto* const end = std::find_if(rest.begin(), rest.end(), ends_word);
  const auto size = static_cast<std::size_t>(end - rest.begin());
  if (size == 0) text_.fail("expected " + std::string(what) + ", found " + in_quotes(rest.substr(0, 1)));
  text_.skip(size);
  return rest.substr(0, size);
}

std::int64_t FluentText::decimal(std::string_view what) {
  return number_of<std::int64_t>(text_, word(what), 10, what);
}

std::uint64_t FluentText::hexadecimal(std::string_view what) {
  return number_of<std::uint64_t>(text_, word(what), 16, what);
}

void FluentText::skip_list() {
  for (std::size_t depth = 1; depth > 0;) {
    const char sign = peek();
    if (sign == '\0') text_.fail_truncated("')'");
    if (sign != '(' && sign != ')') {
      static_cast<void>(word("a word"));
      continue;
    }
    depth = sign == '(' ? depth + 1 : depth - 1;
    text_.seek(text_.position() + 1);
  }
}

std::size_t FluentText::size_of_binary() const {
  const std::size_t end = text_.remaining().find(kEndOfBinary);
  if (end == std::string_view::npos)
    text_.fail("the binary section that begins here does not end; the file is truncated");
  return end;
}

const char* FluentText::raw(std::size_t bytes, std::string_view what) {
  beat(text_.source().watch);
  const std::string_view rest = text_.remaining();
  if (rest.size() < bytes) text_.fail_truncated(what);
  text_.skip(bytes);
  return rest.data();
}

std::uint64_t FluentText::index(std::string_view what) {
  if (bytes_ == 0) return hexadecimal(what);
  const char* const number = raw(bytes_, what);
  return bytes_ == 4 ? load<std::uint32_t>(number, order_) : load<std::uint64_t>(number, order_);
}

double FluentText::real(std::string_view what) {
  double value = 0;
  if (bytes_ == 4) {
    value = load<float>(raw(4, what), order_);
  } else if (bytes_ == 8) {
    value = load<double>(raw(8, what), order_);
  } else {
    const std::string_view found = word(what);
    const char* const end = found.data() + found.size();
    const auto result = parse_real(found.data(), end, value);
    if (result.ec == std::errc::result_out_of_range)
      text_.fail(in_quotes(found) + " is too large for a double");
    if (result.ec != std::errc() || result.ptr != end)
      text_.fail("expected " + std::string(what) + ", found " + in_quotes(found));
  }
  if (text_.source().finite && !std::isfinite(value)) text_.fail(std::string(what) + " is not finite");
  return value;
}

void FluentText::end_body() {
  close("a list");
  if (bytes_ > 0) return skip_binary();
  close("a section");
}

void FluentText::skip_binary() {
  text_.seek(text_.position() + size_of_binary() + kEndOfBinary.size());
  if (peek() != ')') static_cast<void>(word("the index of the section"));
  close("a section");
  bytes_ = 0;
}

std::size_t FluentText::count(std::uint64_t first, std::uint64_t last, std::size_t bytes_each,
                              std::string_view what) {
  if (first < 1 || last < first || last >= no_entity)
    text_.fail(std::string(what) + " from " + std::to_string(first) + " to " + std::to_string(last) +
               " are none that 32 bits count");
  const std::size_t left = text_.remaining().size();
  if (last - first >= left / bytes_each + 1)
    text_.fail(std::to_string(last - first + 1) + " " + std::string(what) + " are announced, but only " +
               std::to_string(left) + " bytes follow; the file is truncated or damaged");
  return static_cast<std::size_t>(last - first + 1);
}

}  // namespace holdfast::io
