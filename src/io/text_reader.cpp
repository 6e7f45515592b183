// Reads numbers and words, with their lines, from a text in memory.
//
// Lines are counted only for errors, so that reading does not pay for them.
#include "io/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "text/parse.h"

namespace holdfast::io {
namespace {

bool blank(char c) { return static_cast<unsigned char>(c) <= ' ' && c != '\0'; }
bool line_end(char c) { return c == '\n' || c == '\r'; }

}  // namespace

std::size_t line_of(std::string_view text, std::size_t position) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < position && i < text.size(); ++i) {
    if (text[i] == '\n') ++line;
    if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) ++line;
  }
  return line;
}

TextReader::TextReader(const Source& source, char comment) : source_(source), comment_(comment) {
  const std::string_view bytes = source.bytes;
  if (bytes.empty()) throw FileError(source.path, "", "the file is empty");
  if (bytes.starts_with("\xEF\xBB\xBF")) position_ = 3;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw FileError(source.path, "line 1", "is UTF-16 text; save it as ASCII or UTF-8");
}

bool TextReader::at_end() {
  const std::string_view text = source_.bytes;
  for (;;) {
    while (position_ < text.size() && blank(text[position_])) ++position_;
    if (position_ == text.size()) return true;
    if (comment_ == '\0' || text[position_] != comment_) return false;
    skip_line();
  }
}

bool TextReader::at_line_end() {
  const std::string_view text = source_.bytes;
  while (position_ < text.size() && blank(text[position_]) && !line_end(text[position_])) ++position_;
  if (position_ == text.size() || line_end(text[position_])) return true;
  return comment_ != '\0' && text[position_] == comment_;
}

void TextReader::skip_line() {
  const std::string_view text = source_.bytes;
  while (position_ < text.size() && !line_end(text[position_])) ++position_;
  if (position_ < text.size()) position_ += text.substr(position_).starts_with("\r\n") ? 2 : 1;
}

bool TextReader::delimiter_at(std::size_t position) const {
  if (position >= source_.bytes.size()) return true;
  const char c = source_.bytes[position];
  return blank(c) || (comment_ != '\0' && c == comment_);
}

std::size_t TextReader::word_end(std::size_t position) const {
  while (!delimiter_at(position)) ++position;
  return position;
}

void TextReader::start(std::string_view what) {
  beat(source_.watch);
  if (at_end()) fail_truncated(what);
  last_ = position_;
}

std::string_view TextReader::word(std::string_view what) {
  start(what);
  position_ = word_end(position_);
  return source_.bytes.substr(last_, position_ - last_);
}

std::string_view TextReader::word_on_line() {
  beat(source_.watch);
  if (at_line_end()) return {};
  last_ = position_;
  position_ = word_end(position_);
  return source_.bytes.substr(last_, position_ - last_);
}

std::string_view TextReader::rest_of_line() {
  last_ = position_;
  const std::string_view text = source_.bytes;
  std::size_t end = position_;
  while (end < text.size() && !line_end(text[end])) ++end;
  skip_line();
  return text.substr(last_, end - last_);
}

double TextReader::real(std::string_view what) {
  start(what);
  const char* const begin = source_.bytes.data();
  const char* const end = begin + source_.bytes.size();
  double value = 0;
  auto result = parse_real(begin + position_, end, value);
  std::string number;  // with another spelling, if necessary
  if (result.ptr != end && (*result.ptr == 'D' || *result.ptr == 'd')) {  // Fortran's exponent, 1.5D+3
    number = source_.bytes.substr(position_, word_end(position_) - position_);
    number[static_cast<std::size_t>(result.ptr - begin) - position_] = 'e';
    result = parse_real(number.data(), number.data() + number.size(), value);
    result.ptr = begin + position_ + (result.ptr - number.data());
  }
  if (result.ec == std::errc::result_out_of_range)
    fail(
        in_quotes(source_.bytes.substr(position_, static_cast<std::size_t>(result.ptr - begin) - position_)) +
        " is too large for a double");
  if (result.ec != std::errc()) fail_expected(what);
  position_ = static_cast<std::size_t>(result.ptr - begin);
  if (!delimiter_at(position_)) fail_expected(what);
  if (source_.finite && !std::isfinite(value)) fail(std::string(what) + " is not finite");
  return value;
}

