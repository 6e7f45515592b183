// The lines of an .inp file: keywords with their parameters, the lines of data behind each, and comments,
// some of which keep ids.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "io/fields.h"
#include "io/labels.h"

namespace holdfast::io {

struct InpKeyword {
  std::string name;                           ///< in lower case
  std::map<std::string, std::string> values;  ///< by parameter in lower case

  [[nodiscard]] bool has(const char* parameter) const { return values.contains(parameter); }
};

/// Names and ids of the three kinds of sets.
struct InpNames {
  NamedIds regions{kRegionStem}, markers{kFacetStem}, segments{kSegmentStem};
};

/// Stands at a line that is no comment, or at the end.
class InpText {
 public:
  /// Comments that keep ids go into `names`. Throws for a file without a line.
  InpText(const Source& source, InpNames& names) : text_(source, '\0'), names_(names) {
    if (!next()) text_.fail_truncated("a keyword");
  }

  /// Goes to the next line; whether there is one.
  bool next();
  [[nodiscard]] bool at_end() const { return line_.empty(); }
  [[nodiscard]] bool is_data() const { return !line_.empty() && line_[0] != '*'; }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::vector<std::string_view> fields() const { return split(line_, ','); }
  /// Reads the keyword of this line and goes behind it. Throws if it has none.
  InpKeyword keyword();

  /// For what is wrong with the line.
  [[nodiscard]] const TextReader& reader() const { return text_; }
  /// For what is wrong with the line at a place where the reader has been.
  void seek(std::size_t position) { text_.seek(position); }

 private:
  TextReader text_;
  InpNames& names_;
  std::string_view line_;
};

}  // namespace holdfast::io
