// Open file descriptors that paths name (`descriptor_of` in holdfast/io.h).
//
// Such a file is not opened again: that would start at its beginning or truncate it, and fails for sockets.
// It is not replaced by another file either.
#pragma once

#include "holdfast/io.h"

namespace holdfast::io {

/// A copy of the descriptor, to be closed separately, or -1 with errno.
[[nodiscard]] int copy_of_descriptor(int descriptor);

}  // namespace holdfast::io
