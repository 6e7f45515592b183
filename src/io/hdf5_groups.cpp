// Groups of HDF5: symbol tables in B-trees of version 1, links in object headers, and links in fractal heaps
// that a B-tree of version 2 lists (HDF5 file format specification, III.A, III.D, III.G, IV.A.2.g).
#include <bit>

#include "io/hdf5_number.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint16_t kLinkInfo = 0x0002, kLink = 0x0006, kSymbolTable = 0x0011;

/// Bytes that a number up to `most` takes.
std::size_t width_of(std::uint64_t most) { return (static_cast<std::size_t>(std::bit_width(most)) + 7) / 8; }

}  // namespace

std::map<std::string, Hdf5File::Object> Hdf5File::links(Object group) const {
  std::map<std::string, Object> found;
  for (const Hdf5Message& message : messages(group)) {
    if (message.type == kSymbolTable) {
      links_of_table(number<std::uint64_t>(message.at), number<std::uint64_t>(message.at + 8), found);
    } else if (message.type == kLink) {
      link_of_message(message.at, message.size, found);
    } else if (message.type == kLinkInfo) {
      const std::uint64_t at = message.at + ((number<std::uint8_t>(message.at + 1) & 1) != 0 ? 10 : 2);
      const auto heap = number<std::uint64_t>(at), tree = number<std::uint64_t>(at + 8);
      if (heap != kNoAddress) links_of_heap(heap, tree, found);
    }
  }
  return found;
}

std::optional<Hdf5File::Object> Hdf5File::find(Object from, std::string_view path) const {
  while (!path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const std::string name(path.substr(0, slash));
    path.remove_prefix(std::min(slash + 1, path.size()));
    if (name.empty()) continue;
    const auto all = links(from);
    const auto found = all.find(name);
    if (found == all.end()) return std::nullopt;
    from = found->second;
  }
  return from;
}

void Hdf5File::links_of_table(std::uint64_t tree, std::uint64_t heap,
                              std::map<std::string, Object>& found) const {
  require_signature(heap, "HEAP");
  const std::string_view names = bytes(number<std::uint64_t>(heap + 24), number<std::uint64_t>(heap + 8));
  std::vector<std::uint64_t> nodes{tree};
  std::size_t blocks = 0;
  while (!nodes.empty()) {
    const std::uint64_t at = nodes.back();
    nodes.pop_back();
    count_block(blocks, at);
    if (bytes(at, 4) == "TREE") {
      const std::size_t children = number<std::uint16_t>(at + 6);
      // Behind the head, keys and children take turns; the last child comes first from the back.
      for (std::size_t i = children; i-- > 0;) nodes.push_back(number<std::uint64_t>(at + 32 + 16 * i));
      continue;
    }
    require_signature(at, "SNOD");
    const std::size_t entries = number<std::uint16_t>(at + 6);
    for (std::size_t i = 0; i < entries; ++i) {
      count_block(blocks, at);
      const std::uint64_t entry = at + 8 + 40 * i, name = number<std::uint64_t>(entry);
      const std::size_t end = name < names.size() ? names.find('\0', name) : std::string_view::npos;
      if (end == std::string_view::npos) fail(entry, "a name of HDF5 lies beyond its heap");
      found.emplace(names.substr(name, end - name), number<std::uint64_t>(entry + 8));
    }
  }
}

void Hdf5File::link_of_message(std::uint64_t at, std::uint64_t size,
                               std::map<std::string, Object>& found) const {
  const std::uint64_t end = at + size;
  const auto flags = number<std::uint8_t>(at + 1);
  std::uint64_t place = at + 2;
  std::uint8_t type = 0;
  if ((flags & 8) != 0) type = number<std::uint8_t>(place++);
  if ((flags & 4) != 0) place += 8;   // order of creation
  if ((flags & 16) != 0) place += 1;  // character set
  const std::size_t width = std::size_t{1} << (flags & 3);
  const std::uint64_t length = number(place, width);
  place += width;
  if (place > end || length > end - place) fail(at, "a link of HDF5 goes beyond its message");
  const std::string name(bytes(place, length));
  if (type == 0) found.emplace(name, number<std::uint64_t>(place + length));  // others lead out of the file
}

void Hdf5File::links_of_heap(std::uint64_t heap, std::uint64_t tree,
                             std::map<std::string, Object>& found) const {
  require_signature(heap, "FRHP");
  const std::size_t id_size = number<std::uint16_t>(heap + 5);
  if (number<std::uint16_t>(heap + 7) != 0) fail(heap + 7, "links that are packed are not read");
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

  // An offset counts through all direct blocks: two rows of the first size, then each of twice the last.
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
    const std::uint64_t id = record + 4;  // behind the hash
    if ((number<std::uint8_t>(id) & 0x30) != 0) fail(id, "a link of HDF5 outside its heap is not read");
    const std::uint64_t at = address_of(number(id + 1, offset_size), id);
    link_of_message(at, number(id + 1 + offset_size, length_size), found);
  };

  require_signature(tree, "BTHD");
  const std::size_t node_size = number<std::uint32_t>(tree + 6),
                    record_size = number<std::uint16_t>(tree + 10), depth = number<std::uint16_t>(tree + 12);
  constexpr std::size_t kHead = 6, kTail = 4, kDeepest = 16;
  if (record_size < 4 + id_size || node_size < kHead + kTail + record_size || depth > kDeepest)
    fail(tree, "a tree of HDF5 is damaged");
  // How wide the numbers of records are that inner nodes of each level have for their children.
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
