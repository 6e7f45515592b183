#include "staged_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "holdfast/io.h"

namespace holdfast::cli {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::error_code& error) {
  throw FileError(path, "", what + ": " + error.message());
}

/// The outermost folder of a path that does not exist; empty if the path exists.
fs::path first_missing(const fs::path& path) {
  std::error_code ignored;
  fs::path missing;
  for (fs::path p = path; !p.empty() && !fs::exists(p, ignored); p = p.parent_path()) {
    missing = p;
    if (p == p.parent_path()) break;
  }
  return missing;
}

}  // namespace

StagedFolder::StagedFolder(const fs::path& folder)
    : folder_(folder.has_filename() ? folder : folder.parent_path()), made_(first_missing(folder_)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) fail(folder_, "the folder cannot be made", error);
  std::string name = (folder_ / ".holdfast-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    fail(folder_, "cannot be written to", std::error_code(errno, std::generic_category()));
  staging_ = name;
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (made_.empty()) return;
  // `remove` only removes empty folders.
  for (fs::path p = folder_; fs::remove(p, ignored) && p != made_; p = p.parent_path()) continue;
}

void StagedFolder::write(const fs::path& name, const std::function<void(const fs::path&)>& write) const {
  try {
    write(of(name));
  } catch (const FileError& error) {
    const std::string told = error.what(), shown = of(name).string();
    if (!told.starts_with(shown)) throw;
    throw FileError(folder_ / name, "", told.substr(std::min(told.size(), shown.size() + 2)));
  }
}

void StagedFolder::publish(const fs::path& last) {
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(staging_))
    if (entry.path().filename() != last) names.push_back(entry.path().filename());
  names.push_back(last);
  std::error_code error;
  for (const fs::path& name : names)
    if (fs::is_directory(folder_ / name, error))
      fail(folder_ / name, "cannot be written", std::make_error_code(std::errc::is_a_directory));
  fs::remove(folder_ / last, error);
  if (error) fail(folder_ / last, "cannot be replaced", error);
  for (const fs::path& name : names) {
    fs::rename(staging_ / name, folder_ / name, error);
    if (error) fail(folder_ / name, "cannot be written: the finished file cannot be renamed", error);
  }
}

}  // namespace holdfast::cli
