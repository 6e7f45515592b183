// The arrays of a VTK XML file: ASCII, base64 and raw, uncompressed and in compressed blocks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/vtk_values.h"
#include "io/vtu_decode.h"
#include "io/xml_reader.h"

namespace holdfast::io {

/// A DataArray element, not yet decoded.
struct DataArray {
  XmlTag tag;
  std::size_t content = 0;  ///< offset after the tag
};

/// A whole file. Its arrays are decoded on demand. All queries concern the current piece, which at first is
/// the first one.
class VtuFile {
 public:
  /// Throws FileError if the file is of another kind or truncated.
  explicit VtuFile(const Source& source);

  [[nodiscard]] const Source& source() const { return source_; }
  /// PolyData; otherwise an UnstructuredGrid.
  [[nodiscard]] bool is_polydata() const { return polydata_; }
  [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }
  void turn_to(std::size_t piece) { piece_ = piece; }
  [[nodiscard]] std::uint64_t points() const { return piece().points; }
  [[nodiscard]] std::uint64_t cells() const { return piece().cells; }
  /// The number of cells in a section of polygonal data.
  [[nodiscard]] std::uint64_t cells_of(const std::string& section) const {
    const auto found = piece().counts.find(section);
    return found == piece().counts.end() ? 0 : found->second;
  }

  /// By "section/name"; the name of the points' array is empty.
  [[nodiscard]] const std::map<std::string, DataArray>& arrays() const { return piece().arrays; }
  [[nodiscard]] const std::vector<std::string>& arrays_of_strings() const { return piece().strings; }
  [[nodiscard]] const DataArray* find(const std::string& name) const;
  /// The values of an array that must exist; there must be `count` of them if that is known. T: double, int,
  /// std::int64_t or std::uint8_t.
  template <typename T>
  [[nodiscard]] std::vector<T> values(const std::string& name, std::optional<std::uint64_t> count) const;
  /// The number of values a point or cell, 1 to 9.
  [[nodiscard]] std::uint64_t components(const DataArray& array) const;

 private:
  struct Seen;
  struct Piece {
    std::uint64_t points = 0, cells = 0;
    std::map<std::string, std::uint64_t> counts;
    std::map<std::string, DataArray> arrays;  ///< including those of the whole file
    std::vector<std::string> strings;         ///< names of arrays of strings, of points and cells
  };
  struct Appended {
    std::size_t offset;
    bool base64;
  };
  void read_tag(const XmlTag& tag, Seen& seen);
  [[nodiscard]] const Piece& piece() const { return pieces_[piece_]; }
  void read_file_attributes(const XmlTag& tag, Seen& seen);
  void read_piece(const XmlTag& tag, Seen& seen);
  void read_appended(const XmlTag& tag);

  template <typename T>
  [[nodiscard]] std::vector<T> read_values(const DataArray& array, std::optional<std::uint64_t> count) const;
  template <typename T>
  [[nodiscard]] std::vector<T> text_values(const DataArray& array) const;
  [[nodiscard]] std::string decoded(const DataArray& array, bool base64, std::size_t position,
                                    std::optional<std::uint64_t> count) const;
  void require_count(const DataArray& array, std::uint64_t size, std::optional<std::uint64_t> count) const;
  [[nodiscard]] VtkType type_of(const DataArray& array) const;

  Source source_;
  XmlReader xml_;
  VtuEncoding encoding_;
  bool polydata_ = false;
  std::vector<Piece> pieces_;
  std::size_t piece_ = 0;
  std::optional<Appended> appended_;
};

}  // namespace holdfast::io
