// Arbitrary bytes as a size field of any format: read, or refused with a FileError; a field that is read can
// be evaluated anywhere, and its sizes are absent or positive.
#include <array>
#include <vector>

#include "bytes.h"
#include "holdfast/io.h"

namespace {

using namespace holdfast;

constexpr std::array<std::array<const char*, 3>, 5> kFormats{
    {{".mesh", ".sol"}, {".meshb", ".solb"}, {".vtu"}, {".mtr", ".node", ".ele"}, {".pos"}}};

void ask(const SizeField& field, const std::vector<Point>& places) {
  if (field.sizes.size() == field.vertices.size() && !field.sizes.empty()) {
    const auto size = size_function(field);
    for (const Point& p : places) fuzz::require(size(p) >= 0, "a size that is negative or no number");
  }
  if (field.metrics.size() == field.vertices.size() && !field.metrics.empty()) {
    const auto metric = metric_function(field);
    for (const Point& p : places) static_cast<void>(metric(p));
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  fuzz::Bytes bytes(data, size);
  const auto& format = kFormats[bytes.below(kFormats.size())];
  std::vector<Point> places{{0, 0, 0}, {0.25, 0.25, 0.25}, {1e300, -1e300, 5}};
  places.push_back(bytes.point());
  for (Point& p : places)
    for (double& x : p) x = std::isfinite(x) ? x : 0;
  folder.empty();
  folder.write_parts(bytes.text(), {format.data(), format[1] == nullptr   ? 1u
                                                   : format[2] == nullptr ? 2u
                                                                          : 3u});
  try {
    const SizeField field = read_size_field(folder / (std::string("a") + format[0]));
    for (const Point& p : field.vertices)
      if (places.size() < 40) places.push_back(p);
    if (field.vertices.size() < 1000) ask(field, places);
  } catch (const FileError&) {
  }
  return 0;
}
