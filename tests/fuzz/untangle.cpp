// Bytes as a volume mesh, mostly a Delaunay mesh whose vertices have moved: made positive with its boundary
// kept as the header says, or refused.
#include "holdfast/untangle.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "bytes.h"
#include "exact/predicates.h"
#include "holdfast/holdfast.h"

namespace {

using namespace holdfast;
using fuzz::Bytes;

Volume volume_from(Bytes& bytes) {
  Volume volume;
  const std::uint8_t how = bytes.byte();
  std::set<Point> seen;
  for (std::size_t n = 4 + bytes.byte() % 24; n > 0; --n) {
    const Point p{double(bytes.byte() % 16), double(bytes.byte() % 16), double(bytes.byte() % 16)};
    if (seen.insert(p).second) volume.vertices.push_back(p);
  }
  volume.tetrahedra = delaunay(volume.vertices, 1 + how % 4u);
  const std::size_t n = volume.vertices.size();
  if (how % 8 == 7)  // arbitrary tetrahedra
    for (std::size_t k = bytes.byte() % 12; k > 0; --k)
      volume.tetrahedra.push_back(
          {bytes.below(n + 1), bytes.below(n + 1), bytes.below(n + 1), bytes.below(n + 1)});
  for (std::size_t k = bytes.byte() % 12; k > 0 && !volume.vertices.empty(); --k) {
    Point& p = volume.vertices[bytes.below(n)];
    p = bytes.point();
  }
  for (std::size_t k = bytes.byte() % 4; k > 0 && !volume.tetrahedra.empty(); --k) {
    const Tetrahedron& t = volume.tetrahedra[bytes.below(volume.tetrahedra.size())];
    if (bytes.flag())
      volume.facets.push_back({t[0], t[1], t[2]});
    else
      volume.segments.push_back({t[0], t[3]});
  }
  if ((how & 64u) != 0)
    for (std::size_t k = 0; k < volume.tetrahedra.size(); ++k) volume.regions.push_back(bytes.byte() % 2);
  if ((how & 128u) != 0)
    for (Tetrahedron& t : volume.tetrahedra)
      if (bytes.flag()) std::swap(t[2], t[3]);
  return volume;
}

bool is_corner(const Volume& volume, Index v) {
  return std::any_of(volume.tetrahedra.begin(), volume.tetrahedra.end(),
                     [v](const Tetrahedron& t) { return std::find(t.begin(), t.end(), v) != t.end(); });
}

void require_positive(const Volume& volume) {
  for (const Tetrahedron& t : volume.tetrahedra) {
    const auto at = [&](std::size_t k) { return volume.vertices[t[k]].data(); };
    fuzz::require(exact::orient3d(at(0), at(1), at(2), at(3)) > 0, "a tetrahedron that is not positive");
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Volume volume = volume_from(bytes);
  UntangleOptions options;
  options.refill = bytes.flag();
  options.seed = bytes.byte();
  if (bytes.flag() && !volume.vertices.empty())
    options.fixed.push_back(bytes.below(volume.vertices.size() + 1));
  int calls = 2000;
  options.progress = [calls](const UntangleProgress&) mutable { return --calls >= 0; };
  UntangleResult result;
  try {
    result = untangle(volume, options);
  } catch (const std::invalid_argument&) {
    return 0;
  }
  if (result.outcome != Outcome::done) {
    fuzz::require(!result.message.empty(), "ended without a message");
    return 0;
  }
  require_positive(result.volume);
  fuzz::require(result.volume.facets == volume.facets && result.volume.segments == volume.segments,
                "other facets or segments");
  for (const Index v : options.fixed)
    fuzz::require(result.volume.vertices[v] == volume.vertices[v] &&
                      is_corner(result.volume, v) == is_corner(volume, v),
                  "a fixed vertex has moved or gone");
  for (const Triangle& f : volume.facets)
    for (const Index v : f)
      fuzz::require(result.volume.vertices[v] == volume.vertices[v], "a vertex of a facet has moved");
  return 0;
}
