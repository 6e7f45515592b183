// Holdfast: fills any triangulated surface with tetrahedra and keeps every input triangle.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <optional>

#include "holdfast/export.h"
#include "holdfast/intermediate.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"
#include "holdfast/version.h"

namespace holdfast {

/// Stages of the pipeline, in order.
enum class Stage {
  validate,
  delaunay,
  flips,
  partition,
  eliminate,
  classify,
  suppress,
  field_points,
  optimise
};

/// Name of a stage as the command line and the report spell it.
[[nodiscard]] HOLDFAST_API const char* name(Stage stage);

/// Which regions stay in the volume.
enum class Keep {
  /// By winding number where the surface is consistently oriented, with the regions of seeds; else every
  /// bounded region.
  automatic,
  bounded,    ///< every bounded region
  winding,    ///< bounded regions of non-zero winding number
  box,        ///< everything up to an enclosing box
};

/// A region to number: the region that holds `where` gets `id`.
using RegionSeed = Surface::RegionSeed;

/// How long edges should be, for field points. The smallest of all limits counts.
struct Sizes {
  /// The largest size anywhere; 0: that of the surface. If large triangles or thin walls leave a region too
  /// few elements, the region gets a smaller size, at least half of this one (Report::Field::smaller_sizes).
  double size = 0;
  /// How fast sizes grow inward, per unit of length, 0 to 1. They start at the surface's vertices, whose
  /// sizes are those of their edges. Unset: 0.3, and up to 0.5 where sizes of the surface jump. Points that
  /// needles make useless are then removed, unless `grow` is false (docs/sizes.md).
  std::optional<double> gradation = {};
  /// Whether sizes inside may grow beyond those of the surrounding surface. If not, they lie between those
  /// sizes.
  bool grow = true;
  /// One per vertex of the complex, or empty. Replaces the size that the vertex's edges ask for; 0 keeps that
  /// size. The smallest of several vertices at one place counts.
  std::vector<double> vertex_sizes = {};
  /// The largest size at a point; a value that is not positive is no limit. Called often.
  std::function<double(const Point&)> field = {};
  /// The same for many points at a time, one size per point, in fewer calls. Either function is enough; if
  /// both are set, they must agree.
  std::function<void(std::span<const Point>, std::span<double>)> fields = {};
  /// Sizes that depend on the direction: the metric at a point, in which edges should have length at most 1.
  /// A tensor that is not positive definite is no limit. Called as `field` is. The other sizes limit the
  /// metric's sizes in all directions. `gradation` limits the largest size at a point. Elements are judged in
  /// the metric.
  std::function<Metric(const Point&)> metric = {};
  /// Whether these functions may be called from several threads at the same time, as those of `size_function`
  /// and `metric_function` may (holdfast/io.h). If not, only the calling thread calls them, and it adds all
  /// field points by itself.
  bool concurrent = false;
  /// The largest volume of a tetrahedron; 0: no limit. Every tetrahedron keeps the bound, exactly. Tetrahedra
  /// at triangles that are large compared with the bound may become flat. Regions may have bounds of their
  /// own. A mesh of more than 2^30 tetrahedra is refused with std::length_error.
  double max_volume = 0;
  /// The largest ratio wanted of a tetrahedron's circumradius to its shortest edge; 0: no limit. A regular
  /// tetrahedron has 0.612. This is an aim: tetrahedra that the surface forces stay, and are counted.
  double max_ratio = 0;
  /// The least number of elements across: every path of inner edges between two walls that face each other
  /// has at least this many edges (docs/sizes.md says which walls face each other). 0 or 1: no demand; at
  /// most 100. Edges are split for it, even if flat elements result.
  unsigned layers = 0;
};

/// How long to improve the elements of a mesh with field points. Each effort takes several times as long as
/// the one before.
enum class Effort { fast, good, best };

/// Progress of a running call. Stages come in order, with two exceptions: validation continues after
/// Delaunay, and another attempt, if one is needed, begins with Delaunay again.
struct Progress {
  Stage stage;
  double fraction;  ///< of this stage, 0 to 1
  /// Of the whole call, 0 to 1; never falls. An estimate from the time that stages usually take.
  double overall = 0;
};

/// Options of `mesh`. Every default keeps the promise.
struct Options : Limits {
  bool flips = true;     ///< recover by flips before partition; if false, partition does all the work
  bool optimise = true;  ///< at the end, improves elements by exchanges and moves of Steiner points
  /// Also adds a few points for elements that would otherwise be flat. If false, elements may be as flat as
  /// the surface's vertices and the forced points make them. Field points, for `sizes`, do not depend on
  /// this.
  bool add_points = true;
  /// With sizes, field points are added, which make the whole volume suitable for computation. Without sizes,
  /// only the points that the surface forces are added.
  std::optional<Sizes> sizes;
  Effort effort = Effort::good;  ///< for `sizes`
  Keep keep = Keep::automatic;
  double box_margin = 0.1;  ///< of the largest extent, for Keep::box
  std::vector<Point> holes;
  std::vector<RegionSeed> regions;
  bool drop_outside = false;  ///< facets outside every kept region are dropped instead of refused
  /// Ends the call after this stage and returns the mesh so far, exact vertices rounded. Before `classify`
  /// that is every tetrahedron of the enclosing box, as region 0, with the facets and segments present.
  std::optional<Stage> stop_after;
  LayingOrder order = LayingOrder::random;  ///< of the constraints laid by partition and elimination
  std::uint64_t seed = 1;                   ///< of the random orders
  unsigned threads = 1;                     ///< 0: all available; the result is the same
  bool neighbours = false;                  ///< fills `Result::neighbours`
  /// Called every 20 ms or so from the calling thread; returns false to cancel. What it throws ends the call.
  std::function<bool(const Progress&)> progress;
};

/// Figures of a run, those of the paper's Tables I and II among them.
struct Report {
  struct Input {
    std::size_t vertices = 0;           ///< distinct ones; the next two count the rest
    std::size_t merged_vertices = 0;    ///< vertices at the place of an earlier one
    std::size_t left_out_vertices = 0;  ///< unused ones that are not finite or at the place of another
    std::size_t segments = 0, facets = 0, components = 0;
    bool closed = false;
    std::size_t nonmanifold_segments = 0, dangling_facets = 0;
  } input;
  struct Missing {
    std::size_t segments = 0, facets = 0;
  } delaunay, flips;  ///< missing after Delaunay, and after the flips
  /// Points added by the partition, those in the cavities of facets and in failed attempts included.
  std::size_t segment_points = 0, facet_points = 0;
  std::size_t steiner_points = 0;  ///< left in the volume, without the corners of a box
  /// Points left by suppression: those that the surface forces, as far as suppression could tell. The
  /// optimisation adds some and removes some.
  std::size_t forced_points = 0;
  std::size_t unrounded_points = 0;  ///< of all that are left, those without a position in doubles
  struct Optimised {
    std::size_t exchanges = 0;  ///< of tetrahedra for better ones
    std::size_t moves = 0;      ///< of Steiner points
    std::size_t points = 0;     ///< Steiner points added where a tetrahedron would stay flat
  } optimised;
  /// Shape of the elements of a volume with field points.
  struct Shape {
    double min_dihedral_deg = 0, max_dihedral_deg = 0;
    std::array<std::size_t, 15> least_dihedral{};  ///< elements by their least angle, in bins of 5 degrees
    std::array<std::size_t, 10> quality{};         ///< by Q, in bins that end where quality_bins says
  };
  static constexpr std::array<double, 9> quality_bins{1.25, 1.5, 2, 3, 5, 10, 30, 100, 1000};
  /// An element with an angle below 10 degrees that facets force: two facets meet at that angle, or a facet
  /// that is a face of the element has such an angle itself.
  struct Forced {
    Index tetrahedron;
    double min_dihedral_deg;
    std::vector<Index> facets;  ///< of the volume
  };
  /// What was done for the sizes; all zero without them.
  struct Field {
    std::size_t points = 0;  ///< field points; they count as Steiner points, too
    double gradation = 0;    ///< `Sizes::gradation`, or the chosen one if that is unset
    Shape before, after;     ///< the optimisation; measured in the metric, if there is one
    /// Edges by length over the mean of the sizes wanted at their ends, or by length in the metrics there, in
    /// bins of 1/8; the last bin is open. An edge counts once for each of its elements.
    std::array<std::size_t, 24> edge_lengths{};
    std::size_t moves = 0, swaps = 0, contractions = 0, insertions = 0;  ///< of the optimisation
    /// Elements with an angle below 10 degrees (`below_10_deg`); those of them that facets force (`forced`);
    /// of the others, those with all corners on the surface, which is thinner there than its triangles are
    /// long (`across`). Not determined with a metric.
    std::size_t below_10_deg = 0, forced = 0, across = 0;
    /// A facet that is much larger than the elements wanted near it, or a needle, and so bears no elements of
    /// the wanted size.
    struct Limiting {
      Index facet;              ///< of the complex
      double wanted, bearable;  ///< lengths of edges at `place`, where they differ most
      /// Share of the whole, 0 to 1, where this facet limits sizes more than others do.
      double volume;
      Point place;
    };
    /// The share of the volume, 0 to 1, where nearby facets bear only elements larger than wanted (see
    /// docs/sizes.md), and the share where, besides, the wanted sizes are the caller's. Zero with a metric or
    /// with bounds on volumes, which are kept all the same.
    double limited_volume = 0, limited_asked_volume = 0;
    /// A region whose sizes were made smaller than the caller's because those gave too few elements.
    struct SmallerSize {
      int region;
      double asked, used;
    };
    std::vector<SmallerSize> smaller_sizes;
    std::vector<Limiting> limiting;    ///< by volume, the most first, at most 100
    bool stopped_early = false;        ///< too many trials failed: edges may be longer than wanted
    std::vector<Forced> worst_forced;  ///< the worst of the forced elements, at most 100
  } field;
  /// What was done for `Sizes::max_volume` and `max_ratio`; all zero without them.
  struct Bounds {
    std::size_t points = 0;        ///< added only for the volume, after all else
    double fullest = 0;            ///< the largest volume of a tetrahedron over its bound: at most 1
    std::size_t flat = 0;          ///< tetrahedra at these points with a dihedral angle below 10 degrees
    std::size_t ratio_points = 0;  ///< added only for the ratio
    double worst_ratio = 0;
    std::size_t above_ratio = 0;  ///< tetrahedra with a larger ratio than was asked for
  } bounds;
  /// What was done for `Sizes::layers`; all zero without it.
  struct Layers {
    std::size_t points = 0;     ///< added for the layers
    std::size_t left = 0;       ///< edges that still span too much
    std::vector<Point> places;  ///< the middles of those edges, the first 100 of a region
    std::size_t at_rims = 0;  ///< vertices left out because a path over triangles of the side has fewer edges
  } layers;
  std::size_t vertices = 0, tetrahedra = 0, regions = 0;
  /// The rule by which regions were kept: never Keep::automatic once they were chosen.
  Keep keep = Keep::automatic;
  /// If Keep::automatic found no winding numbers and kept every bounded region: the facets that are turned
  /// against their neighbours. If there are none, two facets that rule out winding numbers, for example of an
  /// interface.
  std::vector<Index> turned_facets;
  std::size_t attempts = 0;  ///< with different random orders; in all but the last some point got no doubles
  /// Shape of all elements.
  struct Elements {
    double target = 0, worst = 0;  ///< the paper's Q = sqrt(6)/12 h_max / inradius, 1 is regular
    double min_dihedral_deg = 0, max_dihedral_deg = 0;
    std::size_t below_10_deg = 0;             ///< elements with a dihedral angle below 10 degrees
    std::array<std::size_t, 18> histogram{};  ///< dihedral angles in bins of 10 degrees
  } elements;
  std::map<std::string, double> seconds;  ///< by stage, and "total"; "partition" includes elimination
  std::uint64_t peak_memory_bytes = 0;
};

/// A vertex position that doubles cannot represent, as exact binary fractions.
struct ExactVertex {
  Index vertex;
  std::array<std::string, 3> coordinates;  ///< "m*2^e", both decimal integers
};

/// What `Warning` is about. The numbers are stable.
enum class WarningKind : int {
  orientation = 1,     ///< facets are turned against others, so Keep::automatic kept every bounded region
  open_interface = 2,  ///< facets with an opening; without it they would separate two regions
  field_points = 3,    ///< field points stopped early
  attempt_failed = 4,  ///< an attempt ended with an error; the result of an earlier one is delivered
  parts_apart = 5,     ///< a part that touches no other (holdfast/paste.h)
  sizes = 6,           ///< facets bear only larger elements than the caller asks for
};

/// A decision of the mesher, or a doubt about the input, in a mesh that keeps the promise.
struct Warning {
  WarningKind kind;
  std::vector<Index> facets;    ///< of the complex
  std::vector<Segment> border;  ///< for open_interface, the edges of the opening
  std::vector<Point> where;
  std::string message;  ///< one sentence with indices and coordinates
};

/// Ids of the regions in front of a facet (seen from there its corners turn counterclockwise) and behind it;
/// no value on a side without tetrahedra.
using FacetRegions = std::array<std::optional<int>, 2>;

/// The neighbours of a tetrahedron: entry i is behind the face opposite corner i, or `no_entity`.
using Neighbours = std::array<Index, 4>;

struct Result {
  Outcome outcome = Outcome::done;
  Volume volume;                            ///< empty unless `outcome` is done or not_representable
  std::vector<FacetRegions> facet_regions;  ///< one per facet of `volume`; empty if stopped before `classify`
  Report report;
  std::vector<Defect> defects;
  std::vector<Warning> warnings;  ///< if the outcome is done or not_representable
  /// What `vertex_map` gives for the complex; with a volume only.
  std::vector<std::int64_t> vertex_map;
  /// For parts pasted together (holdfast/paste.h): markers of the volume's facets that stand for several
  /// markers of the parts.
  std::map<int, std::vector<int>> marker_sets;
  /// If `Options::neighbours` is set: what `neighbours` gives for the volume's tetrahedra.
  std::vector<Neighbours> neighbours;
  std::vector<ExactVertex> exact_vertices;  ///< for not_representable
  std::string message;                      ///< one sentence when the outcome is not done
  Intermediate intermediate;                ///< if `Options::stop_after` is before `classify`
};

/// Fills a complex with tetrahedra, keeping every facet and segment (the promise).
///
/// Expected endings are outcomes. Throws std::invalid_argument for options that make no sense or do not
/// suit the complex (marker arrays of a wrong length, a hole or region seed on a facet or in a region that it
/// cannot name, a margin that is not positive), std::length_error beyond 2^28 vertices, std::bad_alloc when
/// memory runs out without a limit, and std::logic_error if an internal invariant breaks (please report it).
[[nodiscard]] HOLDFAST_API Result mesh(const Complex& complex, const Options& options = {});

/// The same for a surface that owns its arrays, temporaries included.
template <std::same_as<Surface> Owner>
[[nodiscard]] Result mesh(const Owner& surface, const Options& options = {}) {
  return mesh(surface.view(), options);
}

/// Maps each vertex of a complex to its vertex in a mesh of the complex, or to -1 if it is left out. Empty if
/// every vertex keeps its index. A mesh has each place (vertices with identical coordinates, +0 and -0 being
/// one) once, in the order of the first vertex in use there. Vertices that no facet and no segment uses are
/// left out if they are not finite or at the place of another vertex; of several unused vertices at one place
/// the first stays.
[[nodiscard]] HOLDFAST_API std::vector<std::int64_t> vertex_map(const Complex& complex);

struct DiagnoseOptions : Limits {
  std::size_t most = SIZE_MAX;  ///< bounds the number of defects
  unsigned threads = 1;         ///< 0: all available; the result is the same
  ProgressFunction progress = {};
};

/// Every broken rule of a valid input, exactly; empty for a valid complex. Throws Interrupted for its limits.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Complex& complex,
                                                        const DiagnoseOptions& options);

