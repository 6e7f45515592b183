// Numbers in HDF5's own structures, which are little endian.
#pragma once

#include "io/byte_reader.h"
#include "io/hdf5_read.h"

namespace holdfast::io {

inline constexpr std::uint64_t kNoAddress = ~std::uint64_t{0};

/// The bytes that a structure takes which is padded to a multiple of eight.
[[nodiscard]] inline std::size_t hdf5_padded(std::size_t size) { return (size + 7) / 8 * 8; }

template <typename T>
T Hdf5File::number(std::uint64_t at) const {
  return load<T>(bytes(at, sizeof(T)).data(), std::endian::little);
}

}  // namespace holdfast::io
