// Values in HDF5: datatypes, dataspaces, and arrays that are contiguous or in chunks, which may be compressed
// (HDF5 file format specification, III.A.1, IV.A.2.b, d, i, l).
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/hdf5_number.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint16_t kDataspace = 0x0001, kDatatype = 0x0003, kLayout = 0x0008, kFilters = 0x000B;
constexpr std::uint16_t kDeflate = 1, kShuffle = 2, kChecksum = 3;
constexpr std::size_t kMostRank = 32;

/// How many times larger an array may be than its compressed file, as for gzip; more is a decompression bomb.
constexpr std::uint64_t kMostPacked = 200, kAlways = std::uint64_t{64} << 20;
std::uint64_t most_bytes(const Source& source) {
  return std::max(kAlways, kMostPacked * source.bytes.size());
}

/// Undoes HDF5's shuffle filter, which stores byte 0 of all values, then byte 1 of all, and so on.
std::string unshuffled(const std::string& bytes, std::size_t size) {
  if (size < 2) return bytes;
  const std::size_t count = bytes.size() / size;
  std::string result = bytes;
  for (std::size_t b = 0; b < size; ++b)
    for (std::size_t i = 0; i < count; ++i) result[i * size + b] = bytes[b * count + i];
  return result;
}

}  // namespace

/// The chunks of an array.
struct Hdf5File::Chunks {
  std::vector<std::uint64_t> shape;  ///< of a chunk
  std::size_t file_rank = 0;         ///< dimensions for which the file has offsets, besides one for bytes
  std::uint64_t size = 0;            ///< bytes of an unpacked chunk
  const std::vector<Filter>& filters;
};

Hdf5Datatype Hdf5File::datatype(std::uint64_t at, std::uint64_t size, std::uint64_t& inner) const {
  if (size < 8) fail(at, "a datatype of HDF5 is cut off");
  constexpr std::uint8_t kInteger = 0, kReal = 1, kText = 3, kEnumeration = 8, kArray = 10;
  const std::uint8_t head = number<std::uint8_t>(at), kind = head & 15, version = head >> 4;
  const auto bits = number<std::uint8_t>(at + 1);
  Hdf5Datatype type;
  type.size = number<std::uint32_t>(at + 4);
  type.big_endian = (bits & 1) != 0;
  type.is_signed = (bits & 8) != 0;
  inner = 1;
  switch (kind) {
    case kInteger:
      if (type.size != 1 && type.size != 2 && type.size != 4 && type.size != 8)
        fail(at, "integers of " + std::to_string(type.size) + " bytes are not read");
      return type;
    case kReal:
      if (type.size != 4 && type.size != 8)
        fail(at, "reals of " + std::to_string(type.size) + " bytes are not read");
      type.kind = Hdf5Datatype::Kind::real;
      return type;
    case kText:
      if (type.size == 0) fail(at, "texts of no length are not read");
      type.kind = Hdf5Datatype::Kind::text;
      return type;
    case kEnumeration:
      if ((number<std::uint8_t>(at + 8) & 15) != kInteger) fail(at, "an enumeration of HDF5 is damaged");
      return datatype(at + 8, size - 8, inner);
    case kArray: {
      // A text, as MED stores names, or several values per element.
      const std::size_t rank = number<std::uint8_t>(at + 8);
      const std::uint64_t dimensions = at + (version < 3 ? 12 : 9);
      std::uint64_t count = 1;
      if (rank > 4) fail(at, "an array's datatype of HDF5 is damaged");
      for (std::size_t i = 0; i < rank; ++i)
        count *= std::max<std::uint32_t>(1, number<std::uint32_t>(dimensions + 4 * i));
      const std::uint64_t base = dimensions + 4 * rank * (version < 3 ? 2 : 1);
      if (count > type.size || base >= at + size || (number<std::uint8_t>(base) & 15) > kText)
        fail(at, "an array's datatype of HDF5 is damaged");
      std::uint64_t unused = 0;
      Hdf5Datatype of_base = datatype(base, at + size - base, unused);
      if (of_base.size * count != type.size || unused != 1)
        fail(at, "an array's datatype of HDF5 is damaged");
      if (of_base.kind == Hdf5Datatype::Kind::integer && of_base.size == 1) {
        type.kind = Hdf5Datatype::Kind::text;
        return type;
      }
      inner = count;
      return of_base;
    }
    default:
      fail(at, "values of HDF5's kind " + std::to_string(kind) +
                   " are not read; numbers and texts of fixed length are");
  }
}

