// Unpacks .xz streams: blocks of LZMA2, whose chunks LZMA packs by a range coder.
#include "io/xz_block.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

namespace holdfast::io {
namespace {

using Probability = std::uint16_t;
constexpr Probability kEven = 1024;  // of 2048

/// Bits of a chunk. Behind its end they are those of zeros, and `is_whole` is false.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::string_view bytes) : bytes_(bytes) {
    sound_ = next() == 0;
    for (int i = 0; i < 4; ++i) code_ = code_ << 8 | next();
  }

  /// Whether all bytes were read, and none behind them.
  [[nodiscard]] bool is_whole() const { return sound_ && at_ == bytes_.size() && code_ == 0; }
  [[nodiscard]] bool is_beyond() const { return at_ > bytes_.size(); }

  std::uint32_t bit(Probability& probability) {
    const std::uint32_t bound = (range_ >> 11) * probability;
    const bool one = code_ >= bound;
    if (one) {
      range_ -= bound;
      code_ -= bound;
      probability = static_cast<Probability>(probability - (probability >> 5));
    } else {
      range_ = bound;
      probability = static_cast<Probability>(probability + ((2048 - probability) >> 5));
    }
    normalise();
    return one ? 1 : 0;
  }

  std::uint32_t direct_bits(unsigned count) {
    std::uint32_t value = 0;
    for (; count > 0; --count) {
      range_ >>= 1;
      const bool one = code_ >= range_;
      if (one) code_ -= range_;
      normalise();
      value = value << 1 | (one ? 1 : 0);
    }
    return value;
  }

  /// The highest bit first; `tree` has 2^count probabilities.
  std::uint32_t tree(Probability* tree, unsigned count) {
    std::uint32_t symbol = 1;
    for (unsigned i = 0; i < count; ++i) symbol = symbol << 1 | bit(tree[symbol]);
    return symbol - (1u << count);
  }
  /// The lowest bit first.
  std::uint32_t reverse_tree(Probability* tree, unsigned count) {
    std::uint32_t symbol = 1, value = 0;
    for (unsigned i = 0; i < count; ++i) {
      const std::uint32_t one = bit(tree[symbol]);
      symbol = symbol << 1 | one;
      value |= one << i;
    }
    return value;
  }

 private:
  std::uint32_t next() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0;
  }
  void normalise() {
    if (range_ >= 1u << 24) return;
    range_ <<= 8;
    code_ = code_ << 8 | next();
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF, code_ = 0;
  bool sound_ = false;
};

struct LengthTree {
  Probability choice = kEven, choice_2 = kEven;
  std::array<std::array<Probability, 8>, 16> low, mid;
  std::array<Probability, 256> high;

  LengthTree() {
    for (auto* of : {&low, &mid})
      for (auto& tree : *of) tree.fill(kEven);
    high.fill(kEven);
  }
  /// Less the least length, 2.
  std::uint32_t decode(RangeDecoder& from, std::size_t place) {
    if (from.bit(choice) == 0) return from.tree(low[place].data(), 3);
    if (from.bit(choice_2) == 0) return 8 + from.tree(mid[place].data(), 3);
    return 16 + from.tree(high.data(), 8);
  }
};

/// What LZMA has learnt so far: forgotten where a chunk says so.
struct LzmaState {
  unsigned context = 3, low_places = 0, places = 2;  // lc, lp, pb
  std::uint32_t state = 0;
  std::array<std::uint32_t, 4> distances{};  // less 1, the last first
  std::vector<Probability> literals;
  std::array<std::array<Probability, 16>, 12> is_match, is_long;
  std::array<Probability, 12> is_repeat, is_not_last, is_not_second, is_not_third;
  std::array<std::array<Probability, 64>, 4> slots;
  std::array<Probability, 115> near;
  std::array<Probability, 16> align;
  LengthTree length, repeated_length;

  LzmaState() { forget(); }
  [[nodiscard]] bool set_properties(unsigned char properties) {
    if (properties >= 9 * 5 * 5) return false;
    context = properties % 9;
    low_places = properties / 9 % 5;
    places = properties / 45;
    return context + low_places <= 4;
  }
  void forget() {
    state = 0;
    distances = {};
    literals.assign(std::size_t{0x300} << (context + low_places), kEven);
    for (auto* of : {&is_match, &is_long})
      for (auto& row : *of) row.fill(kEven);
    for (auto* of : {&is_repeat, &is_not_last, &is_not_second, &is_not_third}) of->fill(kEven);
    for (auto& row : slots) row.fill(kEven);
    near.fill(kEven);
    align.fill(kEven);
    length = repeated_length = {};
  }
};

