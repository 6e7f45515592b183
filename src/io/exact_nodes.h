// Coordinates of few characters. Abaqus and CalculiX read 20 characters of a number (Abaqus: "Input syntax
// rules"; CalculiX reads with Fortran's f20.0), so an exponent after them would be lost; LS-DYNA and Nastran
// read 16. A coordinate that needs more is rounded; its exact value is written in a comment, from which it is
// read back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

inline constexpr std::size_t kInpCharacters = 20, kDynaCharacters = 16;

/// The number of at most `most` characters that is nearest to `value`; exact if possible.
[[nodiscard]] std::string short_real(double value, std::size_t most);

/// The double that a format's text of a coordinate has.
using Rounding = double (*)(double);
[[nodiscard]] double rounded_for_inp(double value);
[[nodiscard]] double rounded_for_dyna(double value);

/// Writes a comment for each node that is rounded: `** exact NODE X Y Z` after the format's comment mark.
void write_exact_nodes(AtomicWriter& out, const Volume& volume, std::string_view mark, Rounding rounding);

/// The nodes in such comments.
class ExactNodes {
 public:
  explicit ExactNodes(Rounding rounding) : rounding_(rounding) {}
  /// Reads a comment, without its mark. Other comments are ignored.
  void read(std::string_view comment);
  /// The exact position of a node if `point` is that position rounded; otherwise `point`, since the node may
  /// have been moved.
  [[nodiscard]] const Point& of(std::int64_t node, const Point& point) const;

 private:
  Rounding rounding_;  ///< of the file
  std::unordered_map<std::int64_t, Point> points_;
};

}  // namespace holdfast::io
