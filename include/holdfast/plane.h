// Holdfast: triangles in the plane that keep every given segment.
//
// After P.L. George, H. Borouchaki, E. Saltel, "'Ultimate' robustness in meshing an arbitrary polyhedron"
// (Int. J. Numer. Meth. Engng 2003), §2, which gives three methods, each of them complete; and J. Ruppert, "A
// Delaunay refinement algorithm for quality 2-dimensional mesh generation" (J. Algorithms 1995).
#pragma once

#include <filesystem>
#include <map>

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
/// each other and the points in common ends alone. Markers are as many as their entities, or none.
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
inline constexpr std::array plane_methods{PlaneMethod::ears, PlaneMethod::swaps, PlaneMethod::partition};
[[nodiscard]] HOLDFAST_API const char* name(PlaneMethod method);

/// Which corner the method ears takes.
enum class PlaneEars {
  first,  ///< any that can be cut off
  best,   ///< of those the one whose triangle is closest to a regular one
  join,   ///< any; if its triangle holds others, its side goes with the nearest of them, which splits the
          ///< polygon
};
inline constexpr std::array plane_ears{PlaneEars::first, PlaneEars::best, PlaneEars::join};
[[nodiscard]] HOLDFAST_API const char* name(PlaneEars ears);

/// Where a run may end before it is done.
enum class PlaneStage {
  delaunay,   ///< swaps and partition: the Delaunay triangles of all points
  partition,  ///< partition: every segment stands, in pieces, and all added points are there
};
inline constexpr std::array plane_stages{PlaneStage::delaunay, PlaneStage::partition};
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
  std::optional<PlaneStage> stop_after;
  LayingOrder order = LayingOrder::given;  ///< of missing segments, for swaps and partition
  std::uint64_t seed = 1;                  ///< of the random orders
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
  std::map<std::string, double> seconds;  ///< by stage, and "total"
};

/// Triangles in the plane: the points of the input, in order and bit for bit, then those added.
struct PlaneMesh {
  std::vector<PlanePoint> points;
  std::vector<Triangle> triangles;  ///< corners turn left
  std::vector<int> regions;         ///< one a triangle: that of a seed, or the next free number from 1
  std::vector<Segment> segments;
  std::vector<int> point_markers, segment_markers;  ///< empty, or one each
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
/// segment in them and adding no point. Throws std::invalid_argument for markers of a wrong number, for
/// holes and seeds that are not finite or on a segment, and for a stage that the method does not have;
/// std::length_error beyond 2^28 points.
[[nodiscard]] HOLDFAST_API PlaneResult triangulate(const Plane& plane, const PlaneOptions& options = {});

/// Everything that makes an input invalid, at most `most` of each kind.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Plane& plane, std::size_t most = SIZE_MAX);

/// Reads .poly (points, segments, holes and regions as Triangle has them, the points also in a .node beside)
/// or .node (points alone). Throws FileError.
[[nodiscard]] HOLDFAST_API Plane read_plane(const std::filesystem::path& path,
                                            const ReadOptions& options = {});

/// Writes triangles: .off (z = 0), .node and .ele beside it, .vtu. Throws FileError.
HOLDFAST_API void write_plane(const std::filesystem::path& path, const PlaneMesh& mesh,
                              const WriteOptions& options = {});

/// Extensions of the formats that write_plane knows, and the files that it writes.
[[nodiscard]] HOLDFAST_API std::vector<std::string> plane_formats();
[[nodiscard]] HOLDFAST_API std::vector<std::filesystem::path> files_of_plane(
    const std::filesystem::path& path, std::string_view format);

}  // namespace holdfast