/// Appends a chunk to what was unpacked since `begin`.
class Chunk {
 public:
  Chunk(std::string& bytes, std::size_t begin, LzmaState& lzma, std::string_view packed)
      : bytes_(bytes), begin_(begin), lzma_(lzma), from_(packed) {}

  [[nodiscard]] bool unpack(std::size_t size) {
    const std::size_t end = bytes_.size() + size;
    while (bytes_.size() < end) {
      const std::size_t place = position() & ((std::size_t{1} << lzma_.places) - 1);
      if (from_.bit(lzma_.is_match[lzma_.state][place]) == 0) {
        literal();
      } else {
        const std::uint32_t count =
            from_.bit(lzma_.is_repeat[lzma_.state]) == 0 ? match(place) : repeat(place);
        if (count > end - bytes_.size() || !copy(count)) return false;
      }
      if (from_.is_beyond()) return false;
    }
    return from_.is_whole();
  }

 private:
  [[nodiscard]] std::size_t position() const { return bytes_.size() - begin_; }
  [[nodiscard]] std::uint32_t before(std::size_t distance) const {
    return distance < position() ? static_cast<unsigned char>(bytes_[bytes_.size() - 1 - distance]) : 0;
  }

  void literal() {
    const std::size_t low = position() & ((std::size_t{1} << lzma_.low_places) - 1);
    const std::size_t row = (low << lzma_.context) + (before(0) >> (8 - lzma_.context));
    Probability* const tree = lzma_.literals.data() + 0x300 * row;
    std::uint32_t symbol = 1;
    if (lzma_.state >= 7) {
      // It differs from what the last match would have gone on with.
      std::uint32_t other = before(lzma_.distances[0]);
      while (symbol < 0x100) {
        const std::uint32_t bit = other >> 7 & 1;
        other <<= 1;
        const std::uint32_t found = from_.bit(tree[((1 + bit) << 8) + symbol]);
        symbol = symbol << 1 | found;
        if (found != bit) break;
      }
    }
    while (symbol < 0x100) symbol = symbol << 1 | from_.bit(tree[symbol]);
    bytes_.push_back(static_cast<char>(symbol & 0xFF));
    lzma_.state = lzma_.state < 4 ? 0 : lzma_.state - (lzma_.state < 10 ? 3 : 6);
  }

  /// How many bytes to copy, as of `repeat`; the distance is the first of `distances`.
  std::uint32_t match(std::size_t place) {
    auto& d = lzma_.distances;
    const std::uint32_t count = lzma_.length.decode(from_, place);
    lzma_.state = lzma_.state < 7 ? 7 : 10;
    d = {distance(count), d[0], d[1], d[2]};
    return count + 2;
  }

  std::uint32_t repeat(std::size_t place) {
    auto& d = lzma_.distances;
    std::uint32_t& state = lzma_.state;
    if (from_.bit(lzma_.is_not_last[state]) == 0) {
      if (from_.bit(lzma_.is_long[state][place]) == 0) {
        state = state < 7 ? 9 : 11;
        return 1;
      }
    } else {
      const std::size_t which = from_.bit(lzma_.is_not_second[state]) == 0  ? 1
                                : from_.bit(lzma_.is_not_third[state]) == 0 ? 2
                                                                            : 3;
      std::rotate(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(which),
                  d.begin() + static_cast<std::ptrdiff_t>(which) + 1);
    }
    const std::uint32_t count = lzma_.repeated_length.decode(from_, place);
    state = state < 7 ? 8 : 11;
    return count + 2;
  }

  std::uint32_t distance(std::uint32_t count) {
    const std::uint32_t slot = from_.tree(lzma_.slots[std::min(count, 3u)].data(), 6);
    if (slot < 4) return slot;
    const unsigned bits = (slot >> 1) - 1;
    const std::uint32_t first = (2 | (slot & 1)) << bits;
    if (slot < 14) return first + from_.reverse_tree(lzma_.near.data() + first - slot, bits);
    const std::uint32_t high = from_.direct_bits(bits - 4);
    return first + (high << 4) + from_.reverse_tree(lzma_.align.data(), 4);
  }

  bool copy(std::uint32_t count) {
    if (lzma_.distances[0] >= position()) return false;
    for (; count > 0; --count) bytes_.push_back(bytes_[bytes_.size() - 1 - lzma_.distances[0]]);
    return true;
  }

