// The layout follows the NetCDF Users Guide, "NetCDF Classic Format Specification".
#include "io/netcdf_write.h"

#include <stdexcept>

#include "io/byte_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint32_t kDimensions = 10, kArrays = 11, kAttributes = 12, kFloatType = 5;

std::uint64_t padded(std::uint64_t size) { return (size + 3) / 4 * 4; }

template <typename T>
void append(std::string& bytes, T value) {
  store(bytes, value, std::endian::big);
}

void append_name(std::string& bytes, const std::string& name) {
  append(bytes, static_cast<std::uint32_t>(name.size()));
  bytes += name;
  bytes.resize(padded(bytes.size()), '\0');
}

void append_list(std::string& bytes, std::uint32_t tag, std::size_t members) {
  append(bytes, members == 0 ? std::uint32_t{0} : tag);
  append(bytes, static_cast<std::uint32_t>(members));
}

void append_attributes(std::string& bytes, const std::vector<NetcdfAttribute>& attributes) {
  append_list(bytes, kAttributes, attributes.size());
  for (const auto& [name, value] : attributes) {
    append_name(bytes, name);
    if (const auto* text = std::get_if<std::string>(&value)) {
      append(bytes, static_cast<std::uint32_t>(NetcdfKind::text));
      append_name(bytes, *text);
    } else if (const auto* number = std::get_if<std::int32_t>(&value)) {
      append(bytes, static_cast<std::uint32_t>(NetcdfKind::integer));
      append(bytes, std::uint32_t{1});
      append(bytes, *number);
    } else {
      append(bytes, kFloatType);
      append(bytes, std::uint32_t{1});
      append(bytes, std::get<float>(value));
    }
  }
}

std::uint64_t size_of(NetcdfKind kind) {
  return kind == NetcdfKind::text ? 1 : kind == NetcdfKind::integer ? 4 : 8;
}

/// The number of a dimension in the list.
std::uint32_t number_of(const NetcdfContent& content, const std::string& dimension) {
  std::uint32_t number = 0;
  while (content.dimensions.at(number).first != dimension) ++number;
  return number;
}

/// The bytes of an array without padding; of one record if it has records.
std::uint64_t bytes_of(const NetcdfContent& content, const NetcdfArray& array) {
  std::uint64_t bytes = size_of(array.kind);
  for (const std::string& dimension : array.dimensions) {
    const std::uint64_t extent = content.dimensions[number_of(content, dimension)].second;
    if (extent > 0) bytes *= extent;
  }
  if (bytes > 0xfffffffcULL)
    throw std::invalid_argument("an array of more than 4 GB does not fit netCDF's classic format");
  return bytes;
}

/// The header, for arrays whose values start at `first`; its length does not depend on that.
std::string header_of(const NetcdfContent& content, std::uint64_t first) {
  std::string bytes = "CDF\x02";
  append(bytes, std::uint32_t{0});  // records
  append_list(bytes, kDimensions, content.dimensions.size());
  for (const auto& [name, extent] : content.dimensions) {
    append_name(bytes, name);
    append(bytes, static_cast<std::uint32_t>(extent));
  }
  append_attributes(bytes, content.attributes);
  append_list(bytes, kArrays, content.arrays.size());
  std::uint64_t end = first;
  for (const NetcdfArray& array : content.arrays)
    if (array.write) end += padded(bytes_of(content, array));
  for (const NetcdfArray& array : content.arrays) {
    append_name(bytes, array.name);
    append(bytes, static_cast<std::uint32_t>(array.dimensions.size()));
    for (const std::string& dimension : array.dimensions) append(bytes, number_of(content, dimension));
    append_attributes(bytes, array.attributes);
    append(bytes, static_cast<std::uint32_t>(array.kind));
    const std::uint64_t size = padded(bytes_of(content, array));
    append(bytes, static_cast<std::uint32_t>(size));
    append(bytes, array.write ? first : end);  // records follow all other arrays
    if (array.write) first += size;
  }
  return bytes;
}

}  // namespace

void NetcdfValues::add(double value) {
  std::string bytes;
  append(bytes, value);
  out_ << bytes;
}

void NetcdfValues::add(std::int32_t value) {
  std::string bytes;
  append(bytes, value);
  out_ << bytes;
}

void NetcdfValues::add(const std::string& text, std::size_t width) {
  std::string row = text.substr(0, width);
  row.resize(width, '\0');
  out_ << row;
}

void NetcdfContent::write(AtomicWriter& out) const {
  out << header_of(*this, header_of(*this, 0).size());
  NetcdfValues values(out);
  for (const NetcdfArray& array : arrays) {
    if (!array.write) continue;
    array.write(values);
    const std::uint64_t bytes = bytes_of(*this, array);
    out << std::string(static_cast<std::size_t>(padded(bytes) - bytes), '\0');
  }
}

}  // namespace holdfast::io
