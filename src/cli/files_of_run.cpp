#include "files_of_run.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "command.h"
#include "holdfast/surface_io.h"
#include "letters.h"

namespace holdfast::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* standard_input = "/dev/stdin";
constexpr const char* standard_output = "/dev/stdout";

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c); });
  return text;
}

/// The path as the user would write it.
std::string called(const fs::path& path) {
  if (path == standard_input) return "standard input";
  if (path == standard_output) return "standard output";
  return path.string();
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Follows symbolic links, even to a file that does not exist; an open descriptor is not followed.
fs::path linked(fs::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int link = 0; link < most_links; ++link) {
    if (descriptor_of(path) || !fs::is_symlink(path, error)) break;
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = folder_of(path) / target;
  }
  return path;
}

bool status_of(const fs::path& path, struct stat& status) {
  const std::optional<int> descriptor = descriptor_of(linked(path));
  return (descriptor ? fstat(*descriptor, &status) : stat(path.c_str(), &status)) == 0;
}

bool same_inode(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// Whether the folder ignores the case of names. No system call tells, so a file is created to find out.
bool ignores_case(const fs::path& folder) {
  const std::string name = fmt::format(".holdfast-{}-case.tmp", getpid());
  const fs::path file = folder / name;
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  close(descriptor);
  const bool found = access((folder / upper(name)).c_str(), F_OK) == 0;
  unlink(file.c_str());
  return found;
}

/// Why no file can be created in what is no folder: something on the way to it is a file, or it does not
/// exist.
std::string no_folder(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path above = folder; !above.empty(); above = above.parent_path()) {
    if (fs::exists(above, ignored) && !fs::is_directory(above, ignored))
      return fmt::format("'{}' is a file, not a folder", above.string());
    if (!above.has_relative_path()) break;
  }
  return fmt::format("there is no folder '{}'; create it first", folder.string());
}

/// Throws FileError for the path unless files can be created in the folder.
void require_writable_folder(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw FileError(path, "", no_folder(folder));
  if (access(folder.c_str(), W_OK) != 0)
    throw FileError(path, "",
                    fmt::format("cannot write to folder '{}' ({}); choose another or change its permissions",
                                folder.string(), std::strerror(errno)));
}

/// Throws FileError unless a file of this name can be created or written to.
void require_writable(const fs::path& path) {
  const fs::path target = linked(path);
  if (const std::optional<int> descriptor = descriptor_of(target)) {
    const int flags = fcntl(*descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) throw FileError(path, "", "is not open for writing");
    return;
  }
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) throw FileError(path, "", "is a folder; name a file in it");
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    if (access(target.c_str(), W_OK) != 0)
      throw FileError(path, "", fmt::format("cannot be written ({})", std::strerror(errno)));
    return;
  }
  require_writable_folder(path, folder_of(target));
}

/// The same for a file whose folders are created when it is written.
void require_writable_with_folders(const fs::path& path) {
  std::error_code ignored;
  fs::path folder = folder_of(path);
  if (fs::is_directory(folder, ignored)) return require_writable(path);
  while (!fs::exists(folder, ignored) && folder.has_parent_path()) folder = folder.parent_path();
  if (!fs::exists(folder, ignored)) folder = ".";
  require_writable_folder(path, folder);
}

/// A name without an extension needs the option, because a pipe can be read only once and cannot be examined.
void require_format(const fs::path& path, std::string_view format) {
  std::error_code ignored;
  if (format.empty() && !path.has_extension() && (descriptor_of(path) || fs::is_fifo(path, ignored)))
    throw UsageError(
        fmt::format("{}: the name has no ending that gives the format; give --input-format", called(path)));
}

std::vector<std::string> without(std::vector<std::string> names, const std::vector<std::string>& others) {
  std::erase_if(names, [&](const std::string& name) {
    return std::find(others.begin(), others.end(), name) != others.end();
  });
  return names;
}

}  // namespace

std::string or_standard_input(const std::string& path) { return path == "-" ? standard_input : path; }

std::string or_standard_output(const std::string& path) { return path == "-" ? standard_output : path; }

std::string format_of(const VolumeTarget& target) {
  return volume_format_of(target.path, target.options.format);
}

void FilesOfRun::read_surfaces(const std::vector<fs::path>& paths, std::string_view format, bool of_volumes) {
  for (const fs::path& path : paths) {
    if (of_volumes) {
      read_volume(path, format);
      continue;
    }
    require_format(path, format);
    read("the input", files_of_surface(path, format));
  }
}

void FilesOfRun::read_points(const fs::path& path, std::string_view format) { read_surfaces({path}, format); }

void FilesOfRun::read_volume(const fs::path& path, std::string_view format) {
  require_format(path, format);
  std::vector<fs::path> files = files_of_volume(path, format);
  // The files that an .inp includes.
  for (const fs::path& file : files_of_surface(path, format))
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  read("the input", files);
}

void FilesOfRun::read_file(std::string_view option, const fs::path& path) {
  if (!path.empty()) read(option, {path});
}

void FilesOfRun::read_size_field(std::string_view option, const fs::path& path) {
  if (path.empty()) return;
  if (path == standard_input)
    throw UsageError(fmt::format("{}: name a file whose ending gives the format", option));
  read(option, files_of_size_field(path));
}

void FilesOfRun::read(std::string_view option, const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) {
    File file{std::string(option), path, false, true, {}, {}, {}};
    // A file that does not exist cannot be overwritten; the reader reports it.
    if (status_of(path, file.status)) add(std::move(file));
  }
}

