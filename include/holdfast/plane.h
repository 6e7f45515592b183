// Holdfast: triangles in the plane that keep every given segment.
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

/// Points and segments in the plane: outlines in any number, nested or not, holes, segments that end anywhere
/// and points on none.
///
/// Valid are finite coordinates, no two points at one place, and segments with two different ends that meet
/// each other, the points, holes and seeds in common ends alone. Markers are as many as their entities, or
/// none.
struct Plane {
  std::vector<PlanePoint> points;
  std::vector<Segment> segments;
  std::vector<int> point_markers, segment_markers;
  std::vector<PlanePoint> holes;  ///< the region of each is left out; those in no region mean nothing
  struct Seed {
    PlanePoint where;
    int id;
    double area = 0;  ///< most that a triangle of the region may measure when it is refined; 0: no limit
  };
  std::vector<Seed> regions;    ///< the region of each gets its id
  int base = 0;                 ///< the number of the first point and segment in the file, for messages
  std::vector<Remark> remarks;  ///< what the file holds besides
};

/// How segments that the mesh lacks come into it.
enum class PlaneMethod {
  ears,       ///< §2.1: corners are cut off the outlines one by one
  swaps,      ///< §2.2: of Delaunay triangles, edges are swapped at random until the segments stand
  partition,  ///< §2.3: points are added where segments cross Delaunay edges, and removed by swaps
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneMethod method);

/// Which corner the method ears takes.
enum class PlaneEars {
  first,  ///< any that can be cut off
  best,   ///< of those the one whose triangle is closest to a regular one
  join,   ///< any; if its triangle holds others, its side goes with the nearest of them, which splits the
          ///< polygon
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneEars ears);

/// Where a run may end before it is done.
enum class PlaneStage {
  delaunay,   ///< swaps and partition: the Delaunay triangles of all points
  partition,  ///< partition: every segment stands, in pieces, and all added points are there
  swap,       ///< swaps: after some number of them
};
[[nodiscard]] HOLDFAST_API const char* name(PlaneStage stage);

struct PlaneOptions : Limits {
  PlaneMethod method = PlaneMethod::swaps;
  PlaneEars ears = PlaneEars::first;
  /// Partition: its points are removed when all segments stand, and not after each segment, which takes
  /// fewer.
  bool partition_first = false;
  /// Then swaps (Lawson) until the triangles are constrained Delaunay.
  bool delaunay = false;
  /// Everything within the convex hull is kept, but holes; so it is where there are no segments.
  bool hull = false;
  /// Refinement (Ruppert): points are added until no edge is longer than `size` (0: no limit), no triangle
  /// larger than its region's Seed::area, and none has an angle below `angle` degrees, but where segments
  /// meet at small angles, and across from there. Given one of the two, the triangles are constrained
  /// Delaunay. It ends for every input up to 26.45 degrees (Miller, Pav, Walkington 2003), in practice up to
  /// about 33. Given a size alone, the angle is 20.
  double size = 0;
  std::optional<double> angle;
  /// Refinement adds points inside alone, none on segments.
  bool keep_boundary = false;
  /// Most points that refinement adds; it stops there and says so in the report.
  std::size_t max_points = 10'000'000;
  std::optional<PlaneStage> stop_after;
  std::size_t stop_after_swaps = 0;  ///< for PlaneStage::swap: how many of them
  /// Of missing segments, for swaps and partition; unless given, such that each is near the one before.
  std::optional<LayingOrder> order;
  std::uint64_t seed = 1;  ///< of the random orders
  ProgressFunction progress = {};
};

/// Numbers of a run.
struct PlaneReport {
  std::size_t points = 0, segments = 0, holes = 0;  ///< of the input
  std::size_t missing_segments = 0;                 ///< of the Delaunay triangles; 0 for ears
  std::size_t swaps = 0;                            ///< until the segments stood
  std::size_t delaunay_swaps = 0;                   ///< until the triangles were constrained Delaunay
  std::size_t partition_points = 0;                 ///< added, and removed, by partition
  std::size_t most_partition_points = 0;            ///< of these, at the same time
  std::size_t ears = 0;                             ///< triangles cut off
  std::size_t joined = 0;  ///< of these, made with the reflex vertex nearest to a side
  std::size_t links = 0;   ///< between parts of an outline
  std::size_t triangles = 0, regions = 0;
  std::size_t field_points = 0;    ///< added by refinement, on no segment
  std::size_t segment_points = 0;  ///< added by refinement, on segments
  std::size_t small_angles = 0;  ///< triangles below the bound at, or across from, small angles of the input
  std::size_t small_angles_left = 0;      ///< others: at segments that are kept, or after `max_points`
  std::size_t large_left = 0;             ///< triangles above the limits of size, for the same reasons
  bool capped = false;                    ///< refinement stopped at `max_points`
  double least_angle = 0;                 ///< of all triangles, degrees, as doubles measure it
  std::map<std::string, double> seconds;  ///< by stage, and "total"
};

