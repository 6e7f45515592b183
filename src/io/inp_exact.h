// Coordinates in .inp. Abaqus and CalculiX read 20 characters of a number (Abaqus: "Input syntax rules";
// CalculiX reads with Fortran's f20.0), so an exponent after them would be lost. A coordinate that needs more
// than 20 characters is rounded; its exact value is written in a comment, from which it is read back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

/// The number of at most 20 characters that is nearest to `value`; exact if possible.
[[nodiscard]] std::string inp_real(double value);

/// Writes a comment for each node that .inp rounds: `** exact NODE X Y Z`.
void write_exact_nodes(AtomicWriter& out, const Volume& volume);

/// The nodes in such comments.
class ExactNodes {
 public:
  /// Reads a comment, without its two asterisks. Other comments are ignored.
  void read(std::string_view comment);
  /// The exact position of a node if `point` is that position rounded; otherwise `point`, since the node may
  /// have been moved.
  [[nodiscard]] const Point& of(std::int64_t node, const Point& point) const;

 private:
  std::unordered_map<std::int64_t, Point> points_;
};

}  // namespace holdfast::io
