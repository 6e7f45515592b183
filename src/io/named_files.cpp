#include "io/named_files.h"

#include <system_error>

#include "io/file_bytes.h"

namespace holdfast::io {

std::vector<std::filesystem::path> with_named_files(const std::filesystem::path& path,
                                                    const ListFiles& named) {
  std::vector<std::filesystem::path> files{path};
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return files;
  try {
    const FileBytes bytes(path);
    const std::vector<std::filesystem::path> others = named({path, bytes.view()});
    files.insert(files.end(), others.begin(), others.end());
  } catch (const FileError&) {
    // The reader reports it.
  }
  return files;
}

}  // namespace holdfast::io
