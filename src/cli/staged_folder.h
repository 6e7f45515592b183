// Files of one folder that appear together: all or none.
#pragma once

#include <filesystem>
#include <functional>

namespace holdfast::cli {

/// A temporary folder beside the final places of its files, which are renamed when all are complete. Until
/// then the destructor removes it and the folders above it that it created, so an exception leaves nothing.
class StagedFolder {
 public:
  /// `folder` need not exist. Throws FileError.
  explicit StagedFolder(const std::filesystem::path& folder);
  ~StagedFolder();
  StagedFolder(StagedFolder&&) = delete;

  /// The temporary path of a file of this name.
  [[nodiscard]] std::filesystem::path of(const std::filesystem::path& name) const { return staging_ / name; }
  /// Calls `write` with that path. A FileError names the final path instead.
  void write(const std::filesystem::path& name,
             const std::function<void(const std::filesystem::path&)>& write) const;
  /// Moves all files to their final names. `last`, which lists the others, is removed first and moved last.
  /// Throws FileError.
  void publish(const std::filesystem::path& last);

 private:
  std::filesystem::path folder_, staging_;
  std::filesystem::path made_;  ///< the outermost folder created; empty if all existed
};

}  // namespace holdfast::cli
