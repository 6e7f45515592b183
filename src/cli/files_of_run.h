// The files that a command reads and writes. Ensures that no file overwrites another.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

/// Replaces "-" by the system's name of standard input or output; other paths stay. For
/// CLI::Option::transform.
[[nodiscard]] std::string or_standard_input(const std::string& path);
[[nodiscard]] std::string or_standard_output(const std::string& path);

/// Where and how to write a volume.
struct VolumeTarget {
  std::filesystem::path path;
  WriteOptions options;
};

/// The format's ending, ".vtu" or so.
[[nodiscard]] std::string format_of(const VolumeTarget& target);

/// Every file of a run. A command names them all before it does any work; each is compared with those named
/// before it. A file that is written must not be read or written under another option, whatever its name:
/// files are compared by identity, which covers links and other spellings, and files that do not exist yet by
/// folder and name. `option` is what the user knows a file by ("-o", "the input"). An empty path names no
/// file.
class FilesOfRun {
 public:
  /// Surfaces in, with the files that lie beside them. All functions throw UsageError.
  void read_surfaces(const std::vector<std::filesystem::path>& paths, std::string_view format);
  void read_points(const std::filesystem::path& path, std::string_view format);
  void read_volume(const std::filesystem::path& path, std::string_view format);
  /// Any other file.
  void read_file(std::string_view option, const std::filesystem::path& path);
  void read_size_field(std::string_view option, const std::filesystem::path& path);

  /// A file of the program's own making, in folders that need not be there yet if these are made with it.
  /// Throws FileError, too, if it cannot be created.
  void write(std::string_view option, const std::filesystem::path& path, bool with_folders = false);
  /// A volume of a format that is known (`format`, or the extension when it is empty), and what belongs to
  /// it. `or_surface`: the command writes surfaces, too, and its user is told of their formats.
  [[nodiscard]] VolumeTarget write_volume(std::string_view option, const std::filesystem::path& path,
                                          std::string format, bool or_surface = false);

  /// A surface, of a format that is known likewise.
  [[nodiscard]] WriteOptions write_surface(std::string_view option, const std::filesystem::path& path,
                                           std::string format);

  /// Prints the findings of a command: to stderr if a file goes to stdout. Throws FileError.
  void list(std::string_view text) const;
  [[nodiscard]] bool list_is_on_terminal() const;

 private:
  struct File {
    std::string option;
    std::filesystem::path path;  ///< as named
    bool written, exists;
    struct stat status;          ///< if it exists; else of its folder
    std::filesystem::path name;  ///< in this folder
  };
  void read(std::string_view option, const std::vector<std::filesystem::path>& paths);
  void add(File file);
  static void require_different(const File& written, const File& other);

  std::vector<File> files_;
  bool writes_stdout_ = false;
};

}  // namespace holdfast::cli
