// *INCLUDE in .inp files: the text of the named file replaces the line that names it. A file named by INPUT
// of *NODE or *ELEMENT is inserted after the keyword.
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

/// Names are relative to the folder of the first file, in which Abaqus and CalculiX run.
class InpIncludes {
 public:
  /// Reads all files. Throws FileError, also if files include each other. The source must outlive the object.
  explicit InpIncludes(const Source& source);

  /// The whole text; its errors name the file and line where they occur.
  [[nodiscard]] Source source() const;
  /// The included files, each as often as it is included.
  [[nodiscard]] const std::deque<std::filesystem::path>& files() const { return files_; }

 private:
  void add(const std::filesystem::path& path, std::string_view bytes, std::size_t depth);
  void add_text(const std::filesystem::path& path, std::string_view bytes, std::size_t begin,
                std::size_t end);

  Source source_;
  std::string text_;  ///< empty if nothing is included
  std::vector<Origin> origins_;
  std::deque<std::filesystem::path> files_;  // a deque, so that its paths do not move
};

}  // namespace holdfast::io
