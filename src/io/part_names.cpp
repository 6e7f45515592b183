#include "io/part_names.h"

#include <set>

namespace holdfast::io {

std::vector<std::map<int, std::string>> names_apart(std::vector<std::map<int, std::string>> of_parts,
                                                    std::span<const std::string> parts) {
  struct Uses {
    std::set<int> ids;
    std::set<std::size_t> parts;
  };
  std::map<std::string, Uses> uses;
  for (std::size_t k = 0; k < of_parts.size(); ++k)
    for (const auto& [id, name] : of_parts[k]) {
      uses[name].ids.insert(id);
      uses[name].parts.insert(k);
    }
  for (std::size_t k = 0; k < of_parts.size() && k < parts.size(); ++k)
    for (auto& [id, name] : of_parts[k]) {
      const Uses& of = uses[name];
      if (!name.empty() && of.ids.size() > 1 && of.parts.size() > 1) name.insert(0, parts[k] + '.');
    }
  return of_parts;
}

}  // namespace holdfast::io
