// Writes HDF5 files by the HDF5 file format specification, version 2.0, with structures that every version of
// the library from 1.8 on reads: superblock 0, object headers of version 1, contiguous arrays.
//
//   superblock | for each group its members, then its object header with links to them | values of the arrays
#include "io/hdf5_write.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "io/byte_reader.h"
#include "io/hdf5_number.h"

namespace holdfast::io {
namespace {

constexpr std::uint64_t kUndefined = ~std::uint64_t{0};
constexpr std::uint16_t kLeafK = 4, kInternalK = 16;  // of B-trees, which are not used
constexpr std::size_t kSuperblock = 96, kMostMessages = 65000;

class Bytes {
 public:
  template <typename T>
  Bytes& put(T value) {
    store(bytes_, value, std::endian::little);
    return *this;
  }
  Bytes& text(std::string_view text) { return bytes_.append(text), *this; }
  Bytes& zeros(std::size_t count) { return bytes_.append(count, '\0'), *this; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] const std::string& all() const { return bytes_; }

 private:
  std::string bytes_;
};

Bytes padded(Bytes bytes) { return bytes.zeros(hdf5_padded(bytes.size()) - bytes.size()); }

std::size_t bytes_of(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::text80:
      return 80;
    case Hdf5Type::int8:
      return 1;
    case Hdf5Type::int32:
    case Hdf5Type::float32:
      return 4;
    default:
      return 8;
  }
}

Bytes dataspace(std::initializer_list<std::uint64_t> shape) {
  Bytes bytes;
  bytes.put<std::uint8_t>(1).put(static_cast<std::uint8_t>(shape.size())).zeros(6);
  for (const std::uint64_t n : shape) bytes.put(n);
  return bytes;
}
Bytes dataspace(const Hdf5Array& array) {
  return array.columns == 1 && !array.two_directions ? dataspace({array.rows})
                                                     : dataspace({array.rows, array.columns});
}

Bytes integer_type(std::uint32_t size) {
  Bytes bytes;  // version 1, class 0; little endian, signed
  bytes.put<std::uint8_t>(0x10).put<std::uint8_t>(0x08).put<std::uint8_t>(0).put<std::uint8_t>(0);
  bytes.put(size).put<std::uint16_t>(0).put(static_cast<std::uint16_t>(8 * size));
  return bytes;
}

/// The type of a text that ends in a zero.
Bytes text_type(std::uint32_t size) {
  Bytes bytes;  // version 1, class 3
  bytes.put<std::uint8_t>(0x13).zeros(3).put(size);
  return bytes;
}

Bytes datatype(Hdf5Type type) {
  Bytes bytes;
  if (type == Hdf5Type::float64 || type == Hdf5Type::float32) {
    // Version 1, class 1; little endian, a mantissa with an implied bit, the sign in the last bit.
    const bool is_double = type == Hdf5Type::float64;
    const std::uint8_t bits = is_double ? 64 : 32, mantissa = is_double ? 52 : 23,
                       exponent = is_double ? 11 : 8;
    bytes.put<std::uint8_t>(0x11).put<std::uint8_t>(0x20).put<std::uint8_t>(bits - 1).put<std::uint8_t>(0);
    bytes.put<std::uint32_t>(bits / 8U).put<std::uint16_t>(0).put<std::uint16_t>(bits);
    bytes.put(mantissa).put(exponent).put<std::uint8_t>(0).put(mantissa);
    bytes.put<std::uint32_t>(is_double ? 1023 : 127);
  } else if (type == Hdf5Type::text80) {
    // Version 2, class 10: an array of 80 one-byte integers.
    bytes.put<std::uint8_t>(0x2A).zeros(3).put<std::uint32_t>(80);
    bytes.put<std::uint8_t>(1).zeros(3).put<std::uint32_t>(80).put<std::uint32_t>(0);
    bytes.text(integer_type(1).all());
  } else {
    bytes = integer_type(static_cast<std::uint32_t>(bytes_of(type)));
  }
  return bytes.zeros(hdf5_padded(bytes.size()) - bytes.size());
}

Bytes fill_value() {
  Bytes bytes;  // version 2, allocated late, written if set, not defined
  bytes.put<std::uint8_t>(2).put<std::uint8_t>(2).put<std::uint8_t>(2).put<std::uint8_t>(0);
  return bytes.zeros(4);
}

Bytes layout(std::uint64_t address, std::uint64_t size) {
  Bytes bytes;  // version 3, contiguous
  bytes.put<std::uint8_t>(3).put<std::uint8_t>(1).put(size == 0 ? kUndefined : address).put(size);
  return bytes.zeros(hdf5_padded(bytes.size()) - bytes.size());
}

/// An object header of version 1 with its messages.
Bytes header(const std::vector<std::pair<std::uint16_t, Bytes>>& messages) {
  std::uint32_t size = 0;
  for (const auto& [type, message] : messages) size += static_cast<std::uint32_t>(8 + message.size());
  Bytes bytes;
  bytes.put<std::uint8_t>(1).zeros(1).put(static_cast<std::uint16_t>(messages.size()));
  bytes.put<std::uint32_t>(1).put(size).zeros(4);
  for (const auto& [type, message] : messages) {
    bytes.put(type).put(static_cast<std::uint16_t>(message.size())).zeros(4);
    bytes.text(message.all());
  }
  return bytes;
}

using Messages = std::vector<std::pair<std::uint16_t, Bytes>>;

Bytes attribute(const Hdf5Attribute& attribute) {
  Bytes type, value;
  if (const auto* const text = std::get_if<std::string>(&attribute.value)) {
    type = text_type(static_cast<std::uint32_t>(text->size() + 1));
    value.text(*text).zeros(1);
  } else if (const auto* const real = std::get_if<double>(&attribute.value)) {
    type = datatype(Hdf5Type::float64);
    value.put(*real);
  } else {
    type = integer_type(4);
    value.put(std::get<std::int32_t>(attribute.value));
  }
  const Bytes space = dataspace({});
  Bytes bytes;  // version 1
  bytes.put<std::uint8_t>(1).zeros(1).put(static_cast<std::uint16_t>(attribute.name.size() + 1));
  bytes.put(static_cast<std::uint16_t>(type.size())).put(static_cast<std::uint16_t>(space.size()));
  Bytes name;
  name.text(attribute.name).zeros(1);
  bytes.text(padded(name).all()).text(padded(type).all()).text(padded(space).all()).text(value.all());
  return padded(bytes);
}

void add_attributes(Messages& messages, const std::vector<Hdf5Attribute>& attributes) {
  for (const Hdf5Attribute& one : attributes) messages.emplace_back(0x000C, attribute(one));
}

/// Everything in a file except the values of its arrays, which begin at `values_begin`.
class Metadata {
 public:
  Metadata(const Hdf5Group& root, std::uint64_t values_begin) : values_end_(values_begin) {
    bytes_.zeros(kSuperblock);
    const std::uint64_t header = add_group(root);
    Bytes head;
    head.text("\x89HDF\r\n\x1a\n").zeros(5).put<std::uint8_t>(8).put<std::uint8_t>(8).zeros(1);
    head.put(kLeafK).put(kInternalK).zeros(4);
    head.put<std::uint64_t>(0).put(kUndefined).put(values_end_).put(kUndefined);
    head.put<std::uint64_t>(0).put(header).zeros(24);  // the root's entry
    superblock_ = head.all();
  }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::string all() const { return superblock_ + bytes_.all().substr(kSuperblock); }
  /// In the order of their values in the file.
  [[nodiscard]] const std::vector<const Hdf5Array*>& arrays() const { return arrays_; }