std::vector<std::uint64_t> Hdf5File::dataspace(std::uint64_t at, std::uint64_t size) const {
  if (size < 4) fail(at, "a dataspace of HDF5 is cut off");
  const auto version = number<std::uint8_t>(at);
  const std::size_t rank = number<std::uint8_t>(at + 1);
  const bool none = version == 2 && number<std::uint8_t>(at + 3) == 2;
  const std::uint64_t begin = at + (version == 1 ? 8 : 4);
  if (version < 1 || version > 2 || rank > kMostRank || begin + 8 * rank > at + size)
    fail(at, "a dataspace of HDF5 is damaged");
  if (none) return {0};
  std::vector<std::uint64_t> shape;
  for (std::size_t i = 0; i < rank; ++i) shape.push_back(number<std::uint64_t>(begin + 8 * i));
  return shape;
}

std::vector<Hdf5File::Filter> Hdf5File::filters(std::uint64_t at, std::uint64_t size) const {
  const std::uint64_t end = at + size;
  const auto version = number<std::uint8_t>(at);
  const std::size_t count = number<std::uint8_t>(at + 1);
  std::uint64_t place = at + (version == 1 ? 8 : 2);
  std::vector<Filter> result;
  for (std::size_t i = 0; i < count; ++i) {
    Filter filter{number<std::uint16_t>(place), 0};
    const bool named = version == 1 || filter.id >= 256;
    const std::size_t name = named ? number<std::uint16_t>(place + 2) : 0;
    const std::size_t values = number<std::uint16_t>(place + (named ? 6 : 4));
    place += (named ? 8 : 6) + (version == 1 ? hdf5_padded(name) : name);
    if (values > 0) filter.parameter = number<std::uint32_t>(place);
    place += 4 * values + (version == 1 && values % 2 == 1 ? 4 : 0);
    if (place > end) fail(at, "the filters of an HDF5 array are damaged");
    if (filter.id != kDeflate && filter.id != kShuffle && filter.id != kChecksum)
      fail(at, "an array packed by HDF5's filter " + std::to_string(filter.id) +
                   " is not read; h5repack -f GZIP=4 packs it otherwise");
    result.push_back(filter);
  }
  return result;
}

void Hdf5File::set_type(Values& values, const Hdf5Message& message) const {
  std::uint64_t inner = 1;
  values.type = datatype(message.at, message.size, inner);
  values.count *= inner;
  if (inner > 1) values.shape.push_back(inner);
}

void Hdf5File::set_shape(Values& values, std::vector<std::uint64_t> shape) const {
  const std::uint64_t most = most_bytes(source_) / std::max<std::size_t>(1, values.type.size);
  for (const std::uint64_t n : shape) {
    if (n != 0 && values.count > most / n)
      throw FileError(source_.path, "",
                      "an array of HDF5 has more values than the file can hold; it is damaged");
    values.count *= n;
  }
  values.shape.insert(values.shape.begin(), shape.begin(), shape.end());
}

std::vector<std::uint64_t> Hdf5File::shape(Object array) const { return described(array).shape; }

Hdf5File::Values Hdf5File::described(Object array) const {
  std::optional<Hdf5Message> type, space;
  for (const Hdf5Message& message : messages(array)) {
    if (message.type == kDatatype) type = message;
    if (message.type == kDataspace) space = message;
  }
  if (!type || !space) fail(array, "an array of HDF5 should be here");
  Values values;
  set_type(values, *type);
  set_shape(values, dataspace(space->at, space->size));
  return values;
}

bool Hdf5File::holds_integers(Object array) const {
  return described(array).type.kind == Hdf5Datatype::Kind::integer;
}

Hdf5File::Values Hdf5File::values(Object array) const {
  Values values = described(array);
  if (values.count == 0) return values;
  std::vector<Filter> packed;
  std::optional<Hdf5Message> layout;
  for (const Hdf5Message& message : messages(array)) {
    if (message.type == kFilters) packed = filters(message.at, message.size);
    if (message.type == kLayout) layout = message;
  }
  if (!layout) fail(array, "an array of HDF5 without a layout");
  read_layout(*layout, packed, values);
  return values;
}

