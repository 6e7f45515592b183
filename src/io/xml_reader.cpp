// Reads the tags of an XML text one after the other: the part of XML that mesh files use.
#include "io/xml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "io/text_reader.h"
#include "text/markup.h"
#include "text/parse.h"
#include "text/utf8.h"

namespace holdfast::io {
namespace {

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(kXmlBlanks), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(kXmlBlanks) + 1);
}

/// The UTF-8 bytes of the character reference (&#252; or &#xfc;) at the start of `text`, and its length;
/// empty if there is none.
std::pair<std::string, std::size_t> character_by_number(std::string_view text) {
  if (!text.starts_with("&#")) return {};
  const bool hexadecimal = text.substr(2).starts_with('x');
  const char* const digits = text.data() + (hexadecimal ? 3 : 2);
  const char* const end = text.data() + text.size();
  std::uint32_t code = 0;
  const auto result = std::from_chars(digits, end, code, hexadecimal ? 16 : 10);
  const bool is_character = code > 0 && code < 0x110000 && (code < 0xD800 || code > 0xDFFF);
  if (result.ec != std::errc() || result.ptr == end || *result.ptr != ';' || !is_character) return {};
  std::string bytes;
  append_utf8(bytes, code);
  return {bytes, static_cast<std::size_t>(result.ptr + 1 - text.data())};
}

}  // namespace

std::string unescaped(std::string_view text) {
  constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string result;
  while (!text.empty()) {
    if (const auto [bytes, length] = character_by_number(text); length > 0) {
      result += bytes;
      text.remove_prefix(length);
      continue;
    }
    const auto found = std::find_if(std::begin(kEntities), std::end(kEntities),
                                    [&](const auto& entity) { return text.starts_with(entity.first); });
    const bool is_entity = found != std::end(kEntities);
    result += is_entity ? found->second : text.front();
    text.remove_prefix(is_entity ? found->first.size() : 1);
  }
  return result;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (const std::string_view entity = entity_of(c); !entity.empty())
      result += entity;
    else  // XML has no control characters
      result += c >= '\0' && c < ' ' ? ' ' : c;
  }
  return result;
}

std::string XmlTag::attribute(std::string_view key) const {
  for (const auto& [name, value] : attributes)
    if (name == key) return value;
  return {};
}

std::optional<XmlTag> XmlReader::next() {
  for (;;) {
    position_ = source_.bytes.find('<', position_);
    if (position_ == std::string_view::npos) {
      position_ = source_.bytes.size();
      return std::nullopt;
    }
    if (!starts_with("<?") && !starts_with("<!")) break;
    const std::string_view end = starts_with("<!--") ? "-->" : ">";  // tags in CDATA count, as XDMF's do
    position_ = std::min(source_.bytes.find(end, position_), source_.bytes.size());
  }
  XmlTag tag;
  tag.position = position_++;
  if (starts_with("/")) {
    tag.closing = true;
    ++position_;
  }
  tag.name = read_name();
  read_attributes(tag);
  return tag;
}

void XmlReader::skip_blanks() {
  position_ = std::min(source_.bytes.find_first_not_of(kXmlBlanks, position_), source_.bytes.size());
}

std::string XmlReader::read_name() {
  const std::size_t begin = position_;
  position_ = std::min(source_.bytes.find_first_of(" \t\r\n=/><\"'", position_), source_.bytes.size());
  return std::string(source_.bytes.substr(begin, position_ - begin));
}

void XmlReader::read_attributes(XmlTag& tag) {
  for (;;) {
    skip_blanks();
    if (position_ == source_.bytes.size()) fail(tag, "a tag that does not end; the file is truncated");
    const char c = source_.bytes[position_];
    if (c == '>') {
      ++position_;
      return;
    }
    if (c == '/') {
      tag.empty = true;
      ++position_;
      continue;
    }
    const std::string name = read_name();
    skip_blanks();
    if (name.empty() || !starts_with("=")) fail(tag, "an attribute without a value");
    ++position_;
    skip_blanks();
    const char quote = position_ < source_.bytes.size() ? source_.bytes[position_] : '\0';
    if (quote != '"' && quote != '\'') fail(tag, "an attribute without quotes");
    const std::size_t end = source_.bytes.find(quote, position_ + 1);
    if (end == std::string_view::npos) fail(tag, "an attribute that does not end; the file is truncated");
    tag.attributes.emplace_back(name, unescaped(source_.bytes.substr(position_ + 1, end - position_ - 1)));
    position_ = end + 1;
  }
}

std::uint64_t XmlReader::to_number(const XmlTag& tag, const std::string& what, std::string_view text) const {
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    fail(tag, what + " is no number: " + in_quotes(text));
  return value;
}

double XmlReader::to_real(const XmlTag& tag, const std::string& what, std::string_view text) const {
  double value = 0;
  const auto result = parse_real(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) fail(tag, in_quotes(text) + " is too large for a double");
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    fail(tag, what + " is no number: " + in_quotes(text));
  if (source_.finite && !std::isfinite(value)) fail(tag, what + " is not finite");
  return value;
}

std::uint64_t XmlReader::number(const XmlTag& tag, std::string_view key) const {
  return to_number(tag, "the attribute " + std::string(key), tag.attribute(key));
}

double XmlReader::real(const XmlTag& tag, std::string_view key) const {
  return to_real(tag, "the attribute " + std::string(key), without_blanks(tag.attribute(key)));
}

std::string_view XmlReader::text() const {
  const std::size_t end = std::min(source_.bytes.find('<', position_), source_.bytes.size());
  return without_blanks(source_.bytes.substr(position_, end - position_));
}

std::uint64_t XmlReader::number_in_text(const XmlTag& tag) const {
  return to_number(tag, "the text of <" + tag.name + ">", text());
}

double XmlReader::real_in_text(const XmlTag& tag) const {
  return to_real(tag, "the text of <" + tag.name + ">", text());
}

std::vector<double> XmlReader::reals(const XmlTag& tag, std::string_view key, std::size_t count) const {
  const std::string list = tag.attribute(key);
  std::vector<double> values;
  for (std::string_view left = without_blanks(list); !left.empty(); left = without_blanks(left)) {
    const std::size_t end = std::min(left.find_first_of(kXmlBlanks), left.size());
    values.push_back(to_real(tag, "the attribute " + std::string(key), left.substr(0, end)));
    left.remove_prefix(end);
  }
  if (values.size() != count)
    fail(tag, "the attribute " + std::string(key) + " has " + std::to_string(values.size()) +
                  " numbers instead of " + std::to_string(count));
  return values;
}

void XmlReader::fail(const XmlTag& tag, const std::string& reason) const {
  TextReader(source_, '\0').fail_at(tag.position, reason);
}

}  // namespace holdfast::io
