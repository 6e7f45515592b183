// Holdfast: writes a page that shows meshes: one HTML file that a browser opens without a server or a
// network.
#pragma once

#include <filesystem>

#include "holdfast/check.h"
#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/summary.h"
#include "holdfast/types.h"

namespace holdfast {

/// A surface or a volume that a page shows. What it points to must outlive the call.
struct PagePart {
  std::string name;                        ///< its name on the page: a file's name, "before", ...
  const Volume* volume = nullptr;          ///< shown if not null; otherwise `complex`
  Complex complex;                         ///< a surface; indices in it need not be in range
  std::span<const Defect> defects = {};    ///< of `complex`
  const DefectSummary* summary = nullptr;  ///< of `defects`
};

struct Page {
  std::string title;
  std::vector<PagePart> parts;       ///< one is shown at a time; the page opens on the first that has defects
  std::string verdict;               ///< one sentence: the finding
  bool good = true;                  ///< whether the finding is good
  std::span<const Rule> rules = {};  ///< of a check
  std::string report;                ///< JSON, shown as text
};

struct PageOptions : Limits {
  /// For a volume with more tetrahedra, the page holds the surface and the tetrahedra nearest to the middle
  /// of the longest side, and says so.
  std::size_t most_tetrahedra = 1'200'000;
  ProgressFunction progress = {};
};

/// Writes a page to a temporary name and renames the file, so that no partial file is ever left. Names,
/// messages and markers are shown as plain text, whatever they contain, and the page's policy allows only its
/// own script. Throws FileError, Interrupted for its limits, and std::invalid_argument if there are not as
/// many tags as entities.
HOLDFAST_API void write_page(const std::filesystem::path& path, const Page& page,
                             const PageOptions& options = {});

/// The arrays and places of a page, packed as the page holds them: a zlib stream.
[[nodiscard]] HOLDFAST_API std::string page_data(const Page& page, const PageOptions& options = {});

}  // namespace holdfast
