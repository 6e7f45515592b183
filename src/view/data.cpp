#include "view/data.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "view/packed.h"
#include "view/text.h"

namespace holdfast::view {
namespace {

static_assert(sizeof(Point) == 3 * sizeof(double) && sizeof(Tetrahedron) == 4 * sizeof(Index));

std::span<const double> flat(std::span<const Point> points) {
  return {points.empty() ? nullptr : points[0].data(), 3 * points.size()};
}

template <std::size_t N>
std::span<const std::uint32_t> flat(std::span<const std::array<Index, N>> entities) {
  return {entities.empty() ? nullptr : entities[0].data(), N * entities.size()};
}

std::span<const std::uint32_t> flat(std::span<const int> tags) {
  return {reinterpret_cast<const std::uint32_t*>(tags.data()), tags.size()};
}

/// A part as spans, whatever it is of.
struct Arrays {
  std::span<const Point> vertices;
  std::span<const Tetrahedron> tetrahedra;
  std::span<const int> regions, facet_markers, segment_markers;
  std::span<const Triangle> facets;
  std::span<const Segment> segments;
  std::span<const std::int64_t> input_vertices;
  const Names* names;
};

Arrays arrays_of(const PagePart& part) {
  if (part.volume == nullptr) {
    const Complex& c = part.complex;
    return {c.vertices, {}, {}, c.facet_markers, c.segment_markers, c.facets, c.segments, {}, c.names};
  }
  const Volume& v = *part.volume;
  return {v.vertices, v.tetrahedra, v.regions,        v.facet_markers, v.segment_markers,
          v.facets,   v.segments,   v.input_vertices, &v.names};
}

void require_consistent(const Arrays& arrays) {
  const auto matches = [](const auto& tags, std::size_t count) {
    return tags.empty() || tags.size() == count;
  };
  if (!matches(arrays.regions, arrays.tetrahedra.size()) ||
      !matches(arrays.facet_markers, arrays.facets.size()) ||
      !matches(arrays.segment_markers, arrays.segments.size()) ||
      !matches(arrays.input_vertices, arrays.vertices.size()))
    throw std::invalid_argument(
        "a page with regions, markers or input vertices of another number than their entities");
}

/// The tetrahedra nearest to the middle of the longest side, in ascending order; `across` becomes that axis.
std::vector<Index> slab(const Arrays& arrays, std::size_t most, std::size_t& across) {
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Point& p : arrays.vertices)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  for (std::size_t k = across = 0; k < 3; ++k)
    if (high[k] / 2 - low[k] / 2 > high[across] / 2 - low[across] / 2) across = k;
  const double middle = low[across] / 2 + high[across] / 2;
  const auto far = [&](Index t) {
    double sum = 0;
    for (const Index v : arrays.tetrahedra[t])
      if (v < arrays.vertices.size()) sum += (arrays.vertices[v][across] - middle) / 4;
    return std::max(sum, -sum);
  };
  std::vector<std::pair<double, Index>> order(arrays.tetrahedra.size());
  for (Index t = 0; t < order.size(); ++t) order[t] = {far(t), t};
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end());
  std::vector<Index> kept(most);
  std::transform(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), kept.begin(),
                 [](const auto& entry) { return entry.second; });
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::string names_json(const std::map<int, std::string>& names) {
  std::string text = "{";
  for (const auto& [id, name] : names)
    text += (text.size() > 1 ? "," : "") + json(std::to_string(id)) + ":" + json(name);
  return text += "}";
}

template <typename Values, typename Write>
std::string list_json(const Values& values, Write&& write) {
  std::string text = "[";
  for (const auto& value : values) text += (text.size() > 1 ? "," : "") + write(value);
  return text += "]";
}

std::string indices_json(std::span<const Index> indices) {
  return list_json(indices, [](Index i) { return std::to_string(i); });
}

std::string entry_json(const Entry& entry) {
  const auto place = [](const Point& p) { return list_json(p, [](double x) { return json(x); }); };
  return "{\"part\":" + std::to_string(entry.part) + ",\"vertices\":" + indices_json(entry.vertices) +
         ",\"facets\":" + indices_json(entry.facets) + ",\"segments\":" + indices_json(entry.segments) +
         ",\"where\":" + list_json(entry.where, place) + "}";
}

/// Tells the arrays of a part in the header, and writes them in the same order.
class PartWriter {
 public:
  PartWriter(const PagePart& part, std::size_t most) : part_(part), arrays_(arrays_of(part)) {
    require_consistent(arrays_);
    if (arrays_.tetrahedra.size() > most) cut(most);
    if (!arrays_.input_vertices.empty())
      for (const std::int64_t input : arrays_.input_vertices) added_ += input < 0 ? '\1' : '\0';
  }