  std::string& bytes_;
  std::size_t begin_;
  LzmaState& lzma_;
  RangeDecoder from_;
};

class XzReader {
 public:
  XzReader(std::string& bytes, std::string_view stream, std::size_t size)
      : bytes_(bytes), stream_(stream), end_(bytes.size() + size) {}

  [[nodiscard]] bool read() {
    static constexpr std::string_view kMagic(
        "\xFD"
        "7zXZ\0\0",
        7);
    if (!stream_.starts_with(kMagic) || stream_.size() < 12) return false;
    const unsigned check = byte(7);
    if (check > 15) return false;
    // By the type of the sum, none being the first.
    static constexpr std::array<std::size_t, 6> kSizes{0, 4, 8, 16, 32, 64};
    const std::size_t sum = kSizes[(check + 2) / 3];
    at_ = 12;
    while (at_ < stream_.size() && byte(at_) != 0) {
      const std::size_t begin = bytes_.size();
      if (!read_block_header() || !read_chunks()) return false;
      at_ = (at_ + 3) / 4 * 4;
      if (sum > stream_.size() || at_ > stream_.size() - sum) return false;
      if (check == 1 && number(at_) != crc32(0, reinterpret_cast<const Bytef*>(bytes_.data() + begin),
                                             static_cast<uInt>(bytes_.size() - begin)))
        return false;
      at_ += sum;
    }
    return bytes_.size() == end_ && at_ < stream_.size();
  }

 private:
  [[nodiscard]] unsigned byte(std::size_t at) const { return static_cast<unsigned char>(stream_[at]); }
  [[nodiscard]] std::uint32_t number(std::size_t at) const {
    return byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24;
  }
  [[nodiscard]] bool has(std::size_t count) const { return count <= stream_.size() - at_; }

  /// One filter is allowed, LZMA2. How large the dictionary is does not matter: all bytes are at hand.
  bool read_block_header() {
    const std::size_t size = (byte(at_) + 1) * std::size_t{4};
    if (size < 8 || !has(size)) return false;
    const unsigned flags = byte(at_ + 1);
    std::size_t at = at_ + 2;
    for (const unsigned given : {0x40u, 0x80u}) {
      if ((flags & given) == 0) continue;
      while (at < at_ + size && (byte(at) & 0x80) != 0) ++at;
      ++at;
    }
    if ((flags & 3) != 0 || at + 3 > at_ + size || byte(at) != 0x21 || byte(at + 1) != 1) return false;
    at_ += size;
    return true;
  }

  bool read_chunks() {
    bool knows_properties = false, knows_dictionary = false;
    while (has(1)) {
      const unsigned control = byte(at_++);
      if (control == 0) return true;
      const bool is_packed = control >= 0x80;
      if (!is_packed && control > 2) return false;
      const unsigned reset = is_packed ? control >> 5 & 3 : control == 1 ? 3 : 0;
      if (!has(is_packed ? 5 : 2)) return false;
      const std::size_t high = is_packed ? control & 0x1F : 0;
      const std::size_t size = (high << 16 | byte(at_) << 8 | byte(at_ + 1)) + 1;
      const std::size_t packed = is_packed ? (byte(at_ + 2) << 8 | byte(at_ + 3)) + std::size_t{1} : size;
      at_ += is_packed ? 4 : 2;
      if (size > end_ - bytes_.size()) return false;
      if (reset == 3) {
        begin_ = bytes_.size();
        knows_dictionary = true;
      }
      if (!knows_dictionary) return false;
      if (is_packed && reset >= 2) {
        if (!lzma_.set_properties(static_cast<unsigned char>(byte(at_++)))) return false;
        knows_properties = true;
      }
      if (is_packed && reset >= 1) lzma_.forget();
      if (!has(packed) || (is_packed && !knows_properties)) return false;
      const std::string_view chunk = stream_.substr(at_, packed);
      if (!is_packed)
        bytes_ += chunk;
      else if (!Chunk(bytes_, begin_, lzma_, chunk).unpack(size))
        return false;
      at_ += packed;
    }
    return false;
  }

  std::string& bytes_;
  std::string_view stream_;
  std::size_t end_, at_ = 0, begin_ = 0;
  LzmaState lzma_;
};

}  // namespace

bool append_xz(std::string& bytes, std::string_view stream, std::size_t size) {
  return XzReader(bytes, stream, size).read();
}

}  // namespace holdfast::io
