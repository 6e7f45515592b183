// Holdfast: reading surfaces, reading and writing volumes.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "holdfast/export.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

/// A file that cannot be read or written: what, where in it, and why.
class HOLDFAST_API FileError : public std::runtime_error {
 public:
  FileError(std::filesystem::path path, std::string where, const std::string& reason, int error_number = 0)
      : std::runtime_error(path.string() + (where.empty() ? "" : ": " + where) + ": " + reason),
        path_(std::move(path)),
        where_(std::move(where)),
        error_number_(error_number) {}
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Place in the file: "line 12", "byte 84", "cell 3", in JSON "/meshes/0/name", or empty if the error
  /// concerns the whole file.
  [[nodiscard]] const std::string& where() const { return where_; }
  /// The system's number of the error (`errno`), or 0 if the system let the file be read or written.
  [[nodiscard]] int error_number() const { return error_number_; }

 private:
  std::filesystem::path path_;
  std::string where_;
  int error_number_;
};

/// The open descriptor of this process that a path names directly, without following links: "/dev/stdin",
/// "/dev/stdout", "/dev/stderr", "/dev/fd/N". Functions here read a descriptor from its current position and
/// write straight to it, as with pipes and devices, because there is no file to rename.
[[nodiscard]] HOLDFAST_API std::optional<int> descriptor_of(const std::filesystem::path& path);

/// Limits and progress of reading a file. All readers throw Interrupted for their limits.
struct ReadOptions : Limits {
  std::string format;  ///< overrides the extension: ".stl", ...
  ProgressFunction progress = {};
  /// How far, in the file's unit, corners of a facet of several polygons or with holes (.poly) may lie from
  /// its mean plane, and those of polygons in read_planes from theirs; 0: as far as the rounding of
  /// coordinates to six digits or to single precision explains. Single polygons need no plane elsewhere.
  double tolerance = 0;
  /// read_planes: arcs of a .dxf become straight pieces of at most this many degrees, 0.1 to 120; 0: arcs are
  /// refused.
  double arc_step = 0;
};

/// Reads a surface; the format follows the extension unless `format` (".stl", ...) is given.
///
/// .off, .stl, .obj, .ply, .3mf, .amf, .gltf, .glb, .wrl (VRML), .dae, .ts (GOCAD), .gts, .dxf, .ac (AC3D),
/// .3ds, .gii (GIFTI), .freesurfer (also .pial, .white and others of its endings),
/// .mesh, .meshb (GMF), .poly, .smesh, .node (TetGen), .vtu, .vtp, .vtk, .msh (1, 2.x, 3, 4.0, 4.1), ASCII
/// and binary where the format has both; each also compressed by gzip (.stl.gz). Lengths are in the file's
/// own unit.
/// - Coordinates keep their bits, including -0 and numbers that are not finite (`diagnose` reports them).
/// - Vertices keep their indices, including vertices with identical coordinates (`mesh` and all else count
///   these as one, see Complex). But .stl has no indices: its distinct vertices are numbered in the order of
///   the file.
/// - A polygon of two corners is a segment (.off, .poly, .smesh, .ply). A polygon of one corner is just its
///   vertex. A convex polygon of more than three corners is fanned. Other polygons become constrained
///   Delaunay triangles as seen along their normal, plane or not. One whose sides cross becomes triangles of
///   least area, which may cross, too. A corner at the place of the corner before it does not count. Remarks
///   tell the largest distance from the plane, and how many cross. A facet of several polygons or with holes
///   (.poly) becomes triangles of the area that they enclose.
/// - Markers: references (.mesh, .meshb), boundary markers (.poly, .smesh), physical or else elementary
///   tags (.msh), the cell array "marker" (.vtu, .vtp, .vtk), solids (.stl), copies of objects (.3mf, .amf),
///   and more (docs/formats.md).
///   Of vertices: references, boundary markers, physical tags of point elements, the point array "marker".
///   Marker vectors are empty if all markers are 0.
/// - The largest volume V of a region (.poly, .smesh) becomes its size H = (6 sqrt(2) V)^(1/3), the edge of a
///   regular tetrahedron of that volume.
/// - Tetrahedra in the file are left out; .poly and .smesh may also fill `holes` and `regions`.
/// - `remarks` list what the file holds and a surface does not.
/// Indices in the result are always in range. No other rule of `diagnose` is checked.
/// Throws FileError, also for a file without vertices.
[[nodiscard]] HOLDFAST_API Surface read_surface(const std::filesystem::path& path,
                                                const ReadOptions& options = {});
