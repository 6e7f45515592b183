// The lines of LS-DYNA's keyword files: keywords, and cards in columns or with commas (LS-DYNA keyword user's
// manual, volume I, "Getting started").
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/exact_nodes.h"
#include "io/includes.h"
#include "io/text_reader.h"

namespace holdfast::io {

[[nodiscard]] const IncludeRule& dyna_includes();

/// Widths of the fields of a card: of the first, of the next three, and of the others.
struct DynaColumns {
  std::size_t first, next, other;
};

class DynaText {
 public:
  explicit DynaText(const Source& source) : text_(source, '\0') { next_line(); }

  [[nodiscard]] bool at_end() const { return line_.empty(); }
  [[nodiscard]] bool is_data() const { return !line_.empty() && line_[0] != '*'; }
  /// Reads the keyword of this line, and moves past it. Throws if there is none.
  void read_keyword();
  /// The last keyword, in lower case without its asterisk: "element_shell_thickness".
  [[nodiscard]] const std::string& keyword() const { return keyword_; }
  /// The part of the keyword after `stem`, between underscores; false if it does not begin with it.
  bool options_after(std::string_view stem, std::set<std::string>& options) const;

  /// The fields of this card, valid until the next call; moves to the next line.
  std::span<const std::string_view> card(const DynaColumns& columns);
  std::span<const std::string_view> node_card() {
    return card(wide_ ? kWide : long_numbers_ ? kLongNode : kNode);
  }
  std::span<const std::string_view> element_card() {
    return card(wide_ ? kWide : long_numbers_ ? kOther : kElement);
  }
  std::span<const std::string_view> other_card() { return card(wide_ ? kWide : kOther); }
  /// The text of this line; moves to the next line.
  std::string_view title();
  /// Skips cards; fewer if another keyword comes first.
  void skip_cards(std::size_t count);
  void skip_keyword();
  /// Moves to the end of the file that this line belongs to, which ends with *END.
  void end_of_file();

  [[nodiscard]] const ExactNodes& exact_nodes() const { return exact_nodes_; }
  /// Of the line that was read last.
  [[nodiscard]] std::size_t place() const { return place_; }
  /// For errors in the line that was read last.
  [[nodiscard]] const TextReader& reader() {
    text_.seek(place_);
    return text_;
  }
  [[nodiscard]] const Source& source() const { return text_.source(); }

 private:
  static constexpr DynaColumns kNode{8, 16, 8}, kLongNode{10, 16, 10}, kElement{8, 8, 8}, kOther{10, 10, 10},
      kWide{20, 20, 20};

  /// Moves to the next line that is no comment.
  void next_line();

  TextReader text_;
  ExactNodes exact_nodes_{rounded_for_dyna};
  std::string_view line_;
  std::size_t place_ = 0, line_at_ = 0, behind_ = 0;  ///< of the line read last, this one, and the next
  std::string keyword_;
  std::vector<std::string_view> fields_;
  bool all_wide_ = false, all_long_ = false;  ///< of the file
  bool wide_ = false, long_numbers_ = false;  ///< of the keyword
};

/// An integer in a field; 0 if it is empty.
[[nodiscard]] std::int64_t dyna_integer(DynaText& text, std::span<const std::string_view> fields,
                                        std::size_t i, std::string_view what);

}  // namespace holdfast::io
