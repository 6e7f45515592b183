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
  automatic,  ///< winding number where the surface is consistently oriented, else every bounded region
  bounded,    ///< every bounded region
  winding,    ///< bounded regions of non-zero winding number
  box,        ///< everything out to an enclosing box
};

/// A region to number: the region that holds `where` gets `id`.
using RegionSeed = Surface::RegionSeed;

/// How long edges should be, for field points. The least of all limits counts.
struct Sizes {
  /// The most anywhere; 0: as the surface has it. Where large triangles or thin walls beside it leave too few
  /// elements, a smaller one is taken for a region, half of it at least (Report::Field::smaller_sizes).
  double size = 0;
  /// From a vertex of the surface, whose size is that of its edges, sizes grow inward by this much a unit of
  /// length, 0 to 1. Unset: 0.3, and up to 0.5 where sizes of the surface jump; and points go again where
  /// needles make them useless, unless `grow` is false (docs/sizes.md).
  std::optional<double> gradation = {};
  /// Whether sizes grow inside beyond those of the surface round; else they lie between them.
  bool grow = true;
  /// One a vertex of the complex, instead of what its edges ask for (0: keep that); or none. Of several
  /// vertices at one place the least counts.
  std::vector<double> vertex_sizes = {};
  /// The most at a point; what is not positive is no limit. Called often.
  std::function<double(const Point&)> field = {};
  /// The same for many points at a time, into as many sizes: fewer calls. One of the two is enough; where
  /// there are both, they must agree.
  std::function<void(std::span<const Point>, std::span<double>)> fields = {};
  /// The metric in which edges should have length 1 at most, at a point: sizes that depend on the direction.
  /// A tensor that is not positive definite is no limit. Called as `field` is. The other sizes limit those of
  /// the metric in all directions; what `gradation` limits is the largest size at a point. Elements are
  /// judged as the metric sees them.
  std::function<Metric(const Point&)> metric = {};
  /// Whether these functions may be called from several threads at the same time, as those of `size_function`
  /// and `metric_function` may (holdfast/io.h). Else they are called from the calling thread alone, which
  /// then adds field points by itself.
  bool concurrent = false;
  /// The most that a tetrahedron may measure; 0: no limit. The bound is true, exactly, of every tetrahedron
  /// of the volume, even at the price of flat ones: those next to triangles that are large beside it. Regions
  /// may have bounds of their own. A mesh of more than 2^30 tetrahedra is refused by std::length_error.
  double max_volume = 0;
  /// The most that the radius of the sphere round a tetrahedron should be, over its shortest edge; 0: no
  /// limit. Regular ones have 0.612. This is an aim: what the surface forces stays, and is counted.
  double max_ratio = 0;
  /// Elements across, at least: on every path of edges inside from one of two walls that face each other to
  /// the other (docs/sizes.md says which do); 0 or 1: no demand. Edges are parted for it, even at the price
  /// of flat elements. At most 100.
  unsigned layers = 0;
};

/// How long to improve the elements with field points: each is some times slower than the one before.
enum class Effort { fast, good, best };

/// Progress of a running call. Stages come in order, with two exceptions: validation goes on after Delaunay,
/// and another attempt, if one is needed, begins with Delaunay again.
struct Progress {
  Stage stage;
  double fraction;  ///< of this stage, 0 to 1
  /// Of the whole call, 0 to 1, and never less than before: an estimate by what stages usually take.
  double overall = 0;
};

