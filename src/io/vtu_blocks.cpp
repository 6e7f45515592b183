#include "io/vtu_blocks.h"

#include <zlib.h>

#include <cstring>
#include <utility>

namespace holdfast::io {
namespace {

std::string deflated(std::string_view block) {
  std::string room(compressBound(block.size()), '\0');
  uLongf size = room.size();
  // Level 1 takes half the time of the default for 5 % more bytes. It cannot fail, because the room suffices.
  compress2(reinterpret_cast<Bytef*>(room.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
            block.size(), 1);
  return room.substr(0, size);
}

// Of constant length, with no zeros or blanks in the value, because meshio searches for its text.
std::string in_quotes_padded(std::uint64_t offset) {
  constexpr std::size_t kLongest = 20;  // digits
  const std::string digits = std::to_string(offset);
  return '"' + digits + '"' + std::string(kLongest - digits.size(), ' ');
}

}  // namespace

void append_vtu_size(std::string& bytes, std::uint64_t size) {
  char raw[sizeof size];
  std::memcpy(raw, &size, sizeof size);
  bytes.append(raw, sizeof raw);
}

std::vector<std::string> deflated_blocks(std::string_view bytes, const Threads& threads) {
  std::vector<std::string> blocks(vtu_blocks_of(bytes.size()));
  parallel(threads, blocks.size(),
           [&](std::size_t k) { blocks[k] = deflated(bytes.substr(k * kVtuBlock, kVtuBlock)); });
  return blocks;
}

std::string vtu_block_header(std::uint64_t bytes, const std::vector<std::uint64_t>& sizes) {
  std::string header;
  append_vtu_size(header, sizes.size());
  append_vtu_size(header, kVtuBlock);
  append_vtu_size(header, bytes % kVtuBlock);
  for (const std::uint64_t size : sizes) append_vtu_size(header, size);
  return header;
}

void VtuAppended::write_offset(std::uint64_t bytes) {
  arrays_.push_back({bytes, out_.position()});
  if (compresses_) {
    out_ << in_quotes_padded(0);
  } else {
    out_ << '"' << next_offset_ << '"';
    next_offset_ += sizeof(std::uint64_t) + bytes;
  }
}

void VtuAppended::begin() {
  begin_ = out_.position();
  begin_array();
}

// Also begins the following arrays while they are empty.
void VtuAppended::begin_array() {
  for (; array_ < arrays_.size(); ++array_) {
    const Array& array = arrays_[array_];
    missing_ = array.bytes;
    header_at_ = out_.position();
    if (compresses_) {
      out_.patch(array.offset_at, in_quotes_padded(header_at_ - begin_));
      out_ << vtu_block_header(array.bytes, std::vector<std::uint64_t>(vtu_blocks_of(array.bytes)));
    } else {
      std::string size;
      append_vtu_size(size, array.bytes);
      out_ << size;
    }
    if (missing_ > 0) return;
  }
}

void VtuAppended::write_buffer() {
  if (compresses_) {
    for (const std::string& block : deflated_blocks(buffer_, threads_)) {
      sizes_.push_back(block.size());
      out_ << block;
    }
  } else {
    out_ << buffer_;
  }
  buffer_.clear();
  if (missing_ == 0) end_array();
}

void VtuAppended::end_array() {
  if (compresses_) out_.patch(header_at_, vtu_block_header(arrays_[array_].bytes, std::exchange(sizes_, {})));
  ++array_;
  begin_array();
}

}  // namespace holdfast::io
