#include "io/lz4_block.h"

namespace holdfast::io {
namespace {

/// A block is a series of sequences: a token with two lengths of four bits, literals, and the distance back
/// to a match in two bytes. The last sequence ends after its literals.
class Lz4Block {
 public:
  explicit Lz4Block(std::string_view block) : block_(block) {}

  /// Appends the block's data. Returns whether the block is complete and no match begins before `bytes`.
  bool append_to(std::string& bytes, std::size_t size) {
    const std::size_t begin = bytes.size(), end = begin + size;
    while (at_ < block_.size()) {
      const std::size_t token = byte();
      std::size_t literals = token >> 4;
      if (!extend(literals) || literals > block_.size() - at_ || literals > end - bytes.size()) return false;
      bytes.append(block_.substr(at_, literals));
      at_ += literals;
      if (at_ == block_.size()) break;
      if (block_.size() - at_ < 2) return false;
      const std::size_t low = byte(), back = low | byte() << 8;
      std::size_t match = token & kLongest;
      if (!extend(match) || back == 0 || back > bytes.size() - begin) return false;
      match += kShortestMatch;
      if (match > end - bytes.size()) return false;
      // Byte by byte, because a match may overlap itself.
      for (std::size_t from = bytes.size() - back; match > 0; --match) bytes.push_back(bytes[from++]);
    }
    return bytes.size() == end;
  }

 private:
  static constexpr std::size_t kLongest = 15, kShortestMatch = 4, kMore = 255;

  std::size_t byte() { return static_cast<unsigned char>(block_[at_++]); }

  /// A length of 15 is extended by the following bytes, up to one that is not 255.
  bool extend(std::size_t& length) {
    if (length < kLongest) return true;
    std::size_t more = kMore;
    while (more == kMore) {
      if (at_ == block_.size()) return false;
      more = byte();
      length += more;
    }
    return true;
  }

  std::string_view block_;
  std::size_t at_ = 0;
};

}  // namespace

bool append_lz4_block(std::string& bytes, std::string_view block, std::size_t size) {
  return Lz4Block(block).append_to(bytes, size);
}

}  // namespace holdfast::io
