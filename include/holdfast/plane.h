// Holdfast: triangulates the plane and keeps every given segment.
//
// After P.L. George, H. Borouchaki, E. Saltel, "'Ultimate' robustness in meshing an arbitrary polyhedron"
// (Int. J. Numer. Meth. Engng 2003), §2, which gives three methods, each of them complete; and J. Ruppert, "A
// Delaunay refinement algorithm for quality 2-dimensional mesh generation" (J. Algorithms 1995).
#pragma once

#include <filesystem>
#include <map>
#include <span>

#include "holdfast/intermediate.h"
#include "holdfast/io.h"
#include "holdfast/types.h"

namespace holdfast {

/// x, y.
using PlanePoint = std::array<double, 2>;

/// Points and segments in the plane: any number of outlines, nested or not, holes, segments with free ends,
/// and points on no segment.
///
/// A valid input has finite coordinates and no two points at one place. Each segment has two different ends,
/// and meets other segments, points, holes and seeds only in common ends. There are as many markers as
/// entities, or none.
struct Plane {
  std::vector<PlanePoint> points;
  std::vector<Segment> segments;
  std::vector<int> point_markers, segment_markers;
  std::vector<PlanePoint> holes;  ///< the region of each is omitted; a hole in no region has no effect
  struct Seed {
    PlanePoint where;
    int id;
    double area = 0;  ///< largest area of a triangle of the region after refinement; 0: no limit
  };
  std::vector<Seed> regions;    ///< the region of each gets its id
  int base = 0;                 ///< the number of the first point and segment in the file, for messages
  std::vector<Remark> remarks;  ///< what the file also has
  Names names = {};             ///< of markers of segments and points, and as `facets` of regions
};

/// How missing segments are recovered.
enum class PlaneMethod {
  ears,       ///< §2.1: corners are cut off the outlines one by one
  swaps,      ///< §2.2: edges of the Delaunay triangles are swapped at random until the segments exist
  partition,  ///< §2.3: points are added where segments cross Delaunay edges, and removed by swaps
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneMethod method);

/// Which corner the method ears takes.
enum class PlaneEars {
  first,  ///< any corner that can be cut off
  best,   ///< the corner whose triangle is closest to a regular one
  join,   ///< any corner; if its triangle contains other vertices, its side is joined to the nearest of them,
          ///< which splits the polygon
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneEars ears);

/// Where a run may be stopped early.
enum class PlaneStage {
  delaunay,   ///< swaps and partition: the Delaunay triangles of all points
  partition,  ///< partition: every segment exists, in pieces, with all added points
  swap,       ///< swaps: after a given number of them
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneStage stage);

struct PlaneOptions : Limits {
  PlaneMethod method = PlaneMethod::swaps;
  PlaneEars ears = PlaneEars::first;
  /// Partition: added points are removed when all segments exist. By default they are removed after each
  /// segment, which takes fewer points.
  bool partition_first = false;
  /// Finally swaps edges (Lawson) until the triangles are constrained Delaunay.
  bool delaunay = false;
  /// Keeps everything within the convex hull except holes. Without segments this is always so.
  bool hull = false;
  /// Refinement (Ruppert): points are added until no edge is longer than `size` (0: no limit), no triangle is
  /// larger than its region's Seed::area, and no triangle has an angle below `angle` degrees, except at small
  /// angles between segments and opposite them. If `size` or `angle` is given, the triangles are
  /// constrained Delaunay. Refinement ends for every input if the angle is at most 26.45 degrees (Miller,
  /// Pav, Walkington 2003), and in practice up to about 33. If only a size is given, the angle is 20.
  double size = 0;
  std::optional<double> angle;
  /// Refinement adds points inside only, none on segments.
  bool keep_boundary = false;
  /// Largest number of points that refinement adds. It stops there, and the report says so.
  std::size_t max_points = 10'000'000;
  std::optional<PlaneStage> stop_after;
  std::size_t stop_after_swaps = 0;  ///< for PlaneStage::swap: the number of swaps
  /// Order of missing segments, for swaps and partition. By default each segment is near the one before it.
  std::optional<LayingOrder> order;
  std::uint64_t seed = 1;  ///< of the random orders
  ProgressFunction progress = {};
};

/// Figures of a run.
struct PlaneReport {
  std::size_t points = 0, segments = 0, holes = 0;  ///< of the input
  std::size_t missing_segments = 0;                 ///< in the Delaunay triangles; 0 for ears
  std::size_t swaps = 0;                            ///< until the segments existed
  std::size_t delaunay_swaps = 0;                   ///< until the triangles were constrained Delaunay
  std::size_t partition_points = 0;                 ///< added, and removed, by partition
  std::size_t most_partition_points = 0;            ///< of these, the most at one time
  std::size_t ears = 0;                             ///< triangles cut off
  std::size_t joined = 0;  ///< of these, those made with the reflex vertex nearest to a side
  std::size_t links = 0;   ///< between parts of an outline
  std::size_t triangles = 0, regions = 0;
  /// Holes in no region; seeds in no kept region, or in one with a later seed: numbers in the input. Of
  /// planes in space only if there is one.
  std::vector<Index> idle_holes, idle_seeds;
  std::size_t field_points = 0;    ///< added by refinement, on no segment
  std::size_t segment_points = 0;  ///< added by refinement, on segments
  /// Triangles below the bound at small angles of the input, or opposite them.
  std::size_t small_angles = 0;
  /// Other triangles below the bound: at kept segments, or after `max_points`.
  std::size_t small_angles_left = 0;
  std::size_t large_left = 0;             ///< triangles above the limits of size, for the same reasons
  bool capped = false;                    ///< refinement stopped at `max_points`
  double least_angle = 0;                 ///< of all triangles, in degrees, computed in doubles
  std::map<std::string, double> seconds;  ///< by stage, and "total"
};

/// Triangles in the plane. The points of the input come first, in order and bit for bit, then the added
/// points.
struct PlaneMesh {
  std::vector<PlanePoint> points;
  std::vector<Triangle> triangles;  ///< counterclockwise
  std::vector<int> regions;         ///< one per triangle: that of a seed, or the next free number from 1
  std::vector<Segment> segments;
  std::vector<int> point_markers, segment_markers;  ///< empty, or one per point and per segment
  /// For planes in space: the points, those of the input bit for bit. `points` is then empty.
  std::vector<Point> in_space = {};
  int base = 0;      ///< number of the first point and of the first triangle in .node and .ele
  Names names = {};  ///< those of the input
};

struct PlaneResult {
  Outcome outcome = Outcome::done;  ///< or invalid_input, or what Limits say
  PlaneMesh mesh;                   ///< empty unless `outcome` is done
  PlaneReport report;
  /// What makes the input invalid. Numbers count from 0, but in messages from `Plane::base`. `where` has z =
  /// 0.
  std::vector<Defect> defects;
  std::string message;        ///< one sentence when the outcome is not done
  Intermediate intermediate;  ///< if `PlaneOptions::stop_after` is set; only of segments
};

/// Triangulates every region that segments separate from the outside, except the regions of holes, and keeps
/// each segment in them. Only refinement adds points. A point on a segment is rounded to doubles and cuts the
/// segment into pieces, which carry its marker. Throws std::invalid_argument for markers of a wrong number,
/// for holes and seeds that are not finite, for a stage that the method does not have, and for a
/// size or angle (0 to 34 degrees) out of range, or refinement after a stage; std::length_error beyond 2^28
/// points.
[[nodiscard]] HOLDFAST_API PlaneResult triangulate(const Plane& plane, const PlaneOptions& options = {});

/// Outlines in planes in space: polygons, or facets of polygons and holes, of a surface's file.
struct PlanesInSpace {
  /// The points of the file; empty for a file of two dimensions, whose one plane is the file itself.
  std::vector<Point> points;
  struct Part {
    Plane plane;                 ///< as seen along an axis; no two of its points coincide in this projection
    std::vector<Index> numbers;  ///< of the plane's points in the file
    std::size_t axis = 2;
    Point normal{};       ///< of the mean plane, of any length
    bool turned = false;  ///< its first polygon, and so its triangles, are clockwise in this projection
  };
  std::vector<Part> parts;  ///< one part if everything is coplanar, otherwise one for each polygon or facet
  std::vector<Remark> remarks;  ///< what the file also has
  Names names = {};             ///< as in Plane
};

/// Triangulates each plane and returns the triangles of all planes together, oriented as their polygons.
/// Points that refinement adds lie in the plane up to rounding. Defects are numbered as in the file; `where`
/// is in space. Throws as the function above does, and std::invalid_argument if refinement would put points
/// on segments of several planes.
[[nodiscard]] HOLDFAST_API PlaneResult triangulate(const PlanesInSpace& planes,
                                                   const PlaneOptions& options = {});

/// All defects that make an input invalid, at most `most` of each kind.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Plane& plane, std::size_t most = SIZE_MAX);

/// Reads .poly (points, segments, holes and regions in Triangle's format; the points may be in a .node beside
/// it) or .node (only points). Throws FileError.
[[nodiscard]] HOLDFAST_API Plane read_plane(const std::filesystem::path& path,
                                            const ReadOptions& options = {});

/// Reads the same files, and polygons in space in any format that read_surface knows (.off, .obj, .ply, .poly
/// of three dimensions, ...). If all corners lie in one plane (exactly, up to rounding or within
/// ReadOptions::tolerance), the sides of all polygons are segments in that plane. Otherwise each polygon, or
/// facet of a .poly, has its own plane. Of a .dxf, the lines are segments, too, marked and named by layers;
/// its arcs need ReadOptions::arc_step. Throws FileError, also for polygons that lie in no plane.
[[nodiscard]] HOLDFAST_API PlanesInSpace read_planes(const std::filesystem::path& path,
                                                     const ReadOptions& options = {});

/// Points and segments that lie in one plane in space: exactly, up to rounding, or within `tolerance`. Each
/// point keeps its number; points at one place count as one, with the first of their markers that is not 0.
/// There are as many markers as entities, or none. Throws std::invalid_argument for a tolerance that is
/// negative or not finite, for markers of another number, for segments of points that do not exist, and if
/// there is no such plane.
[[nodiscard]] HOLDFAST_API PlanesInSpace plane_in_space(
    std::span<const Point> points, std::span<const Segment> segments, std::span<const Point> holes = {},
    double tolerance = 0, std::span<const int> point_markers = {}, std::span<const int> segment_markers = {});

/// The triangles as a surface: points of the plane have z = 0, and the region of a triangle is its marker,
/// since surfaces have no regions.
[[nodiscard]] HOLDFAST_API Surface surface_of(const PlaneMesh& mesh);

/// Writes triangles: .off (z = 0), .node and .ele and .edge beside it, .vtu; in all other formats, as
/// `write_surface` and `write_volume` write `surface_of` the mesh. Throws FileError.
HOLDFAST_API void write_plane(const std::filesystem::path& path, const PlaneMesh& mesh,
                              const WriteOptions& options = {});

/// What the file of `write_plane` does not hold of the mesh.
[[nodiscard]] HOLDFAST_API std::vector<Remark> not_held(const std::filesystem::path& path,
                                                        const PlaneMesh& mesh,
                                                        const WriteOptions& options = {});

/// Extensions of the formats that write_plane knows, and the files that it writes.
[[nodiscard]] HOLDFAST_API std::vector<std::string> plane_formats();
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_plane(
    const std::filesystem::path& path, std::string_view format);

}  // namespace holdfast
