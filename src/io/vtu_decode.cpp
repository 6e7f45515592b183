// Decodes the arrays of VTK's XML files: base64, size headers, blocks compressed by zlib, LZ4 or LZMA.
#include "io/vtu_decode.h"

#include <zlib.h>

#include <array>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "io/base64.h"
#include "io/byte_reader.h"
#include "io/lz4_block.h"
#include "io/xz_block.h"

namespace holdfast::io {
namespace {

/// The bytes of an array, decoded on demand.
class Stream {
 public:
  Stream(const Source& source, bool base64, std::size_t position)
      : source_(source), base64_(base64), position_(position) {}

  /// The next bytes. The rest of a base64 group is kept for the next call, unless padding ends the group: a
  /// header may be encoded separately from its data.
  std::string take(std::uint64_t wanted) {
    if (wanted > available()) fail("the data ends too early; the file is truncated");
    const auto count = static_cast<std::size_t>(wanted);
    if (!base64_) {
      position_ += count;
      return std::string(source_.bytes.substr(position_ - count, count));
    }
    std::string bytes = std::exchange(pending_, {});
    bytes.reserve(count + 3);
    while (bytes.size() < count) decode_group(bytes);
    pending_ = bytes.substr(count);
    bytes.resize(count);
    return bytes;
  }

  /// An upper bound on the bytes that can still be taken.
  [[nodiscard]] std::uint64_t available() const {
    const std::uint64_t left = source_.bytes.size() - position_;
    return base64_ ? pending_.size() + left / 4 * 3 : left;
  }

  /// Drops the rest of the current group: what follows is encoded separately.
  void drop_pending() { pending_.clear(); }

  /// Called per block, which takes up to some milliseconds.
  void step() const { holdfast::io::step(source_.watch); }

  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(source_.path, "byte " + std::to_string(position_), reason);
  }

 private:
  void decode_group(std::string& bytes) {
    beat(source_.watch);
    static constexpr std::array<int, 256> kValues = base64_values();
    const std::string_view group = source_.bytes.substr(position_, 4);
    if (group.size() < 4) fail("the base64 data ends too early; the file is truncated");
    const std::size_t padding = group[3] != '=' ? 0 : group[2] != '=' ? 1 : 2;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int value = i + padding < 4 ? kValues[static_cast<unsigned char>(group[i])] : 0;
      if (value < 0) fail("a character that is not base64");
      bits = bits << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t i = 0; i + padding < 3; ++i)
      bytes.push_back(static_cast<char>(bits >> (16 - 8 * i) & 0xFF));
    position_ += 4;
  }

  Source source_;
  bool base64_;
  std::size_t position_;
  std::string pending_;
};

// The largest compression ratio of deflate (zlib, "Technical Details").
constexpr std::uint64_t kBestRatioOfDeflate = 1032;

/// Appends the data of a zlib block; returns whether it has `size` bytes.
bool append_deflated(std::string& bytes, std::string_view packed, std::size_t size) {
  const std::size_t start = bytes.size();
  bytes.resize(start + size);
  uLongf unpacked = size;
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data() + start), &unpacked,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  return status == Z_OK && unpacked == size;
}

struct WayToUnpack {
  std::uint64_t best_ratio;  ///< bounds the memory
  bool (*append)(std::string& bytes, std::string_view packed, std::size_t size);
};

WayToUnpack way_of(VtuCompressor compressor) {
  switch (compressor) {
    case VtuCompressor::lz4:
      return {kBestRatioOfLz4, append_lz4_block};
    case VtuCompressor::lzma:
      return {kBestRatioOfXz, append_xz};
    default:
      return {kBestRatioOfDeflate, append_deflated};
  }
}

class ArrayDecoder {
 public:
  ArrayDecoder(const Source& source, const VtuEncoding& encoding, bool base64, std::size_t position)
      : encoding_(encoding), stream_(source, base64, position) {}

  std::uint64_t size() {
    if (encoding_.compressor == VtuCompressor::none) return size_word();
    const std::uint64_t blocks = size_word();
    if (blocks == 0) return 0;
    const std::uint64_t block = size_word(), last = size_word();
    if (block > 0 && blocks > std::numeric_limits<std::uint64_t>::max() / block)
      stream_.fail("blocks of impossible size are announced; the file is damaged");
    return last == 0 ? blocks * block : (blocks - 1) * block + last;
  }

  std::string decode() {
    if (encoding_.compressor != VtuCompressor::none) return decode_blocks();
    const std::uint64_t size = size_word();
    return stream_.take(size);
  }

 private:
  std::uint64_t size_word() {
    if (encoding_.wide_header) return load<std::uint64_t>(stream_.take(8).data(), encoding_.order);
    return load<std::uint32_t>(stream_.take(4).data(), encoding_.order);
  }

  std::string decode_blocks() {
    const std::uint64_t blocks = size_word();
    if (blocks == 0) return {};
    const std::uint64_t block = size_word(), last = size_word();
    if (blocks > stream_.available() / (encoding_.wide_header ? 8 : 4))
      stream_.fail(std::to_string(blocks) + " blocks are announced; the file is truncated or damaged");
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(blocks));
    for (std::uint64_t& size : sizes) size = size_word();
    stream_.drop_pending();
    std::string result;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      stream_.step();
      const bool partial = i + 1 == sizes.size() && last != 0;
      unpack_block(result, sizes[i], partial ? last : block);
    }
    return result;
  }

  void unpack_block(std::string& result, std::uint64_t packed_size, std::uint64_t size) {
    const auto [best_ratio, append] = way_of(encoding_.compressor);
    const std::string packed = stream_.take(packed_size);
    if (size / best_ratio > packed_size) stream_.fail("a block of impossible size; the file is damaged");
    if (size > result.max_size() - result.size()) throw std::bad_alloc();  // with sizes of 32 bits
    if (!append(result, packed, static_cast<std::size_t>(size)))
      stream_.fail("a block that cannot be decompressed; the file is damaged");
  }

  const VtuEncoding& encoding_;
  Stream stream_;
};

}  // namespace

std::uint64_t announced_size(const Source& source, const VtuEncoding& encoding, bool base64,
                             std::size_t position) {
  return ArrayDecoder(source, encoding, base64, position).size();
}

std::string decode_vtu_array(const Source& source, const VtuEncoding& encoding, bool base64,
                             std::size_t position) {
  return ArrayDecoder(source, encoding, base64, position).decode();
}

}  // namespace holdfast::io