/// Triangles in the plane: the points of the input, in order and bit for bit, then those added.
struct PlaneMesh {
  std::vector<PlanePoint> points;
  std::vector<Triangle> triangles;  ///< corners turn left
  std::vector<int> regions;         ///< one a triangle: that of a seed, or the next free number from 1
  std::vector<Segment> segments;
  std::vector<int> point_markers, segment_markers;  ///< empty, or one each
  /// Of planes in space, where the points lie, those of the input bit for bit; `points` is empty then.
  std::vector<Point> in_space = {};
  int base = 0;  ///< number of the first point and of the first triangle in .node and .ele
};

struct PlaneResult {
  Outcome outcome = Outcome::done;  ///< or invalid_input, or what Limits say
  PlaneMesh mesh;                   ///< empty unless `outcome` is done
  PlaneReport report;
  /// What makes the input invalid; numbers count from 0, in messages from `Plane::base`. `where` has z = 0.
  std::vector<Defect> defects;
  std::string message;        ///< one sentence when the outcome is not done
  Intermediate intermediate;  ///< if `PlaneOptions::stop_after` is set; of segments alone
};

/// Triangulates every region that segments separate from the outside, but for those of holes, keeping each
/// segment in them. Points are added by refinement alone: those on a segment cut it into pieces, which have
/// its marker, and are rounded to doubles. Throws std::invalid_argument for markers of a wrong number, for
/// holes and seeds that are not finite, for a stage that the method does not have, and for a
/// size or angle (0 to 34 degrees) out of range, or refinement after a stage; std::length_error beyond 2^28
/// points.
[[nodiscard]] HOLDFAST_API PlaneResult triangulate(const Plane& plane, const PlaneOptions& options = {});

/// Outlines in planes in space: polygons, or facets of polygons and holes, of a surface's file.
struct PlanesInSpace {
  std::vector<Point> points;  ///< of the file; empty for a file of two dimensions, which is its one plane
  struct Part {
    Plane plane;                 ///< as seen along an axis, onto which no two of its points fall together
    std::vector<Index> numbers;  ///< of the plane's points in the file
    std::size_t axis = 2;
    Point normal{};       ///< of the mean plane, of any length
    bool turned = false;  ///< seen so, its first polygon turns right, and so shall its triangles
  };
  std::vector<Part> parts;      ///< one if all lies in one plane, else one a polygon or facet
  std::vector<Remark> remarks;  ///< what the file holds besides
};

/// The same for each plane, and the triangles of all together, turned as their polygons are. Points that
/// refinement adds lie in the plane within rounding. Defects are numbered as in the file, `where` is in
/// space. Throws what the other one does, and std::invalid_argument where refinement would put points on the
/// segments of several planes.
[[nodiscard]] HOLDFAST_API PlaneResult triangulate(const PlanesInSpace& planes,
                                                   const PlaneOptions& options = {});

/// Everything that makes an input invalid, at most `most` of each kind.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Plane& plane, std::size_t most = SIZE_MAX);

/// Reads .poly (points, segments, holes and regions as Triangle has them, the points also in a .node beside)
/// or .node (points alone). Throws FileError.
[[nodiscard]] HOLDFAST_API Plane read_plane(const std::filesystem::path& path,
                                            const ReadOptions& options = {});

/// Reads the same, and besides polygons in space of any format that read_surface knows (.off, .obj, .ply,
/// .poly of three dimensions, ...). If all corners lie in one plane, exactly, up to rounding or within
/// ReadOptions::tolerance, the sides of all polygons are segments in it; else each polygon, or facet of a
/// .poly, has a plane of its own. Throws FileError, also for polygons that lie in no plane.
[[nodiscard]] HOLDFAST_API PlanesInSpace read_planes(const std::filesystem::path& path,
                                                     const ReadOptions& options = {});

/// Points and segments that lie in one plane in space: exactly, up to rounding, or within `tolerance`. Each
/// point is numbered as given; those at one place are taken as one. Throws std::invalid_argument for a
/// tolerance that is negative or not finite, for segments of points that are not there, and where there is no
/// such plane.
[[nodiscard]] HOLDFAST_API PlanesInSpace plane_in_space(std::span<const Point> points,
                                                        std::span<const Segment> segments,
                                                        std::span<const Point> holes = {},
                                                        double tolerance = 0);

/// Writes triangles: .off (z = 0), .node and .ele beside it, .vtu. Throws FileError.
HOLDFAST_API void write_plane(const std::filesystem::path& path, const PlaneMesh& mesh,
                              const WriteOptions& options = {});

/// Extensions of the formats that write_plane knows, and the files that it writes.
[[nodiscard]] HOLDFAST_API std::vector<std::string> plane_formats();
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_plane(
    const std::filesystem::path& path, std::string_view format);

}  // namespace holdfast
