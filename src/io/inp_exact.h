// Coordinates of .inp. Abaqus and CalculiX read 20 characters of a number (Abaqus: "Input syntax rules";
// CalculiX reads by Fortran's f20.0), so that an exponent behind them is lost: what 20 characters do not hold
// is rounded, and stands in a comment as it was, from which it is read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

/// A number in at most 20 characters, the nearest to `value` of those; exact if one is.
[[nodiscard]] std::string inp_real(double value);

/// A comment for each node that .inp rounds: `** exact NODE X Y Z`.
void write_exact_nodes(AtomicWriter& out, const Volume& volume);

/// The nodes of such comments.
class ExactNodes {
 public:
  /// Takes a comment, without the two asterisks; others are left alone.
  void read(std::string_view comment);
  /// The exact place of a node, where `point` is that one rounded, or else `point`: it may have moved since.
  [[nodiscard]] const Point& of(std::int64_t node, const Point& point) const;

 private:
  std::unordered_map<std::int64_t, Point> points_;
};

}  // namespace holdfast::io
