// The groups of a DXF file: a code on one line, its value on the next (AutoCAD DXF reference).
#pragma once

#include <string_view>
#include <vector>

#include "io/fields.h"
#include "io/text_reader.h"

namespace holdfast::io {

struct DxfGroup {
  int code;
  std::string_view value;
  std::size_t place;  ///< of the value
};

/// An entity, or the begin or end of something: what group 0 names, with the groups up to the next one.
struct DxfEntity {
  std::string_view type;
  std::size_t place = 0;
  std::vector<DxfGroup> groups;
};

class DxfText {
 public:
  explicit DxfText(const Source& source);

  /// Reads the next entity; false at the end of the file.
  bool next(DxfEntity& entity);

  /// The value of a group as text, an integer or a real number; a default if the entity has none.
  [[nodiscard]] static std::string_view text(const DxfEntity& entity, int code);
  [[nodiscard]] std::int64_t integer(const DxfEntity& entity, int code, std::int64_t otherwise);
  [[nodiscard]] double real(const DxfEntity& entity, int code, double otherwise);
  [[nodiscard]] double real(const DxfGroup& group);
  [[nodiscard]] std::int64_t integer(const DxfGroup& group);
  /// The point in the groups `code`, 10 more and 20 more.
  [[nodiscard]] Point point(const DxfEntity& entity, int code);

  [[noreturn]] void fail_at(std::size_t place, const std::string& reason) const {
    text_.fail_at(place, reason);
  }
  [[nodiscard]] const Source& source() const { return text_.source(); }

 private:
  bool read_group(DxfGroup& group);
  static const DxfGroup* find(const DxfEntity& entity, int code);

  TextReader text_;
  DxfGroup group_{};
  bool has_group_ = false;
};

}  // namespace holdfast::io