void Hdf5File::read_layout(const Hdf5Message& layout, const std::vector<Filter>& filters,
                           Values& values) const {
  constexpr std::uint8_t kCompact = 0, kContiguous = 1, kChunked = 2;
  const std::uint64_t at = layout.at, size = values.count * values.type.size;
  const auto version = number<std::uint8_t>(at), kind = number<std::uint8_t>(at + 1);
  if (version != 3 && !(version == 4 && kind != kChunked))
    fail(at, "an array's layout of HDF5 is of a version that is not read; h5repack writes an older one");
  if (kind == kCompact) {
    if (number<std::uint16_t>(at + 2) < size) fail(at, "an array of HDF5 is shorter than its shape");
    values.bytes = bytes(at + 4, size);
  } else if (kind == kContiguous) {
    if (number<std::uint64_t>(at + 10) < size) fail(at, "an array of HDF5 is shorter than its shape");
    values.bytes = bytes(number<std::uint64_t>(at + 2), size);
  } else if (kind == kChunked) {
    const std::size_t rank = number<std::uint8_t>(at + 2);
    Chunks chunks{{}, rank - 1, values.type.size, filters};
    if (rank < 2 || rank > kMostRank || rank - 1 > values.shape.size())
      fail(at, "the chunks of an HDF5 array are damaged");
    for (std::size_t i = 0; i + 1 < rank; ++i) {
      chunks.shape.push_back(number<std::uint32_t>(at + 11 + 4 * i));
      const std::uint64_t n = chunks.shape.back();
      if (n == 0 || chunks.size > std::numeric_limits<std::uint32_t>::max() / n)
        fail(at, "the chunks of an HDF5 array are damaged");
      chunks.size *= n;
    }
    // The components of values with several numbers come last.
    for (std::size_t i = rank - 1; i < values.shape.size(); ++i) {
      chunks.shape.push_back(values.shape[i]);
      chunks.size *= values.shape[i];
    }
    if (chunks.size > most_bytes(source_)) fail(at, "the chunks of an HDF5 array are damaged");
    values.owned.assign(static_cast<std::size_t>(size), '\0');
    const auto tree = number<std::uint64_t>(at + 3);
    if (tree != kNoAddress) read_chunks(tree, chunks, values);
    values.bytes = values.owned;
  } else {
    fail(at, "an array of HDF5 in other files is not read");
  }
}

void Hdf5File::read_chunks(std::uint64_t tree, const Chunks& chunks, Values& values) const {
  const std::size_t rank = chunks.shape.size();
  // The key of a chunk has its size, its filter mask, an offset for each dimension and one for the bytes.
  const std::size_t key_size = 8 + 8 * (chunks.file_rank + 1), step = key_size + 8;
  std::vector<std::uint64_t> nodes{tree};
  std::size_t blocks = 0;
  while (!nodes.empty()) {
    const std::uint64_t at = nodes.back();
    nodes.pop_back();
    require_signature(at, "TREE");
    const std::size_t level = number<std::uint8_t>(at + 5), children = number<std::uint16_t>(at + 6);
    for (std::size_t c = 0; c < children; ++c) {
      count_block(blocks, at);
      const std::uint64_t key = at + 24 + step * c, child = number<std::uint64_t>(key + key_size);
      if (level > 0) {
        nodes.push_back(child);
        continue;
      }
      std::vector<std::uint64_t> origin(rank, 0);
      for (std::size_t i = 0; i < chunks.file_rank; ++i) {
        origin[i] = number<std::uint64_t>(key + 8 + 8 * i);
        if (origin[i] >= values.shape[i]) fail(key, "a chunk of an HDF5 array lies beyond it");
      }
      put_chunk(origin, chunks,
                unpacked_chunk(child, number<std::uint32_t>(key), number<std::uint32_t>(key + 4), chunks),
                values);
    }
  }
}

void Hdf5File::put_chunk(const std::vector<std::uint64_t>& origin, const Chunks& chunks,
                         const std::string& unpacked, Values& values) const {
  // Copies row by row; the part of a chunk beyond the array's end is dropped.
  const std::size_t rank = origin.size(), last = rank - 1, each = values.type.size;
  const auto extent = [&](std::size_t i) { return std::min(chunks.shape[i], values.shape[i] - origin[i]); };
  const std::uint64_t row = extent(last) * each;
  std::vector<std::uint64_t> place(rank, 0);
  for (bool more = true; more;) {
    beat(source_.watch);
    std::uint64_t from = 0, to = 0;
    for (std::size_t i = 0; i < rank; ++i) {
      from = from * chunks.shape[i] + place[i];
      to = to * values.shape[i] + origin[i] + place[i];
    }
    const auto in = [](std::uint64_t bytes) { return static_cast<std::size_t>(bytes); };
    values.owned.replace(in(to * each), in(row), unpacked, in(from * each), in(row));
    more = false;
    for (std::size_t i = last; i-- > 0 && !more;) {
      more = ++place[i] < extent(i);
      if (!more) place[i] = 0;
    }
  }
}

