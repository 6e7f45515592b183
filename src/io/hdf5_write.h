// As much of HDF5 as a mesh needs: arrays of numbers in the root group of a file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

enum class Hdf5Type { int32, int64, float64 };

/// An array of rows of numbers; its values stay with the caller.
struct Hdf5Array {
  std::string name;  ///< not empty; names differ
  Hdf5Type type;
  std::uint64_t rows, columns;
  const void* values;  ///< rows * columns of the type, in the machine's byte order
};

/// Writes a file of at most eight arrays. Throws std::invalid_argument for more.
void write_hdf5(AtomicWriter& out, std::vector<Hdf5Array> arrays);

}  // namespace holdfast::io
