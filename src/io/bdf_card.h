// The cards of Nastran's bulk data: lines cut into fields of 8 or 16 columns, or between commas or blanks
// (MSC Nastran quick reference guide, "Format of bulk data entries").
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::io {

/// A card and the fields of its lines, eight of each, or four where they are wide; without the first and the
/// last of a line, which join lines.
class BdfCard {
 public:
  /// Takes its first line, or one more. The text of the lines must outlive it.
  void add(std::string_view line);

  /// Whether the line goes on with the card before it.
  [[nodiscard]] static bool continues(std::string_view line);

  /// In lower case, without the * of wide fields.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Empty where there is none.
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
