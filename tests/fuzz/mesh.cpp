// Bytes as a complex and all options, meshed and checked: the promise is kept, or the outcome is one that the
// header names. The input arrays are unchanged.
#include <stdexcept>
#include <vector>

#include "bytes.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"

namespace {

using namespace holdfast;
using fuzz::Bytes;

constexpr std::size_t kMostVertices = 24, kMostFacets = 48;

// The raw surface, or one without what makes it invalid: mostly the latter, because few raw surfaces are
// valid.
Surface surface_from(Bytes& bytes) {
  const std::uint8_t how = bytes.byte();
  const bool filtered = how % 8 != 0;
  Surface surface;
  const auto keep_if_valid = [&](auto& list) {
    if (filtered && !diagnose(surface.view(), 1).empty()) list.pop_back();
  };
  for (std::size_t n = bytes.byte() % kMostVertices; n > 0; --n) {
    surface.vertices.push_back(bytes.point());
    keep_if_valid(surface.vertices);
  }
  const auto corner = [&] { return bytes.below(surface.vertices.size() + (filtered ? 0 : 1)); };
  for (std::size_t n = bytes.byte() % kMostFacets; n > 0 && bytes.left() > 0; --n) {
    const Index a = corner(), b = corner(), c = corner();
    surface.facets.push_back({a, b, c});
    keep_if_valid(surface.facets);
  }
  for (std::size_t n = bytes.byte() % 8; n > 0 && bytes.left() > 0; --n) {
    const Index a = corner(), b = corner();
    surface.segments.push_back({a, b});
    keep_if_valid(surface.segments);
  }
  const auto mark = [&](std::vector<int>& markers, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) markers.push_back(bytes.byte() % 4);
  };
  if ((how & 64u) != 0) mark(surface.facet_markers, surface.facets.size());
  if ((how & 128u) != 0) mark(surface.segment_markers, surface.segments.size());
  return surface;
}

double extent(const Surface& surface) {
  double largest = 0;
  for (const Point& p : surface.vertices)
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k] - surface.vertices[0][k]));
  return largest;
}

// Not so small that the number of points explodes.
Sizes sizes_from(Bytes& bytes, const Surface& surface) {
  Sizes sizes;
  const double whole = extent(surface);
  if (bytes.flag()) sizes.size = whole / (1 + bytes.byte() % 4);
  sizes.gradation = (64 + bytes.byte() % 192) / 255.0;
  sizes.grow = bytes.flag();
  if (bytes.flag()) {
    const double most = whole / (1 + bytes.byte() % 3);
    sizes.field = [most](const Point& p) { return p[0] > 0 ? most : 0; };
  }
  if (bytes.flag() && whole > 1e-100 && whole < 1e100) {
    const double m = 4 / (whole * whole);
    sizes.metric = [m](const Point&) { return Metric{m, 0, 2 * m, 0, 0, m}; };
  }
  if (bytes.byte() % 8 == 1) sizes.vertex_sizes.assign(surface.vertices.size(), whole / 2);
  return sizes;
}

Options options_from(Bytes& bytes, const Surface& surface) {
  Options options;
  const std::uint8_t flags = bytes.byte();
  options.flips = (flags & 1u) == 0;
  options.optimise = (flags & 2u) == 0;
  options.add_points = (flags & 4u) == 0;
  options.drop_outside = (flags & 8u) != 0;
  options.threads = (flags & 16u) == 0 ? 1 : 2;
  options.keep = static_cast<Keep>(bytes.byte() % 4);
  options.box_margin = (1 + bytes.byte()) / 64.0;
  options.seed = bytes.byte();
  if ((flags & 32u) != 0) options.sizes = sizes_from(bytes, surface);
  options.effort = static_cast<Effort>(bytes.byte() % 3);
  if ((flags & 64u) != 0) options.stop_after = static_cast<Stage>(bytes.byte() % 9);
  if ((flags & 128u) != 0) {
    options.holes.push_back(bytes.point());
    options.regions.push_back({bytes.point(), bytes.byte()});
  }
  // The callback is called at intervals: long runs are cancelled.
  int calls = 200;
  if (bytes.byte() % 16 == 1) calls = bytes.byte();
  options.progress = [calls](const Progress&) mutable { return --calls >= 0; };
  return options;
}

bool same(const Surface& a, const Surface& b) {
  return a.facets == b.facets && a.segments == b.segments && a.vertices.size() == b.vertices.size() &&
         (a.vertices.empty() ||
          std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Point)) == 0);
}

void require_promise(const Surface& surface, const Options& options, const Result& result) {
  CheckOptions given;
  given.box = options.keep == Keep::box;
  given.outside_dropped = options.drop_outside || !options.holes.empty();
  for (const Rule& rule : check(surface.view(), result.volume, given).rules)
    fuzz::require(rule.holds, rule.name + ": " + rule.detail);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Surface surface = surface_from(bytes);
  const Surface before = surface;
  const Options options = options_from(bytes, surface);
  Result result;
  try {
    result = mesh(surface.view(), options);
  } catch (const std::invalid_argument&) {
    return 0;
  }
  fuzz::require(same(surface, before), "the input has changed");
  if (result.outcome == Outcome::invalid_input)
    fuzz::require(!result.defects.empty(), "refused without a defect");
  if (result.outcome != Outcome::done) fuzz::require(!result.message.empty(), "ended without a message");
  if (result.outcome == Outcome::done && !options.stop_after) require_promise(surface, options, result);
  return 0;
}
