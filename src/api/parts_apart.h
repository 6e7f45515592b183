// Parts that touch no other part.
#pragma once

#include <functional>
#include <vector>

#include "holdfast/paste.h"

namespace holdfast {

/// Parts touch if they have a common vertex. For each connected set of touching parts, finds the nearest
/// other one; each pair once. `step` is called now and then, and may throw.
[[nodiscard]] std::vector<PartApart> find_apart(const PasteResult& pasted, const std::function<void()>& step);

[[nodiscard]] Warning warn_of_apart(const PasteResult& pasted, const PartApart& apart);

}  // namespace holdfast