/// The same without limits. Returns at most `most` defects.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Complex& complex, std::size_t most = SIZE_MAX);

struct DelaunayOptions : Limits {
  std::uint64_t seed = 1;  ///< decides how cospherical points are connected, and the order of the tetrahedra
  unsigned threads = 1;    ///< 0: all available; the result is the same
  ProgressFunction progress = {};
};

/// Delaunay tetrahedra of the convex hull of `points`; repeated points are left unused. All points coplanar:
/// no tetrahedra. Throws std::invalid_argument for non-finite coordinates, and Interrupted for its limits.
[[nodiscard]] HOLDFAST_API std::vector<Tetrahedron> delaunay(std::span<const Point> points,
                                                             const DelaunayOptions& options);

/// The same without limits.
[[nodiscard]] HOLDFAST_API std::vector<Tetrahedron> delaunay(std::span<const Point> points,
                                                             std::uint64_t seed = 1, unsigned threads = 1);

/// Which tetrahedra share a face, one entry per tetrahedron. A face of more than two tetrahedra, or a face
/// that one tetrahedron has twice, gives no neighbours; no mesh has such faces. Any indices are accepted.
[[nodiscard]] HOLDFAST_API std::vector<Neighbours> neighbours(std::span<const Tetrahedron> tetrahedra);

/// Version of the library that runs, "major.minor.patch"; version.h has that of the headers.
[[nodiscard]] HOLDFAST_API const char* version();

}  // namespace holdfast
