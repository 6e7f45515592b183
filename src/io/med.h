// Shared by the reader and the writer of MED files (the layout of MED 3 and 4 in HDF5): element types and
// names.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace holdfast::io {

/// MED orders the first three corners of a tetrahedron in the opposite sense. The table gives our corner or
/// mid-edge node for each of MED's. Once the corners are swapped, the order of edges is the same.
inline constexpr std::array<std::size_t, 10> kMedTetrahedron{0, 2, 1, 3, 6, 5, 4, 7, 9, 8};

/// Groups of the file.
inline constexpr std::string_view kMedMeshes = "ENS_MAA", kMedFamilies = "FAS",
                                  kMedStep = "-0000000000000000001-0000000000000000001";

}  // namespace holdfast::io
