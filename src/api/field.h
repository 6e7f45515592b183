// Kept regions with field points, and the sizes that determine these (paper §9).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "api/boundary.h"
#include "api/without_field.h"
#include "refine/parts.h"
#include "refine/volume_data.h"
#include "size/size_function.h"

namespace holdfast {

/// The mesh and its division belong to the call, and must outlive it.
class Field {
 public:
  Field(const Attempt& attempt, BoxMesh& box, Division& division);
  Field(const Field&) = delete;  // its parts refer to its sizes
  Field& operator=(const Field&) = delete;

  [[nodiscard]] VolumeData volume();
  /// Sets the sizes of all vertices that the surface and the user ask for.
  void set_sizes(const Attempt& attempt);
  /// Sets the sizes of added vertices that have none.
  void give_sizes_to_new_vertices();
  /// Set while a large mesh is in parts, so that improvement can continue with them; otherwise null.
  std::unique_ptr<Parts> parts;
  [[nodiscard]] const SizeFunction& size_function() const { return size_function_; }
  void set_size_function(SizeFunction sizes) { size_function_ = std::move(sizes); }
  /// Whether the user's limit determines the size of some vertex.
  [[nodiscard]] bool is_limited() const;
  [[nodiscard]] bool has_metric() const { return !metrics_.empty(); }
  /// For comparison if the surface alone decides on sizes; otherwise null.
  std::unique_ptr<WithoutField> without;
  double worst_without = 0;  ///< worst Q of `without`, once optimised

 private:
  BoxMesh& box_;
  Division& division_;
  const std::uint64_t seed_;
  const bool asks_for_metric_;
  SizeFunction size_function_;
  std::vector<double> sizes_;    // by vertex
  std::vector<Metric> metrics_;  // by vertex; empty unless the user gives a metric
};

/// Adds points. Uses smaller sizes than the user's if those of a region give too few elements. Returns
/// whether it stopped early.
bool add_enough_points(const Attempt& attempt, BoxMesh& box, Division& division, Field& field,
                       Report::Field& report);

}  // namespace holdfast
