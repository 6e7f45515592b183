// Reads points and segments in the plane: two-dimensional .poly and .node (Shewchuk, Triangle,
// https://www.cs.cmu.edu/~quake/triangle.poly.html).
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "holdfast/plane.h"
#include "io/file_bytes.h"
#include "io/plane_files.h"
#include "io/tetgen.h"
#include "io/text_reader.h"
#include "numbers/float_environment.h"
#include "text/decimal.h"

namespace holdfast {
namespace io {
namespace {

class PlaneReader {
 public:
  explicit PlaneReader(const Source& source) : text_(source) {}

  Plane read_points() {
    read_nodes(text_);
    return finished();
  }

  Plane read_poly() {
    read_nodes(text_);
    if (plane_.points.empty()) {
      const std::filesystem::path beside = sibling(text_.source().path, ".node");
      const FileBytes bytes(beside, text_.source().watch);
      TextReader nodes({beside, bytes.view(), false, text_.source().watch});
      read_nodes(nodes);
    }
    read_segments();
    read_holes();
    read_regions();
    if (!text_.at_end()) {
      text_.seek(text_.position());
      text_.fail("text after the last section; the counts are wrong");
    }
    return finished();
  }

 private:
  [[nodiscard]] Plane finished() {
    plane_.point_markers = point_markers_.take(plane_.points.size());
    plane_.segment_markers = segment_markers_.take(plane_.segments.size());
    if (attributes_ > 0)
      plane_.remarks.push_back({RemarkKind::left_out, attributes_,
                                std::to_string(attributes_) + " attributes of points are left out"});
    if (plane_.points.empty()) text_.fail("the file holds no points");
    return std::move(plane_);
  }

  static PlanePoint point(TextReader& text) {
    const double x = text.real("a coordinate");
    return {x, text.real("a coordinate")};
  }

  /// The point of a hole or region.
  PlanePoint finite_point(const char* what) {
    const PlanePoint p = point(text_);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
      text_.fail(std::string(what) + " is not at a finite place");
    return p;
  }

  void read_nodes(TextReader& text) {
    const std::size_t count = text.count("the number of points", 6);
    const std::size_t start = text.last();
    const std::int64_t dimension = text.at_line_end() ? 2 : text.integer("the dimension");
    if (dimension != 2) text.fail_at(start, "the dimension is not 2");
    const std::size_t attributes = text.at_line_end() ? 0 : text.count("the number of attributes", 1);
    const bool marked = !text.at_line_end() && text.integer("whether there are markers") != 0;
    text.skip_line();
    plane_.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = text.integer("the point's number");
      if (i == 0 && number != 0 && number != 1) text.fail("the first point must have the number 0 or 1");
      if (i == 0) plane_.base = static_cast<int>(number);
      const std::int64_t expected = plane_.base + static_cast<std::int64_t>(i);
      if (number != expected)
        text.fail("expected point " + std::to_string(expected) + ", found the number " +
                  std::to_string(number));
      plane_.points.push_back(point(text));
      for (std::size_t k = 0; k < attributes && !text.at_line_end(); ++k)
        static_cast<void>(text.real("an attribute"));
      point_markers_.add(i, marked && !text.at_line_end() ? text.tag_from_real("a boundary marker") : 0);
      text.skip_line();
    }
    attributes_ += attributes * count;
  }

  void read_segments() {
    if (text_.at_end()) text_.fail_truncated("the number of segments");
    const std::size_t count = text_.count("the number of segments", 6);
    text_.skip_line();
    plane_.segments.reserve(count);
    std::int64_t first = plane_.base;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = text_.integer("the segment's number");
      if (i == 0 && (number == 0 || number == 1)) first = number;
      const std::int64_t expected = first + static_cast<std::int64_t>(i);
      if (number != expected)
        text_.fail("expected segment " + std::to_string(expected) + ", found the number " +
                   std::to_string(number));
      Segment segment{};
      for (Index& end : segment) end = text_.index("a point's number", plane_.base, plane_.points.size());
      segment_markers_.add(i, text_.at_line_end() ? 0 : text_.tag_from_real("a boundary marker"));
      plane_.segments.push_back(segment);
      text_.skip_line();
    }
    if (first != plane_.base)
      plane_.remarks.push_back({RemarkKind::renumbered, count,
                                "segments are numbered from " + std::to_string(first) + " and points from " +
                                    std::to_string(plane_.base) + "; messages number both as the points"});
  }

  void read_holes() {
    if (text_.at_end()) return;  // the section may be missing
    const std::size_t count = text_.count("the number of holes", 6);
    text_.skip_line();
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_.integer("the hole's number"));
      plane_.holes.push_back(finite_point("a hole"));
      text_.skip_line();
    }
  }

  void read_regions() {
    if (text_.at_end()) return;
    const std::size_t count = text_.count("the number of regions", 8);
    text_.skip_line();
    std::vector<double> attributes;
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_.integer("the region's number"));
      Plane::Seed seed{finite_point("a region"), 0};
      attributes.push_back(text_.real("a region's attribute"));
      if (!text_.at_line_end()) seed.area = std::max(0.0, text_.real("a region's largest area"));
      plane_.regions.push_back(seed);
      text_.skip_line();
    }
    name_regions(attributes);
  }

  /// Regions need integer ids; for attributes that are none, unused integers from 1 on are taken.
  void name_regions(const std::vector<double>& attributes) {
    const auto whole = [](double a) {
      return a == std::rint(a) && std::abs(a) <= std::numeric_limits<int>::max();
    };
    std::set<int> taken;
    for (const double a : attributes)
      if (whole(a)) taken.insert(static_cast<int>(a));
    std::map<double, int> named;
    int next = 1;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const double a = attributes[i];
      if (whole(a)) {
        plane_.regions[i].id = static_cast<int>(a);
        continue;
      }
      const auto [found, fresh] = named.try_emplace(a, 0);
      if (fresh) {
        while (taken.contains(next)) ++next;
        found->second = next++;
        plane_.remarks.push_back({RemarkKind::renumbered, 1,
                                  "the attribute " + decimal(a) + " of regions is no whole number; it is " +
                                      std::to_string(found->second) + " in the output"});
      }
      plane_.regions[i].id = found->second;
    }
  }

  TextReader text_;
  Plane plane_;
  Tags point_markers_, segment_markers_;
  std::size_t attributes_ = 0;
};

}  // namespace

std::string plane_extension_of(const std::filesystem::path& path, std::string_view format) {
  std::string extension = lower(format.empty() ? without_gz(path).extension().string() : std::string(format));
  if (!extension.empty() && extension[0] != '.') extension.insert(0, 1, '.');
  return extension;
}

Plane parse_plane(const Source& source, std::string_view extension) {
  PlaneReader reader(source);
  return extension == ".poly" ? reader.read_poly() : reader.read_points();
}

}  // namespace io

Plane read_plane(const std::filesystem::path& path, const ReadOptions& options) {
  const FloatEnvironment environment;
  const std::string extension = io::plane_extension_of(path, options.format);
  if (extension != ".poly" && extension != ".node")
    throw FileError(
        path, "",
        (extension.empty() ? "a name without extension" : "the format " + io::in_quotes(extension)) +
            " cannot be read as points and segments; the formats are .poly, .node");
  io::Watch watch(options, options.progress);
  const io::FileBytes bytes(path, &watch);
  Plane plane = io::parse_plane({path, bytes.view(), false, &watch}, extension);
  watch.finish();
  return plane;
}

}  // namespace holdfast
