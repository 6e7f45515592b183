// HDF5 files: superblocks, object headers of both versions, attributes (HDF5 file format specification,
// version 3.0, II and IV.A).
#include "io/hdf5_read.h"

#include <algorithm>

#include "io/byte_reader.h"
#include "io/hdf5_number.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
constexpr std::uint16_t kContinuation = 0x0010, kAttribute = 0x000C, kAttributeInfo = 0x0015;

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with(kSignature); }

Hdf5File::Hdf5File(const Source& source) : source_(source) { read_superblock(); }

void Hdf5File::fail(std::uint64_t at, const std::string& reason) const {
  throw FileError(source_.path, "byte " + std::to_string(at), reason);
}

std::string_view Hdf5File::bytes(std::uint64_t at, std::uint64_t size) const {
  beat(source_.watch);
  if (at > source_.bytes.size() || size > source_.bytes.size() - at)
    fail(std::min<std::uint64_t>(at, source_.bytes.size()),
         "what should be at byte " + std::to_string(at) +
             " lies beyond the file's end; it is truncated or damaged");
  return source_.bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
}

std::uint64_t Hdf5File::number(std::uint64_t at, std::size_t size) const {
  std::uint64_t value = 0;
  const std::string_view raw = bytes(at, size);
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(raw[i]);
  return value;
}

void Hdf5File::require_signature(std::uint64_t at, std::string_view signature) const {
  if (bytes(at, signature.size()) != signature)
    fail(at, "the block " + in_quotes(signature) + " of HDF5 should be here; the file is damaged");
}

void Hdf5File::count_block(std::size_t& blocks, std::uint64_t at) const {
  constexpr std::size_t kLeast = 8;  // the least bytes of an entry
  if (++blocks > source_.bytes.size() / kLeast + 1) fail(at, "a tree of HDF5 runs in circles");
}

void Hdf5File::read_superblock() {
  if (!is_hdf5(source_.bytes)) throw FileError(source_.path, "", "this is no HDF5 file");
  const auto version = number<std::uint8_t>(8);
  const bool old = version < 2;
  if (version > 3) fail(8, "version " + std::to_string(version) + " of HDF5's superblock is not read");
  const std::uint64_t sizes = old ? 13 : 9;
  if (number<std::uint8_t>(sizes) != 8 || number<std::uint8_t>(sizes + 1) != 8)
    fail(sizes, "HDF5 files whose addresses are not of 8 bytes are not read");
  const std::uint64_t base = version == 0 ? 24 : version == 1 ? 28 : 12;
  if (number<std::uint64_t>(base) != 0) fail(base, "HDF5 files with a base address are not read");
  root_ = number<std::uint64_t>(old ? base + 40 : base + 24);
}

std::vector<Hdf5Message> Hdf5File::messages(Object object) const {
  std::vector<Hdf5Message> found;
  if (bytes(object, 4) == "OHDR")
    read_messages_2(object, found);
  else
    read_messages_1(object, found);
  return found;
}

void Hdf5File::read_messages_1(Object object, std::vector<Hdf5Message>& found) const {
  if (number<std::uint8_t>(object) != 1) fail(object, "an object's header of HDF5 should be here");
  const std::size_t count = number<std::uint16_t>(object + 2);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks{
      {object + 16, number<std::uint32_t>(object + 8)}};
  for (std::size_t block = 0; block < blocks.size() && found.size() < count; ++block) {
    auto [at, size] = blocks[block];
    const std::uint64_t end = at + bytes(at, size).size();
    while (at + 8 <= end && found.size() < count) {
      const Hdf5Message message{number<std::uint16_t>(at), static_cast<std::size_t>(at + 8),
                                number<std::uint16_t>(at + 2)};
      if (message.at + message.size > end) fail(at, "a message of HDF5 goes beyond its block");
      found.push_back(message);
      if (message.type == kContinuation)
        blocks.emplace_back(number<std::uint64_t>(message.at), number<std::uint64_t>(message.at + 8));
      at = message.at + message.size;
    }
  }
}

