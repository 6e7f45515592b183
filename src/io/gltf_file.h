// A glTF file as its JSON and its numbers (Khronos, glTF 2.0, sections 3 and 4): in one file or several.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/json_reader.h"
#include "io/mesh_data.h"

namespace holdfast::io {

class GltfFile {
 public:
  explicit GltfFile(const Source& source);

  [[nodiscard]] const Json& root() const { return root_; }
  /// The elements of an object's array; empty if it is missing.
  [[nodiscard]] std::span<const Json> list(const Json& object, std::string_view key) const;
  /// A member that is a count or a similar number.
  [[nodiscard]] std::optional<std::size_t> number(const Json& object, std::string_view key) const;
  /// A member that is the index of an entry in one of the file's arrays.
  [[nodiscard]] std::optional<std::size_t> entry(const Json& object, std::string_view key,
                                                 std::string_view array) const;
  [[nodiscard]] std::size_t entry_of(const Json& value, std::string_view array) const;
  /// A member that is an array of this many real numbers.
  [[nodiscard]] std::optional<std::vector<double>> reals(const Json& object, std::string_view key,
                                                         std::size_t count) const;
  /// The name of an object.
  [[nodiscard]] static std::string name(const Json& object);

  /// The values of an accessor with this many components; those of an element are adjacent.
  [[nodiscard]] std::vector<double> values(std::size_t accessor, std::size_t components);
  /// Whether the file itself contains the values. Otherwise an extension computes them from its bytes.
  [[nodiscard]] bool has_values(std::size_t accessor) const;

  /// `at` must be a node of the tree.
  [[noreturn]] void fail(const Json& at, const std::string& reason) const {
    fail_in_json(source_, root_, at, reason);
  }
  /// The separate files that contain its buffers.
  [[nodiscard]] std::vector<std::filesystem::path> files_beside() const;
  /// The total length of the file and of the separate files that were read.
  [[nodiscard]] std::size_t bytes() const;
  /// The number of bytes after the last chunk.
  [[nodiscard]] std::size_t behind() const { return behind_; }

 private:
  /// Elements at a constant stride.
  struct View {
    std::string_view bytes;
    std::size_t stride = 0;
  };
  void read_chunks();
  std::string_view buffer(std::size_t b);
  std::string_view external(const Json& uri);
  std::optional<std::filesystem::path> path_of(const std::string& uri) const;
  std::string decoded(const Json& uri) const;
  View view(const Json& user, std::size_t count, std::size_t bytes);
  void read_sparse(const Json& accessor, const Json& sparse, std::size_t count, std::size_t components,
                   std::vector<double>& values);

  Source source_;
  std::size_t json_begin_ = 0, json_end_ = 0;
  std::optional<std::string_view> chunk_;  ///< the buffer in the file itself
  std::size_t behind_ = 0;
  Json root_;
  std::map<std::size_t, std::string> decoded_;                            ///< by buffer
  std::map<std::filesystem::path, std::unique_ptr<FileBytes>> external_;  ///< by path
};

}  // namespace holdfast::io
