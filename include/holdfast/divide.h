// Holdfast: a surface in parts, whose volumes are made apart, anywhere, and fit (docs/divide.md).
//
// A mesh keeps every triangle of its surface. So a volume that is cut along triangles can be meshed part by
// part, by programs that know nothing of each other, and the parts have the same triangles where they meet.
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
  double size = 0;              ///< `Sizes::size` of the parts' meshes; 0: as the surface has it
  Keep keep = Keep::automatic;  ///< not Keep::box
  std::vector<Point> holes;
  std::vector<RegionSeed> regions;  ///< their sizes go into the parts; a largest volume does not
  bool drop_outside = false;
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< 0: all there are; the result is the same
  ProgressFunction progress = {};
};

/// A closed surface, to be meshed by itself with field points.
struct SurfacePart {
  /// Of the whole surface what borders on the part, then the interfaces, marked
  /// `SurfaceDivision::interface_marker`. Vertices are in the order that they have in the whole. `regions`
  /// number the regions as the whole has them and carry their sizes; `holes` are in what the part encloses
  /// but does not hold.
  Surface surface;
  std::size_t interface_facets = 0;  ///< of `surface`
  double tetrahedra = 0;             ///< an estimate, to balance the work by
};

struct SurfaceDivision {
  Outcome outcome = Outcome::done;  ///< as `mesh` has it
  std::string message;              ///< one sentence unless it is done
  std::vector<Defect> defects;
  std::vector<SurfacePart>
      parts;                 ///< as many as asked for, or fewer where the surface is too coarse for them
  int interface_marker = 0;  ///< above all markers of the facets
};

/// Cuts the volume that a surface encloses into parts of about equal work.
///
/// The volume is meshed coarsely, but for the neighbourhood of the planes that bisect the work; interfaces
/// are faces of that mesh near these planes, of the size that is wanted there. Memory goes with the surface
/// and the interfaces, not with the final mesh. Throws as `mesh` does, and std::invalid_argument for no
/// parts and for Keep::box.
[[nodiscard]] HOLDFAST_API SurfaceDivision divide(const Complex& complex, const DivideOptions& options);

/// The same for a surface that owns its arrays, be it a temporary.
template <std::same_as<Surface> Owner>
[[nodiscard]] SurfaceDivision divide(const Owner& surface, const DivideOptions& options) {
  return divide(surface.view(), options);
}

/// Numbers the vertices of parts in the whole, one part after the other: first the surface's places, as in a
/// mesh of it, then all others as they come. Vertices at one place of the surface or of interfaces are one.
/// Memory goes with the surface and the interfaces.
class HOLDFAST_API Joiner {
 public:
  /// `surface` is the one that was divided; `interface_marker` that of the division.
  Joiner(const Complex& surface, int interface_marker);
  ~Joiner();
  Joiner(Joiner&&) noexcept;
  Joiner& operator=(Joiner&&) noexcept;

  struct Numbered {
    std::vector<std::uint64_t> vertices;  ///< numbers in the whole, one a vertex of the part
    std::vector<Index> fresh;  ///< vertices that neither the surface nor a part before has, in order
  };
  /// The next part's volume, whose facets carry their markers.
  [[nodiscard]] Numbered add(const Volume& part);

  /// Vertices so far, those of the surface included.
  [[nodiscard]] std::uint64_t vertices() const;
  /// What all volumes have in common: the surface's places as vertices, and, of its facets and segments,
  /// which name these, those that were in a part so far. No tetrahedra.
  [[nodiscard]] Volume surface() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All parts as one volume, as a mesh of the surface would be; interfaces are no facets of it. Throws
/// std::length_error beyond 2^32 - 2 vertices.
[[nodiscard]] HOLDFAST_API Volume join_parts(const Complex& surface, std::span<const Volume> parts,
                                             int interface_marker);

/// Gives the volume of part k; called several times for each, in order.
using PartLoader = std::function<Volume(std::size_t)>;

/// Writes what `join_parts` would give as a .vtu file, whatever its name, one part in memory at a time;
/// numbers of vertices have 64 bits where they need them, and arrays are compressed as `options` says, but
/// into a pipe. Throws as `write_volume` does, and what `load` throws.
HOLDFAST_API void write_joined(const std::filesystem::path& path, const Complex& surface, std::size_t parts,
                               const PartLoader& load, int interface_marker,
                               const WriteOptions& options = {});

/// What is examined of a division, beyond `check` of each part with its own surface.
enum class FitKind : int {
  facets_there = 1,        ///< every facet of the surface is one of a part
  segments_there = 2,      ///< every segment is one of a part
  vertices_there = 3,      ///< every place is a vertex of a part
  interfaces_matched = 4,  ///< a face of a single part on its boundary is a facet of the surface, and one of
                           ///< two parts is, too, or has one region
  nothing_twice = 5,       ///< of two parts at a face one is in front and one behind, and there is no third
};
[[nodiscard]] HOLDFAST_API const char* name(FitKind kind);

struct Fit {
  FitKind kind;
  bool holds;
  std::string detail;  ///< counts where it holds; the first offending faces where it does not
};

/// Examines whether parts fit, one after the other; memory goes with the surface and the interfaces.
class HOLDFAST_API FitChecker {
 public:
  /// With `outside_dropped`, what is in no part counts as dropped, as with `Options::drop_outside`.
  explicit FitChecker(const Complex& surface, bool outside_dropped = false);
  ~FitChecker();
  FitChecker(FitChecker&&) noexcept;
  FitChecker& operator=(FitChecker&&) noexcept;

  /// The volume of the next part, which `check` has found to keep its surface.
  void add(const Volume& part);
  /// After the last part: all of `FitKind`, in order.
  [[nodiscard]] std::vector<Fit> finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace holdfast