void FilesOfRun::write(std::string_view option, const fs::path& path, bool with_folders) {
  if (path.empty()) return;
  File file{std::string(option), path, true, true, {}, {}, {}};
  const fs::path target = linked(path);
  if (!status_of(path, file.status)) {
    file.exists = false;
    // The name in the nearest existing folder: the others are created with the file.
    fs::path folder = folder_of(target);
    file.name = target.filename();
    while (stat(folder.c_str(), &file.status) != 0 && folder.has_filename()) {
      file.name = folder.filename() / file.name;
      folder = folder_of(folder);
    }
    file.lower_name = lower(file.name.string());
  }
  if (with_folders)
    require_writable_with_folders(path);
  else
    require_writable(path);
  if (descriptor_of(target) == STDOUT_FILENO) writes_stdout_ = true;
  add(std::move(file));
}

VolumeTarget FilesOfRun::write_volume(std::string_view option, const fs::path& path, std::string format,
                                      bool or_surface) {
  VolumeTarget target{path, {}};
  if (!format.empty() && format.front() != '.') format.insert(format.begin(), '.');
  target.options.format = lower(format);
  if (target.options.format == ".msh2") {
    target.options.format = ".msh";
    target.options.legacy_msh = true;
  }
  const std::string kind = format_of(target);
  if (kind == ".pvtu")
    throw UsageError(fmt::format("{}: {} is of pieces; give --partition K", called(path), kind));
  const std::vector<std::string> known = volume_formats();
  if (std::find(known.begin(), known.end(), kind) == known.end())
    throw UsageError(fmt::format(
        "{}: {}; use {}{} (--format msh2 for version 2.2 of .msh) {}by --format", called(path),
        kind.empty() ? "the name has no ending that gives the format"
                     : "'" + kind + "' is no " + (or_surface ? "format to write" : "volume format"),
        fmt::join(known, " "),
        or_surface ? fmt::format(", of surfaces alone {},", fmt::join(without(surface_formats(), known), " "))
                   : "",
        path == standard_output ? "" : "as the file's ending or "));
  const std::vector<fs::path> files = files_of_volume(path, target.options.format);
  struct stat status {};
  const bool is_stream =
      descriptor_of(linked(path)) || (status_of(path, status) && !S_ISREG(status.st_mode) &&
                                      !(kind == ".openfoam" && S_ISDIR(status.st_mode)));
  if (files.size() > 1 && is_stream)
    throw UsageError(fmt::format("{}: the format {} consists of {} files, which need a name", called(path),
                                 kind, files.size()));
  // The folders of an OpenFOAM case need not exist yet.
  for (const fs::path& file : files) write(option, file, kind == ".openfoam");
  return target;
}

WriteOptions FilesOfRun::write_surface(std::string_view option, const fs::path& path, std::string format) {
  if (!format.empty() && format.front() != '.') format.insert(format.begin(), '.');
  WriteOptions options;
  options.format = lower(format);
  const std::string kind = options.format.empty() ? lower(path.extension().string()) : options.format;
  const std::vector<std::string> known = surface_formats();
  if (std::find(known.begin(), known.end(), kind) == known.end())
    throw UsageError(fmt::format("{}: {}; use {} {}by --format", called(path),
                                 kind.empty() ? "the name has no ending that gives the format"
                                              : "'" + kind + "' is no format of surfaces to write",
                                 fmt::join(known, " "),
                                 path == standard_output ? "" : "as the file's ending or "));
  write(option, path);
  return options;
}

void FilesOfRun::list(std::string_view text) const {
  write_bytes(writes_stdout_ ? "/dev/stderr" : standard_output, text);
}

bool FilesOfRun::list_is_on_terminal() const {
  return isatty(writes_stdout_ ? STDERR_FILENO : STDOUT_FILENO) != 0;
}

void FilesOfRun::add(File file) {
  for (const File& other : files_) {
    if (file.written || other.written) {
      require_different(file.written ? file : other, file.written ? other : file);
    } else if (file.path == standard_input && other.path == standard_input) {
      throw UsageError("standard input can be read only once");
    }
  }
  files_.push_back(std::move(file));
}

void FilesOfRun::require_different(const File& written, const File& other) {
  if (written.exists != other.exists || !same_inode(written.status, other.status)) return;
  if (!written.exists && written.lower_name != other.lower_name) return;
  if (!written.exists && written.name != other.name && !ignores_case(folder_of(linked(written.path)))) return;
  if (written.exists) {
    // Writing to a terminal or to /dev/null replaces nothing, nor does writing to a pipe whose other end is
    // read. But two outputs through one pipe would mix.
    const mode_t kind = written.status.st_mode;
    const bool replaces = S_ISREG(kind) || S_ISBLK(kind);
    const bool twice = other.written && (!S_ISCHR(kind) || written.path == other.path);
    const bool is_nowhere = written.path == "/dev/null";
    if (is_nowhere || (!replaces && !twice)) return;
  }
  if (!other.written)
    throw UsageError(fmt::format("{}: {} would overwrite {}{}; give another name", called(written.path),
                                 written.option, other.option,
                                 written.path == other.path ? "" : " " + called(other.path)));
  const std::string both =
      written.option == other.option ? other.option : other.option + " and " + written.option;
  throw UsageError(fmt::format("{}: {} would write the same file{}; give another name", called(written.path),
                               both, written.path == other.path ? "" : ", " + called(other.path)));
}

}  // namespace holdfast::cli
