// An XDMF file as its grids. Their arrays are in HDF5 files, in raw files or in the text.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_bytes.h"
#include "io/hdf5_read.h"
#include "io/vtk_cells.h"
#include "io/vtk_values.h"
#include "io/xml_reader.h"

namespace holdfast::io {

/// An element of the file and its text, up to the next tag.
struct XdmfItem {
  XmlTag tag;
  std::string_view text;
};

struct XdmfAttribute {
  XmlTag tag;
  std::vector<XdmfItem> items;
};

struct XdmfGrid {
  XmlTag tag;
  std::optional<XmlTag> topology, geometry;
  std::vector<XdmfItem> cells, points;
  std::vector<XdmfAttribute> attributes;
  bool takes_topology = false;  ///< uses the first grid's, by xi:include
};

/// A whole file. Arrays are read on demand; the HDF5 files stay open.
class XdmfFile {
 public:
  /// Throws FileError if the file is of another kind or truncated.
  explicit XdmfFile(const Source& source);

  [[nodiscard]] const Source& source() const { return source_; }
  /// The grids with cells or attributes of cells; for a collection in time, only its first grid.
  [[nodiscard]] const std::vector<XdmfGrid>& grids() const { return grids_; }
  /// The number of grids of later times.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// Whether a file with the boundary of the tetrahedra should exist.
  [[nodiscard]] bool surface_is_beside() const { return surface_is_beside_; }
  [[nodiscard]] Names take_names() { return names_.take(); }

  /// The values of the first item that has values, in an element `of` the file. T: double or std::int64_t.
  template <typename T>
  [[nodiscard]] std::vector<T> values_of(const std::vector<XdmfItem>& items, const XmlTag& of) const;
  /// Whether an item holds integers by its type, or by the array itself if the item states no type, as in
  /// DOLFINx's files.
  [[nodiscard]] bool holds_integers(const XdmfItem& item) const;
  /// An attribute that must be a count.
  [[nodiscard]] std::uint64_t number(const XmlTag& tag, std::string_view key) const {
    return xml_.number(tag, key);
  }
  [[noreturn]] void fail(const XmlTag& tag, const std::string& reason) const { xml_.fail(tag, reason); }

 private:
  struct Heavy {
    Heavy(std::filesystem::path name, Watch* watch)
        : path(std::move(name)), bytes(path, watch), file({path, bytes.view(), false, watch}) {}
    std::filesystem::path path;
    FileBytes bytes;
    Hdf5File file;
  };

  void read_grids();
  void read_name(const XmlTag& tag);
  [[nodiscard]] std::string_view text_behind() const;
  [[nodiscard]] std::pair<const Hdf5File*, Hdf5File::Object> array_of(const XdmfItem& item) const;
  [[nodiscard]] std::filesystem::path path_of(const XdmfItem& item) const;
  template <typename T>
  [[nodiscard]] std::vector<T> raw_values_of(const XdmfItem& item, std::uint64_t count) const;
  [[nodiscard]] VtkType raw_type_of(const XdmfItem& item) const;
  [[nodiscard]] std::uint64_t dimensions_of(const XdmfItem& item) const;

  Source source_;
  XmlReader xml_;
  std::vector<XdmfGrid> grids_;
  VtkNames names_;
  std::size_t left_out_ = 0;
  bool surface_is_beside_ = false;
  mutable std::map<std::string, std::unique_ptr<Heavy>> heavy_;
};

}  // namespace holdfast::io
