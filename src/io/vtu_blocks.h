// Compressed arrays of VTK's XML files: zlib blocks behind a header of 64-bit sizes
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "Compressed Data").
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/atomic_writer.h"
#include "mesh/parallel.h"

namespace holdfast::io {

/// Large enough that block headers cost nothing, and small enough for readers that fetch single blocks.
inline constexpr std::size_t kVtuBlock = std::size_t{1} << 18;

[[nodiscard]] constexpr std::uint64_t vtu_blocks_of(std::uint64_t bytes) {
  return (bytes + kVtuBlock - 1) / kVtuBlock;
}
/// Appends a number in the form of the headers of arrays.
void append_vtu_size(std::string& bytes, std::uint64_t size);
/// The blocks of some bytes, compressed.
[[nodiscard]] std::vector<std::string> deflated_blocks(std::string_view bytes, const Threads& threads);
/// The header before the blocks of an array of this many bytes.
[[nodiscard]] std::string vtu_block_header(std::uint64_t bytes, const std::vector<std::uint64_t>& sizes);

/// The appended section of a file that is never in memory as a whole: offsets of arrays and their sizes are
/// patched in when they are known.
class VtuAppended {
 public:
  /// Compresses if asked to and if `out` can be patched. Both must outlive the object.
  VtuAppended(AtomicWriter& out, bool compress, const Threads& threads)
      : out_(out), compresses_(compress && out.can_be_patched()), threads_(threads) {}

  [[nodiscard]] bool compresses() const { return compresses_; }
  /// Writes the value of an attribute in the header: the offset of the next array, which has this many bytes.
  void write_offset(std::uint64_t bytes);
  /// To be called after the header: the section begins here.
  void begin();
  /// Writes the bytes of the arrays, one array after the other.
  template <typename T>
  void put(T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = buffer_.size();
    buffer_.resize(at + sizeof value);
    std::memcpy(buffer_.data() + at, &value, sizeof value);
    missing_ -= sizeof value;
    if (buffer_.size() >= kBuffer || missing_ == 0) write_buffer();
  }

 private:
  // A multiple of a block, so that only the last block of an array is shorter.
  static constexpr std::size_t kBuffer = 16 * kVtuBlock;
  struct Array {
    std::uint64_t bytes, offset_at;  ///< `offset_at`: position of its offset in the file
  };

  void begin_array();
  void write_buffer();
  void end_array();

  AtomicWriter& out_;
  const bool compresses_;
  const Threads threads_;
  std::vector<Array> arrays_;
  std::size_t array_ = 0;  // the current one
  std::uint64_t next_offset_ = 0, begin_ = 0, header_at_ = 0, missing_ = 0;
  std::vector<std::uint64_t> sizes_;  // of the current array's blocks
  std::string buffer_;
};

}  // namespace holdfast::io
