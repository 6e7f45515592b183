// The input of a call: what validation finds out about it, once for all attempts.
#pragma once

#include <optional>
#include <vector>

#include "holdfast/holdfast.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/tet_mesh.h"
#include "recover/standing.h"
#include "surface/complex.h"
#include "surface/elements.h"

namespace holdfast {

class Input {
 public:
  Input(const Complex& complex, const Options& options, const Threads& threads, Monitor& monitor)
      : complex_(complex), options_(options), threads_(threads), monitor_(monitor) {}

  /// Defects that can be told before Delaunay, and the counts of the input; none where all is well so far.
  [[nodiscard]] std::vector<Defect> validate(Report::Input& counts);
  /// The rest, with Delaunay tetrahedra at hand; nothing to do after the first time.
  [[nodiscard]] std::vector<Defect> validate_missing(TetMesh& mesh, const Standing& standing);

  [[nodiscard]] const Complex& complex() const { return complex_; }
  [[nodiscard]] const SegmentTable& table() const { return table_; }
  /// The paper's Target, of all facets; computed once.
  [[nodiscard]] double target();

  /// `diagnose` gives them all.
  static constexpr std::size_t kMostDefects = 100;

 private:
  Report::Input list_elements_and_segments();
  [[nodiscard]] std::vector<Defect> defects() const;
  [[nodiscard]] std::function<void(double)> poll() const;

  const Complex& complex_;
  const Options& options_;
  const Threads threads_;
  Monitor& monitor_;
  Elements elements_;  // until they are known to fit together
  bool elements_fit_ = false;
  SegmentTable table_;
  std::optional<double> target_;
};

}  // namespace holdfast