[[nodiscard]] HOLDFAST_API Surface read_surface(const std::filesystem::path& path, std::string_view format);

/// Reads a volume: .vtu, .vtk, .mesh, .meshb, .msh, .node, .ele, .face, .edge (TetGen) side by side, and the
/// other formats of `readable_volume_formats` (docs/formats.md); each also compressed by gzip.
///
/// Region ids are references (.mesh, .meshb), the cell array "region" (.vtu, .vtk), physical or else
/// elementary tags (.msh), the first attribute (.ele), or otherwise 0. Vertices of .msh are ordered by
/// node tag. Indices are checked to be in range. Positive volumes and the rest of the promise are not checked
/// (see `check`). `remarks` receives what the file holds and a volume does not. Throws FileError.
[[nodiscard]] HOLDFAST_API Volume read_volume(const std::filesystem::path& path,
                                              const ReadOptions& options = {},
                                              std::vector<Remark>* remarks = nullptr);
[[nodiscard]] HOLDFAST_API Volume read_volume(const std::filesystem::path& path, std::string_view format);

/// Reads points: an .xyz text (three numbers per line; the rest of the line is ignored), or the vertices of
/// any file that `read_surface` reads. Throws FileError.
[[nodiscard]] HOLDFAST_API std::vector<Point> read_points(const std::filesystem::path& path,
                                                          const ReadOptions& options = {});
[[nodiscard]] HOLDFAST_API std::vector<Point> read_points(const std::filesystem::path& path,
                                                          std::string_view format);

/// Concatenates surfaces into one; indices are shifted. If surface i has no facet markers, its facets get the
/// next free number, from 1, and the name `names[i]` if there is one. A marker that an earlier surface uses
/// under another name gets the next free number, too, and a remark says so. If surfaces use one name for
/// different markers, `names[i]` and a dot are put before the name. If a region has several names, the first
/// counts.
[[nodiscard]] HOLDFAST_API Surface join(std::span<const Surface> parts,
                                        std::span<const std::string> names = {});

/// The surface of a volume, for meshing it again: its facets and segments with their markers and names, then
/// all other faces on its boundary and between regions, seen from outside. Only the vertices that these use
/// are kept, in their order. Throws std::invalid_argument if regions or indices do not fit the volume.
[[nodiscard]] HOLDFAST_API Surface surface_of(const Volume& volume);

struct WriteOptions : Limits {
  bool compress = true;     ///< .vtu: zlib blocks
  bool legacy_msh = false;  ///< .msh: version 2.2 instead of 4.1
  bool binary = false;      ///< .msh: numbers as bytes
  bool one_file = false;    ///< .vtu, .xdmf: facets and segments in the same file, not in a second one
  bool gzip = false;        ///< OpenFOAM: compresses files, whose names then end with .gz
  bool shells = false;      ///< .inp: facets as shell elements, too
  unsigned threads = 1;     ///< for compression; 0: all available; the file is the same
  std::string format;       ///< overrides the extension
  ProgressFunction progress = {};
};

/// Writes a volume to a temporary name and renames the file, so that no partial file is ever left. Throws
/// Interrupted for its limits, and an older file of this name is then unchanged.
///
/// .vtu (appended raw data, with `input_vertices` as the point array "input_vertex"), .vtk (ASCII), .mesh,
/// .meshb (GMF), .msh, .node (with .ele, .face and .edge; vertices from 0). Coordinates read back bit for
/// bit, also from text. Vertices, and the corners of tetrahedra and facets, keep their order; .msh 4.1 groups
/// the entities by marker. Throws FileError, and std::invalid_argument if an index is not that of a vertex,
/// or if there are some regions, markers or input vertices, but not one per entity. See `not_held`.
HOLDFAST_API void write_volume(const std::filesystem::path& path, const Volume& volume,
                               const WriteOptions& options = {});

