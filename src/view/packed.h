// The stream that holds a page's data, as viewer/src/container.ts reads it.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "io/watch.h"

namespace holdfast::view {

/// A zlib stream that grows by bytes, and by arrays in planes.
class Packed {
 public:
  explicit Packed(io::Watch& watch);
  ~Packed();
  Packed(const Packed&) = delete;
  Packed& operator=(const Packed&) = delete;

  void bytes(std::string_view text) { feed(text, Z_NO_FLUSH); }
  /// All first bytes of the values, then all second ones, and so on: neighbours in a plane are alike.
  void doubles(std::span<const double> values);
  /// Likewise, each less the value `step` before it unless that is 0.
  void words(std::span<const std::uint32_t> values, std::size_t step);
  /// Ends the stream and gives it.
  [[nodiscard]] std::string finish();

 private:
  void feed(std::string_view text, int flush);

  io::Watch& watch_;
  z_stream stream_{};
  std::string out_;
};

/// By RFC 4648, in which nothing is markup.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace holdfast::view
