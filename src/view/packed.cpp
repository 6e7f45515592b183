#include "view/packed.h"

#include <algorithm>
#include <bit>
#include <new>

namespace holdfast::view {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;

}  // namespace

Packed::Packed(io::Watch& watch) : watch_(watch) {
  // Level 1: a quarter of the time of the default for 5 % more bytes.
  if (deflateInit(&stream_, 1) != Z_OK) throw std::bad_alloc();
}

Packed::~Packed() { deflateEnd(&stream_); }

void Packed::feed(std::string_view text, int flush) {
  std::string room(kPiece, '\0');
  do {
    const std::string_view piece = text.substr(0, kPiece);
    text.remove_prefix(piece.size());
    const int how = text.empty() ? flush : Z_NO_FLUSH;
    // zlib reads from here and does not write; its interface is older than const.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    stream_.avail_in = static_cast<uInt>(piece.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(room.data());
      stream_.avail_out = static_cast<uInt>(room.size());
      deflate(&stream_, how);
      out_.append(room.data(), room.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
    watch_.step();
  } while (!text.empty());
}

void Packed::doubles(std::span<const double> values) {
  std::string plane(values.size(), '\0');
  for (unsigned k = 0; k < 8; ++k) {
    std::transform(values.begin(), values.end(), plane.begin(), [&](double value) {
      return static_cast<char>(std::bit_cast<std::uint64_t>(value) >> (8 * k) & 0xFF);
    });
    bytes(plane);
  }
}

void Packed::words(std::span<const std::uint32_t> values, std::size_t step) {
  std::string plane(values.size(), '\0');
  for (unsigned k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::uint32_t before = step > 0 && i >= step ? values[i - step] : 0;
      plane[i] = static_cast<char>((values[i] - before) >> (8 * k) & 0xFF);
    }
    bytes(plane);
  }
}

std::string Packed::finish() {
  feed({}, Z_FINISH);
  return std::move(out_);
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < here ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= here ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace holdfast::view
