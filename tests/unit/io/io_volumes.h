// Volumes read from bytes, and the errors of reading them.
#pragma once

#include "io_samples.h"

namespace holdfast::samples {

inline Volume volume(const std::string& bytes, const std::string& name) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  return read_volume(folder / name);
}

/// The place and reason of the reading error, without the path.
inline std::string error(const std::string& bytes, const std::string& name) {
  try {
    static_cast<void>(volume(bytes, name));
  } catch (const FileError& failure) {
    return std::string(failure.what()).substr(failure.path().string().size() + 2);
  }
  return "read";
}

}  // namespace holdfast::samples
