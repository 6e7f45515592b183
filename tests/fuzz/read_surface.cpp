// Arbitrary bytes as a surface of any format: read, or refused with a FileError; a surface that is read can
// be examined.
//
// The first byte chooses the format, the rest is the file (or files, if a format needs several).
#include <array>
#include <vector>

#include "bytes.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"

namespace {

using namespace holdfast;

constexpr std::array<std::array<const char*, 2>, 27> kFormats{
    {{".off"},  {".stl"},    {".obj"},           {".ply"},
     {".mesh"}, {".meshb"},  {".poly", ".node"}, {".smesh", ".node"},
     {".node"}, {".vtu"},    {".vtp"},           {".vtk"},
     {".msh"},  {".stl.gz"}, {".3mf"},           {".amf"},
     {".ts"},   {".gltf"},   {".glb"},           {".wrl"},
     {".gts"},  {".dxf"},    {".dae"},           {".ac"},
     {".3ds"},  {".gii"},    {".pial"}}};

void require_in_range(const Surface& surface) {
  for (const Triangle& f : surface.facets)
    for (const Index v : f) fuzz::require(v < surface.vertices.size(), "a facet's index out of range");
  for (const Segment& s : surface.segments)
    for (const Index v : s) fuzz::require(v < surface.vertices.size(), "a segment's index out of range");
  fuzz::require(surface.facet_markers.empty() || surface.facet_markers.size() == surface.facets.size(),
                "facet markers of another number than facets");
  fuzz::require(surface.segment_markers.empty() || surface.segment_markers.size() == surface.segments.size(),
                "segment markers of another number than segments");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::Bytes bytes(data, size);
  const auto& format = kFormats[bytes.below(kFormats.size())];
  folder.empty();
  folder.write_parts(bytes.text(), {format.data(), format[1] == nullptr ? 1u : 2u});
  try {
    const Surface surface = read_surface(folder / (std::string("a") + format[0]));
    require_in_range(surface);
    if (surface.vertices.size() + surface.facets.size() + surface.segments.size() < 300)
      static_cast<void>(diagnose(surface.view(), 20));
  } catch (const FileError&) {
  }
  return 0;
}
