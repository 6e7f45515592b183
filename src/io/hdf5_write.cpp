// Writes HDF5 files by the HDF5 file format specification, version 2.0, with the oldest of its structures,
// which every version of the library reads: superblock 0, a group as a B-tree of version 1 with one leaf, and
// contiguous arrays.
//
//   superblock | root's object header | B-tree node | local heap of names | leaf | object headers | arrays
#include "io/hdf5_write.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "io/byte_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint64_t kUndefined = ~std::uint64_t{0};
constexpr std::size_t kLeafK = 4, kInternalK = 16;  // half of the entries of a leaf and of an inner node
constexpr std::size_t kSuperblock = 96, kRootHeader = 40, kTree = 24 + 8 * (4 * kInternalK + 1),
                      kHeapHead = 32, kLeaf = 8 + 2 * kLeafK * 40;

class Bytes {
 public:
  template <typename T>
  Bytes& put(T value) {
    store(bytes_, value, std::endian::little);
    return *this;
  }
  Bytes& text(std::string_view text) { return bytes_.append(text), *this; }
  Bytes& zeros(std::size_t count) { return bytes_.append(count, '\0'), *this; }
  /// Zeros up to a size.
  Bytes& fill(std::size_t size) { return zeros(size - bytes_.size()); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] const std::string& all() const { return bytes_; }

 private:
  std::string bytes_;
};

std::size_t round_up(std::size_t size) { return (size + 7) / 8 * 8; }

std::size_t bytes_of(Hdf5Type type) { return type == Hdf5Type::int32 ? 4 : 8; }

Bytes dataspace(const Hdf5Array& array) {
  const bool is_matrix = array.columns != 1;
  Bytes bytes;
  bytes.put<std::uint8_t>(1).put<std::uint8_t>(is_matrix ? 2 : 1).zeros(6).put(array.rows);
  if (is_matrix) bytes.put(array.columns);
  return bytes;
}

Bytes datatype(Hdf5Type type) {
  Bytes bytes;
  if (type == Hdf5Type::float64) {
    // Version 1, class 1; little endian, a mantissa with an implied bit, the sign in bit 63.
    bytes.put<std::uint8_t>(0x11).put<std::uint8_t>(0x20).put<std::uint8_t>(63).put<std::uint8_t>(0);
    bytes.put<std::uint32_t>(8).put<std::uint16_t>(0).put<std::uint16_t>(64);
    bytes.put<std::uint8_t>(52).put<std::uint8_t>(11).put<std::uint8_t>(0).put<std::uint8_t>(52);
    bytes.put<std::uint32_t>(1023);
  } else {
    const auto size = static_cast<std::uint32_t>(bytes_of(type));
    // Version 1, class 0; little endian, signed.
    bytes.put<std::uint8_t>(0x10).put<std::uint8_t>(0x08).put<std::uint8_t>(0).put<std::uint8_t>(0);
    bytes.put(size).put<std::uint16_t>(0).put(static_cast<std::uint16_t>(8 * size));
  }
  return bytes.zeros(round_up(bytes.size()) - bytes.size());
}

Bytes fill_value() {
  Bytes bytes;  // version 2, allocated late, written if set, not defined
  bytes.put<std::uint8_t>(2).put<std::uint8_t>(2).put<std::uint8_t>(2).put<std::uint8_t>(0);
  return bytes.zeros(4);
}

Bytes layout(std::uint64_t address, std::uint64_t size) {
  Bytes bytes;  // version 3, contiguous
  bytes.put<std::uint8_t>(3).put<std::uint8_t>(1).put(size == 0 ? kUndefined : address).put(size);
  return bytes.zeros(round_up(bytes.size()) - bytes.size());
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

Bytes array_header(const Hdf5Array& array, std::uint64_t address) {
  return header({{0x0001, dataspace(array)},
                 {0x0003, datatype(array.type)},
                 {0x0005, fill_value()},
                 {0x0008, layout(address, array.rows * array.columns * bytes_of(array.type))}});
}

void put_values(AtomicWriter& out, const Hdf5Array& array) {
  const std::size_t size = bytes_of(array.type), count = array.rows * array.columns;
  const char* const values = static_cast<const char*>(array.values);
  if (std::endian::native == std::endian::little) {
    out << std::string_view(values, count * size);
  } else {
    std::string turned;
    for (std::size_t i = 0; i < count; ++i) {
      turned.assign(values + i * size, size);
      std::reverse(turned.begin(), turned.end());
      out << turned;
    }
  }
  out << std::string(round_up(count * size) - count * size, '\0');
}

}  // namespace

void write_hdf5(AtomicWriter& out, std::vector<Hdf5Array> arrays) {
  if (arrays.size() > 2 * kLeafK) throw std::invalid_argument("more arrays than one leaf of a group holds");
  std::sort(arrays.begin(), arrays.end(),
            [](const Hdf5Array& a, const Hdf5Array& b) { return a.name < b.name; });
  Bytes names;
  names.zeros(8);
  std::vector<std::uint64_t> name_at;
  for (const Hdf5Array& array : arrays) {
    name_at.push_back(names.size());
    names.text(array.name).zeros(round_up(array.name.size() + 1) - array.name.size());
  }
  const std::uint64_t tree = kSuperblock + kRootHeader, heap = tree + kTree,
                      leaf = heap + kHeapHead + names.size();
  std::vector<std::uint64_t> header_at;
  std::uint64_t end = leaf + kLeaf;
  for (const Hdf5Array& array : arrays) {
    header_at.push_back(end);
    end += array_header(array, 0).size();
  }
  std::vector<std::uint64_t> values_at;
  for (const Hdf5Array& array : arrays) {
    values_at.push_back(end);
    end += round_up(array.rows * array.columns * bytes_of(array.type));
  }

  Bytes head;
  head.text("\x89HDF\r\n\x1a\n").zeros(5).put<std::uint8_t>(8).put<std::uint8_t>(8).zeros(1);
  head.put(static_cast<std::uint16_t>(kLeafK)).put(static_cast<std::uint16_t>(kInternalK)).zeros(4);
  head.put<std::uint64_t>(0).put(kUndefined).put(end).put(kUndefined);
  // The root's entry, with the addresses of its tree and names at hand.
  head.put<std::uint64_t>(0)
      .put<std::uint64_t>(kSuperblock)
      .put<std::uint32_t>(1)
      .zeros(4)
      .put(tree)
      .put(heap);
  Bytes symbols;
  symbols.put(tree).put(heap);
  head.text(header({{0x0011, symbols}}).all());
  head.text("TREE").zeros(2).put<std::uint16_t>(arrays.empty() ? 0 : 1).put(kUndefined).put(kUndefined);
  head.put<std::uint64_t>(0).put(leaf).put(arrays.empty() ? std::uint64_t{0} : name_at.back());
  head.fill(heap);
  head.text("HEAP").zeros(4).put<std::uint64_t>(names.size()).put<std::uint64_t>(1).put(heap + kHeapHead);
  head.text(names.all());
  head.text("SNOD").put<std::uint8_t>(1).zeros(1).put(static_cast<std::uint16_t>(arrays.size()));
  for (std::size_t i = 0; i < arrays.size(); ++i) head.put(name_at[i]).put(header_at[i]).zeros(24);
  head.fill(leaf + kLeaf);
  for (std::size_t i = 0; i < arrays.size(); ++i) head.text(array_header(arrays[i], values_at[i]).all());
  out << head.all();
  for (const Hdf5Array& array : arrays) put_values(out, array);
}

}  // namespace holdfast::io
