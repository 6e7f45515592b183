// A glTF file as its JSON and its numbers (Khronos, glTF 2.0, sections 3 and 4): in one file or several.
#pragma once

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

  [[nodiscard]] const JsonValue& root() const { return root_; }
  /// What an array of an object holds; nothing where it is missing.
  [[nodiscard]] std::span<const JsonValue> list(const JsonValue& object, std::string_view key) const;
  /// A member that is a count or the like.
  [[nodiscard]] std::optional<std::uint64_t> number(const JsonValue& object, std::string_view key) const;
  /// A member that is the number of an entry of an array of the file.
  [[nodiscard]] std::optional<std::size_t> entry(const JsonValue& object, std::string_view key,
                                                 std::string_view array) const;
  [[nodiscard]] std::size_t entry_of(const JsonValue& value, std::string_view array) const;
  /// A member that is an array of so many real numbers.
  [[nodiscard]] std::optional<std::vector<double>> reals(const JsonValue& object, std::string_view key,
                                                         std::size_t count) const;
  /// The name that an object has.
  [[nodiscard]] static std::string name(const JsonValue& object);

  /// The values of an accessor that has so many components; those of an element are together.
  [[nodiscard]] std::vector<double> values(std::size_t accessor, std::size_t components);
  /// Whether the file itself has them, and not only what an extension makes of its bytes.
  [[nodiscard]] bool has_values(std::size_t accessor) const;

  [[noreturn]] void fail(const JsonValue& at, const std::string& reason) const {
    fail_in_json(source_, json_begin_, at.position, reason);
  }
  /// The length of the file and of those beside it that were read.
  [[nodiscard]] std::size_t bytes() const;
  /// Bytes behind the last chunk.
  [[nodiscard]] std::size_t behind() const { return behind_; }

 private:
  /// Elements at equal distances.
  struct View {
    std::string_view bytes;
    std::size_t stride = 0;
  };
  void read_chunks();
  std::string_view buffer(std::size_t b);
  std::string_view external(const JsonValue& uri);
  std::string decoded(const JsonValue& uri) const;
  View view(const JsonValue& user, std::size_t count, std::size_t bytes);
  void read_sparse(const JsonValue& accessor, const JsonValue& sparse, std::size_t count,
                   std::size_t components, std::vector<double>& values);

  Source source_;
  std::size_t json_begin_ = 0, json_end_ = 0;
  std::optional<std::string_view> chunk_;  ///< the buffer in the file itself
  std::size_t behind_ = 0;
  JsonValue root_;
  std::map<std::size_t, std::string> decoded_;                            ///< by buffer
  std::map<std::filesystem::path, std::unique_ptr<FileBytes>> external_;  ///< by path
};

}  // namespace holdfast::io
