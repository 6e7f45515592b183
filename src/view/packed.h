// The stream of a page's data, in the format that viewer/src/container.ts reads.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::view {

/// A growing zlib stream. Bytes are appended as they are, arrays in byte planes.
class Packed {
 public:
  explicit Packed(io::Watch& watch);
  ~Packed();
  Packed(const Packed&) = delete;
  Packed& operator=(const Packed&) = delete;

  void bytes(std::string_view text) { feed(text, Z_NO_FLUSH); }
  /// Appends the first bytes of all values, then the second bytes, and so on: neighbours in a plane are
  /// alike.
  void doubles(std::span<const double> values);
  /// Likewise. Unless `step` is 0, each value is replaced by its difference to the value `step` before it.
  void words(std::span<const std::uint32_t> values, std::size_t step);
  /// Ends the stream and returns it.
  [[nodiscard]] std::string finish();

 private:
  void feed(std::string_view text, int flush);

  io::Watch& watch_;
  z_stream stream_{};
  std::string out_;
};

/// Base64 by RFC 4648; its alphabet contains no markup.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace holdfast::view
