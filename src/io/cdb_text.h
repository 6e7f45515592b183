// The lines of Ansys MAPDL's archive files: commands, and blocks of numbers in the columns of a Fortran
// format (Mechanical APDL command reference: NBLOCK, EBLOCK, CMBLOCK).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/fields.h"
#include "io/text_reader.h"

namespace holdfast::io {

/// The fields of a block's lines: integers, then real numbers.
struct CdbColumns {
  std::size_t integers = 0, integer_width = 0, real_width = 0;
};

class CdbText {
 public:
  explicit CdbText(const Source& source) : text_(source, '\0') {}

  /// Moves to the next line; false at the end.
  bool next();
  [[nodiscard]] std::string_view line() const { return line_; }
  /// The command of this line in lower case, and its arguments.
  [[nodiscard]] std::string command() const { return lower(trimmed(line_.substr(0, line_.find(',')))); }
  [[nodiscard]] std::vector<std::string_view> arguments() const { return split(line_, ','); }
  /// Moves to the line of a block's format, such as (3i9,6e21.13e3), and reads it.
  CdbColumns read_format();

  /// Column i of this line as an integer; 0 if it is blank.
  [[nodiscard]] std::int64_t integer(const CdbColumns& columns, std::size_t i, std::string_view what) const;
  /// Real number i of this line, after `integers` integers; 0 if it is blank.
  [[nodiscard]] double real(const CdbColumns& columns, std::size_t i, std::string_view what) const;
  /// Whether this line ends a block: -1, or a command.
  [[nodiscard]] bool ends_block(const CdbColumns& columns) const;

  [[nodiscard]] std::size_t place() const { return text_.last(); }
  [[nodiscard]] const Source& source() const { return text_.source(); }
  [[noreturn]] void fail(const std::string& reason) const { text_.fail(reason); }
  [[noreturn]] void fail_at(std::size_t place, const std::string& reason) const {
    text_.fail_at(place, reason);
  }
  [[noreturn]] void fail_truncated(std::string_view what) const { text_.fail_truncated(what); }
  /// For numbers in commands.
  [[nodiscard]] const TextReader& reader() const { return text_; }

 private:
  TextReader text_;
  std::string_view line_;
};

}  // namespace holdfast::io
