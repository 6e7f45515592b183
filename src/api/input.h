// The input of a call and all results of its validation, shared by all attempts. Its complex has each place
// once (surface/places.h). Only data for the caller uses the given indices.
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

/// The given complex with each place once; it is not copied unless its vertices repeat a place or some are
/// left out.
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
  /// The vertex of `complex` for a given one.
  [[nodiscard]] Index operator()(Index given) const {
    return merged_.index.empty() ? given : merged_.index[given];
  }
  /// By given vertex; empty if the complexes are the same.
  [[nodiscard]] const std::vector<Index>& index() const { return merged_.index; }
  /// The sizes at the vertices of `complex`, taken from the given ones.
  [[nodiscard]] std::vector<double> sizes(const std::vector<double>& given) const {
    return merged_.index.empty() || given.empty() ? given : merged_sizes(merged_, given);
  }

 private:
  Complex complex_;  // the given complex, or merged_
  Merged merged_;
};

class Input {
 public:
  /// `parts` are the parts of a pasted complex, or null.
  Input(const Complex& complex, SamePlace same_place, const Options& options, const Threads& threads,
        Monitor& monitor, PartsOfComplex* parts = nullptr)
      : given_(complex),
        distinct_(complex),
        same_place_(same_place),
        options_(options),
        threads_(threads),
        monitor_(monitor),
        parts_(parts) {}

  /// Returns the defects that can be found before Delaunay, and fills the counts of the input.
  [[nodiscard]] std::vector<Defect> validate(Report::Input& counts);
  /// Returns the other defects, found with the Delaunay tetrahedra; later calls do nothing.
  [[nodiscard]] std::vector<Defect> validate_missing(TetMesh& mesh, const Standing& standing);

  /// All defects of both kinds, by a separate search that takes as long as `diagnose`.
  [[nodiscard]] std::vector<Defect> defects() const;

  /// The complex with each place once.
  [[nodiscard]] const Complex& complex() const { return distinct_.complex(); }
  /// The caller's numbers for the vertices of `complex`.
  [[nodiscard]] VertexNames names() const { return distinct_.names(); }
  /// The `vertex_map` of a Result.
  [[nodiscard]] std::vector<std::int64_t> vertex_map() const { return as_map(distinct_.index()); }
  /// The sizes of the options, for the vertices of `complex`.
  [[nodiscard]] Sizes sizes() const;
  [[nodiscard]] const SegmentTable& table() const { return table_; }
  /// The paper's Target for all facets; computed once.
  [[nodiscard]] double target();

  [[nodiscard]] PartsOfComplex* parts() const { return parts_; }

  /// `diagnose` returns them all.
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
  Elements elements_;  // of the given complex, until they are known to be valid
  bool elements_fit_ = false;
  SegmentTable table_;
  std::optional<double> target_;
};

}  // namespace holdfast
