// *INCLUDE of .inp files: the text of the files that are named, in place of the lines that name them; and
// files that INPUT of *NODE and *ELEMENT names, behind these.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/mesh_data.h"

namespace holdfast::io {

/// Names are relative to the folder of the first file, where Abaqus and CalculiX run.
class InpIncludes {
 public:
  /// Reads all of the files. Throws FileError, also for files that include each other. The source must
  /// outlive it.
  explicit InpIncludes(const Source& source);

  /// The whole text, whose errors name the file and line that they are in.
  [[nodiscard]] Source source() const;
  /// Those that are included, each as often as it is.
  [[nodiscard]] const std::deque<std::filesystem::path>& files() const { return files_; }

 private:
  void add(const std::filesystem::path& path, std::string_view bytes, std::size_t depth);
  void add_text(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                std::size_t end);

  Source source_;
  std::string text_;  ///< empty where nothing is included
  std::vector<Origin> origins_;
  std::deque<std::filesystem::path> files_;  // whose places do not change
};

}  // namespace holdfast::io
