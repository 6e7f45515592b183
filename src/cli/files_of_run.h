// The files that a command reads and writes. Ensures that no file overwrites another.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

/// Replaces "-" by the system's name of standard input or output; other paths are unchanged. For
/// CLI::Option::transform.
[[nodiscard]] std::string or_standard_input(const std::string& path);
[[nodiscard]] std::string or_standard_output(const std::string& path);

/// Where and how to write a volume.
struct VolumeTarget {
  std::filesystem::path path;
  WriteOptions options;
};

/// The format's extension, such as ".vtu".
[[nodiscard]] std::string format_of(const VolumeTarget& target);

/// Every file of a run. A command names all its files before it does any work, and each is compared with
/// those named before. A file to write must not be read, or written under another option, whatever its name:
/// existing files are compared by identity, which covers links and other spellings; others by folder and
/// name. `option` is the user's term for a file ("-o", "the input"). An empty path names no file.
class FilesOfRun {
 public:
  /// Surfaces to read, or volumes whose surfaces are taken, with their companion files. All functions throw
  /// UsageError.
  void read_surfaces(const std::vector<std::filesystem::path>& paths, std::string_view format,
                     bool of_volumes = false);
  void read_points(const std::filesystem::path& path, std::string_view format);
  void read_volume(const std::filesystem::path& path, std::string_view format);
  /// Any other file.
  void read_file(std::string_view option, const std::filesystem::path& path);
  void read_size_field(std::string_view option, const std::filesystem::path& path);

  /// A file to write, in folders that need not exist if they are created with it. Also throws FileError if it
  /// cannot be created.
  void write(std::string_view option, const std::filesystem::path& path, bool with_folders = false);
  /// A volume in the format `format` or, if that is empty, of the extension, with its companion files.
  /// `or_surface`: the command also writes surfaces, so a message lists their formats.
  [[nodiscard]] VolumeTarget write_volume(std::string_view option, const std::filesystem::path& path,
                                          std::string format, bool or_surface = false);

  /// A surface, whose format is determined likewise.
  [[nodiscard]] WriteOptions write_surface(std::string_view option, const std::filesystem::path& path,
                                           std::string format);

  /// Prints the findings of a command, to stderr if a file goes to stdout. Throws FileError.
  void list(std::string_view text) const;
  [[nodiscard]] bool list_is_on_terminal() const;

 private:
  struct File {
    std::string option;
    std::filesystem::path path;  ///< as the user named it
    bool written, exists;
    struct stat status;          ///< of the file or, if it does not exist, of its folder
    std::filesystem::path name;  ///< in that folder, if the file does not exist
    std::string lower_name;      ///< in lower case; there may be thousands of files to compare
  };
  void read(std::string_view option, const std::vector<std::filesystem::path>& paths);
  void add(File file);
  static void require_different(const File& written, const File& other);

  std::vector<File> files_;
  bool writes_stdout_ = false;
};

}  // namespace holdfast::cli
