// The part of HDF5 that a mesh needs: groups with attributes, and arrays of numbers and texts.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "holdfast/types.h"
#include "io/atomic_writer.h"

namespace holdfast::io {

struct Hdf5Attribute {
  std::string name;
  std::variant<std::int32_t, double, std::string> value;
};

enum class Hdf5Type {
  int8,
  int32,
  int64,
  float32,
  float64,
  text80,  ///< 80 bytes, padded with zeros, as MED stores names
};

/// An array of rows of numbers; its values stay with the caller.
struct Hdf5Array {
  std::string name;  ///< not empty, without slashes, unique in its group
  Hdf5Type type;
  std::uint64_t rows, columns;
  const void* values;  ///< rows * columns of the type, in the machine's byte order
  std::vector<Hdf5Attribute> attributes = {};
  bool two_directions = false;  ///< also with one column
};

struct Hdf5Group {
  std::string name;  ///< as of arrays; the root has none
  std::vector<Hdf5Attribute> attributes = {};
  std::vector<Hdf5Array> arrays = {};
  std::vector<Hdf5Group> groups = {};
};

/// Writes a file. Throws std::invalid_argument if a group has more than 65,000 members.
void write_hdf5(AtomicWriter& out, const Hdf5Group& root);

}  // namespace holdfast::io
