// Values of enumerations by their Python names.
#pragma once

#include <stdexcept>
#include <string>

#include "holdfast/names.h"

namespace holdfast::python {

template <class Enum>
Enum named(const std::string& text, const char* option) {
  if (const std::optional<Enum> value = from_name<Enum>(text)) return *value;
  std::string known;
  for (const Enum value : values_of<Enum>()) known += std::string(known.empty() ? "" : ", ") + name(value);
  throw std::invalid_argument(std::string(option) + "='" + text + "': there is " + known);
}

}  // namespace holdfast::python