std::string Hdf5File::unpacked_chunk(std::uint64_t at, std::uint64_t size, std::uint32_t mask,
                                     const Chunks& chunks) const {
  std::string unpacked(bytes(at, size));
  for (std::size_t i = chunks.filters.size(); i-- > 0;) {
    if (i < 32 && (mask >> i & 1) != 0) continue;
    const Filter& filter = chunks.filters[i];
    if (filter.id == kChecksum) {
      if (unpacked.size() < 4) fail(at, "a chunk of an HDF5 array is cut off");
      unpacked.resize(unpacked.size() - 4);
    } else if (filter.id == kShuffle) {
      unpacked = unshuffled(unpacked, filter.parameter);
    } else {
      std::string raw(static_cast<std::size_t>(chunks.size) + 4, '\0');
      auto length = static_cast<uLongf>(raw.size());
      if (uncompress(reinterpret_cast<Bytef*>(raw.data()), &length,
                     reinterpret_cast<const Bytef*>(unpacked.data()),
                     static_cast<uLong>(unpacked.size())) != Z_OK)
        fail(at, "a chunk of an HDF5 array cannot be unpacked; the file is damaged");
      raw.resize(length);
      unpacked = std::move(raw);
    }
  }
  if (unpacked.size() != chunks.size)
    fail(at, "a chunk of an HDF5 array has " + std::to_string(unpacked.size()) + " bytes instead of " +
                 std::to_string(chunks.size));
  return unpacked;
}

namespace {

template <typename Out, typename In>
void convert(std::string_view bytes, std::endian order, std::vector<Out>& out, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i)
    out.push_back(static_cast<Out>(load<In>(bytes.data() + i * sizeof(In), order)));
}

/// Calls with a value of the integer type of this size and sign.
template <typename Call>
void with_integer(std::size_t size, bool is_signed, Call&& call) {
  if (size == 1) return is_signed ? call(std::int8_t{}) : call(std::uint8_t{});
  if (size == 2) return is_signed ? call(std::int16_t{}) : call(std::uint16_t{});
  if (size == 4) return is_signed ? call(std::int32_t{}) : call(std::uint32_t{});
  return is_signed ? call(std::int64_t{}) : call(std::uint64_t{});
}

}  // namespace

std::vector<double> Hdf5File::reals(Object array) const {
  const Values read = values(array);
  const std::endian order = read.type.big_endian ? std::endian::big : std::endian::little;
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(read.count));
  if (read.type.kind == Hdf5Datatype::Kind::real) {
    if (read.type.size == 4)
      convert<double, float>(read.bytes, order, result, read.count);
    else
      convert<double, double>(read.bytes, order, result, read.count);
  } else if (read.type.kind == Hdf5Datatype::Kind::integer) {
    with_integer(read.type.size, read.type.is_signed,
                 [&](auto kind) { convert<double, decltype(kind)>(read.bytes, order, result, read.count); });
  } else {
    fail(array, "an array of HDF5 holds texts where numbers are expected");
  }
  return result;
}

std::vector<std::int64_t> Hdf5File::as_integers(const Values& read, Object at) const {
  const std::endian order = read.type.big_endian ? std::endian::big : std::endian::little;
  std::vector<std::int64_t> result;
  result.reserve(static_cast<std::size_t>(read.count));
  if (read.type.kind == Hdf5Datatype::Kind::integer) {
    with_integer(read.type.size, read.type.is_signed, [&](auto kind) {
      convert<std::int64_t, decltype(kind)>(read.bytes, order, result, read.count);
    });
    return result;
  }
  if (read.type.kind == Hdf5Datatype::Kind::text)
    fail(at, "an array of HDF5 holds texts where numbers are expected");
  for (std::uint64_t i = 0; i < read.count; ++i) {
    const char* const place = read.bytes.data() + i * read.type.size;
    const double value = read.type.size == 4 ? double{load<float>(place, order)} : load<double>(place, order);
    constexpr double kMost = 9007199254740992;  // doubles beyond it do not represent all integers
    if (!(std::abs(value) <= kMost) || value != std::trunc(value))
      fail(at, "value " + std::to_string(i) + " of an array of HDF5 is no integer");
    result.push_back(static_cast<std::int64_t>(value));
  }
  return result;
}

std::vector<std::int64_t> Hdf5File::integers(Object array) const { return as_integers(values(array), array); }

std::vector<std::string> Hdf5File::as_texts(const Values& read) {
  std::vector<std::string> result;
  for (std::uint64_t i = 0; i < read.count; ++i) {
    std::string_view text = read.bytes.substr(static_cast<std::size_t>(i * read.type.size), read.type.size);
    text = text.substr(0, text.find('\0'));
    text = text.substr(0, text.find_last_not_of(' ') + 1);
    result.emplace_back(text);
  }
  return result;
}

std::vector<std::string> Hdf5File::texts(Object array) const {
  const Values read = values(array);
  if (read.type.kind != Hdf5Datatype::Kind::text)
    fail(array, "an array of HDF5 holds numbers where texts are expected");
  return as_texts(read);
}

}  // namespace holdfast::io
