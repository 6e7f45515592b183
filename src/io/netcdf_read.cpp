// The classic format is described in the NetCDF Users Guide, "File Structure and Performance", "NetCDF
// Classic Format Specification".
#include "io/netcdf_read.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace holdfast::io {
namespace {

enum NetcdfType : std::uint32_t {
  kByte = 1,
  kChar,
  kShort,
  kInt,
  kFloat,
  kDouble,
  kUbyte,
  kUshort,
  kUint,
  kInt64,
  kUint64  // NOLINT
};

/// Bytes of a value; 0 for no type.
std::size_t size_of(std::uint32_t type) {
  constexpr std::array<std::size_t, 12> kSizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

/// A row of characters without what pads it. A zero inside is a blank.
std::string row_of(std::string text) {
  for (char& c : text)
    if (c == '\0') c = ' ';
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

/// Reads the lists of dimensions, attributes and arrays at the beginning of a classic file.
class NetcdfFile::Header {
 public:
  Header(const Source& source, std::map<std::string, Array>& arrays)
      : bytes_(source, std::endian::big), arrays_(arrays) {
    static_cast<void>(bytes_.take(3));
    version_ = bytes_.read<std::uint8_t>();
    if (version_ != 1 && version_ != 2 && version_ != 5)
      bytes_.fail("netCDF of version " + std::to_string(version_) + " is not read; 1, 2, 5 and netCDF-4 are");
    records_ = count();
    read_dimensions();
    static_cast<void>(attributes());
    read_arrays();
  }

 private:
  std::uint64_t count() {
    return version_ == 5 ? bytes_.read<std::uint64_t>() : std::uint64_t{bytes_.read<std::uint32_t>()};
  }
  std::size_t padded(std::uint64_t size) {
    bytes_.require_items(size, 1, "bytes");
    return (static_cast<std::size_t>(size) + 3) / 4 * 4;
  }
  std::string name() {
    const std::uint64_t size = count();
    return std::string(bytes_.take(padded(size)).substr(0, static_cast<std::size_t>(size)));
  }
  /// The number of members of a list that begins with a tag, or with zero if it has none.
  std::uint64_t list(std::uint32_t tag, const char* what) {
    const auto found = bytes_.read<std::uint32_t>();
    const std::uint64_t members = count();
    if (found != tag && (found != 0 || members != 0))
      bytes_.fail(std::string("expected the list of ") + what + "; the file is damaged");
    bytes_.require_items(members, 8, what);
    return members;
  }

  void read_dimensions() {
    for (std::uint64_t left = list(10, "dimensions"); left > 0; --left) {
      static_cast<void>(name());
      dimensions_.push_back(count());
    }
  }

  std::map<std::string, std::string> attributes() {
    std::map<std::string, std::string> texts;
    for (std::uint64_t left = list(12, "attributes"); left > 0; --left) {
      const std::string key = name();
      const auto type = bytes_.read<std::uint32_t>();
      const std::uint64_t values = count();
      if (size_of(type) == 0) bytes_.fail("an attribute of an unknown type; the file is damaged");
      bytes_.require_items(values, size_of(type), "values of an attribute");
      const std::string_view text = bytes_.take(padded(values * size_of(type)));
      if (type == kChar) texts[key] = row_of(std::string(text.substr(0, static_cast<std::size_t>(values))));
    }
    return texts;
  }

  void read_arrays() {
    for (std::uint64_t left = list(11, "arrays"); left > 0; --left) {
      const std::string key = name();
      Array array;
      const std::uint64_t directions = count();
      bytes_.require_items(directions, version_ == 5 ? 8 : 4, "dimensions of an array");
      for (std::uint64_t k = 0; k < directions; ++k) {
        const std::uint64_t dimension = count();
        if (dimension >= dimensions_.size())
          bytes_.fail("an array of a dimension that is not in the list; the file is damaged");
        std::uint64_t extent = dimensions_[static_cast<std::size_t>(dimension)];
        if (extent == 0 && k == 0) {
          array.by_record = true;
          extent = records_;
        }
        array.shape.push_back(extent);
      }
      array.texts = attributes();
      array.type = bytes_.read<std::uint32_t>();
      if (size_of(array.type) == 0) bytes_.fail("an array of an unknown type; the file is damaged");
      static_cast<void>(count());  // its bytes, which are a matter of its shape
      array.begin =
          version_ == 1 ? std::uint64_t{bytes_.read<std::uint32_t>()} : bytes_.read<std::uint64_t>();
      arrays_[key] = std::move(array);
    }
  }

  ByteReader bytes_;
  std::map<std::string, Array>& arrays_;
  int version_ = 0;
  std::uint64_t records_ = 0;
  std::vector<std::uint64_t> dimensions_;
};

NetcdfFile::NetcdfFile(const Source& source) : source_(source) {
  if (is_hdf5(source.bytes)) {
    hdf5_.emplace(source);
    links_ = hdf5_->links(hdf5_->root());
  } else if (source.bytes.starts_with("CDF")) {
    Header(source_, arrays_);
  } else {
    throw FileError(source.path, "byte 0", "not a netCDF file: it begins neither with CDF nor as HDF5 does");
  }
}

void NetcdfFile::fail(const std::string& array, const std::string& reason) const {
  throw FileError(source_.path, array, reason);
}

bool NetcdfFile::has(const std::string& array) const {
  return hdf5_ ? links_.contains(array) : arrays_.contains(array);
}

const NetcdfFile::Array& NetcdfFile::found(const std::string& array) const {
  const auto found = arrays_.find(array);
  if (found == arrays_.end()) fail(array, "the file has no such array");
  return found->second;
}

Hdf5File::Object NetcdfFile::in_hdf5(const std::string& array) const {
  const auto found = links_.find(array);
  if (found == links_.end()) fail(array, "the file has no such array");
  return found->second;
}

std::vector<std::uint64_t> NetcdfFile::shape(const std::string& array) const {
  if (!has(array)) return {};
  return hdf5_ ? hdf5_->shape(in_hdf5(array)) : found(array).shape;
}

template <typename T>
std::vector<T> NetcdfFile::values(const std::string& name) const {
  const Array& array = found(name);
  if (array.by_record) fail(name, "an array that grows by records is not read");
  std::uint64_t count = 1;
  for (const std::uint64_t extent : array.shape) {
    if (extent > 0 && count > source_.bytes.size() / extent) fail(name, "the file ends within this array");
    count *= extent;
  }
  if (array.begin > source_.bytes.size()) fail(name, "the file ends before this array; it is truncated");
  ByteReader bytes(source_, std::endian::big, static_cast<std::size_t>(array.begin));
  bytes.require_items(count, size_of(array.type), ("values of " + name).c_str());
  std::vector<T> result;
  result.reserve(static_cast<std::size_t>(count));
  const auto add = [&]<typename Value>(Value) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto value = bytes.read<Value>();
      if constexpr (std::is_integral_v<T> && std::is_floating_point_v<Value>)
        fail(name, "holds reals where integers are expected");
      else if constexpr (std::is_same_v<Value, std::uint64_t> && std::is_integral_v<T>)
        result.push_back(static_cast<T>(std::min<std::uint64_t>(value, std::numeric_limits<T>::max())));
      else
        result.push_back(static_cast<T>(value));
    }
  };
  switch (array.type) {
    case kByte:
      add(std::int8_t{});
      break;
    case kChar:
    case kUbyte:
      add(std::uint8_t{});
      break;
    case kShort:
      add(std::int16_t{});
      break;
    case kInt:
      add(std::int32_t{});
      break;
    case kFloat:
      add(float{});
      break;
    case kDouble:
      add(double{});
      break;
    case kUshort:
      add(std::uint16_t{});
      break;
    case kUint:
      add(std::uint32_t{});
      break;
    case kInt64:
      add(std::int64_t{});
      break;
    default:
      add(std::uint64_t{});
  }
  return result;
}

std::vector<double> NetcdfFile::reals(const std::string& array) const {
  return hdf5_ ? hdf5_->reals(in_hdf5(array)) : values<double>(array);
}

std::vector<std::int64_t> NetcdfFile::integers(const std::string& array) const {
  return hdf5_ ? hdf5_->integers(in_hdf5(array)) : values<std::int64_t>(array);
}

std::vector<std::string> NetcdfFile::texts(const std::string& array) const {
  const std::vector<std::uint64_t> extents = shape(array);
  if (extents.size() != 2 || extents[1] == 0) return {};
  std::string all;
  if (hdf5_)
    for (const std::string& character : hdf5_->texts(in_hdf5(array)))
      all += character.empty() ? ' ' : character[0];
  else
    for (const std::int64_t character : values<std::int64_t>(array)) all += static_cast<char>(character);
  std::vector<std::string> rows;
  const auto width = static_cast<std::size_t>(extents[1]);
  for (std::size_t at = 0; at + width <= all.size(); at += width)
    rows.push_back(row_of(all.substr(at, width)));
  return rows;
}

std::string NetcdfFile::text_attribute(const std::string& array, const std::string& name) const {
  if (hdf5_) return hdf5_->text_attribute(in_hdf5(array), name).value_or("");
  const auto& texts = found(array).texts;
  const auto attribute = texts.find(name);
  return attribute == texts.end() ? std::string() : attribute->second;
}

}  // namespace holdfast::io
