#include "classify/words.h"

namespace holdfast {

std::string listed(const std::string& noun, const std::string& plural, const std::vector<Index>& ids) {
  constexpr std::size_t kListed = 3;
  if (ids.empty()) return {};
  const std::size_t shown = ids.size() <= kListed + 1 ? ids.size() : kListed;
  std::string words = (ids.size() == 1 ? noun : plural) + " ";
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) words += i + 1 == ids.size() ? " and " : ", ";
    words += std::to_string(ids[i]);
  }
  if (shown < ids.size()) words += " and " + std::to_string(ids.size() - shown) + " more";
  return words;
}

}  // namespace holdfast
