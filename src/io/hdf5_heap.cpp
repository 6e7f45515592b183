// Objects in fractal heaps of HDF5, listed by a B-tree of version 2: links of large groups, and attributes of
// objects with many (HDF5 file format specification, III.A.2, III.G).
#include <bit>

#include "io/hdf5_number.h"

namespace holdfast::io {
namespace {

/// The number of bytes that a number up to `most` takes.
std::size_t width_of(std::uint64_t most) { return (static_cast<std::size_t>(std::bit_width(most)) + 7) / 8; }

}  // namespace

void Hdf5File::each_in_heap(std::uint64_t heap, std::uint64_t tree, std::size_t id_in_record,
                            const std::function<void(std::uint64_t, std::uint64_t)>& visit) const {
  require_signature(heap, "FRHP");
  const std::size_t id_size = number<std::uint16_t>(heap + 5);
  if (number<std::uint16_t>(heap + 7) != 0) fail(heap + 7, "a heap of HDF5 that is packed is not read");
  const std::size_t row_width = number<std::uint16_t>(heap + 110);
  const auto first_block = number<std::uint64_t>(heap + 112),
             largest_direct = number<std::uint64_t>(heap + 120);
  const std::size_t bits = number<std::uint16_t>(heap + 128), offset_size = (bits + 7) / 8;
  const auto root = number<std::uint64_t>(heap + 132);
  const std::size_t rows = number<std::uint16_t>(heap + 140);
  const auto largest_object = std::uint64_t{number<std::uint32_t>(heap + 10)};
  const std::size_t length_size = width_of(std::min(largest_direct, largest_object));
  if (offset_size == 0 || offset_size > 8 || length_size == 0 || row_width == 0 || first_block == 0 ||
      1 + offset_size + length_size > id_size)
    fail(heap, "a heap of HDF5 is damaged");

  // Offsets count through all direct blocks: two rows of blocks of the first size, then rows of twice the
  // previous size.
  const auto address_of = [&](std::uint64_t offset, std::uint64_t id_at) {
    if (rows == 0) return root + offset;
    std::uint64_t block = root + 13 + offset_size, size = first_block, begin = 0;
    for (std::size_t row = 0; row < rows && size <= largest_direct; ++row) {
      if (row > 1) size *= 2;
      if (offset < begin + size * row_width) {
        const std::uint64_t column = (offset - begin) / size;
        return number<std::uint64_t>(block + 8 * column) + (offset - begin - column * size);
      }
      begin += size * row_width;
      block += 8 * row_width;
    }
    fail(id_at, "a heap of HDF5 of more than one level is not read; h5repack or h5copy writes the file anew");
  };
  const auto add = [&](std::uint64_t record) {
    const std::uint64_t id = record + id_in_record;
    if ((number<std::uint8_t>(id) & 0x30) != 0)
      fail(id, "a link or attribute of HDF5 outside its heap is not read");
    const std::uint64_t at = address_of(number(id + 1, offset_size), id);
    visit(at, number(id + 1 + offset_size, length_size));
  };

  require_signature(tree, "BTHD");
  const std::size_t node_size = number<std::uint32_t>(tree + 6),
                    record_size = number<std::uint16_t>(tree + 10), depth = number<std::uint16_t>(tree + 12);
  constexpr std::size_t kHead = 6, kTail = 4, kDeepest = 16;
  if (record_size < id_in_record + id_size || node_size < kHead + kTail + record_size || depth > kDeepest)
    fail(tree, "a tree of HDF5 is damaged");
  // The widths of the record counts that inner nodes of each level store for their children.
  const std::uint64_t in_leaf = (node_size - kHead - kTail) / record_size;
  const std::size_t count_width = width_of(in_leaf);
  std::vector<std::size_t> total_width{0};
  std::uint64_t total = in_leaf;
  for (std::size_t level = 1; level <= depth; ++level) {
    const std::uint64_t pointer = 8 + count_width + total_width.back();
    const std::uint64_t in_node =
        (node_size - kHead - kTail - std::min<std::uint64_t>(pointer, node_size - 10)) /
        (record_size + pointer);
    total = (in_node + 1) * total + in_node;
    total_width.push_back(width_of(total));
  }
  struct Node {
    std::uint64_t at, records;
    std::size_t level;
  };
  std::vector<Node> nodes;
  std::size_t blocks = 0;
  const auto top = number<std::uint64_t>(tree + 16);
  if (top != kNoAddress) nodes.push_back({top, number<std::uint16_t>(tree + 24), depth});
  while (!nodes.empty()) {
    const Node node = nodes.back();
    nodes.pop_back();
    count_block(blocks, node.at);
    require_signature(node.at, node.level == 0 ? "BTLF" : "BTIN");
    const std::uint64_t records = node.at + kHead, children = records + node.records * record_size;
    static_cast<void>(bytes(records, node.records * record_size));
    for (std::uint64_t i = 0; i < node.records; ++i) {
      count_block(blocks, node.at);
      add(records + i * record_size);
    }
    if (node.level == 0) continue;
    const std::uint64_t pointer = 8 + count_width + (node.level > 1 ? total_width[node.level - 1] : 0);
    for (std::uint64_t i = 0; i <= node.records; ++i) {
      const std::uint64_t child = children + i * pointer;
      nodes.push_back({number<std::uint64_t>(child), number(child + 8, count_width), node.level - 1});
    }
  }
}

}  // namespace holdfast::io
