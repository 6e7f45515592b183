// Reads numbers and words from a text in memory and knows the line of each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/mesh_data.h"

namespace holdfast::io {

/// A cursor over text. Blanks are spaces, tabs and control characters up to 32; lines end with
/// "\n", "\r\n" or "\r". A byte order mark at the start is skipped.
///
/// `what` in the functions below names the thing that is read, with its article ("a coordinate"),
/// for the error. All of them throw FileError with the line.
class TextReader {
 public:
  /// `comment` starts a comment that ends with the line; 0: there are no comments.
  explicit TextReader(const Source& source, char comment = '#');

  /// Skips blanks, line ends and comments. True at the end of the text.
  bool at_end();
  /// Skips blanks within the line. True if only a comment follows on the line.
  bool at_line_end();
  /// Moves to the start of the next line.
  void skip_line();

  /// The next word, on this or a later line.
  std::string_view word(std::string_view what);
  /// The next word of this line; empty at its end.
  std::string_view word_on_line();
  /// The rest of the line without its end; moves to the next line.
  std::string_view rest_of_line();

  /// A number; "nan" and "inf" are accepted, because `diagnose` reports where they are.
  double real(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// An integer that fits a marker or region id.
  int tag(std::string_view what);
  /// A whole number that may be spelled as a real, such as "3.0".
  int tag_from_real(std::string_view what);
  Point point();
  /// An index of one of `size` things, numbered from `base`; returned zero-based.
  Index index(std::string_view what, std::int64_t base, std::size_t size);
  /// A count of things of at least `bytes_each` bytes of text each. It is checked against the rest of the
  /// file, so that a reader may reserve memory for them.
  std::size_t count(std::string_view what, std::size_t bytes_each);

  /// Whether a number follows (not the end, and not a word such as "End").
  bool number_follows();

  /// Throws a FileError for the line of what was read last.
  [[noreturn]] void fail(const std::string& reason) const;
  /// Throws a FileError for the line of the byte at `position`.
  [[noreturn]] void fail_at(std::size_t position, const std::string& reason) const;
  /// Throws a FileError that says the file ends where `what` should be.
  [[noreturn]] void fail_truncated(std::string_view what) const;

  /// Offset of the next byte.
  [[nodiscard]] std::size_t position() const { return position_; }
  /// Offset of what was read last.
  [[nodiscard]] std::size_t last() const { return last_; }
  void seek(std::size_t position) { position_ = last_ = position; }
  /// Moves on within what was read last, of which errors name the line.
  void skip(std::size_t bytes) { position_ += bytes; }
  [[nodiscard]] std::string_view remaining() const { return source_.bytes.substr(position_); }
  [[nodiscard]] const Source& source() const { return source_; }

 private:
  [[nodiscard]] bool delimiter_at(std::size_t position) const;
  [[nodiscard]] std::size_t word_end(std::size_t position) const;
  void start(std::string_view what);
  [[noreturn]] void fail_expected(std::string_view what) const;

  Source source_;
  char comment_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;
};

/// The line of a position, from 1.
[[nodiscard]] std::size_t line_of(std::string_view text, std::size_t position);

/// `word` in lower case (ASCII).
[[nodiscard]] std::string lower(std::string_view word);

/// `text` in quotes for a message: shortened, and without bytes that control a terminal.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace holdfast::io