/// Options of `mesh`. Every default gives the promise.
struct Options : Limits {
  bool flips = true;     ///< recover by flips before partition; without, partition does all the work
  bool optimise = true;  ///< better elements by exchanges and moves of Steiner points, after all else
  /// Also add a few points for elements that are flat otherwise. If false, elements may be as flat as the
  /// surface's vertices and the forced points make them. Field points, for `sizes`, do not depend on this.
  bool add_points = true;
  /// With sizes, field points are added, and the whole volume is made fit to compute with. Without, only the
  /// points that the surface forces are added.
  std::optional<Sizes> sizes;
  Effort effort = Effort::good;  ///< for `sizes`
  Keep keep = Keep::automatic;
  double box_margin = 0.1;  ///< of the largest extent, for Keep::box
  std::vector<Point> holes;
  std::vector<RegionSeed> regions;
  bool drop_outside = false;  ///< facets outside every kept region are dropped instead of refused
  /// Ends after this stage with what stands then, exact vertices rounded. Before `classify` that is every
  /// tetrahedron of the enclosing box, as region 0, and the facets and segments that stand.
  std::optional<Stage> stop_after;
  LayingOrder order = LayingOrder::random;  ///< of constraints that partition and elimination lay
  std::uint64_t seed = 1;                   ///< of the random orders
  unsigned threads = 1;                     ///< 0: all there are; the result is the same
  bool neighbours = false;                  ///< fills `Result::neighbours`
  /// Called every 20 ms or so from the calling thread; returns false to cancel. What it throws ends the call.
  std::function<bool(const Progress&)> progress;
};

