// A JSON text as a tree (RFC 8259): as much as files of meshes need, which hold their numbers elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

struct JsonValue {
  enum class Kind { null, boolean, number, string, array, object };
  Kind kind = Kind::null;
  std::size_t position = 0;            ///< in the source's bytes
  std::string_view text;               ///< of a number or a boolean; of a string what is between its quotes
  std::vector<std::string_view> keys;  ///< of an object, as they stand in the text
  std::vector<JsonValue> items;        ///< of an array, or of an object

  /// The member of an object; null if there is none.
  [[nodiscard]] const JsonValue* find(std::string_view key) const;
  /// A string without its escapes, in UTF-8.
  [[nodiscard]] std::string string() const;
};

/// The value that is the text from `begin` to `end`. Throws FileError: with the line, or in a text of a
/// single line with the byte.
[[nodiscard]] JsonValue read_json(const Source& source, std::size_t begin, std::size_t end);

/// Throws a FileError for a place in such a text.
[[noreturn]] void fail_in_json(const Source& source, std::size_t begin, std::size_t position,
                               const std::string& reason);

}  // namespace holdfast::io
