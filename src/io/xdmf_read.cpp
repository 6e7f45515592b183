// Reads XDMF 2 and 3 (xdmf.org, "XDMF model and format"): grids with their arrays in HDF5 or in the text, as
// Holdfast, DOLFINx, meshio and ParaView write them. Of a collection in time the first grid counts.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <system_error>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/hdf5_read.h"
#include "io/labels.h"
#include "io/text_reader.h"
#include "io/vtk_cells.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

/// An element of the file and its text, up to the next tag.
struct Item {
  XmlTag tag;
  std::string_view text;
};

struct Attribute {
  XmlTag tag;
  std::vector<Item> items;
};

struct Grid {
  XmlTag tag;
  std::optional<XmlTag> topology, geometry;
  std::vector<Item> cells, points;
  std::vector<Attribute> attributes;
  bool takes_topology = false;  ///< by xi:include from the first grid
};

struct Shape {
  std::string_view name, short_name;
  std::int64_t number;  ///< in mixed topologies
  VtkCell cell;
  std::size_t corners;  ///< 0: as NodesPerElement, or the cell itself, says
};

constexpr Shape kShapes[] = {
    {"polyvertex", "", 1, VtkCell::poly_vertex, 0},
    {"polyline", "", 2, VtkCell::poly_line, 0},
    {"polygon", "", 3, VtkCell::polygon, 0},
    {"triangle", "", 4, VtkCell::triangle, 3},
    {"quadrilateral", "", 5, VtkCell::quad, 4},
    {"tetrahedron", "", 6, VtkCell::tetrahedron, 4},
    {"edge_3", "", 34, VtkCell::quadratic_edge, 3},
    {"triangle_6", "tri_6", 36, VtkCell::quadratic_triangle, 6},
    {"tetrahedron_10", "tet_10", 38, VtkCell::quadratic_tetrahedron, 10},
};

bool is_volume(std::uint8_t type) {
  return type == static_cast<std::uint8_t>(VtkCell::tetrahedron) ||
         type == static_cast<std::uint8_t>(VtkCell::quadratic_tetrahedron);
}

class XdmfReader {
 public:
  explicit XdmfReader(const Source& source) : source_(source), xml_(source) {}

  MeshData read() {
    read_grids();
    if (grids_.empty()) throw FileError(source_.path, "", "the file has no grid of points and cells");
    read_points();
    for (Grid& grid : grids_) read_cells(grid);
    grid_.names = names_.take();
    if (surface_is_beside_) read_surface_beside();
    settle_tags();
    return mesh_of(source_, std::move(grid_));
  }

 private:
  // The text behind a tag; entities are left as they are, which numbers and names of arrays do not have.
  [[nodiscard]] std::string_view text_behind() const {
    const std::size_t begin = xml_.position();
    return source_.bytes.substr(begin,
                                std::min(source_.bytes.find('<', begin), source_.bytes.size()) - begin);
  }

  void read_grids() {
    bool is_xdmf = false, ended = false, in_time = false;
    std::vector<Item>* items = nullptr;
    while (const std::optional<XmlTag> tag = xml_.next()) {
      beat(source_.watch);
      if (tag->name == "Xdmf") {
        is_xdmf = true;
        ended = tag->closing;
      } else if (tag->name == "Grid" && !tag->closing) {
        const std::string kind = lower(tag->attribute("GridType"));
        if (kind == "collection" || kind == "tree") {
          in_time = in_time || lower(tag->attribute("CollectionType")) == "temporal";
          continue;
        }
        grids_.push_back({*tag, {}, {}, {}, {}, {}, false});
      } else if (grids_.empty()) {
        continue;
      } else if (tag->name == "Topology" && !tag->closing) {
        grids_.back().topology = *tag;
        items = &grids_.back().cells;
      } else if (tag->name == "Geometry" && !tag->closing) {
        grids_.back().geometry = *tag;
        items = &grids_.back().points;
      } else if (tag->name == "Attribute" && !tag->closing) {
        grids_.back().attributes.push_back({*tag, {}});
        items = &grids_.back().attributes.back().items;
      } else if (tag->name == "Topology" || tag->name == "Geometry" || tag->name == "Attribute") {
        items = nullptr;
      } else if (tag->name == "DataItem" && !tag->closing && items != nullptr) {
        items->push_back({*tag, text_behind()});
      } else if (tag->name == "include" || tag->name == "xi:include") {
        if (tag->attribute("xpointer").find("Topology") != std::string::npos)
          grids_.back().takes_topology = true;
      } else if (tag->name == "map" && !tag->closing) {
        read_name(*tag);
      }
    }
    if (!is_xdmf) throw FileError(source_.path, "", "not an XDMF file: it has no Xdmf element");
    if (!ended) throw FileError(source_.path, "", "the file does not end with </Xdmf>; it is truncated");
    std::erase_if(grids_, [](const Grid& grid) { return !grid.topology && !grid.takes_topology; });
    if (in_time && grids_.size() > 1) {
      left_out_ = grids_.size() - 1;
      grids_.resize(1);
    }
  }

