// Enumerators by name, as the command line spells them.
#pragma once

#include <fmt/core.h>

#include <string>

#include "command.h"
#include "holdfast/names.h"

namespace holdfast::cli {

/// All names of an enumeration, for messages.
template <typename Enum>
std::string names_of() {
  std::string names;
  for (const Enum value : values_of<Enum>()) names += (names.empty() ? "" : ", ") + std::string(name(value));
  return names;
}

template <typename Enum>
Enum named(const char* option, const std::string& text) {
  if (const std::optional<Enum> value = from_name<Enum>(text)) return *value;
  throw UsageError(fmt::format("{}: there is no '{}'; the values are {}", option, text, names_of<Enum>()));
}

}  // namespace holdfast::cli
