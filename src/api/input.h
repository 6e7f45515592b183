// The input of a call, with all that validation finds out about it, once for all attempts. From then on the
// complex has each place once (surface/places.h). Only data for the caller uses the given indices.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "classify/parts.h"
#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"
#include "surface/elements.h"
#include "surface/places.h"

namespace holdfast {

/// What was given with each place once: the same complex, unless its vertices repeat a place or some are left
/// out.
class DistinctPlaces {
 public:
  explicit DistinctPlaces(const Complex& given) : complex_(given) {}
  DistinctPlaces(const DistinctPlaces&) = delete;
  DistinctPlaces& operator=(const DistinctPlaces&) = delete;

  void merge(const Complex& given, const Places& places) {
    merged_ = holdfast::merge(given, places);
    complex_.vertices = merged_.vertices;
    complex_.facets = merged_.facets;
    complex_.segments = merged_.segments;
    complex_.vertex_markers = merged_.vertex_markers;
  }

  [[nodiscard]] const Complex& complex() const { return complex_; }
  [[nodiscard]] VertexNames names() const { return VertexNames(merged_.first); }
  /// The vertex of `complex` for one that was given.
  [[nodiscard]] Index operator()(Index given) const {
    return merged_.index.empty() ? given : merged_.index[given];
  }
  /// Of all that were given; empty where they are the same.
  [[nodiscard]] const std::vector<Index>& index() const { return merged_.index; }
  /// The sizes at the vertices of `complex` for those at the given ones.
  [[nodiscard]] std::vector<double> sizes(const std::vector<double>& given) const {
    return merged_.index.empty() || given.empty() ? given : merged_sizes(merged_, given);
  }

 private:
  Complex complex_;  // what was given, or merged_
  Merged merged_;
};

class Input {
 public:
  /// `parts` are those of a complex that was pasted together, else null.
  Input(const Complex& complex, SamePlace same_place, const Options& options, const Threads& threads,
        Monitor& monitor, PartsOfComplex* parts = nullptr)
      : given_(complex),
        distinct_(complex),
        same_place_(same_place),
        options_(options),
        threads_(threads),
        monitor_(monitor),
        parts_(parts) {}

  /// Defects that can be found before Delaunay, and the counts of the input; none if all is well so far.
  [[nodiscard]] std::vector<Defect> validate(Report::Input& counts);
  /// The other defects, found with the Delaunay tetrahedra; later calls do nothing.
  [[nodiscard]] std::vector<Defect> validate_missing(TetMesh& mesh, const Standing& standing);

  /// All of both, by a search of its own that takes as long as `diagnose`.
  [[nodiscard]] std::vector<Defect> defects() const;

  /// With each place once.
  [[nodiscard]] const Complex& complex() const { return distinct_.complex(); }
  /// What the caller calls the vertices of `complex`.
  [[nodiscard]] VertexNames names() const { return distinct_.names(); }
  /// Of Result.
  [[nodiscard]] std::vector<std::int64_t> vertex_map() const { return as_map(distinct_.index()); }
  /// Those of the options, for the vertices of `complex`.
  [[nodiscard]] Sizes sizes() const;
  [[nodiscard]] const SegmentTable& table() const { return table_; }
  /// The paper's Target, of all facets; computed once.
  [[nodiscard]] double target();

  [[nodiscard]] PartsOfComplex* parts() const { return parts_; }

  /// `diagnose` gives them all.
  static constexpr std::size_t kMostDefects = 100;

 private:
  Report::Input list_elements_and_segments();
  void count_places(Report::Input& counts) const;
  [[nodiscard]] std::function<void(double)> poll() const;

  const Complex& given_;
  DistinctPlaces distinct_;
  const SamePlace same_place_;
  const Options& options_;
  const Threads threads_;
  Monitor& monitor_;
  PartsOfComplex* const parts_;
  Elements elements_;  // of what was given, until they are known to fit together
  bool elements_fit_ = false;
  SegmentTable table_;
  std::optional<double> target_;
};

}  // namespace holdfast
