// Groups of HDF5: symbol tables in B-trees of version 1, links in object headers, and links in fractal heaps
// (HDF5 file format specification, III.A, III.D, IV.A.2.g).
#include "io/hdf5_number.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

constexpr std::uint16_t kLinkInfo = 0x0002, kLink = 0x0006, kSymbolTable = 0x0011;

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
      constexpr std::size_t kHash = 4;  // of the name; it precedes the link's place in a record
      const auto add = [&](std::uint64_t link, std::uint64_t size) { link_of_message(link, size, found); };
      if (heap != kNoAddress) each_in_heap(heap, tree, kHash, add);
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
      // After the header, keys and children alternate; pushed in reverse, the first child is popped first.
      for (std::size_t i = children; i-- > 0;) nodes.push_back(number<std::uint64_t>(at + 32 + 16 * i));
      continue;
    }
    require_signature(at, "SNOD");
    const std::size_t entries = number<std::uint16_t>(at + 6);
    for (std::size_t i = 0; i < entries; ++i) {
      count_block(blocks, at);
      const std::uint64_t entry = at + 8 + 40 * i, name = number<std::uint64_t>(entry);
      const std::size_t begin = name < names.size() ? static_cast<std::size_t>(name) : names.size(),
                        end = names.find('\0', begin);
      if (end == std::string_view::npos) fail(entry, "a name of HDF5 lies beyond its heap");
      found.emplace(names.substr(begin, end - begin), number<std::uint64_t>(entry + 8));
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
  if ((flags & 4) != 0) place += 8;   // creation order
  if ((flags & 16) != 0) place += 1;  // character set
  const std::size_t width = std::size_t{1} << (flags & 3);
  const std::uint64_t length = number(place, width);
  place += width;
  if (place > end || length > end - place) fail(at, "a link of HDF5 goes beyond its message");
  const std::string name(bytes(place, length));
  if (type == 0) found.emplace(name, number<std::uint64_t>(place + length));  // others lead out of the file
}

}  // namespace holdfast::io
