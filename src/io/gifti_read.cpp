// GIFTI's .gii: surfaces of brains, as XML with arrays of numbers (NITRC, "Geometry format under the
// neuroimaging informatics technology initiative", 2011). Arrays of triangles belong to the
// array of points before them. Coordinates stay as they are stored; the matrices of coordinate
// systems are not applied.
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/base64.h"
#include "io/brain_surfaces.h"
#include "io/byte_reader.h"
#include "io/file_bytes.h"
#include "io/gunzip.h"
#include "io/text_reader.h"
#include "io/xml_reader.h"
#include "text/decimal.h"

namespace holdfast::io {
namespace {

struct NumberType {
  std::string_view name;
  std::size_t bytes;
  double (*load)(const char*, std::endian);
};

template <typename T>
double loaded(const char* bytes, std::endian order) {
  return static_cast<double>(load<T>(bytes, order));
}

constexpr NumberType kNumberTypes[] = {
    {"NIFTI_TYPE_FLOAT32", 4, loaded<float>},      {"NIFTI_TYPE_FLOAT64", 8, loaded<double>},
    {"NIFTI_TYPE_INT32", 4, loaded<std::int32_t>}, {"NIFTI_TYPE_UINT32", 4, loaded<std::uint32_t>},
    {"NIFTI_TYPE_INT64", 8, loaded<std::int64_t>}, {"NIFTI_TYPE_UINT64", 8, loaded<std::uint64_t>},
    {"NIFTI_TYPE_INT16", 2, loaded<std::int16_t>}, {"NIFTI_TYPE_UINT16", 2, loaded<std::uint16_t>},
    {"NIFTI_TYPE_UINT8", 1, loaded<unsigned char>}};

/// Whether an attribute has a value, which older files spell as the constant of the GIFTI library.
bool has(const XmlTag& tag, std::string_view key, std::string_view value, std::string_view constant) {
  const std::string given = tag.attribute(key);
  return given == value || given == constant;
}

/// An array of three numbers a row.
struct Rows {
  XmlTag tag;
  std::vector<Point> rows;
};

class GiftiReader {
 public:
  explicit GiftiReader(const Source& source) : source_(source), xml_(source), mesh_(source) {}

  MeshData read() {
    bool is_gifti = false;
    while (const std::optional<XmlTag> tag = xml_.next()) {
      step(source_.watch);
      if (!tag->closing && tag->name == "GIFTI") is_gifti = true;
      if (!tag->closing && tag->name == "DataArray") read_array(*tag);
    }
    if (!is_gifti) throw FileError(source_.path, "line 1", "expected GIFTI's XML, which has a tag <GIFTI>");
    for (std::size_t k = 0; k < points_.size(); ++k) add_points(k);
    mesh_.leave_out(
        others_, [](const std::string& intent) { return in_quotes(intent); }, "arrays of data",
        "array of data");
    return std::move(mesh_);
  }

 private:
  static constexpr std::string_view kEncoding = "Encoding";

  void read_array(const XmlTag& tag) {
    const std::string intent = tag.attribute("Intent");
    const bool is_points = intent == "NIFTI_INTENT_POINTSET";
    if (!is_points && intent != "NIFTI_INTENT_TRIANGLE") {
      ++others_[intent];
      return;
    }
    if (!is_points && points_.empty()) xml_.fail(tag, "triangles before any points");
    Rows rows{tag, rows_of(tag)};
    if (is_points) {
      points_.push_back(std::move(rows));
      triangles_.emplace_back();
    } else {
      triangles_.back().push_back(std::move(rows));
    }
  }

  std::vector<Point> rows_of(const XmlTag& tag) {
    const std::uint64_t rows = xml_.number(tag, "Dim0");
    if (xml_.number(tag, "Dimensionality") != 2 || xml_.number(tag, "Dim1") != 3)
      xml_.fail(tag, "points and triangles have three numbers a row");
    std::optional<XmlTag> data;
    if (!tag.empty) do
        data = xml_.next();
      while (data && data->name != "Data" && data->name != "DataArray");
    if (!data || data->name != "Data" || data->closing) xml_.fail(tag, "an array without <Data>");
    const std::vector<double> values = values_of(tag, rows);
    std::vector<Point> result(rows);
    // As text, nibabel writes and reads rows whatever the order says.
    const bool by_row = has(tag, kEncoding, "ASCII", "GIFTI_ENCODING_ASCII") ||
                        !has(tag, "ArrayIndexingOrder", "ColumnMajorOrder", "GIFTI_IND_ORD_COL_MAJOR");
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t k = 0; k < 3; ++k) result[r][k] = by_row ? values[3 * r + k] : values[k * rows + r];
    return result;
  }