/// Numbers of a run; the paper's Tables I and II.
struct Report {
  struct Input {
    std::size_t vertices = 0;           ///< distinct ones; besides these the complex has
    std::size_t merged_vertices = 0;    ///< vertices at the place of an earlier one
    std::size_t left_out_vertices = 0;  ///< unused ones, not finite or at the place of another
    std::size_t segments = 0, facets = 0, components = 0;
    bool closed = false;
    std::size_t nonmanifold_segments = 0, dangling_facets = 0;
  } input;
  struct Missing {
    std::size_t segments = 0, facets = 0;
  } delaunay, flips;  ///< missing after Delaunay, and after the flips
  /// Added by the partition, in the cavities of facets and in attempts that came to nothing, too.
  std::size_t segment_points = 0, facet_points = 0;
  std::size_t steiner_points = 0;  ///< left in the volume; corners of a box do not count
  /// Left by suppression: what the surface forces, as far as was found. The optimisation adds some, and
  /// removes some.
  std::size_t forced_points = 0;
  std::size_t unrounded_points = 0;  ///< of all that are left, without a position in doubles
  struct Optimised {
    std::size_t exchanges = 0;  ///< of tetrahedra for better ones
    std::size_t moves = 0;      ///< of Steiner points
    std::size_t points = 0;     ///< Steiner points added where a tetrahedron stayed flat otherwise
  } optimised;
  /// Shape of the elements of a volume with field points.
  struct Shape {
    double min_dihedral_deg = 0, max_dihedral_deg = 0;
    std::array<std::size_t, 15> least_dihedral{};  ///< elements by their least angle, in bins of 5 degrees
    std::array<std::size_t, 10> quality{};         ///< by Q, in bins that end where quality_bins says
  };
  static constexpr std::array<double, 9> quality_bins{1.25, 1.5, 2, 3, 5, 10, 30, 100, 1000};
  /// An element with an angle below 10 degrees that facets force: two facets that meet at that angle, or
  /// faces of the element that have such an angle themselves.
  struct Forced {
    Index tetrahedron;
    double min_dihedral_deg;
    std::vector<Index> facets;  ///< of the volume
  };
  /// What was done for the sizes; all zero without.
  struct Field {
    std::size_t points = 0;  ///< field points; they count as Steiner points, too
    double gradation = 0;    ///< `Sizes::gradation`, or what was chosen where that is unset
    Shape before, after;     ///< the optimisation; as the metric sees it, if there is one
    /// Lengths of edges over the mean of the sizes wanted at their ends, or in the metrics there, in bins of
    /// 1/8, the last without end; an edge counts once for each element.
    std::array<std::size_t, 24> edge_lengths{};
    std::size_t moves = 0, swaps = 0, contractions = 0, insertions = 0;  ///< of the optimisation
    /// Elements with an angle below 10 degrees; those of them that facets force; and of the others, those
    /// whose corners all belong to the surface, which is thinner there than its triangles are long. Not
    /// looked for with a metric.
    std::size_t below_10_deg = 0, forced = 0, across = 0;
    /// A facet that bears no elements as small as wanted near it, being much larger, or a needle.
    struct Limiting {
      Index facet;              ///< of the complex
      double wanted, bearable;  ///< lengths of edges, where they differ most: at `place`
      double volume;            ///< part of all, 0 to 1, on which this facet limits sizes more than others do
      Point place;
    };
    /// The part of the volume, 0 to 1, where facets near by bear only larger elements than are wanted (see
    /// docs/sizes.md), and that of it where the caller's sizes are the ones wanted. Zero with a metric or
    /// bounds on volumes, which are kept to all the same.
    double limited_volume = 0, limited_asked_volume = 0;
    /// A region that got smaller sizes than the caller's, as too few elements came of these.
    struct SmallerSize {
      int region;
      double asked, used;
    };
    std::vector<SmallerSize> smaller_sizes;
    std::vector<Limiting> limiting;    ///< by volume, the most first, at most 100
    bool stopped_early = false;        ///< too much was tried in vain: edges may be longer than wanted
    std::vector<Forced> worst_forced;  ///< the worst of these, at most 100
  } field;
  /// What was done for `Sizes::max_volume` and `max_ratio`; all zero without.
  struct Bounds {
    std::size_t points = 0;        ///< added for the volume alone, when all else was done
    double fullest = 0;            ///< the largest volume of a tetrahedron over its bound: at most 1
    std::size_t flat = 0;          ///< tetrahedra at these points with a dihedral angle below 10 degrees
    std::size_t ratio_points = 0;  ///< added for the ratio alone
    double worst_ratio = 0;
    std::size_t above_ratio = 0;  ///< tetrahedra with a larger ratio than was asked for
  } bounds;
  /// What was done for `Sizes::layers`; all zero without.
  struct Layers {
    std::size_t points = 0;     ///< added for it
    std::size_t left = 0;       ///< edges that span too much all the same
    std::vector<Point> places;  ///< the middles of those edges, the first 100 of a region
    std::size_t at_rims =
        0;  ///< vertices that are left out, as on a way of fewer edges over triangles of the side
  } layers;
  std::size_t vertices = 0, tetrahedra = 0, regions = 0;
  /// The rule by which regions were kept: never Keep::automatic once they were chosen.
  Keep keep = Keep::automatic;
  /// If Keep::automatic found no winding numbers and kept every bounded region: facets that are turned
  /// against those round them. If there are none, two facets (of an interface, say) that rule out winding
  /// numbers.
  std::vector<Index> turned_facets;
  std::size_t attempts = 0;  ///< with other random orders; all but the last found no doubles for some point
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

/// A vertex position that no double holds, as exact binary fractions.
struct ExactVertex {
  Index vertex;
  std::array<std::string, 3> coordinates;  ///< "m*2^e", both decimal integers
};

/// What `Warning` is about. The numbers are stable.
enum class WarningKind : int {
  orientation = 1,  ///< facets are turned against others, so that Keep::automatic kept every bounded region
  open_interface = 2,  ///< facets with an opening between what would be two regions without it
  field_points = 3,    ///< field points stopped early
  attempt_failed = 4,  ///< an attempt ended by an error; what an earlier one had is delivered
  parts_apart = 5,     ///< a part that touches no other (holdfast/paste.h)
  sizes = 6,           ///< facets bear only larger elements than the caller asks for
};

/// What was decided, or may not be as it was meant, in a mesh that keeps the promise.
struct Warning {
  WarningKind kind;
  std::vector<Index> facets;    ///< of the complex
  std::vector<Segment> border;  ///< for open_interface, the edges of the opening
  std::vector<Point> where;
  std::string message;  ///< one sentence with indices and coordinates
};

/// Ids of the regions in front of a facet (where its corners turn counterclockwise) and behind it; nothing
/// on a side without tetrahedra.
using FacetRegions = std::array<std::optional<int>, 2>;

/// Of a tetrahedron, at i the one behind the face opposite to its corner i; `no_entity` where there is none.
using Neighbours = std::array<Index, 4>;

struct Result {
  Outcome outcome = Outcome::done;
  Volume volume;                            ///< empty unless `outcome` is done or not_representable
  std::vector<FacetRegions> facet_regions;  ///< one a facet of `volume`; none if stopped before `classify`
  Report report;
  std::vector<Defect> defects;
  std::vector<Warning> warnings;  ///< where the outcome is done or not_representable
  /// What `vertex_map` gives for the complex; with a volume only.
  std::vector<std::int64_t> vertex_map;
  /// Of parts pasted together (holdfast/paste.h): markers of the volume's facets that stand for several of
  /// the parts'.
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
/// suit the complex (marker arrays of a wrong length, a hole or region seed on a facet or in no region that
/// it could mean, a margin that is not positive), std::length_error beyond 2^28 vertices, std::bad_alloc when
/// memory runs out without a limit, and std::logic_error if an internal invariant breaks (please report it).
[[nodiscard]] HOLDFAST_API Result mesh(const Complex& complex, const Options& options = {});

/// The same for a surface that owns its arrays, be it a temporary.
template <std::same_as<Surface> Owner>
[[nodiscard]] Result mesh(const Owner& surface, const Options& options = {}) {
  return mesh(surface.view(), options);
}

/// For each vertex of a complex the vertex that it is in a mesh of it, or -1 where it is left out; empty
/// where each is the one with its own index. A mesh has each place (vertices with identical coordinates, +0
/// and -0 being one) once, in the order of the first vertices in use there. Vertices that no facet and no
/// segment uses are left out where they are not finite or at the place of another vertex (of several unused
/// ones the first stays).
[[nodiscard]] HOLDFAST_API std::vector<std::int64_t> vertex_map(const Complex& complex);

struct DiagnoseOptions : Limits {
  std::size_t most = SIZE_MAX;  ///< bounds the number of defects
  unsigned threads = 1;         ///< 0: all there are; the result is the same
  ProgressFunction progress = {};
};

/// Every broken rule of a valid input, exactly; empty for a valid complex. Throws Interrupted for its limits.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Complex& complex,
                                                        const DiagnoseOptions& options);

/// The same without limits. `most` bounds the number of defects returned.
[[nodiscard]] HOLDFAST_API std::vector<Defect> diagnose(const Complex& complex, std::size_t most = SIZE_MAX);

struct DelaunayOptions : Limits {
  std::uint64_t seed = 1;  ///< decides how cospherical points are joined, and the order of the tetrahedra
  unsigned threads = 1;    ///< 0: all there are; the result is the same
  ProgressFunction progress = {};
};

/// Delaunay tetrahedra of the convex hull of `points`; repeated points are left unused. All points coplanar:
/// no tetrahedra. Throws std::invalid_argument for non-finite coordinates, and Interrupted for its limits.
[[nodiscard]] HOLDFAST_API std::vector<Tetrahedron> delaunay(std::span<const Point> points,
                                                             const DelaunayOptions& options);

/// The same without limits.
[[nodiscard]] HOLDFAST_API std::vector<Tetrahedron> delaunay(std::span<const Point> points,
                                                             std::uint64_t seed = 1, unsigned threads = 1);

/// Which tetrahedra share a face, one entry a tetrahedron. Where more than two have a face, or one has it
/// twice, as only in what is no mesh, they count as none there. Any indices are accepted.
[[nodiscard]] HOLDFAST_API std::vector<Neighbours> neighbours(std::span<const Tetrahedron> tetrahedra);

/// Version of the library that runs, "major.minor.patch"; version.h has that of the headers.
[[nodiscard]] HOLDFAST_API const char* version();

}  // namespace holdfast
