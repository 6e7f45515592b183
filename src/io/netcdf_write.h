// Writes netCDF's classic format, version 2, which holds arrays of up to 4 GB at any place of a file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/atomic_writer.h"

namespace holdfast::io {

using NetcdfAttribute = std::pair<std::string, std::variant<std::string, std::int32_t, float>>;

/// The values of an array, given one by one and written as the format stores them.
class NetcdfValues {
 public:
  explicit NetcdfValues(AtomicWriter& out) : out_(out) {}
  void add(double value);
  void add(std::int32_t value);
  /// A row of `width` characters.
  void add(const std::string& text, std::size_t width);

 private:
  AtomicWriter& out_;
};

enum class NetcdfKind : std::uint32_t { text = 2, integer = 4, real = 6 };

struct NetcdfArray {
  std::string name;
  NetcdfKind kind = NetcdfKind::integer;
  std::vector<std::string> dimensions;
  std::vector<NetcdfAttribute> attributes = {};
  std::function<void(NetcdfValues&)> write = {};  ///< all of its values; none for an array of no records
};

/// A file whose dimension of extent 0, if any, counts records, of which there are none.
struct NetcdfContent {
  std::vector<std::pair<std::string, std::uint64_t>> dimensions;
  std::vector<NetcdfAttribute> attributes;
  std::vector<NetcdfArray> arrays;

  /// Throws std::invalid_argument if an array has more than 4 GB.
  void write(AtomicWriter& out) const;
};

}  // namespace holdfast::io
