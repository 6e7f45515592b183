// STL, ASCII and binary (3D Systems, StereoLithography Interface Specification, 1989).
//
// Vertices with identical coordinates are merged, because the format repeats them in every triangle. If a
// file has several solids, the marker of a facet is its solid's number from 1, named after the solid.
#include <algorithm>
#include <array>

#include "io/byte_reader.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "surface/weld.h"
#include "text/count.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kHeader = 80, kRecord = 50;
constexpr std::uint32_t kUnknown = 0xFFFFFFFF;

/// The number of triangles that a binary file's header announces.
std::uint32_t announced(std::string_view bytes) {
  return load<std::uint32_t>(bytes.data() + kHeader, std::endian::little);
}

bool is_binary(std::string_view bytes) {
  if (bytes.size() < kHeader + 4) return false;
  // Binary files may start with "solid", too, so their exact size decides first.
  if (bytes.size() == kHeader + 4 + kRecord * std::uint64_t{announced(bytes)}) return true;
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), bytes.size());
  if (lower(bytes.substr(first, 5)) != "solid") return true;
  // Text has zero bytes only at its end, if at all; the numbers of a binary file have some.
  return bytes.find('\0') <= bytes.find_last_not_of('\0') && bytes.find('\0') != std::string_view::npos;
}

/// Where the triangles of a solid begin, and how many there are.
struct BinarySolid {
  std::size_t begin;
  std::uint32_t count;
};

/// The solids of a file that is several binary files one after the other, as CAD Exchanger writes parts;
/// empty if the headers do not lead to the very end of the file.
std::vector<BinarySolid> solids_in_a_row(std::string_view bytes) {
  std::vector<BinarySolid> solids;
  std::size_t at = 0;
  while (bytes.size() - at >= kHeader + 4) {
    const std::uint32_t count = announced(bytes.substr(at));
    at += kHeader + 4;
    if ((bytes.size() - at) / kRecord < count) return {};
    solids.push_back({at, count});
    at += kRecord * std::size_t{count};
  }
  return at == bytes.size() && solids.size() > 1 ? solids : std::vector<BinarySolid>{};
}

void read_triangles(const Source& source, const BinarySolid& solid, Welder& weld, MeshData& mesh) {
  // A batch of points is decoded and prefetched before the first lookup.
  constexpr std::uint32_t kBatch = 16;
  std::array<Point, 3 * kBatch> points;
  std::array<std::uint64_t, 3 * kBatch> hashes;
  const char* record = source.bytes.data() + solid.begin;
  for (std::uint32_t first = 0; first < solid.count; first += kBatch) {
    beat(source.watch);
    const std::size_t corners = 3 * std::size_t{std::min(kBatch, solid.count - first)};
    for (std::size_t i = 0; i < corners; ++i) {
      const char* corner = record + kRecord * (i / 3) + 12 * (i % 3 + 1);  // after the normal's 12 bytes
      for (std::size_t axis = 0; axis < 3; ++axis)
        points[i][axis] = load<float>(corner + 4 * axis, std::endian::little);
      hashes[i] = weld.announce(points[i]);
    }
    for (std::size_t i = 0; i < corners; i += 3)
      mesh.facets.push_back({weld.add(points[i], hashes[i]), weld.add(points[i + 1], hashes[i + 1]),
                             weld.add(points[i + 2], hashes[i + 2])});
    record += kRecord * kBatch;
  }
}

std::size_t attributes_of(const Source& source, const BinarySolid& solid) {
  const char* const attributes = source.bytes.data() + solid.begin + kRecord - 2;
  std::size_t set = 0;
  for (std::size_t i = 0; i < solid.count; ++i)
    set += load<std::uint16_t>(attributes + kRecord * i, std::endian::little) != 0 ? 1 : 0;
  return set;
}

