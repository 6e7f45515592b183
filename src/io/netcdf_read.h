// The arrays of a netCDF file by their names: the classic format in its versions 1, 2 and 5, and netCDF-4,
// which is HDF5.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/byte_reader.h"
#include "io/hdf5_read.h"

namespace holdfast::io {

/// All functions throw FileError with the array's name, or the byte, if the file is damaged.
class NetcdfFile {
 public:
  explicit NetcdfFile(const Source& source);

  [[nodiscard]] bool has(const std::string& array) const;
  /// The extent in each direction, slowest first; empty if there is no such array.
  [[nodiscard]] std::vector<std::uint64_t> shape(const std::string& array) const;
  [[nodiscard]] std::vector<double> reals(const std::string& array) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& array) const;
  /// The rows of an array of characters, without zeros and blanks at their ends. Empty without such an array.
  [[nodiscard]] std::vector<std::string> texts(const std::string& array) const;
  /// Empty if there is none.
  [[nodiscard]] std::string text_attribute(const std::string& array, const std::string& name) const;

  [[nodiscard]] const Source& source() const { return source_; }
  [[noreturn]] void fail(const std::string& array, const std::string& reason) const;

 private:
  struct Array {
    std::uint32_t type = 0;
    std::vector<std::uint64_t> shape;
    std::uint64_t begin = 0;
    bool by_record = false;
    std::map<std::string, std::string> texts;  ///< attributes
  };
  class Header;

  [[nodiscard]] const Array& found(const std::string& array) const;
  [[nodiscard]] Hdf5File::Object in_hdf5(const std::string& array) const;
  /// All values of a classic array, converted.
  template <typename T>
  [[nodiscard]] std::vector<T> values(const std::string& array) const;

  Source source_;
  std::optional<Hdf5File> hdf5_;  ///< of netCDF-4
  std::map<std::string, Hdf5File::Object> links_;
  std::map<std::string, Array> arrays_;  ///< of the classic format
};

}  // namespace holdfast::io
