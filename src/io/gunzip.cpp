// Decompresses by zlib: gzip files of one or several consecutive members (RFC 1952), and raw deflated bytes.
#include "io/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

namespace holdfast::io {
namespace {

class Inflater {
 public:
  /// `window_bits` as for zlib's inflateInit2, where they also select the format.
  Inflater(const Source& source, std::size_t begin, std::size_t end, int window_bits)
      : source_(source), used_(begin), begin_(begin), end_(end) {
    if (inflateInit2(&stream_, window_bits) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string run() {
    std::string unpacked(std::max<std::size_t>(4 * (end_ - begin_), 1 << 16), '\0');
    std::size_t size = 0;
    for (;;) {
      if (size == unpacked.size()) grow(unpacked);
      holdfast::io::step(source_.watch);
      const int status = step(unpacked, size);
      if (status == Z_STREAM_END) {
        if (!is_gzip(source_.bytes.substr(used_, end_ - used_))) break;
        inflateReset(&stream_);
      } else if (status != Z_OK && !(status == Z_BUF_ERROR && size == unpacked.size())) {
        fail(used_ == end_ ? "the compressed data ends too early; the file is truncated"
                           : "the compressed data is damaged");
      }
    }
    unpacked.resize(size);
    return unpacked;
  }
  /// The position after the last byte used.
  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  int step(std::string& unpacked, std::size_t& size) {
    constexpr std::size_t kMost = std::numeric_limits<uInt>::max(), kChunk = std::size_t{1} << 20;
    const std::size_t in = std::min(end_ - used_, kMost);
    const std::size_t out = std::min(unpacked.size() - size, kChunk);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(source_.bytes.data() + used_));
    stream_.avail_in = static_cast<uInt>(in);
    stream_.next_out = reinterpret_cast<Bytef*>(unpacked.data() + size);
    stream_.avail_out = static_cast<uInt>(out);
    const int status = inflate(&stream_, Z_NO_FLUSH);
    used_ += in - stream_.avail_in;
    size += out - stream_.avail_out;
    return status;
  }

  /// Meshes, as text or bytes, compress to a tenth or so; large data compressed to a 200th is a decompression
  /// bomb.
  void grow(std::string& unpacked) const {
    constexpr std::size_t kHarmless = std::size_t{64} << 20, kBestRatio = 200;
    if (unpacked.size() >= kHarmless && unpacked.size() / kBestRatio > end_ - begin_)
      fail("unpacks to more than " + std::to_string(unpacked.size()) + " bytes, " +
           std::to_string(kBestRatio) +
           " times its size; no mesh is packed as tightly. Unpack it first if it is one");
    try {
      unpacked.resize(2 * unpacked.size());
    } catch (const std::bad_alloc&) {
      fail("unpacks to more than " + std::to_string(unpacked.size()) + " bytes, which do not fit in memory");
    }
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(source_.path, "byte " + std::to_string(used_), reason);
  }

  Source source_;
  z_stream stream_{};
  std::size_t used_, begin_, end_;
};

}  // namespace

Unpacked gunzipped(const Source& source) {
  constexpr int kGzip = 16;  // expect the gzip header and trailer
  Inflater inflater(source, 0, source.bytes.size(), MAX_WBITS + kGzip);
  Unpacked unpacked{inflater.run()};
  const std::string_view behind = source.bytes.substr(inflater.used());
  if (behind.find_first_not_of('\0') != std::string_view::npos) unpacked.behind = behind.size();
  return unpacked;
}

std::string unpacked_zlib(const Source& source) {
  constexpr int kEither = 32;  // the header tells which of the two it is
  return Inflater(source, 0, source.bytes.size(), MAX_WBITS + kEither).run();
}

std::string inflated(const Source& source, std::size_t begin, std::size_t end) {
  return Inflater(source, begin, end, -MAX_WBITS).run();  // negative for no header and trailer
}

}  // namespace holdfast::io
