#include "io/ensight_geo.h"

#include <algorithm>
#include <cmath>

#include "io/byte_reader.h"
#include "io/fields.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kLine = 80;  // bytes of a text in binary

std::string_view cleaned(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  return trimmed(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

}  // namespace

EnsightGeo::EnsightGeo(const Source& source) : text_(source, '\0') {
  const std::string head = lower(source.bytes.substr(0, 16));
  if (head.find("fortran binary") != std::string::npos)
    throw FileError(source.path, "", "in Fortran's binary; save it in C's binary or as text");
  binary_ = head.starts_with("c binary");
  if (binary_) static_cast<void>(line("C Binary"));
}

void EnsightGeo::fail_at(std::size_t place, const std::string& reason) const {
  if (binary_) throw FileError(text_.source().path, "byte " + std::to_string(place), reason);
  text_.fail_at(place, reason);
}

const char* EnsightGeo::raw(std::size_t bytes, std::string_view what) {
  beat(text_.source().watch);
  text_.seek(text_.position());
  const std::string_view rest = text_.remaining();
  if (rest.size() < bytes) fail("the file ends where " + std::string(what) + " is expected; it is truncated");
  text_.skip(bytes);
  return rest.data();
}

bool EnsightGeo::at_end() {
  if (binary_) return text_.remaining().size() < kLine;
  if (after_number_) text_.skip_line();
  after_number_ = false;
  return text_.at_end();
}

std::string_view EnsightGeo::line(std::string_view what) {
  if (binary_) return cleaned({raw(kLine, what), kLine});
  if (after_number_) text_.skip_line();
  after_number_ = false;
  if (text_.remaining().empty()) text_.fail_truncated(what);
  return trimmed(text_.rest_of_line());
}

std::string_view EnsightGeo::keyword(std::string_view what) {
  for (;;)
    if (const std::string_view found = line(what); !found.empty()) return found;
}

std::int64_t EnsightGeo::integer(std::string_view what) {
  after_number_ = true;
  return binary_ ? load<std::int32_t>(raw(4, what), order_) : text_.integer(what);
}

std::size_t EnsightGeo::count(std::string_view what, std::size_t values) {
  const std::int64_t value = integer(what);
  const std::size_t left = text_.remaining().size(), bytes_each = values * (binary_ ? 4 : 2);
  if (value < 0 || static_cast<std::uint64_t>(value) > (left + 1) / std::max<std::size_t>(bytes_each, 1))
    fail(std::string(what) + " is " + std::to_string(value) + ", but only " + std::to_string(left) +
         " bytes follow; the file is truncated or damaged");
  return static_cast<std::size_t>(value);
}

double EnsightGeo::real(std::string_view what) {
  after_number_ = true;
  if (!binary_) return text_.real(what);
  const double value = load<float>(raw(4, what), order_);
  if (text_.source().finite && !std::isfinite(value)) fail(std::string(what) + " is not finite");
  return value;
}

std::int64_t EnsightGeo::part_number() {
  if (!binary_) return integer("the number of a part");
  constexpr std::int32_t kMost = 1 << 20;  // above all numbers of parts, and below them in the other order
  const char* const number = raw(4, "the number of a part");
  const auto fits = [&](std::endian order) {
    const auto value = load<std::int32_t>(number, order);
    return value >= 0 && value < kMost;
  };
  if (!has_order_ && !fits(order_)) order_ = std::endian::big;
  has_order_ = true;
  if (!fits(order_)) fail("no number of a part");
  return load<std::int32_t>(number, order_);
}

void EnsightGeo::skip_integers(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) static_cast<void>(integer("a number"));
}

}  // namespace holdfast::io