void Hdf5File::read_messages_2(Object object, std::vector<Hdf5Message>& found) const {
  constexpr std::size_t kMost = 65536;  // messages per object
  const auto flags = number<std::uint8_t>(object + 5);
  std::uint64_t at = object + 6 + ((flags & 0x20) != 0 ? 16 : 0) + ((flags & 0x10) != 0 ? 4 : 0);
  const std::size_t width = std::size_t{1} << (flags & 3);
  const std::size_t head = (flags & 4) != 0 ? 6 : 4;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks{{at + width, number(at, width)}};
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    at = blocks[block].first;
    const std::uint64_t end = at + bytes(at, blocks[block].second).size();
    while (at + head <= end) {
      const Hdf5Message message{number<std::uint8_t>(at), static_cast<std::size_t>(at + head),
                                number<std::uint16_t>(at + 1)};
      if (message.at + message.size > end) fail(at, "a message of HDF5 goes beyond its block");
      if (found.size() == kMost) fail(at, "an object's header of HDF5 runs in circles");
      found.push_back(message);
      if (message.type == kContinuation) {
        const auto next = number<std::uint64_t>(message.at), size = number<std::uint64_t>(message.at + 8);
        require_signature(next, "OCHK");
        if (size < 8) fail(next, "a block of HDF5 is too short");
        blocks.emplace_back(next + 4, size - 8);  // without the checksum
      }
      at = message.at + message.size;
    }
  }
}

std::optional<Hdf5File::Values> Hdf5File::attribute(Object object, std::string_view name) const {
  std::optional<Values> found;
  const auto look_at = [&](std::uint64_t at, std::uint64_t size) {
    if (!found) found = attribute_of_message(at, size, name);
  };
  for (const Hdf5Message& message : messages(object)) {
    if (message.type == kAttribute) {
      look_at(message.at, message.size);
    } else if (message.type == kAttributeInfo) {  // many attributes, stored in a heap
      const std::uint64_t at = message.at + ((number<std::uint8_t>(message.at + 1) & 1) != 0 ? 4 : 2);
      const auto heap = number<std::uint64_t>(at), tree = number<std::uint64_t>(at + 8);
      constexpr std::size_t kNothing = 0;  // bytes before the attribute's place in a record
      if (heap != kNoAddress) each_in_heap(heap, tree, kNothing, look_at);
    }
  }
  return found;
}

std::optional<Hdf5File::Values> Hdf5File::attribute_of_message(std::uint64_t at, std::uint64_t size,
                                                               std::string_view name) const {
  const auto version = number<std::uint8_t>(at);
  if (version < 1 || version > 3) fail(at, "an attribute's version of HDF5 is not read");
  const std::size_t name_size = number<std::uint16_t>(at + 2), type_size = number<std::uint16_t>(at + 4),
                    space_size = number<std::uint16_t>(at + 6);
  const auto padded = [&](std::size_t bytes) { return version == 1 ? hdf5_padded(bytes) : bytes; };
  const std::uint64_t name_at = at + (version == 3 ? 9 : 8);
  const std::uint64_t type_at = name_at + padded(name_size), space_at = type_at + padded(type_size),
                      data_at = space_at + padded(space_size);
  if (data_at > at + size) fail(at, "an attribute of HDF5 goes beyond its message");
  std::string_view found = bytes(name_at, name_size);
  found = found.substr(0, found.find('\0'));
  if (found != name) return std::nullopt;
  Values values;
  set_type(values, {0, static_cast<std::size_t>(type_at), type_size});
  set_shape(values, dataspace(space_at, space_size));
  const std::uint64_t data_size = values.count * values.type.size;
  if (data_size > at + size - data_at) fail(data_at, "an attribute of HDF5 goes beyond its message");
  values.bytes = bytes(data_at, data_size);
  return values;
}

std::optional<std::int64_t> Hdf5File::integer_attribute(Object object, std::string_view name) const {
  const std::optional<Values> values = attribute(object, name);
  if (!values || values->type.kind != Hdf5Datatype::Kind::integer || values->count == 0) return std::nullopt;
  return as_integers(*values, object).front();
}

std::optional<std::string> Hdf5File::text_attribute(Object object, std::string_view name) const {
  const std::optional<Values> values = attribute(object, name);
  if (!values || values->type.kind != Hdf5Datatype::Kind::text || values->count == 0) return std::nullopt;
  return as_texts(*values).front();
}

}  // namespace holdfast::io
