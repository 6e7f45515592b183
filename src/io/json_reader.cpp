// A JSON text as a tree.
#include "io/json_reader.h"

#include <algorithm>
#include <charconv>

#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kDeepest = 128;
/// A value takes forty times the memory of its text; files of meshes have far fewer.
constexpr std::size_t kMostValues = std::size_t{1} << 23;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class JsonReader {
 public:
  JsonReader(const Source& source, std::size_t begin, std::size_t end)
      : source_(source), text_(source.bytes.substr(0, end)), begin_(begin), at_(begin) {}

  JsonValue read() {
    JsonValue value = read_value(0);
    skip_blanks();
    if (at_ < text_.size()) fail("expected the end of the text");
    return value;
  }

 private:
  JsonValue read_value(std::size_t depth) {
    beat(source_.watch);
    skip_blanks();
    if (++values_ > kMostValues) fail("more than " + std::to_string(kMostValues) + " values");
    if (depth > kDeepest) fail("values in values without end");
    JsonValue value;
    value.position = at_;
    const char c = next("a value");
    if (c == '{')
      read_object(value, depth);
    else if (c == '[')
      read_array(value, depth);
    else if (c == '"')
      read_string(value);
    else if (c == '-' || is_digit(c))
      read_number(value);
    else
      read_word(value);
    return value;
  }

  void read_object(JsonValue& value, std::size_t depth) {
    value.kind = JsonValue::Kind::object;
    ++at_;
    if (ends_with('}')) return;
    do {
      skip_blanks();
      JsonValue key;
      if (next("a name") != '"') fail("expected a name in quotes");
      read_string(key);
      skip_blanks();
      if (next("a colon") != ':') fail("expected a colon");
      ++at_;
      value.keys.push_back(key.text);
      value.items.push_back(read_value(depth + 1));
    } while (goes_on('}'));
  }

  void read_array(JsonValue& value, std::size_t depth) {
    value.kind = JsonValue::Kind::array;
    ++at_;
    if (ends_with(']')) return;
    do value.items.push_back(read_value(depth + 1));
    while (goes_on(']'));
  }

  bool ends_with(char end) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != end) return false;
    ++at_;
    return true;
  }

  bool goes_on(char end) {
    skip_blanks();
    const char c = next("a comma");
    if (c != ',' && c != end) fail(std::string("expected a comma or ") + end);
    ++at_;
    return c == ',';
  }

  void read_string(JsonValue& value) {
    value.kind = JsonValue::Kind::string;
    const std::size_t first = ++at_;
    while (next("a closing quote") != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    value.text = text_.substr(first, at_ - first);
    ++at_;
  }

  void read_number(JsonValue& value) {
    value.kind = JsonValue::Kind::number;
    std::size_t end = at_;
    while (end < text_.size() &&
           (is_digit(text_[end]) || std::string_view("+-.eE").find(text_[end]) != std::string_view::npos))
      ++end;
    value.text = text_.substr(at_, end - at_);
    double number = 0;
    const auto result = std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
    if (result.ec != std::errc() || result.ptr != value.text.data() + value.text.size())
      fail("expected a number, found " + in_quotes(value.text));
    at_ = end;
  }

  void read_word(JsonValue& value) {
    for (const std::string_view word : {"true", "false", "null"}) {
      if (!text_.substr(at_).starts_with(word)) continue;
      value.kind = word == "null" ? JsonValue::Kind::null : JsonValue::Kind::boolean;
      value.text = word;
      at_ += word.size();
      return;
    }
    fail("expected a value, found " + in_quotes(text_.substr(at_, 1)));
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }

  char next(const char* what) {
    if (at_ >= text_.size()) {
      at_ = text_.size();
      fail(std::string("the text ends where ") + what + " is expected; it is truncated");
    }
    return text_[at_];
  }

  [[noreturn]] void fail(const std::string& reason) const { fail_in_json(source_, begin_, at_, reason); }

  Source source_;
  std::string_view text_;  ///< from the start of the file
  std::size_t begin_, at_;
  std::size_t values_ = 0;
};

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | code >> 6);
  } else {
    if (code < 0x10000) {
      put(0xE0 | code >> 12);
    } else {
      put(0xF0 | code >> 18);
      put(0x80 | (code >> 12 & 0x3F));
    }
    put(0x80 | (code >> 6 & 0x3F));
  }
  put(0x80 | (code & 0x3F));
}

/// The number of four hexadecimal digits at the start; beyond 16 bits where there are none.
std::uint32_t hexadecimal(std::string_view text) {
  std::uint32_t code = 0;
  const auto result =
      std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 4), code, 16);
  return result.ec == std::errc() && result.ptr == text.data() + 4 ? code : 0x10000;
}

/// What "\uXXXX" at the start stands for, or two of them, and how long it is.
std::pair<std::uint32_t, std::size_t> code_point(std::string_view text) {
  const std::uint32_t first = hexadecimal(text.substr(2));
  if (first > 0xFFFF) return {'?', 2};
  if (first < 0xD800 || first > 0xDFFF) return {first, 6};
  if (first < 0xDC00 && text.substr(6).starts_with("\\u")) {
    const std::uint32_t second = hexadecimal(text.substr(8));
    if (second >= 0xDC00 && second <= 0xDFFF)
      return {0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00), 12};
  }
  return {'?', 6};
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::string JsonValue::string() const {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      result += text[i++];
      continue;
    }
    constexpr std::string_view kNames = "bfnrt", kCharacters = "\b\f\n\r\t";
    if (text[i + 1] == 'u') {
      const auto [code, length] = code_point(text.substr(i));
      append_utf8(result, code);
      i += length;
      continue;
    }
    const std::size_t name = kNames.find(text[i + 1]);
    result += name == std::string_view::npos ? text[i + 1] : kCharacters[name];
    i += 2;
  }
  return result;
}

JsonValue read_json(const Source& source, std::size_t begin, std::size_t end) {
  return JsonReader(source, begin, end).read();
}

void fail_in_json(const Source& source, std::size_t begin, std::size_t position, const std::string& reason) {
  const std::string_view before = source.bytes.substr(begin, position - begin);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const bool has_lines = begin == 0 && source.bytes.find('\n') != std::string_view::npos;
  throw FileError(source.path,
                  has_lines ? "line " + std::to_string(lines + 1) : "byte " + std::to_string(position),
                  reason);
}

}  // namespace holdfast::io
