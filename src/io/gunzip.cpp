// Files compressed by gzip: one member or several, behind one another (RFC 1952).
#include "io/gunzip.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

namespace holdfast::io {
namespace {

class Inflater {
 public:
  explicit Inflater(const Source& source) : source_(source) {
    constexpr int kGzip = 16;  // zlib: read the gzip header and trailer
    if (inflateInit2(&stream_, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string run() {
    std::string unpacked(std::max<std::size_t>(4 * source_.bytes.size(), 1 << 16), '\0');
    std::size_t size = 0;
    for (;;) {
      if (size == unpacked.size()) grow(unpacked);
      holdfast::io::step(source_.watch);
      const int status = step(unpacked, size);
      if (status == Z_STREAM_END) {
        // What follows the last member, as zeros that pad a tape, is not data.
        if (!is_gzip(source_.bytes.substr(used_))) break;
        inflateReset(&stream_);
      } else if (status != Z_OK && !(status == Z_BUF_ERROR && size == unpacked.size())) {
        fail(used_ == source_.bytes.size() ? "the compressed data ends too early; the file is truncated"
                                           : "the compressed data is damaged");
      }
    }
    unpacked.resize(size);
    return unpacked;
  }

 private:
  int step(std::string& unpacked, std::size_t& size) {
    constexpr std::size_t kMost = std::numeric_limits<uInt>::max(), kChunk = std::size_t{1} << 20;
    const std::size_t in = std::min(source_.bytes.size() - used_, kMost);
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

  /// Meshes, as text or bytes, are packed to a tenth or so; what is packed to a 200th and large fills the
  /// memory with nothing.
  void grow(std::string& unpacked) const {
    constexpr std::size_t kHarmless = std::size_t{64} << 20, kBestRatio = 200;
    if (unpacked.size() >= kHarmless && unpacked.size() / kBestRatio > source_.bytes.size())
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
  std::size_t used_ = 0;
};

}  // namespace

std::string gunzipped(const Source& source) { return Inflater(source).run(); }

}  // namespace holdfast::io
