// Arbitrary arrays as a surface and a volume: `check` says of each rule whether it holds, and terminates.
#include "holdfast/check.h"

#include <vector>

#include "bytes.h"

namespace {

using namespace holdfast;
using fuzz::Bytes;

template <typename Tuple>
std::vector<Tuple> tuples(Bytes& bytes, std::size_t vertices) {
  std::vector<Tuple> list(bytes.byte() % 24);
  for (Tuple& t : list)
    for (Index& v : t) v = bytes.byte() == 255 ? UINT32_MAX : bytes.below(vertices + 1);
  return list;
}

std::vector<int> numbers(Bytes& bytes, std::size_t count) {
  std::vector<int> list(bytes.byte() % 8 == 1 ? bytes.byte() % 8 : count);
  for (int& x : list) x = bytes.byte() % 3;
  return list;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  Volume volume;
  volume.vertices.resize(bytes.byte() % 16);
  for (Point& p : volume.vertices) p = bytes.point();
  const std::size_t n = volume.vertices.size();
  volume.tetrahedra = tuples<Tetrahedron>(bytes, n);
  volume.facets = tuples<Triangle>(bytes, n);
  volume.segments = tuples<Segment>(bytes, n);
  volume.regions = numbers(bytes, volume.tetrahedra.size());
  volume.facet_markers = numbers(bytes, volume.facets.size());
  volume.segment_markers = numbers(bytes, volume.segments.size());
  Surface surface;
  surface.vertices = volume.vertices;
  surface.vertices.resize(std::min<std::size_t>(bytes.byte() % 20, n + 1), Point{7, 7, 7});
  surface.facets = (how & 1u) != 0 ? volume.facets : tuples<Triangle>(bytes, n);
  surface.segments = (how & 2u) != 0 ? volume.segments : tuples<Segment>(bytes, n);
  if ((how & 4u) != 0) surface.facet_markers = numbers(bytes, surface.facets.size());
  if ((how & 8u) != 0) surface.segment_markers = numbers(bytes, surface.segments.size());
  CheckOptions options;
  options.box = (how & 16u) != 0;
  options.outside_dropped = (how & 32u) != 0;
  const CheckResult result = check(surface.view(), volume, options);
  fuzz::require(result.rules.size() == 13, "not every rule was told");
  for (const Rule& rule : result.rules)
    fuzz::require(rule.holds || !rule.detail.empty(), "a broken rule without a word why");
  return 0;
}
