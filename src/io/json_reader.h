// A JSON text (RFC 8259) as a tree of nlohmann's values, with what a file of meshes asks of one.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

using Json = nlohmann::json;

/// The value that is the text from `begin` to `end`. Throws FileError: with the line, or in a text of a
/// single line with the byte.
[[nodiscard]] Json read_json(const Source& source, std::size_t begin, std::size_t end);

/// The member of an object; null if there is none.
[[nodiscard]] const Json* member(const Json& object, std::string_view key);

/// What a string says, or how a number or a word is spelled, or what else the value is.
[[nodiscard]] std::string shown(const Json& value);

/// Throws a FileError whose place is the JSON pointer (RFC 6901) of a value in a tree.
[[noreturn]] void fail_in_json(const Source& source, const Json& root, const Json& value,
                               const std::string& reason);

}  // namespace holdfast::io