/// What a file of `write_volume` cannot hold unchanged, so that other programs or `read_volume` get something
/// else. Empty for .vtu, .vtk, .mesh, .meshb and .node, which hold everything. In .msh, Gmsh
/// does not accept negative ids as ids, and version 4.1 changes the order of entities.
[[nodiscard]] HOLDFAST_API std::vector<Remark> not_held(const std::filesystem::path& path,
                                                        const Volume& volume,
                                                        const WriteOptions& options = {});

/// Wanted lengths of edges, or metrics in which edges should have length 1, at the vertices of a background
/// mesh.
struct SizeField {
  std::vector<Point> vertices;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<double> sizes;    ///< one per vertex, or none
  std::vector<Metric> metrics;  ///< one per vertex, if there are no sizes
};

/// Reads a size field: .mesh or .meshb and the .sol or .solb beside it (or one of these), .vtu with a point
/// array "size" or "metric", .mtr (TetGen) with the .node and .ele beside it, .pos (Gmsh, parsed, scalars or
/// tensors on tetrahedra). A .mtr without .ele holds sizes for the vertices of a surface; the field then has
/// sizes only.
/// - Metrics are symmetric tensors of type 3 (.sol), of 6 columns (.mtr), both m11 m12 m22 m13 m23 m33; of 6
///   components (.vtu, xx yy zz xy yz xz as in VTK); or full 3 x 3 ones (.vtu with 9 components, .pos TT).
/// Throws FileError, also for coordinates that are not finite, sizes that are not positive and tensors that
/// are not positive definite.
[[nodiscard]] HOLDFAST_API SizeField read_size_field(const std::filesystem::path& path,
                                                     const ReadOptions& options = {});

/// The size at a point, for `Sizes::field`: linear in each tetrahedron of the field; 0 (no limit) outside.
/// Throws std::invalid_argument for a field without a size for every vertex, and for numbers that are not
/// finite.
[[nodiscard]] HOLDFAST_API std::function<double(const Point&)> size_function(SizeField field);

/// The metric at a point, for `Sizes::metric`: its logarithm is linear in each tetrahedron of the field; zero
/// (no limit) outside. Throws std::invalid_argument for a field without a positive definite tensor for every
/// vertex, and for coordinates that are not finite.
[[nodiscard]] HOLDFAST_API std::function<Metric(const Point&)> metric_function(SizeField field);

/// Writes bytes to a file. The file appears under its name complete or not at all, as every file here does.
/// Throws FileError.
HOLDFAST_API void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// The files that `read_surface` looks for, given a path: often that file alone. They need not exist.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_surface(
    const std::filesystem::path& path, std::string_view format = {});
/// The same for `read_volume` and `write_volume`: .node, .ele, .face and .edge go together.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_volume(
    const std::filesystem::path& path, std::string_view format = {});
/// The same for `read_size_field`: the mesh and its .sol, the .mtr and its .node.
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_size_field(
    const std::filesystem::path& path);

/// Extensions that `write_volume` knows, with the dot, in lower case. ".openfoam" stands for a folder
/// polyMesh, or for a case with such a folder in its folder constant.
[[nodiscard]] HOLDFAST_API std::vector<std::string> volume_formats();
/// Extensions that `read_volume` knows.
[[nodiscard]] HOLDFAST_API std::vector<std::string> readable_volume_formats();
/// The extension by which a volume of this name is written. It may be none of the above.
[[nodiscard]] HOLDFAST_API std::string volume_format_of(const std::filesystem::path& path,
                                                        std::string_view format = {});

/// Writes the places of defects as points and lines for a viewer: a .vtu file, whatever its name.
///
/// Cell arrays: "kind" (the DefectKind's number) and "defect" (index into `defects`). A defect without
/// places is marked by its vertices, segments and sides of facets. Throws FileError.
HOLDFAST_API void write_marks(const std::filesystem::path& path, const Complex& complex,
                              std::span<const Defect> defects);

}  // namespace holdfast