  [[nodiscard]] std::string header() const {
    std::string text =
        "{\"name\":" + json(part_.name) + ",\"kind\":\"" + (part_.volume != nullptr ? "volume" : "surface") +
        "\",\"names\":{\"facets\":" + names_json(names().facets) +
        ",\"regions\":" + names_json(names().regions) + ",\"segments\":" + names_json(names().segments) +
        "},\"total\":" + std::to_string(arrays_of(part_).tetrahedra.size()) + ",\"note\":" + json(note_) +
        ",\"arrays\":[";
    const auto tell = [&](const char* name, const char* kind, std::size_t count, int step) {
      if (text.back() != '[') text += ",";
      text += std::string("{\"name\":\"") + name + "\",\"kind\":\"" + kind +
              "\",\"count\":" + std::to_string(count) + ",\"step\":" + std::to_string(step) + "}";
    };
    tell("vertices", "f64", 3 * arrays_.vertices.size(), 0);
    tell("tetrahedra", "u32", 4 * arrays_.tetrahedra.size(), 4);
    tell("numbers", "u32", numbers_.size(), 1);
    tell("regions", "i32", arrays_.regions.size(), 0);
    tell("facets", "u32", 3 * arrays_.facets.size(), 3);
    tell("facet_markers", "i32", arrays_.facet_markers.size(), 0);
    tell("segments", "u32", 2 * arrays_.segments.size(), 2);
    tell("segment_markers", "i32", arrays_.segment_markers.size(), 0);
    tell("added", "u8", added_.size(), 0);
    return text += "]}";
  }

  void write(Packed& out) const {
    out.doubles(flat(arrays_.vertices));
    out.words(flat(arrays_.tetrahedra), 4);
    out.words(numbers_, 1);
    out.words(flat(arrays_.regions), 0);
    out.words(flat(arrays_.facets), 3);
    out.words(flat(arrays_.facet_markers), 0);
    out.words(flat(arrays_.segments), 2);
    out.words(flat(arrays_.segment_markers), 0);
    out.bytes(added_);
  }

 private:
  [[nodiscard]] const Names& names() const {
    static const Names none;
    return arrays_.names != nullptr ? *arrays_.names : none;
  }

  void cut(std::size_t most) {
    std::size_t across = 0;
    const std::size_t all = arrays_.tetrahedra.size();
    numbers_ = slab(arrays_, most, across);
    for (const Index t : numbers_) {
      tetrahedra_.push_back(arrays_.tetrahedra[t]);
      if (!arrays_.regions.empty()) regions_.push_back(arrays_.regions[t]);
    }
    arrays_.tetrahedra = tetrahedra_;
    arrays_.regions = regions_;
    note_ = "Of " + std::to_string(all) + " tetrahedra this page holds the " + std::to_string(most) +
            " nearest to the middle across " + "xyz"[across] +
            ", and the whole surface; a cut there shows them";
  }

  const PagePart& part_;
  Arrays arrays_;
  std::vector<Index> numbers_;
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<int> regions_;
  std::string added_, note_;
};

}  // namespace

std::vector<Entry> entries_of(const Page& page) {
  std::vector<Entry> entries;
  for (std::size_t part = 0; part < page.parts.size(); ++part) {
    const PagePart& of = page.parts[part];
    if (of.volume != nullptr) continue;
    if (of.summary != nullptr) {
      for (const DefectGroup& group : of.summary->groups)
        entries.push_back({part, group.message, Entry::Kind::cause, {}, {}, {}, group.worst});
      for (std::size_t i = 0; i < std::min(of.summary->gaps.size(), kMostEntries); ++i) {
        const Gap& gap = of.summary->gaps[i];
        entries.push_back({part, gap.message, Entry::Kind::gap, {&gap.vertex, 1}, {}, {}, {}});
      }
    }
    for (std::size_t i = 0; i < std::min(of.defects.size(), kMostEntries); ++i) {
      const Defect& d = of.defects[i];
      entries.push_back({part, d.message, Entry::Kind::defect, d.vertices, d.facets, d.segments, d.where});
    }
  }
  return entries;
}

std::string packed(const Page& page, const std::vector<Entry>& entries, std::size_t most_tetrahedra,
                   io::Watch& watch) {
  std::vector<PartWriter> writers;
  writers.reserve(page.parts.size());  // they point into themselves
  for (const PagePart& part : page.parts) writers.emplace_back(part, most_tetrahedra);
  const std::string header = "{\"title\":" + json(page.title) + ",\"parts\":" +
                             list_json(writers, [](const PartWriter& writer) { return writer.header(); }) +
                             ",\"entries\":" + list_json(entries, entry_json) + "}";
  Packed out(watch);
  std::string size;
  for (unsigned k = 0; k < 4; ++k) size += static_cast<char>(header.size() >> (8 * k) & 0xFF);
  out.bytes(size);
  out.bytes(header);
  for (const PartWriter& writer : writers) writer.write(out);
  return out.finish();
}

}  // namespace holdfast::view
