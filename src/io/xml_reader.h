// The tags of an XML text, one after the other: the subset of XML that files of meshes use.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// What separates words in XML (section 2.3).
inline constexpr std::string_view kXmlBlanks = " \t\r\n";

/// A text escaped for an attribute between double quotes.
[[nodiscard]] std::string escaped(std::string_view text);
/// The reverse: the five named entities become characters; other entities stay unchanged.
[[nodiscard]] std::string unescaped(std::string_view text);

struct XmlTag {
  std::string name;
  bool closing = false;      ///< </name>
  bool empty = false;        ///< <name/>
  std::size_t position = 0;  ///< of its '<'
  std::vector<std::pair<std::string, std::string>> attributes;

  /// An attribute's value; empty if it is missing.
  [[nodiscard]] std::string attribute(std::string_view key) const;
};

class XmlReader {
 public:
  explicit XmlReader(const Source& source) : source_(source) {}
  /// The next tag; declarations and comments are skipped. Empty at the end.
  std::optional<XmlTag> next();
  /// Offset after the last tag.
  [[nodiscard]] std::size_t position() const { return position_; }
  /// An attribute that must be a count. Throws FileError.
  [[nodiscard]] std::uint64_t number(const XmlTag& tag, std::string_view key) const;
  /// An attribute that must be a real number. Throws FileError.
  [[nodiscard]] double real(const XmlTag& tag, std::string_view key) const;
  /// The text after the last tag, up to the next one, without surrounding blanks.
  [[nodiscard]] std::string_view text() const;
  /// The same for a text that must be a count, or a real number. Throws FileError for the line of `tag`.
  [[nodiscard]] std::uint64_t number_in_text(const XmlTag& tag) const;
  [[nodiscard]] double real_in_text(const XmlTag& tag) const;
  /// A list of real numbers separated by blanks. Throws FileError unless there are `count`.
  [[nodiscard]] std::vector<double> reals(const XmlTag& tag, std::string_view key, std::size_t count) const;
  /// Throws a FileError for the line of a tag.
  [[noreturn]] void fail(const XmlTag& tag, const std::string& reason) const;

 private:
  [[nodiscard]] std::uint64_t to_number(const XmlTag& tag, const std::string& what,
                                        std::string_view text) const;
  [[nodiscard]] double to_real(const XmlTag& tag, const std::string& what, std::string_view text) const;
  void read_attributes(XmlTag& tag);
  void skip_blanks();
  std::string read_name();
  [[nodiscard]] bool starts_with(std::string_view text) const {
    return source_.bytes.substr(position_).starts_with(text);
  }

  Source source_;
  std::size_t position_ = 0;
};

}  // namespace holdfast::io
