// FreeSurfer's surfaces (lh.pial, rh.white, ...; FreeSurfer wiki, "FreeSurferSurfaceFormat"): three bytes,
// two lines of text, the numbers of vertices and triangles, coordinates as floats, corners. Bytes are in big
// endian order. Older files of quadrangles are refused.
#include <bit>
#include <cstdint>

#include "io/brain_surfaces.h"
#include "io/byte_reader.h"

namespace holdfast::io {
namespace {

constexpr std::string_view kTriangleFile = "\xFF\xFF\xFE", kQuadrangleFile = "\xFF\xFF\xFF",
                           kNewQuadrangles = "\xFF\xFF\xFD";

/// The position after two lines.
std::size_t end_of_lines(const ByteReader& bytes, const Source& source) {
  std::size_t end = bytes.position();
  for (int line = 0; line < 2; ++line) {
    end = source.bytes.find('\n', end);
    if (end == std::string_view::npos) bytes.fail("expected two lines of text; the file is truncated");
    ++end;
  }
  return end;
}

std::uint32_t count_of(ByteReader& bytes, const char* what) {
  const auto count = bytes.read<std::int32_t>();
  if (count < 0) bytes.fail("a negative number of " + std::string(what));
  return static_cast<std::uint32_t>(count);
}

Index index_of(ByteReader& bytes, std::size_t size) {
  const auto index = bytes.read<std::int32_t>();
  if (index < 0 || static_cast<std::size_t>(index) >= size)
    bytes.fail("vertex " + std::to_string(index) + ", but there are " + std::to_string(size));
  return static_cast<Index>(index);
}

}  // namespace

MeshData read_freesurfer(const Source& source) {
  ByteReader bytes(source, std::endian::big);
  const std::string_view kind = source.bytes.substr(0, kTriangleFile.size());
  if (kind == kQuadrangleFile || kind == kNewQuadrangles)
    bytes.fail("an old file of quadrangles; `mris_convert IN OUT` makes one of triangles");
  if (kind != kTriangleFile) bytes.fail("expected the bytes FF FF FE with which FreeSurfer's surfaces begin");
  bytes.seek(kTriangleFile.size());
  bytes.seek(end_of_lines(bytes, source));
  const std::uint32_t vertices = count_of(bytes, "vertices"), facets = count_of(bytes, "triangles");
  constexpr std::size_t kBytesEach = 12;
  bytes.require_items(std::uint64_t{vertices} + facets, kBytesEach, "vertices and triangles");
  MeshData mesh(source);
  mesh.vertices.reserve(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    Point p{};
    for (double& x : p) x = static_cast<double>(bytes.read<float>());
    mesh.vertices.push_back(p);
  }
  mesh.facets.reserve(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    Triangle t{};
    for (Index& corner : t) corner = index_of(bytes, vertices);
    mesh.facets.push_back(t);
  }
  return mesh;
}

}  // namespace holdfast::io
