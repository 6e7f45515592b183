// Files of one folder that appear there together: all of them, or none.
#pragma once

#include <filesystem>
#include <functional>

namespace holdfast::cli {

/// A folder beside the final places of its files, which are renamed once all are complete. Until then the
/// destructor removes it, and those folders above it that it had to make, so that an exception leaves
/// nothing.
class StagedFolder {
 public:
  /// `folder` need not be there. Throws FileError.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(StagedFolder&&) = delete;

  /// Where a file of this name stands until then.
  [[nodiscard]] std::filesystem::path of(const std::filesystem::path& name) const { return staging_ / name; }
  /// Has a file written there. What FileError tells of it is told by the name that it would have got.
  void write(const std::filesystem::path& name,
             const std::function<void(const std::filesystem::path&)>& write) const;
  /// Gives all files their names; `last`, which tells of the others, is none of the old folder's while they
  /// change. Throws FileError.
  void publish(const std::filesystem::path& last);

 private:
  std::filesystem::path folder_, staging_;
  std::filesystem::path made_;  ///< the outermost folder that was not there; empty if all were
};

}  // namespace holdfast::cli
