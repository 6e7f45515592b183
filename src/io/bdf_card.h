// The cards of Nastran's bulk data: lines cut into fields of 8 or 16 columns, or between commas or blanks
// (MSC Nastran quick reference guide, "Format of bulk data entries").
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::io {

/// A card and the fields of its lines: eight per line, or four if they are wide. The first and the last
/// field of a line, which join lines, are not counted.
class BdfCard {
 public:
  /// Adds the first line of the card or a continuation. The text of the lines must outlive the card.
  void add(std::string_view line);

  /// Whether the line continues the card before it.
  [[nodiscard]] static bool continues(std::string_view line);

  /// In lower case, without the * of wide fields.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Empty if the card has no such field.
  [[nodiscard]] std::string_view field(std::size_t i) const {
    return i < fields_.size() ? fields_[i] : std::string_view();
  }

 private:
  void add_columns(std::string_view line);
  void add_free(const std::vector<std::string_view>& parts);
  void set_name(std::string_view head);

  std::string name_;
  std::vector<std::string_view> fields_;
  bool begun_ = false, between_blanks_ = false;
};

}  // namespace holdfast::io
