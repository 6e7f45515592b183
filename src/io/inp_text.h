// The lines of an .inp file: keywords with their parameters, the data lines after each, and comments,
// some of which keep ids.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/exact_nodes.h"
#include "io/fields.h"
#include "io/labels.h"
#include "io/placement.h"

namespace holdfast::io {

struct InpKeyword {
  std::string name;                           ///< in lower case
  std::map<std::string, std::string> values;  ///< by parameter in lower case
  std::size_t place = 0;                      ///< of its line, for errors

  [[nodiscard]] bool has(const char* parameter) const { return values.contains(parameter); }
};

/// Names and ids of the three kinds of sets.
struct InpNames {
  NamedIds regions{kRegionStem}, markers{kFacetStem}, segments{kSegmentStem};
};

/// The scope of the lines of an instance of a part, or of its sets: other instances use the same numbers and
/// names.
struct InpScope {
  std::int64_t offset = 0;  ///< added to numbers of nodes and elements
  std::string prefix;       ///< of names of sets, as Abaqus writes it: "NAME."
  bool names_too = false;   ///< defined names get the prefix too, as within the instance
  Placement placement;

  [[nodiscard]] std::string given(const std::string& name) const { return names_too ? prefix + name : name; }
};

/// The range of numbers of each instance, and of the lines outside all instances.
inline constexpr std::int64_t kNumbersOfAnInstance = std::int64_t{1} << 40;
/// A bound on increments of numbers, above all numbers in Abaqus, so that no sum of them overflows.
inline constexpr std::int64_t kMostIncrement = std::int64_t{1} << 30;
/// A number as it is in the file.
[[nodiscard]] inline std::int64_t number_in_file(std::int64_t number) {
  return number < kNumbersOfAnInstance ? number : number % kNumbersOfAnInstance;
}

/// The numbers that a line with GENERATE lists: first, first + step, ..., up to last.
struct InpRange {
  std::int64_t first, last, step;
  /// One less than their count.
  [[nodiscard]] std::int64_t steps() const { return (last - first) / step; }
  void append_to(std::vector<std::int64_t>& numbers) const {
    for (std::int64_t k = 0; k <= steps(); ++k) numbers.push_back(first + k * step);
  }
};

/// The current line is never a comment; the reader may be at the end.
class InpText {
 public:
  /// Comments with ids are stored in `names`, comments with positions of nodes in exact_nodes(). Throws for a
  /// file without a line.
  InpText(const Source& source, InpNames& names) : text_(source, '\0'), names_(names) {
    if (!next()) text_.fail_truncated("a keyword");
  }

  /// Moves to the next line. False if there is none.
  bool next();
  [[nodiscard]] bool at_end() const { return line_.empty(); }
  [[nodiscard]] bool is_data() const { return !line_.empty() && line_[0] != '*'; }
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::vector<std::string_view> fields() const { return split(line_, ','); }
  /// Reads the keyword of this line and moves past it. Throws if there is none.
  InpKeyword keyword();
  /// Whether the line is this keyword, ignoring blanks and case.
  [[nodiscard]] bool is_keyword(std::string_view name) const;

  /// The position of the line, and a way back to it.
  [[nodiscard]] std::size_t place() const { return at_end() ? text_.source().bytes.size() : text_.last(); }
  void go_to(std::size_t place) {
    text_.seek(place);
    next();
  }

  [[nodiscard]] const InpScope& scope() const { return scope_; }
  void set_scope(InpScope scope) { scope_ = std::move(scope); }
  /// A field as the number of a node or an element in the scope. Throws for the line.
  [[nodiscard]] std::int64_t number(std::string_view field, std::string_view what) const;
  /// Field k as an increment of numbers; 1 if it is missing or empty. Throws for the line.
  [[nodiscard]] std::int64_t increment(const std::vector<std::string_view>& fields, std::size_t k,
                                       std::string_view what) const;
  /// The fields of a line with GENERATE, in a set of entities called `what`. Throws for the line.
  [[nodiscard]] InpRange range(const std::vector<std::string_view>& fields, const std::string& what) const;

  [[nodiscard]] const ExactNodes& exact_nodes() const { return exact_nodes_; }

  /// For errors in the current line.
  [[nodiscard]] const TextReader& reader() const { return text_; }
  /// For errors in a line at a position where the reader has been.
  void seek(std::size_t position) { text_.seek(position); }

 private:
  TextReader text_;
  InpNames& names_;
  ExactNodes exact_nodes_{rounded_for_inp};
  std::string_view line_;
  InpScope scope_;
};

}  // namespace holdfast::io
