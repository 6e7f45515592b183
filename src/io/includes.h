// Texts that include others, as solvers' formats do: the text of a named file replaces the lines that name
// it.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_data.h"

namespace holdfast::io {

/// An included file, which replaces the text from `begin` to `end`.
struct Include {
  std::size_t begin, end;
  std::string name;  ///< empty if the lines name none
};

/// How a format includes files.
struct IncludeRule {
  /// The next inclusion from a position on.
  std::optional<Include> (*next)(std::string_view bytes, std::size_t from);
  std::string_view without_name;  ///< the error if the name is missing
};

/// Names are relative to the folder of the first file, in which solvers run.
class Includes {
 public:
  /// Reads all files. Throws FileError, also if files include each other. The source must outlive the object.
  Includes(const Source& source, const IncludeRule& rule);

  /// The whole text; its errors name the file and line where they occur.
  [[nodiscard]] Source source() const;
  /// The included files, each as often as it is included.
  [[nodiscard]] const std::deque<std::filesystem::path>& files() const { return files_; }

 private:
  void add(const std::filesystem::path& path, std::string_view bytes, std::size_t depth);
  void add_text(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                std::size_t end);

  Source source_;
  IncludeRule rule_;
  std::string text_;  ///< empty if nothing is included
  std::vector<Origin> origins_;
  std::deque<std::filesystem::path> files_;  // a deque, so that its paths do not move
};

/// The file and all files that it includes; only the file itself if they cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> with_included_files(const std::filesystem::path& path,
                                                                     const IncludeRule& rule);

}  // namespace holdfast::io
