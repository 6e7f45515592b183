// Holdfast: a surface cut into parts that are meshed separately, anywhere, and still fit (docs/divide.md).
//
// A mesh keeps every triangle of its surface. So if a volume is cut along triangles, independent processes
// can mesh its parts, and the parts have the same triangles where they meet.
#pragma once

#include <concepts>
#include <functional>
#include <memory>

#include "holdfast/export.h"
#include "holdfast/holdfast.h"
#include "holdfast/io.h"
#include "holdfast/limits.h"
#include "holdfast/types.h"

namespace holdfast {

struct DivideOptions : Limits {
  std::size_t parts = 2;
  double size = 0;              ///< `Sizes::size` of the parts' meshes; 0: that of the surface
  Keep keep = Keep::automatic;  ///< not Keep::box
  std::vector<Point> holes;
  std::vector<RegionSeed> regions;  ///< the parts get their sizes, but not their largest volumes
  bool drop_outside = false;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< 0: all available; the result is the same
  ProgressFunction progress = {};
};

/// A closed surface, to be meshed separately with field points.
struct SurfacePart {
  /// The facets of the whole surface that bound the part, then the interfaces, which carry
  /// `SurfaceDivision::interface_marker`. Vertices keep the order of the whole. `regions` number the regions
  /// as in the whole and carry their sizes. `holes` lie in regions that the part encloses but does not
  /// contain.
  Surface surface;
  std::size_t interface_facets = 0;  ///< of `surface`
  double tetrahedra = 0;             ///< an estimate, for balancing the work
};

struct SurfaceDivision {
  Outcome outcome = Outcome::done;  ///< as of `mesh`
  std::string message;              ///< one sentence unless it is done
  std::vector<Defect> defects;
  std::vector<SurfacePart> parts;  ///< as many as requested, or fewer if the surface is too coarse
  int interface_marker = 0;        ///< larger than every facet marker
};

/// Cuts the volume that a surface encloses into parts of about equal work.
///
/// The volume is meshed coarsely, except near the planes that bisect the work. There the mesh has the wanted
/// size, and the interfaces are faces of it. Memory grows with the surface and the interfaces, not with the
/// final mesh. Throws as `mesh` does, and std::invalid_argument for no parts and for Keep::box.
[[nodiscard]] HOLDFAST_API SurfaceDivision divide(const Complex& complex, const DivideOptions& options);

/// The same for a surface that owns its arrays, temporaries included.
template <std::same_as<Surface> Owner>
[[nodiscard]] SurfaceDivision divide(const Owner& surface, const DivideOptions& options) {
  return divide(surface.view(), options);
}

/// Gives the vertices of the parts their numbers in the whole, one part after the other. The places of the
/// surface come first, numbered as in a mesh of it. All other vertices follow in the order of the parts.
/// Vertices at the same place of the surface or of an interface become one. Memory grows with the surface and
/// the interfaces.
class HOLDFAST_API Joiner {
 public:
  /// `surface` is the divided surface; `interface_marker` comes from its division.
  Joiner(const Complex& surface, int interface_marker);
  ~Joiner();
  Joiner(Joiner&&) noexcept;
  Joiner& operator=(Joiner&&) noexcept;

  struct Numbered {
    std::vector<std::uint64_t> vertices;  ///< by vertex of the part, its number in the whole
    std::vector<Index> fresh;  ///< vertices that neither the surface nor an earlier part has, in order
  };
  /// Adds the next part. Its facets carry their markers.
  [[nodiscard]] Numbered add(const Volume& part);

  /// Number of vertices so far, those of the surface included.
  [[nodiscard]] std::uint64_t vertices() const;
  /// The places of the surface as vertices, with the facets and segments that some part had so far. No
  /// tetrahedra.
  [[nodiscard]] Volume surface() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All parts as one volume, as if the surface had been meshed whole. Interfaces are not facets of it. Throws
/// std::length_error beyond 2^32 - 2 vertices.
[[nodiscard]] HOLDFAST_API Volume join_parts(const Complex& surface, std::span<const Volume> parts,
                                             int interface_marker);

/// Returns the volume of part k. Called several times for each part, in order.
using PartLoader = std::function<Volume(std::size_t)>;

/// Writes what `join_parts` would return as a .vtu file, whatever its name, with one part in memory at a
/// time. Vertex numbers have 64 bits where needed. Arrays are compressed as `options` says, but never into a
/// pipe. Throws as `write_volume` does, and what `load` throws.
HOLDFAST_API void write_joined(const std::filesystem::path& path, const Complex& surface, std::size_t parts,
                               const PartLoader& load, int interface_marker,
                               const WriteOptions& options = {});

/// What is examined of a division beyond the `check` of each part against its own surface.
enum class FitKind : int {
  facets_there = 1,        ///< every facet of the surface is a facet of a part
  segments_there = 2,      ///< every segment is a segment of a part
  vertices_there = 3,      ///< every place is a vertex of a part
  interfaces_matched = 4,  ///< a face of a single part on its boundary is a facet of the surface; one of two
                           ///< parts is such a facet, or both parts have the same region there
  nothing_twice = 5,       ///< a face has at most two parts: one in front, one behind
};
[[nodiscard]] HOLDFAST_API const char* name(FitKind kind);

struct Fit {
  FitKind kind;
  bool holds;
  std::string detail;  ///< counts if it holds; else the first offending faces
};

/// Examines whether parts fit, one after the other. Memory grows with the surface and the interfaces.
class HOLDFAST_API FitChecker {
 public:
  /// With `outside_dropped`, facets in no part count as dropped, as with `Options::drop_outside`.
  explicit FitChecker(const Complex& surface, bool outside_dropped = false);
  ~FitChecker();
  FitChecker(FitChecker&&) noexcept;
  FitChecker& operator=(FitChecker&&) noexcept;

  /// Adds the next part. `check` must have found that it keeps its surface.
  void add(const Volume& part);
  /// After the last part: all of `FitKind`, in order.
  [[nodiscard]] std::vector<Fit> finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace holdfast