  std::vector<double> values_of(const XmlTag& tag, std::uint64_t rows) {
    if (has(tag, kEncoding, "ASCII", "GIFTI_ENCODING_ASCII")) return values_in_text(tag, rows);
    if (has(tag, kEncoding, "ExternalFileBinary", "GIFTI_ENCODING_EXTBIN")) {
      const std::uint64_t offset =
          tag.attribute("ExternalFileOffset").empty() ? 0 : xml_.number(tag, "ExternalFileOffset");
      const auto path = source_.path.parent_path() / tag.attribute("ExternalFileName");
      const FileBytes file(path, source_.watch);
      if (offset > file.view().size()) throw FileError(path, "", "the file is truncated");
      return values_in(tag, rows, file.view().substr(offset));
    }
    const bool packed = has(tag, kEncoding, "GZipBase64Binary", "GIFTI_ENCODING_B64GZ");
    if (!packed && !has(tag, kEncoding, "Base64Binary", "GIFTI_ENCODING_B64BIN"))
      xml_.fail(tag, "unknown encoding " + in_quotes(tag.attribute(kEncoding)));
    std::optional<std::string> bytes = decoded_base64(xml_.text(), source_.watch);
    if (!bytes) xml_.fail(tag, "the data has characters that are not base64");
    if (packed) bytes = unpacked_zlib({source_.path, *bytes, false, source_.watch});
    return values_in(tag, rows, *bytes);
  }

  std::vector<double> values_in_text(const XmlTag& tag, std::uint64_t rows) {
    const std::string_view text = xml_.text();
    if (rows > text.size() / 3) xml_.fail(tag, "fewer numbers than its dimensions say");
    TextReader numbers({source_.path, text, false, source_.watch}, '\0');
    std::vector<double> values;
    values.reserve(3 * rows);
    while (values.size() < 3 * rows) {
      if (numbers.at_end()) xml_.fail(tag, "fewer numbers than its dimensions say");
      values.push_back(numbers.real("a number"));
    }
    return values;
  }

  std::vector<double> values_in(const XmlTag& tag, std::uint64_t rows, std::string_view bytes) {
    const std::string type = tag.attribute("DataType");
    const auto found = std::find_if(std::begin(kNumberTypes), std::end(kNumberTypes),
                                    [&](const NumberType& t) { return t.name == type; });
    if (found == std::end(kNumberTypes)) xml_.fail(tag, "unknown type of numbers " + in_quotes(type));
    if (rows > bytes.size() / (3 * found->bytes))
      xml_.fail(tag, "fewer numbers than its dimensions say; the file is damaged");
    const std::endian order =
        has(tag, "Endian", "BigEndian", "GIFTI_ENDIAN_BIG") ? std::endian::big : std::endian::little;
    std::vector<double> values(3 * rows);
    for (std::size_t i = 0; i < values.size(); ++i) {
      beat(source_.watch);
      values[i] = found->load(bytes.data() + i * found->bytes, order);
    }
    return values;
  }

  /// Appends an array of points with its triangles. Several arrays of points have different markers.
  void add_points(std::size_t k) {
    const std::vector<Point>& points = points_[k].rows;
    if (points.size() >= no_entity - mesh_.vertices.size())
      xml_.fail(points_[k].tag, "more vertices than 32 bits number");
    const auto first = static_cast<Index>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), points.begin(), points.end());
    const int marker = points_.size() > 1 ? static_cast<int>(k) + 1 : 0;
    for (const Rows& triangles : triangles_[k])
      for (const Point& row : triangles.rows) {
        Triangle t{};
        for (std::size_t i = 0; i < 3; ++i) {
          if (!(row[i] >= 0 && row[i] < static_cast<double>(points.size())) || row[i] != std::floor(row[i]))
            xml_.fail(triangles.tag, "a triangle has vertex " + decimal(row[i]) + ", but there are " +
                                         std::to_string(points.size()));
          t[i] = first + static_cast<Index>(row[i]);
        }
        mesh_.add_facet(t, marker);
      }
  }

  Source source_;
  XmlReader xml_;
  MeshData mesh_;
  std::vector<Rows> points_;
  std::vector<std::vector<Rows>> triangles_;  ///< of each array of points
  std::map<std::string, std::size_t> others_;
};

}  // namespace

MeshData read_gifti(const Source& source) { return GiftiReader(source).read(); }

}  // namespace holdfast::io
