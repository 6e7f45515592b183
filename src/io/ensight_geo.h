// The values of an EnSight Gold geometry file, as text or in C's binary (EnSight user manual, "EnSight Gold
// geometry file format").
#pragma once

#include <bit>
#include <string_view>

#include "io/text_reader.h"

namespace holdfast::io {

class EnsightGeo {
 public:
  explicit EnsightGeo(const Source& source);

  [[nodiscard]] bool at_end();
  /// A line, or 80 bytes, without blanks round it; it may be empty.
  std::string_view line(std::string_view what);
  /// The next line that is not empty.
  std::string_view keyword(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// A number of things of at least `values` values each, which must fit the rest of the file.
  std::size_t count(std::string_view what, std::size_t values);
  double real(std::string_view what);
  /// The number of a part, which shows the byte order of the numbers.
  std::int64_t part_number();
  void skip_integers(std::size_t count);

  [[nodiscard]] std::size_t place() const { return text_.last(); }
  /// At the value that was read last.
  [[noreturn]] void fail(const std::string& reason) const { fail_at(text_.last(), reason); }
  [[noreturn]] void fail_at(std::size_t place, const std::string& reason) const;

 private:
  const char* raw(std::size_t bytes, std::string_view what);

  TextReader text_;
  bool binary_ = false, has_order_ = false;
  bool after_number_ = false;  ///< the rest of the line has nothing
  std::endian order_ = std::endian::little;
};

}  // namespace holdfast::io
