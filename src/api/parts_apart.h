// Parts that touch no other.
#pragma once

#include <functional>
#include <vector>

#include "holdfast/paste.h"

namespace holdfast {

/// Parts touch where they have a vertex in common. Of each set of parts that hang together so, the nearest of
/// the others; each pair once. `step` is called now and then, and may throw.
[[nodiscard]] std::vector<PartApart> find_apart(const PasteResult& pasted, const std::function<void()>& step);

[[nodiscard]] Warning warn_of_apart(const PasteResult& pasted, const PartApart& apart);

}  // namespace holdfast