std::int64_t TextReader::integer(std::string_view what) {
  start(what);
  const char* const begin = source_.bytes.data();
  const char* const end = begin + source_.bytes.size();
  const char* first = begin + position_;
  if (*first == '+' && first + 1 != end && first[1] != '-') ++first;
  std::int64_t value = 0;
  const auto result = std::from_chars(first, end, value);
  position_ = static_cast<std::size_t>(result.ptr - begin);
  if (result.ec == std::errc::result_out_of_range)
    fail(std::string(what) +
         " is beyond 64 bits: " + in_quotes(source_.bytes.substr(last_, position_ - last_)));
  if (result.ec != std::errc() || !delimiter_at(position_)) fail_expected(what);
  return value;
}

int TextReader::tag(std::string_view what) {
  const std::int64_t value = integer(what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    fail(std::string(what) + " is beyond 32 bits: " + std::to_string(value));
  return static_cast<int>(value);
}

int TextReader::tag_from_real(std::string_view what) {
  const double value = real(what);
  if (!(value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max()) ||
      value != std::trunc(value))
    fail(std::string(what) + " must be a whole number of 32 bits");
  return static_cast<int>(value);
}

Point TextReader::point() {
  const double x = real("a coordinate");
  const double y = real("a coordinate");
  return {x, y, real("a coordinate")};
}

Index TextReader::index(std::string_view what, std::int64_t base, std::size_t size) {
  const std::int64_t value = integer(what);
  if (value < base || static_cast<std::uint64_t>(value - base) >= size) {
    const std::string range = size == 0 ? "there are none"
                                        : "they run from " + std::to_string(base) + " to " +
                                              std::to_string(base + static_cast<std::int64_t>(size) - 1);
    fail(std::string(what) + " is out of range: " + std::to_string(value) + " (" + range + ")");
  }
  return static_cast<Index>(value - base);
}

std::size_t TextReader::count(std::string_view what, std::size_t bytes_each) {
  const std::int64_t value = integer(what);
  if (value < 0) fail(std::string(what) + " is negative: " + std::to_string(value));
  const std::size_t left = source_.bytes.size() - position_;
  // The last item needs no separator.
  if (static_cast<std::uint64_t>(value) > (left + 1) / bytes_each)
    fail(std::string(what) + " is " + std::to_string(value) + ", but only " + std::to_string(left) +
         " bytes follow; the file is truncated or damaged");
  if (value >= std::numeric_limits<Index>::max())
    fail(std::string(what) + " is beyond 32 bits: " + std::to_string(value));
  return static_cast<std::size_t>(value);
}

bool TextReader::number_follows() {
  if (at_end()) return false;
  const char c = source_.bytes[position_];
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

void TextReader::fail(const std::string& reason) const { fail_at(last_, reason); }

void TextReader::fail_at(std::size_t position, const std::string& reason) const {
  const auto behind =
      std::upper_bound(source_.origins.begin(), source_.origins.end(), position,
                       [](std::size_t at, const Origin& origin) { return at < origin.begin; });
  const Origin whole{0, source_.path, 1};
  const Origin& origin = behind == source_.origins.begin() ? whole : behind[-1];
  const std::size_t line =
      origin.line + line_of(source_.bytes.substr(origin.begin), position - origin.begin) - 1;
  throw FileError(origin.path, "line " + std::to_string(line), reason);
}

void TextReader::fail_truncated(std::string_view what) const {
  fail_at(source_.bytes.size(), "the file ends where " + std::string(what) + " is expected; it is truncated");
}

void TextReader::fail_expected(std::string_view what) const {
  fail("expected " + std::string(what) + ", found " +
       in_quotes(source_.bytes.substr(last_, word_end(last_) - last_)));
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 32;
  std::string result = "'";
  for (const char c : text.substr(0, kMost)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMost ? "...'" : "'");
}

}  // namespace holdfast::io
