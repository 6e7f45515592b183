// What the files of `repair` claim: --parents and --report.
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

/// Reads either file, or both; the first counts where they differ. Lines of the file of parents behind those
/// of the output's facets are its segments'; segments of the input are numbered behind its facets. Throws
/// FileError.
[[nodiscard]] ReadClaims read_claims(const std::filesystem::path& parents,
                                     const std::filesystem::path& report, const Surface& input,
                                     const Surface& output);

}  // namespace holdfast::cli
