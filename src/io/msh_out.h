// Shared by the writers of Gmsh's .msh: numbers as text or as bytes, and the rule for names.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_writer.h"
#include "io/byte_reader.h"
#include "io/labels.h"

namespace holdfast::io {

/// Gmsh truncates names after 127 bytes, and a quote ends them.
inline constexpr NameRule kMshNames{127, "!#$%&'()*+,-./:;<=>?@[]^_`{|}~", true, true, false, true};

/// Gmsh's types of elements.
inline constexpr int kMshLine = 1, kMshTriangle = 2, kMshTetrahedron = 4, kMshLine3 = 8, kMshTriangle6 = 9,
                     kMshTetrahedron10 = 11, kMshPoint = 15;

/// Numbers as text or as bytes; words and the counts of version 2 are text in both.
class MshOut {
 public:
  MshOut(AtomicWriter& out, bool binary) : out_(out), binary_(binary) {}
  MshOut& integer(std::int64_t value) {
    return binary_ ? bytes(static_cast<std::int32_t>(value)) : text(value);
  }
  MshOut& size(std::uint64_t value) { return binary_ ? bytes(value) : text(value); }
  MshOut& point(const Point& p) {
    for (const double x : p) binary_ ? bytes(x) : text(x);
    return *this;
  }
  void end_line() {
    if (!binary_) out_ << '\n';
    first_ = true;
  }
  /// After the numbers of a section.
  void end_section(std::string_view end) {
    if (binary_) out_ << '\n';
    out_ << end << '\n';
  }
  [[nodiscard]] bool binary() const { return binary_; }
  AtomicWriter& out() { return out_; }

 private:
  template <typename T>
  MshOut& bytes(T value) {
    std::string raw;
    store(raw, value, std::endian::native);
    out_ << raw;
    return *this;
  }
  template <typename T>
  MshOut& text(T value) {
    if (!first_) out_ << ' ';
    first_ = false;
    out_ << value;
    return *this;
  }
  AtomicWriter& out_;
  bool binary_, first_ = true;
};

/// Writes $MeshFormat and, if there are names, $PhysicalNames: by dimension, one name for each id.
void write_msh_head(MshOut& to, std::string_view version, const std::array<const Labels*, 4>& labels);

}  // namespace holdfast::io
