// TetGen's switches, as `holdfast tetgen` takes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace holdfast::cli {

struct TetgenSwitches {
  bool complex = false;              ///< p: the file is a surface
  bool keep_surface = false;         ///< Y
  bool refine = false;               ///< q
  double ratio = 2;                  ///< q1.4
  double dihedral = 0;               ///< q1.4/20, in degrees; 0: not given
  std::optional<double> max_volume;  ///< a0.1
  bool volume_by_region = false;     ///< a: the bounds of regions in the file
  bool attributes = false;           ///< A
  bool size_field = false;           ///< m
  bool insert = false;               ///< i
  bool detect = false;               ///< d
  bool hull = false;                 ///< c
  bool second_order = false;         ///< o2
  bool from_zero = false;            ///< z
  bool all_faces = false;            ///< f
  bool all_edges = false;            ///< e
  bool neighbours = false;           ///< n
  bool adjacent = false;             ///< nn
  bool medit = false;                ///< g
  bool vtk = false;                  ///< k
  bool keep_unused = false;          ///< J
  bool no_markers = false, no_nodes = false, no_elements = false, no_faces = false;  ///< B N E F
  bool same_name = false;                                                            ///< I
  bool check = false, quiet = false, verbose = false;                                ///< C Q V
  std::string idle;  ///< ignored switches without a counterpart: M, O, T, ...

  /// Whether field points are wanted.
  [[nodiscard]] bool has_sizes() const { return refine || max_volume || volume_by_region || size_field; }
};

/// Reads switches such as "-pq1.4a0.1AY"; several texts act as one. Throws UsageError for unknown switches,
/// and for those that Holdfast does not support, with the reason.
void read_switches(const std::string& text, TetgenSwitches& switches);

}  // namespace holdfast::cli