MeshData read_binary(const Source& source) {
  ByteReader bytes(source, std::endian::little, kHeader);
  auto count = bytes.read<std::uint32_t>();
  MeshData mesh;
  // Programs that do not know the number in advance leave one of these.
  const std::uint64_t whole = bytes.left() / kRecord;
  if ((count == 0 || count == kUnknown) && whole > 0 && bytes.left() % kRecord == 0 && whole < kUnknown) {
    mesh.remarks.push_back(
        {RemarkKind::left_out, 1,
         "the header announces " + std::to_string(count) + " triangles: the " +
             counted(static_cast<std::size_t>(whole), "one that follows is", "that follow are") + " read"});
    count = static_cast<std::uint32_t>(whole);
  }
  bytes.require_items(count, kRecord, "triangles");
  std::uint64_t behind = bytes.left() - kRecord * std::uint64_t{count};
  std::vector<BinarySolid> solids = {{bytes.position(), count}};
  if (behind >= kHeader + 4) {
    if (std::vector<BinarySolid> row = solids_in_a_row(source.bytes); !row.empty()) {
      solids = std::move(row);
      behind = 0;
    }
  }
  if (behind >= kRecord)
    bytes.fail("the header announces " + counted(count, "triangle") + ", but " +
               counted(behind, "more byte follows", "more bytes follow") + (count == 1 ? " it" : " them"));
  std::size_t all = 0, attributes = 0;
  for (const BinarySolid& solid : solids) all += solid.count;
  mesh.facets.reserve(all);
  mesh.vertices.reserve(all / 2);
  Welder weld(mesh.vertices, all / 2);  // a closed surface has half as many vertices as facets
  for (std::size_t s = 0; s < solids.size(); ++s) {
    read_triangles(source, solids[s], weld, mesh);
    attributes += attributes_of(source, solids[s]);
    for (std::size_t f = mesh.facets.size() - solids[s].count; solids.size() > 1 && f < mesh.facets.size();
         ++f)
      mesh.facet_markers.add(f, static_cast<int>(s) + 1);
  }
  mesh.leave_out(attributes, "attributes of triangles (colours, perhaps)",
                 "attribute of a triangle (its colour, perhaps)");
  mesh.leave_out(static_cast<std::size_t>(behind), "bytes after the triangles", "byte after the triangles");
  return mesh;
}

/// Reads a sequence of keywords in any case.
void expect(TextReader& text, std::initializer_list<std::string_view> keywords) {
  for (const std::string_view keyword : keywords) {
    const std::string quoted_keyword = in_quotes(keyword);
    const std::string_view word = text.word(quoted_keyword);
    if (lower(word) != keyword) text.fail("expected " + quoted_keyword + ", found " + in_quotes(word));
  }
}

/// Reads a facet after its keyword.
Triangle read_facet(TextReader& text, Welder& weld) {
  expect(text, {"normal"});
  for (int axis = 0; axis < 3; ++axis) static_cast<void>(text.word("a normal's component"));
  expect(text, {"outer", "loop"});
  Triangle facet{};
  for (Index& corner : facet) {
    expect(text, {"vertex"});
    corner = weld.add(text.point());
  }
  expect(text, {"endloop", "endfacet"});
  return facet;
}

/// Solids are numbered from 1, unless all their names contain a number, as Holdfast writes for markers
/// without a name.
std::vector<int> ids_of(const std::vector<std::string>& solids, std::map<int, std::string>& names) {
  bool told = true;
  for (const std::string& solid : solids) told = told && id_of_default_name(kFacetStem, solid).has_value();
  std::vector<int> ids;
  for (const std::string& solid : solids) {
    ids.push_back(told ? *id_of_default_name(kFacetStem, solid) : static_cast<int>(ids.size()) + 1);
    if (!told && !solid.empty()) names[ids.back()] = solid;
  }
  return ids;
}

MeshData read_ascii(const Source& source) {
  TextReader text(source, '\0');
  MeshData mesh;
  Welder weld(mesh.vertices);
  std::vector<std::size_t> solid_ends;
  std::vector<std::string> names;
  do {
    expect(text, {"solid"});
    names.push_back(cleaned_name(text.rest_of_line()));
    for (;;) {
      if (!mesh.facets.empty() && text.at_end()) {  // some programs omit it
        mesh.remarks.push_back(
            {RemarkKind::left_out, 1, "the file ends without 'endsolid': triangles may be missing"});
        break;
      }
      const std::string keyword = lower(text.word("'facet' or 'endsolid'"));
      if (keyword == "endsolid") break;
      if (keyword != "facet") text.fail("expected 'facet' or 'endsolid', found " + in_quotes(keyword));
      mesh.facets.push_back(read_facet(text, weld));
    }
    text.skip_line();
    solid_ends.push_back(mesh.facets.size());
  } while (!text.at_end());
  if (solid_ends.size() == 1) {  // no markers, but a name for facets without one
    if (!names[0].empty()) mesh.names.facets[0] = names[0];
    return mesh;
  }
  const std::vector<int> ids = ids_of(names, mesh.names.facets);
  std::size_t solid = 0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    while (i == solid_ends[solid]) ++solid;
    mesh.facet_markers.add(i, ids[solid]);
  }
  return mesh;
}

}  // namespace

MeshData read_stl(const Source& source) {
  if (source.bytes.empty()) throw FileError(source.path, "", "the file is empty");
  if (is_binary(source.bytes)) return read_binary(source);
  Source text = source;
  text.bytes = source.bytes.substr(0, source.bytes.find_last_not_of('\0') + 1);
  return read_ascii(text);
}

}  // namespace holdfast::io