  /// A name of an id, as meshio has them: <map key="inlet" dim="2">3</map>.
  void read_name(const XmlTag& tag) {
    const std::string key = tag.attribute("key");
    if (key == kSurfaceBeside) {
      surface_is_beside_ = true;
      return;
    }
    std::array<std::int64_t, 2> pair{};
    const auto integer = [](std::string_view text, std::int64_t& value) {
      return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
    };
    if (integer(text_behind(), pair[0]) && integer(tag.attribute("dim"), pair[1])) names_.add(key, pair);
  }

  /// The file of an HDF5 item, which stays open, and the array in it.
  std::pair<const Hdf5File*, Hdf5File::Object> array_of(const Item& item) {
    std::string_view text = item.text;
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) xml_.fail(item.tag, "the item names no array");
    text = text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos || colon == 0) xml_.fail(item.tag, "FILE.h5:/ARRAY is expected");
    const std::string name = unescaped(text.substr(0, colon));
    auto found = heavy_.find(name);
    if (found == heavy_.end()) {
      const std::filesystem::path path = source_.path.parent_path() / name;
      auto heavy = std::make_unique<Heavy>(path, source_.watch);
      found = heavy_.emplace(name, std::move(heavy)).first;
    }
    const Hdf5File& file = found->second->file;
    const std::optional<Hdf5File::Object> array = file.find(file.root(), text.substr(colon + 1));
    if (!array) xml_.fail(item.tag, "there is no array " + in_quotes(text.substr(colon + 1)) + " in " + name);
    return {&file, *array};
  }

  [[nodiscard]] std::uint64_t dimensions_of(const Item& item) const {
    std::uint64_t count = 1;
    const std::string text = item.tag.attribute("Dimensions");
    std::size_t numbers = 0;
    for (const char *at = text.data(), *end = at + text.size(); at < end;) {
      if (*at == ' ') {
        ++at;
        continue;
      }
      std::uint64_t value = 0;
      const auto [stop, error] = std::from_chars(at, end, value);
      if (error != std::errc() || (value != 0 && count > std::uint64_t{1} << 40) ||
          value > std::uint64_t{1} << 40 || (value != 0 && count > (std::uint64_t{1} << 62) / value))
        xml_.fail(item.tag, "the attribute Dimensions is no list of counts: " + in_quotes(text));
      count *= value;
      ++numbers;
      at = stop;
    }
    if (numbers == 0) xml_.fail(item.tag, "the item has no Dimensions");
    return count;
  }

  template <typename T>
  std::vector<T> values_of(const std::vector<Item>& items, const XmlTag& of) {
    const auto real = std::find_if(items.begin(), items.end(), [](const Item& item) {
      const std::string kind = lower(item.tag.attribute("ItemType"));
      return kind.empty() || kind == "uniform";
    });
    if (real == items.end()) xml_.fail(of, "there are no values in it that can be read");
    const std::uint64_t count = dimensions_of(*real);
    const std::string format = lower(real->tag.attribute("Format"));
    std::vector<T> values;
    if (format == "hdf" || format == "hdf5") {
      const auto [file, array] = array_of(*real);
      if constexpr (std::is_same_v<T, double>)
        values = file->reals(array);
      else
        values = file->integers(array);
    } else if (format == "xml" || format.empty()) {
      TextReader text(
          {source_.path,
           source_.bytes.substr(
               0, static_cast<std::size_t>(real->text.data() + real->text.size() - source_.bytes.data())),
           source_.finite, source_.watch},
          '\0');
      text.seek(static_cast<std::size_t>(real->text.data() - source_.bytes.data()));
      while (!text.at_end()) {
        if constexpr (std::is_same_v<T, double>)
          values.push_back(text.real("a number"));
        else
          values.push_back(text.integer("an integer"));
      }
    } else {
      xml_.fail(real->tag, "values of the format " + in_quotes(format) + " are not read; HDF and XML are");
    }
    if (values.size() != count)
      xml_.fail(real->tag, "there are " + std::to_string(values.size()) + " values, but Dimensions say " +
                               std::to_string(count));
    return values;
  }

  // All grids have the points of the first, as those of cells, facets and edges of one mesh do.
  void read_points() {
    const auto with =
        std::find_if(grids_.begin(), grids_.end(), [](const Grid& g) { return g.geometry.has_value(); });
    if (with == grids_.end()) throw FileError(source_.path, "", "no grid has a Geometry");
    const std::string kind = lower(with->geometry->attribute("GeometryType"));
    const std::size_t dimension = kind == "xy" ? 2 : 3;
    if (!kind.empty() && kind != "xyz" && kind != "xy")
      xml_.fail(*with->geometry, "points of the kind " + in_quotes(kind) + " are not read; XYZ are");
    const std::vector<double> values = values_of<double>(with->points, *with->geometry);
    if (values.size() % dimension != 0) xml_.fail(*with->geometry, "the last point is not whole");
    if (values.size() / dimension >= no_entity) xml_.fail(*with->geometry, "more points than 32 bits count");
    const auto bad = std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
    if (bad != values.end())
      xml_.fail(*with->geometry,
                "point " + std::to_string(static_cast<std::size_t>(bad - values.begin()) / dimension) +
                    " has a coordinate that is not finite");
    for (std::size_t i = 0; i < values.size(); i += dimension)
      grid_.points.push_back({values[i], values[i + 1], dimension == 3 ? values[i + 2] : 0});
    for (const Grid& grid : grids_) {
      if (&grid == &*with || !grid.geometry) continue;
      if (values_of<double>(grid.points, *grid.geometry) != values)
        xml_.fail(*grid.geometry,
                  "the grids of the file have different points, and are not read as one mesh");
    }
  }

  const Shape* shape_named(const std::string& name) const {
    const auto found = std::find_if(std::begin(kShapes), std::end(kShapes), [&](const Shape& shape) {
      return name == shape.name || (!shape.short_name.empty() && name == shape.short_name);
    });
    return found == std::end(kShapes) ? nullptr : found;
  }

  void add_cell(VtkCell type, const std::int64_t* corners, std::size_t count) {
    grid_.types.push_back(static_cast<std::uint8_t>(type));
    grid_.connectivity.insert(grid_.connectivity.end(), corners, corners + count);
    grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
  }

  void read_cells(const Grid& grid) {
    const std::size_t first = grid_.types.size();
    if (!grid.topology) {  // attributes of the first grid's cells
      if (&grid == &grids_.front()) xml_.fail(grid.tag, "the grid has no Topology");
      std::vector<std::size_t> cells(first_cells_);
      std::iota(cells.begin(), cells.end(), std::size_t{0});
      return read_attributes(grid, cells);
    }
    const XmlTag& tag = *grid.topology;
    std::string name = lower(tag.attribute("TopologyType"));
    if (name.empty()) name = lower(tag.attribute("Type"));
    const std::vector<std::int64_t> nodes = values_of<std::int64_t>(grid.cells, tag);
    if (name == "mixed") {
      read_mixed(tag, nodes);
    } else {
      const Shape* const shape = shape_named(name);
      if (shape == nullptr)
        xml_.fail(tag, "cells of the type " + in_quotes(name) +
                           " are not read; split them into triangles or tetrahedra");
      std::size_t corners = shape->corners;
      if (corners == 0) {
        corners = tag.attribute("NodesPerElement").empty()
                      ? 1 + (shape->cell == VtkCell::poly_line)
                      : static_cast<std::size_t>(xml_.number(tag, "NodesPerElement"));
        if (corners == 0) xml_.fail(tag, "cells without corners");
      }
      if (nodes.size() % corners != 0) xml_.fail(tag, "the last cell is not whole");
      for (std::size_t i = 0; i < nodes.size(); i += corners) add_cell(shape->cell, &nodes[i], corners);
    }
    const std::size_t count = grid_.types.size() - first;
    const std::string announced = tag.attribute("NumberOfElements");
    if (!announced.empty() && announced.find_first_not_of("0123456789") == std::string::npos &&
        xml_.number(tag, "NumberOfElements") != count)
      xml_.fail(tag, "there are " + std::to_string(count) + " cells, but NumberOfElements says " + announced);
    if (&grid == &grids_.front()) first_cells_ = count;
    std::vector<std::size_t> cells = take_off_known(first);
    if (cells.empty()) {
      cells.resize(count);
      std::iota(cells.begin(), cells.end(), first);
    }
    read_attributes(grid, cells);
  }

  void read_mixed(const XmlTag& tag, const std::vector<std::int64_t>& nodes) {
    for (std::size_t i = 0; i < nodes.size();) {
      beat(source_.watch);
      const auto shape = std::find_if(std::begin(kShapes), std::end(kShapes),
                                      [&](const Shape& s) { return s.number == nodes[i]; });
      if (shape == std::end(kShapes))
        xml_.fail(tag, "cells of the type " + std::to_string(nodes[i]) +
                           " are not read; split them into triangles or tetrahedra");
      std::size_t corners = shape->corners;
      ++i;
      if (corners == 0) {
        if (i == nodes.size() || nodes[i] < 1 || static_cast<std::uint64_t>(nodes[i]) > nodes.size())
          xml_.fail(tag, "a cell has no number of corners");
        corners = static_cast<std::size_t>(nodes[i++]);
      }
      if (corners > nodes.size() - i) xml_.fail(tag, "the last cell is not whole");
      add_cell(shape->cell, &nodes[i], corners);
      i += corners;
    }
  }

  // Ids of the cells: of tetrahedra the region, of what else there is the marker.
  void read_attributes(const Grid& grid, const std::vector<std::size_t>& cells) {
    const auto is_ids = [&](const Attribute& a) {
      const std::string center = lower(a.tag.attribute("Center"));
      return !a.items.empty() && (center == "cell" || center.empty()) && holds_integers(a.items.front());
    };
    const Attribute* ids = nullptr;
    const auto rank_of = [&](const Attribute& a) {
      const std::string name = a.tag.attribute("Name");
      if (name == "region" || name == "marker") return 0;
      const auto is_in = [&](const auto& known) {
        return std::find(known.begin(), known.end(), name) != known.end();
      };
      if (is_in(kRegionArrays) || is_in(kMarkerArrays)) return 1;
      return 2;
    };
    for (const Attribute& a : grid.attributes)
      if (is_ids(a) && (ids == nullptr || rank_of(a) < rank_of(*ids))) ids = &a;
    for (const Attribute& a : grid.attributes)
      if (&a != ids && rank_of(a) > 0) grid_.other_arrays.push_back(a.tag.attribute("Name"));
    if (ids == nullptr) return;
    const std::vector<std::int64_t> values = values_of<std::int64_t>(ids->items, ids->tag);
    if (values.size() != cells.size())
      xml_.fail(ids->tag, "there are " + std::to_string(values.size()) + " values for " +
                              std::to_string(cells.size()) + " cells");
    tags_.resize(grid_.types.size(), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!std::in_range<int>(values[i]))
        xml_.fail(ids->tag, "value " + std::to_string(i) + " is no id of 32 bits");
      tags_[cells[i]] = static_cast<int>(values[i]);
    }
  }

  /// What an item's type says, or the array itself where it says none, as DOLFINx's do not.
  bool holds_integers(const Item& item) {
    std::string type = item.tag.attribute("NumberType");
    if (type.empty()) type = item.tag.attribute("DataType");
    if (type.empty() && lower(item.tag.attribute("Format")) == "hdf") {
      const auto [file, array] = array_of(item);
      return file->holds_integers(array);
    }
    type = lower(type);
    return type.find("int") != std::string::npos || type == "char" || type == "uchar";
  }

  /// A grid of tetrahedra that an earlier one has lists the tags of these, in whatever order: then they are
  /// taken off again, and the result is which ones they are.
  std::vector<std::size_t> take_off_known(std::size_t first) {
    std::vector<std::size_t> known;
    const auto key_of = [&](std::size_t cell) {
      const std::int64_t begin = cell == 0 ? 0 : grid_.ends[cell - 1];
      std::array<std::int64_t, 4> key{};
      std::copy_n(grid_.connectivity.begin() + begin, 4, key.begin());
      std::sort(key.begin(), key.end());
      return key;
    };
    if (first == 0 || first == grid_.types.size()) return known;
    std::map<std::array<std::int64_t, 4>, std::size_t> cells;
    for (std::size_t i = 0; i < first; ++i)
      if (is_volume(grid_.types[i])) cells.emplace(key_of(i), i);
    for (std::size_t i = first; i < grid_.types.size(); ++i) {
      beat(source_.watch);
      const auto found = is_volume(grid_.types[i]) ? cells.find(key_of(i)) : cells.end();
      if (found == cells.end()) return {};
      known.push_back(found->second);
    }
    grid_.types.resize(first);
    grid_.ends.resize(first);
    grid_.connectivity.resize(static_cast<std::size_t>(grid_.ends.back()));
    return known;
  }

  void settle_tags() {
    tags_.resize(grid_.types.size(), 0);
    grid_.regions.resize(tags_.size(), 0);
    grid_.markers.resize(tags_.size(), 0);
    for (std::size_t i = 0; i < tags_.size(); ++i)
      (is_volume(grid_.types[i]) ? grid_.regions : grid_.markers)[i] = tags_[i];
    if (left_out_ > 0) grid_.other_arrays.push_back("grids of later times");
  }

  /// NAME_surface.xdmf, whose points are those of this file.
  void read_surface_beside() {
    const std::filesystem::path beside = surface_beside(without_gz(source_.path));
    std::error_code error;
    if (!std::filesystem::exists(beside, error)) {
      grid_.other_arrays.push_back("facets in " + beside.filename().string() + ", which is not there");
      return;
    }
    const FileBytes bytes(beside, source_.watch);
    XdmfReader reader({beside, bytes.view(), source_.finite, source_.watch});
    reader.read_grids();
    reader.read_points();
    if (reader.grid_.points != grid_.points)
      throw FileError(beside, "", "its points are not the volume's; the two files are not of one run");
    for (Grid& grid : reader.grids_) reader.read_cells(grid);
    tags_.resize(grid_.types.size(), 0);
    reader.tags_.resize(reader.grid_.types.size(), 0);
    append_cells(grid_, reader.grid_);
    tags_.insert(tags_.end(), reader.tags_.begin(), reader.tags_.end());
  }

  struct Heavy {
    Heavy(std::filesystem::path name, Watch* watch)
        : path(std::move(name)), bytes(path, watch), file({path, bytes.view(), false, watch}) {}
    std::filesystem::path path;
    FileBytes bytes;
    Hdf5File file;
  };

  Source source_;
  XmlReader xml_;
  std::vector<Grid> grids_;
  std::map<std::string, std::unique_ptr<Heavy>> heavy_;
  VtkGrid grid_;
  VtkNames names_;
  std::vector<int> tags_;  ///< one a cell
  std::size_t first_cells_ = 0, left_out_ = 0;
  bool surface_is_beside_ = false;
};

}  // namespace

MeshData read_xdmf(const Source& source) { return XdmfReader(source).read(); }

}  // namespace holdfast::io