 private:
  std::uint64_t add(const Bytes& block) {
    const std::uint64_t at = bytes_.size();
    bytes_.text(block.all()).zeros(hdf5_padded(bytes_.size()) - bytes_.size());
    return at;
  }

  std::uint64_t add_array(const Hdf5Array& array) {
    const std::uint64_t size = array.rows * array.columns * bytes_of(array.type);
    Messages messages{{0x0001, dataspace(array)},
                      {0x0003, datatype(array.type)},
                      {0x0005, fill_value()},
                      {0x0008, layout(values_end_, size)}};
    add_attributes(messages, array.attributes);
    values_end_ += hdf5_padded(static_cast<std::size_t>(size));
    arrays_.push_back(&array);
    return add(header(messages));
  }

  /// Adds a group with links in its header in creation order, on which MED relies.
  std::uint64_t add_group(const Hdf5Group& group) {
    if (group.arrays.size() + group.groups.size() + group.attributes.size() > kMostMessages)
      throw std::invalid_argument("more sets than a group of HDF5 holds here");
    Messages links;
    const auto link = [&](const std::string& name, std::uint64_t object) {
      Bytes bytes;  // version 1; with its creation order, and the length of the name in one byte
      bytes.put<std::uint8_t>(1).put<std::uint8_t>(4).put(static_cast<std::uint64_t>(links.size()));
      bytes.put(static_cast<std::uint8_t>(name.size())).text(name).put(object);
      links.emplace_back(0x0006, padded(std::move(bytes)));
    };
    for (const Hdf5Array& array : group.arrays) link(array.name, add_array(array));
    for (const Hdf5Group& inner : group.groups) link(inner.name, add_group(inner));
    Bytes info, phases;
    info.zeros(1).put<std::uint8_t>(1).put(static_cast<std::uint64_t>(links.size()));  // order is tracked
    info.put(kUndefined).put(kUndefined);                                              // no links elsewhere
    constexpr std::uint16_t kMostInHeader = 65535, kLeastElsewhere = 65534;
    phases.zeros(1).put<std::uint8_t>(1).put(kMostInHeader).put(kLeastElsewhere);
    Messages messages{{0x0002, padded(std::move(info))}, {0x000A, padded(std::move(phases))}};
    messages.insert(messages.end(), links.begin(), links.end());
    add_attributes(messages, group.attributes);
    return add(header(messages));
  }

  Bytes bytes_;
  std::string superblock_;
  std::uint64_t values_end_;
  std::vector<const Hdf5Array*> arrays_;
};

void put_values(AtomicWriter& out, const Hdf5Array& array) {
  const std::size_t size = bytes_of(array.type), count = static_cast<std::size_t>(array.rows * array.columns);
  const char* const values = static_cast<const char*>(array.values);
  if (std::endian::native == std::endian::little || array.type == Hdf5Type::text80) {
    out << std::string_view(values, count * size);
  } else {
    std::string turned;
    for (std::size_t i = 0; i < count; ++i) {
      turned.assign(values + i * size, size);
      std::reverse(turned.begin(), turned.end());
      out << turned;
    }
  }
  out << std::string(hdf5_padded(count * size) - count * size, '\0');
}

}  // namespace

void write_hdf5(AtomicWriter& out, const Hdf5Group& root) {
  // The size does not depend on `values_begin`.
  const Metadata metadata(root, Metadata(root, 0).size());
  out << metadata.all();
  for (const Hdf5Array* const array : metadata.arrays()) put_values(out, *array);
}

}  // namespace holdfast::io
