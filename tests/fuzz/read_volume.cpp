// Arbitrary bytes as a volume of any format: read, or refused with a FileError; a volume that is read can be
// checked, and written and read again without loss.
//
// The first byte chooses the format, the second that of the copy, the rest is the file or the files.
#include <array>
#include <vector>

#include "bytes.h"
#include "holdfast/check.h"
#include "holdfast/io.h"
#include "same_tetrahedra.h"

namespace {

using namespace holdfast;

constexpr std::array<std::array<const char*, 4>, 6> kFormats{
    {{".vtu"}, {".vtk"}, {".mesh"}, {".meshb"}, {".msh"}, {".node", ".ele", ".face", ".edge"}}};

bool same_bits(const std::vector<Point>& a, const std::vector<Point>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0);
}

bool finite(const std::vector<Point>& points) {
  return std::all_of(points.begin(), points.end(), [](const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  });
}

void require_round_trip(const Volume& volume, const fuzz::Folder& folder, std::size_t format) {
  const auto path = folder / (std::string("copy") + kFormats[format][0]);
  write_volume(path, volume, WriteOptions{});
  const Volume copy = read_volume(path);
  fuzz::require(same_bits(copy.vertices, volume.vertices), "other vertices after writing and reading");
  fuzz::require(fuzz::same_tetrahedra(copy.tetrahedra, volume.tetrahedra, volume.vertices),
                "other tetrahedra after writing and reading");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::Bytes bytes(data, size);
  const auto& format = kFormats[bytes.below(kFormats.size())];
  const std::size_t copy = bytes.below(4);  // .msh sorts the tetrahedra by region
  folder.empty();
  folder.write_parts(bytes.text(), {format.data(), format[1] == nullptr ? 1u : 4u});
  Volume volume;
  try {
    volume = read_volume(folder / (std::string("a") + format[0]));
  } catch (const FileError&) {
    return 0;
  }
  for (const Tetrahedron& t : volume.tetrahedra)
    for (const Index v : t) fuzz::require(v < volume.vertices.size(), "a tetrahedron's index out of range");
  if (volume.tetrahedra.size() < 300)
    static_cast<void>(check(Complex{volume.vertices, volume.facets, volume.segments, {}, {}}, volume));
  if (finite(volume.vertices)) require_round_trip(volume, folder, copy);
  return 0;
}
