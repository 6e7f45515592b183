// Open file descriptors that paths name (`descriptor_of` in holdfast/io.h).
//
// Such a file is not opened anew: that would begin at its start again or cut it off, and is refused for
// sockets. Nor is it replaced by another.
#pragma once

#include "holdfast/io.h"

namespace holdfast::io {

/// A copy of the descriptor that is closed on its own, or -1 with errno.
[[nodiscard]] int copy_of_descriptor(int descriptor);

}  // namespace holdfast::io
