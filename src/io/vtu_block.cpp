#include "io/vtu_block.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "io/labels.h"
#include "io/pieces.h"
#include "io/vtk_cells.h"

namespace holdfast::io {
namespace {

bool is_integer(const DataArray& array) {
  return array.tag.attribute("type").find("Int") != std::string::npos;
}

bool is_scalar_integer(const DataArray& array) {
  const std::string components = array.tag.attribute("NumberOfComponents");
  return is_integer(array) && (components.empty() || components == "1");
}

/// The cells' array `own`, or else the first integer array of `others`; empty if there is none.
std::string array_of(const VtuFile& file, const std::string& own, std::span<const std::string_view> others) {
  if (file.find("CellData/" + own)) return "CellData/" + own;
  for (const std::string_view other : others) {
    const std::string name = "CellData/" + std::string(other);
    if (const DataArray* array = file.find(name); array != nullptr && is_scalar_integer(*array)) return name;
  }
  return {};
}

std::vector<Point> read_points(const VtuFile& file) {
  if (file.points() > std::numeric_limits<Index>::max())
    throw FileError(file.source().path, "", "more points than 32 bits count");
  if (file.points() == 0) return {};
  return points_of(file.values<double>("Points/", 3 * file.points()));
}

/// Reads names of ids, and whether there should be a second file.
void read_fields(const VtuFile& file, VtuBlock& block, VtkGrid& grid) {
  VtkNames names;
  for (const auto& [path, array] : file.arrays()) {
    if (!path.starts_with("FieldData/") || !is_integer(array)) continue;
    const std::string name = array.tag.attribute("Name");
    if (name == kSurfaceBeside)
      block.surface_beside = true;
    else if (name != kInterfaces)
      names.add(name, file.values<std::int64_t>(path, std::nullopt));
  }
  grid.names = names.take();
}

/// Whether an array describes the file as a piece of a whole.
bool is_of_pieces(const std::string& name) {
  const auto is_one_of = [&](const auto& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return name == "part" || name == "vtkGhostType" || is_one_of(kPointIds) || is_one_of(kCellIds);
}

void read_tags(const VtuFile& file, VtuGhosts ghosts, VtuBlock& block, VtkGrid& grid) {
  const std::string regions = array_of(file, "region", kRegionArrays),
                    markers = array_of(file, "marker", kMarkerArrays);
  for (const auto& [path, array] : file.arrays()) {
    const bool of_points = path.starts_with("PointData/");
    const std::string name = array.tag.attribute("Name");
    if ((of_points || path.starts_with("CellData/")) && !is_known_array(name) && path != regions &&
        path != markers && !(ghosts == VtuGhosts::left_out && is_of_pieces(name)))
      grid.other_arrays.push_back(name);
  }
  const std::vector<std::string>& strings = file.arrays_of_strings();
  grid.other_arrays.insert(grid.other_arrays.end(), strings.begin(), strings.end());
  if (!regions.empty()) grid.regions = file.values<int>(regions, file.cells());
  if (!markers.empty()) grid.markers = file.values<int>(markers, file.cells());
  if (file.find("PointData/marker")) grid.point_markers = file.values<int>("PointData/marker", file.points());
  if (const std::string name = std::string("PointData/") + kVolumeVertex; file.find(name))
    block.in_volume = file.values<std::int64_t>(name, file.points());
  read_fields(file, block, grid);
}

/// The number of corners of cells with these ends; whether the ends ascend is checked later.
std::uint64_t last_end(const std::vector<std::int64_t>& ends) {
  return ends.empty() || ends.back() < 0 ? 0 : static_cast<std::uint64_t>(ends.back());
}

void read_cells(const VtuFile& file, VtkGrid& grid) {
  grid.types = file.values<std::uint8_t>("Cells/types", file.cells());
  grid.ends = file.values<std::int64_t>("Cells/offsets", file.cells());
  grid.connectivity = file.values<std::int64_t>("Cells/connectivity", last_end(grid.ends));
}

void read_polydata(const VtuFile& file, VtkGrid& grid) {
  struct Section {
    const char* name;
    VtkCell type;
  };
  constexpr Section kSections[] = {{"Verts", VtkCell::poly_vertex},
                                   {"Lines", VtkCell::poly_line},
                                   {"Polys", VtkCell::polygon},
                                   {"Strips", VtkCell::triangle_strip}};
  // In the order of the cell data.
  for (const Section& section : kSections) {
    const std::string name = section.name;
    if (!file.find(name + "/offsets")) continue;
    VtkGrid part;
    part.ends = file.values<std::int64_t>(name + "/offsets", file.cells_of(name));
    part.connectivity = file.values<std::int64_t>(name + "/connectivity", last_end(part.ends));
    for (const std::int64_t end : part.ends)
      if (end < 0 || static_cast<std::uint64_t>(end) > part.connectivity.size())
        throw FileError(file.source().path, "", "an offset of " + name + " is out of range");
    part.types.assign(part.ends.size(), static_cast<std::uint8_t>(section.type));
    append_cells(grid, part);
  }
}

/// The first of these arrays that has one integer per entry; empty if there is none.
std::vector<std::int64_t> ids_of(const VtuFile& file, const std::string& section, std::uint64_t count,
                                 std::span<const char* const> names) {
  for (const std::string name : names)
    if (const DataArray* array = file.find(section + name); array != nullptr && is_scalar_integer(*array))
      return file.values<std::int64_t>(section + name, count);
  return {};
}

constexpr const char* kGhosts = "CellData/vtkGhostType";

/// Drops the cells of other pieces, and returns for each cell of the file whether it stays.
std::vector<std::uint8_t> leave_out_ghosts(const VtuFile& file, VtkGrid& grid) {
  constexpr std::uint8_t kDuplicateCell = 1;
  std::vector<std::uint8_t> stays(grid.types.size(), 1);
  if (file.find(kGhosts) == nullptr) return stays;
  const auto types = file.values<std::uint8_t>(kGhosts, file.cells());
  VtkGrid own;
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < grid.types.size(); begin = grid.ends[c++]) {
    stays[c] = (types[c] & kDuplicateCell) == 0 ? 1 : 0;
    if (stays[c] == 0) continue;
    if (begin < 0 || grid.ends[c] < begin ||
        static_cast<std::uint64_t>(grid.ends[c]) > grid.connectivity.size())
      throw FileError(file.source().path, "cell " + std::to_string(c), "its offset is out of range");
    own.connectivity.insert(own.connectivity.end(), grid.connectivity.begin() + begin,
                            grid.connectivity.begin() + grid.ends[c]);
    own.ends.push_back(static_cast<std::int64_t>(own.connectivity.size()));
    own.types.push_back(grid.types[c]);
    if (!grid.regions.empty()) own.regions.push_back(grid.regions[c]);
    if (!grid.markers.empty()) own.markers.push_back(grid.markers[c]);
  }
  grid.types = std::move(own.types);
  grid.ends = std::move(own.ends);
  grid.connectivity = std::move(own.connectivity);
  grid.regions = std::move(own.regions);
  grid.markers = std::move(own.markers);
  return stays;
}

void read_ids(const VtuFile& file, VtuGhosts ghosts, VtuBlock& block, VtkGrid& grid) {
  block.point_ids = ids_of(file, "PointData/", file.points(), kPointIds);
  std::vector<std::int64_t> cells = ids_of(file, "CellData/", file.cells(), kCellIds);
  std::vector<std::uint8_t> stays(grid.types.size(), 1);
  if (ghosts == VtuGhosts::left_out) stays = leave_out_ghosts(file, grid);
  const auto tetrahedron = static_cast<std::uint8_t>(VtkCell::tetrahedron);
  if (cells.empty() || std::any_of(grid.types.begin(), grid.types.end(),
                                   [&](std::uint8_t type) { return type != tetrahedron; }))
    return;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (stays[c] != 0) block.tetrahedron_ids.push_back(cells[c]);
}

}  // namespace

VtuBlock read_vtu_block(const VtuFile& file, VtuGhosts ghosts) {
  VtuBlock block;
  VtkGrid grid;
  grid.points = read_points(file);
  if (file.is_polydata())
    read_polydata(file, grid);
  else if (file.cells() > 0)
    read_cells(file, grid);
  if (file.is_polydata() || file.cells() > 0) read_tags(file, ghosts, block, grid);
  if (!file.is_polydata()) read_ids(file, ghosts, block, grid);
  block.mesh = mesh_of(file.source(), std::move(grid));
  return block;
}

PointArray point_array(const VtuFile& file, std::span<const char* const> names) {
  std::string known;
  for (const std::string name : names) {
    known += (known.empty() ? "" : " or ") + in_quotes(name);
    const DataArray* const array = file.find("PointData/" + name);
    if (array == nullptr) continue;
    const std::uint64_t components = file.components(*array);
    return {static_cast<std::size_t>(components),
            file.values<double>("PointData/" + name, components * file.points())};
  }
  throw FileError(file.source().path, "", "the points have no array " + known);
}

}  // namespace holdfast::io
