// A JSON text (RFC 8259) as a tree of nlohmann's values, with helpers for files of meshes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

using Json = nlohmann::json;

/// The value of the text from `begin` to `end`. Throws FileError with the line, or with the byte if the text
/// is a single line.
[[nodiscard]] Json read_json(const Source& source, std::size_t begin, std::size_t end);

/// The member of an object; null if there is none.
[[nodiscard]] const Json* member(const Json& object, std::string_view key);

/// The content of a string, the spelling of a number or a word, or the kind of any other value.
[[nodiscard]] std::string shown(const Json& value);

/// Throws a FileError whose place is the JSON pointer (RFC 6901) of a value in the tree.
[[noreturn]] void fail_in_json(const Source& source, const Json& root, const Json& value,
                               const std::string& reason);

}  // namespace holdfast::io
