// Options for writing a volume file, for every command that writes one.
#pragma once

#include <CLI/CLI.hpp>

#include "files_of_run.h"

namespace holdfast::cli {

struct WriteArguments {
  bool binary = false, one_file = false, gzip = false, shells = false;
};

void add_write_options(CLI::App& command, WriteArguments& arguments);

/// Throws UsageError for an option that has no effect in the target's format.
void apply(const WriteArguments& arguments, VolumeTarget& target);

}  // namespace holdfast::cli
