// Judging the options of a call before any work is done.
#pragma once

#include "holdfast/holdfast.h"

namespace holdfast {

/// Throws std::invalid_argument for options that make no sense or do not suit the complex, as far as that can
/// be told without a mesh.
void require_sensible(const Complex& complex, const Options& options);

}  // namespace holdfast
