#include "io/xz_block.h"

#ifdef HOLDFAST_LZMA
#include <lzma.h>
#endif

namespace holdfast::io {

#ifdef HOLDFAST_LZMA

bool has_xz() { return true; }

bool append_xz(std::string& bytes, std::string_view stream, std::size_t size) {
  // The highest level of xz needs half of this; a damaged stream may request any amount.
  std::uint64_t most_memory = std::uint64_t{128} << 20;
  const std::size_t before = bytes.size();
  bytes.resize(before + size);
  std::size_t read = 0, written = 0;
  const lzma_ret end = lzma_stream_buffer_decode(
      &most_memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(stream.data()), &read, stream.size(),
      reinterpret_cast<std::uint8_t*>(bytes.data() + before), &written, size);
  return end == LZMA_OK && written == size;
}

#else

bool has_xz() { return false; }

bool append_xz(std::string&, std::string_view, std::size_t) { return false; }

#endif

}  // namespace holdfast::io
