// Small EnSight Gold files: a case and its geometry.
#pragma once

#include <string>

#include "io_samples.h"

namespace holdfast::samples {

inline const std::string kEnsightCase =
    "# by hand\nFORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: a.geo\n\nVARIABLE\n";

/// Two tetrahedra in a part each, and a part of their common face.
inline const std::string kEnsightGeo =
    "two tetrahedra\n\nnode id given\nelement id off\nextents\n 0 1\n 0 1\n 0 1\npart\n         "
    "3\nupper\ncoordinates\n"
    "         4\n 10\n 20\n 30\n 40\n 0.00000e+00\n 1\n 0\n 0\n 0\n 0\n 1\n 0\n 0\n 0\n 0\n 1\ntetra4\n      "
    "   1\n"
    "         1         2         3         4\npart\n         7\nlower\ncoordinates\n         4\n 10\n 30\n "
    "20\n 50\n 0\n 0\n 1\n 0\n 0\n"
    " 1\n 0\n 0\n 0\n 0\n 0\n -1\ntetra4\n         1\n         1         2         3         4\ng_tetra4\n   "
    "      1\n 1 2 3 4\n"
    "part\n         9\n\ncoordinates\n         3\n 1\n 2\n 3\n 0\n 1\n 0\n 0\n 0\n 1\n 0\n 0\n 0\ntria3\n    "
    "     1\n 1 2 3\npoint\n 1\n 1\n";

/// A hexahedron and a quadrangle on it, in binary.
inline std::string binary_ensight(bool big) {
  const auto text = [](std::string line) {
    line.resize(80, '\0');
    return line;
  };
  std::string bytes = text("C Binary") + text("a") + text("b") + text("node id off") +
                      text("element id given") + text("part") + raw(std::int32_t{2}, big) + text("all\n") +
                      text("coordinates") + raw(std::int32_t{8}, big);
  for (const float x : {0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 0.F, 1.F, 1.F,
                        0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 1.F, 1.F, 1.F})
    bytes += raw(x, big);
  bytes += text("hexa8") + raw(std::int32_t{1}, big) + raw(std::int32_t{77}, big);
  for (std::int32_t i = 1; i <= 8; ++i) bytes += raw(i, big);
  bytes +=
      text("nsided") + raw(std::int32_t{1}, big) + raw(std::int32_t{78}, big) + raw(std::int32_t{4}, big);
  for (const std::int32_t i : {5, 6, 7, 8}) bytes += raw(i, big);
  return bytes;
}

}  // namespace holdfast::samples
