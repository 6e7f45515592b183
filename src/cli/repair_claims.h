// The claims in the files of `repair`: --parents and --report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/check_repair.h"

namespace holdfast::cli {

struct ReadClaims {
  RepairClaims claims;
  std::vector<std::string> disagreements;  ///< of the two files, one sentence each
};

/// Reads either file or both; the file of parents counts where they differ. Its lines after those of the
/// output's facets belong to segments; segments of the input are numbered after its facets. Throws FileError.
[[nodiscard]] ReadClaims read_claims(const std::filesystem::path& parents,
                                     const std::filesystem::path& report, const Surface& input,
                                     const Surface& output);

}  // namespace holdfast::cli
