// The text of Ansys Fluent's mesh and case files: sections (INDEX ...) of nested lists, hexadecimal numbers,
// and sections 2000 to 3999, whose last list is binary (Ansys Fluent user's guide, appendix "Mesh file
// format").
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/text_reader.h"

namespace holdfast::io {

class FluentText {
 public:
  explicit FluentText(const Source& source) : text_(source, '\0') {}

  [[nodiscard]] bool at_end() { return text_.at_end(); }
  /// The next sign that is not blank; '\0' at the end of the file.
  [[nodiscard]] char peek();
  void open(std::string_view what) { expect('(', what); }
  void close(std::string_view what) { expect(')', what); }
  /// The next word, or a text without its quotes.
  std::string_view word(std::string_view what);
  std::int64_t decimal(std::string_view what);
  std::uint64_t hexadecimal(std::string_view what);
  /// Skips the rest of a list that is open, with the lists in it.
  void skip_list();

  /// Enters the body of a section, after its "(": text, or numbers of `bytes` each.
  void begin_body(std::size_t bytes) { bytes_ = bytes; }
  /// The number of bytes up to the end of the binary section.
  [[nodiscard]] std::size_t size_of_binary() const;
  std::uint64_t index(std::string_view what);
  double real(std::string_view what);
  /// Leaves the body and its section.
  void end_body();
  /// Leaves a binary section of any contents.
  void skip_binary();
  /// The number of things from `first` to `last`, which must fit the rest of the file.
  std::size_t count(std::uint64_t first, std::uint64_t last, std::size_t bytes_each, std::string_view what);

  void set_order(std::endian order) { order_ = order; }
  [[nodiscard]] std::size_t position() const { return text_.position(); }
  [[nodiscard]] const Source& source() const { return text_.source(); }
  [[noreturn]] void fail(const std::string& reason) const { text_.fail(reason); }
  [[noreturn]] void fail_at(std::size_t position, const std::string& reason) const {
    text_.fail_at(position, reason);
  }

 private:
  void expect(char sign, std::string_view what);
  /// The bytes of a binary number.
  const char* raw(std::size_t bytes, std::string_view what);

  TextReader text_;
  std::size_t bytes_ = 0;  ///< of a number in the body; 0: text
  std::endian order_ = std::endian::little;
};

}  // namespace holdfast::io
