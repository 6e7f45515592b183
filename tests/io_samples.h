// Shared by the tests of the file formats: a temporary folder, sample meshes, valid sample files.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/io.h"
#include "io/byte_reader.h"

namespace holdfast::samples {

inline WriteOptions uncompressed() {
  WriteOptions options;
  options.compress = false;
  return options;
}

inline WriteOptions legacy_msh() {
  WriteOptions options;
  options.legacy_msh = true;
  return options;
}

inline WriteOptions as_format(const std::string& format) {
  WriteOptions options;
  options.format = format;
  return options;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Two surfaces of GOCAD that close a tetrahedron, and a line.
inline const char* const kGocad = R"(GOCAD TSurf 1
HEADER {
name:Top horizon
*solid*color:#ffff00
}
GOCAD_ORIGINAL_COORDINATE_SYSTEM
NAME Default
AXIS_NAME "X" "Y" "Z"
AXIS_UNIT "m" "m" "m"
ZPOSITIVE Elevation
END_ORIGINAL_COORDINATE_SYSTEM
PROPERTIES T
TFACE
VRTX 1 0 0 0 CNXYZ
PVRTX 2 1 0 0 12.5
VRTX 3 0 1 0
TRGL 1 3 2
BSTONE 1
BORDER 4 1 2
END
GOCAD TSurf 1
HEADER {
name: sides
}
TFACE
VRTX 1 0 0 0
VRTX 2 1 0 0
VRTX 3 0 1 0
VRTX 4 0 0 1
ATOM 5 4
TRGL 1 2 4
TRGL 2 3 4
TRGL 1 5 3
END
GOCAD PLine 1
HEADER {
}
ILINE
VRTX 7 0 0 0
VRTX 8 1 0 0
SEG 7 8
END
)";

/// Two parts and three instances, as Abaqus/CAE writes them.
inline const char* const kAssembly = R"(*Heading
** Job name: Job-1 Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
**
** PARTS
**
*Part, name=Block
*Node
      1,           0.,           0.,           0.
      2,           1.,           0.,           0.
      3,           0.,           1.,           0.
      4,           0.,           0.,           1.
*Element, type=C3D4
1, 1, 2, 3, 4
*Nset, nset=Set-1, generate
 1,  4,  1
*Elset, elset=Set-1
 1,
** Section: Section-1
*Solid Section, elset=Set-1, material=Steel
,
*End Part
**
*Part, name=Lid
*Node
      1,           0.,           0.,           0.
      2,           1.,           0.,           0.
      3,           0.,           1.,           0.
      4,           0.,           0.,           -1.
*Element, type=C3D4
1, 1, 3, 2, 4
*Elset, elset=Set-1
 1,
*End Part
**
** ASSEMBLY
**
*Assembly, name=Assembly
**
*Instance, name=Block-1, part=Block
*End Instance
**
*Instance, name=Lid-1, part=Lid
          0.,           0.,          -2.
*End Instance
**
*Instance, name=Lid-2, part=Lid
          5.,           0.,          0.
          5.,           0.,          0.,           5.,           0.,          1.,    90.
*End Instance
**
*Elset, elset=_top_S1, internal, instance=Block-1
 1,
*Surface, type=ELEMENT, name=top
_top_S1, S1
*End Assembly
*Material, name=Steel
*Elastic
210000., 0.3
*Step, name=Step-1
*Static
*End Step
)";

/// The message of a call's FileError after the path; "read" if there is none.
template <typename Read>
std::string refusal_of(Read&& read) {
  try {
    static_cast<void>(read());
  } catch (const FileError& failure) {
    return std::string(failure.what()).substr(failure.path().string().size() + 2);
  }
  return "read";
}

/// A folder that is removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("holdfast-io-" + std::to_string(::getpid()) + "-" + std::to_string(number++));
    std::filesystem::create_directory(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      result.push_back(entry.path().filename().string());
    return result;
  }

 private:
  std::filesystem::path path_;
};

inline void put(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::string get(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Coordinates whose every bit must survive: no short decimals, both zeros, extremes, denormals.
inline std::vector<Point> awkward_points() {
  using Limits = std::numeric_limits<double>;
  return {{0.1, 1.0 / 3, -0.0},
          {0.0, Limits::max(), Limits::lowest()},
          {Limits::min(), Limits::denorm_min(), -Limits::denorm_min()},
          {1e22, 123456789012345678.0, 9007199254740993.0},
          {5e-324, 2.2250738585072011e-308, -1.7976931348623157e308},
          {-1.5, 1e-5, 1e15}};
}

/// A volume with every kind of entity, negative and large tags, and an unused vertex.
inline Volume sample_volume() {
  Volume volume;
  volume.vertices = awkward_points();
  volume.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {4, 3, 2, 1}};
  volume.regions = {-3, 1, 2147483647};
  volume.facets = {{0, 1, 2}, {3, 2, 1}};
  volume.facet_markers = {-2147483647, 7};
  volume.segments = {{4, 0}, {1, 0}, {3, 2}};
  volume.segment_markers = {0, 5, 9};
  volume.vertex_markers = {0, 3, -3, 0, 3, 2147483647};
  return volume;
}

/// The bits of a coordinate list, for comparisons that distinguish -0 from +0.
inline std::vector<std::uint64_t> bits(const std::vector<Point>& points) {
  std::vector<std::uint64_t> result;
  for (const Point& point : points)
    for (const double x : point) result.push_back(std::bit_cast<std::uint64_t>(x));
  return result;
}

/// A unit tetrahedron's surface with a dangling segment, as text of several formats.
inline const char* const kOff =
    "OFF\n# a comment\n5 6 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n-1 -1 -0.5\n3 0 2 1\n3 0 1 3\n3 1 2 3 0.1 0.2 0.3\n"
    "3 2 0 3\n2 0 4\n1 4\n";
inline const char* const kObj =
    "# cube side\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 1.0\nv 0 1 0\nv 0 0 1 0.5 0.5 0.5\nvt 0 0\n"
    "vn 0 0 1\nusemtl m\ns off\nf 1/1/1 2//1 3/1 4\nf -5 -4 -1\nl 1 5 2\np 3\n";
inline const char* const kPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement face 3\nproperty uchar flags\n"
    "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
    "end_header\n0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 1 255\n0 3 0 2 1\n0 3 0 1 3\n0 3 1 2 3\n2 3\n";
inline const char* const kStl =
    "solid first part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n"
    "  endloop\n endfacet\nendsolid first part\nsolid\nfacet normal nan nan nan\nouter loop\nvertex 1 0 0\n"
    "vertex 0 1 0\nvertex 0 0 1e0\nendloop\nendfacet\nendsolid\n";
inline const char* const kMesh =
    "MeshVersionFormatted 2\nDimension\n3\n# comment\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n"
    "Edges\n1\n1 2 8\nTriangles\n2\n1 3 2 10\n1 2 4 20\nTetrahedra 1\n1 2 3 4 5\nRidges\n1\n1\nEnd\n";
inline const char* const kPoly =
    "# part 1\n5 3 0 1\n1 0 0 0 1\n2 1 0 0 1\n3 1 1 0 1\n4 0 1 0 1\n5 0 0 1 1\n# part 2\n3 1\n1 0 7\n4 1 2 3 "
    "4\n"
    "2 0 8\n3 1 2 5\n3 2 3 5\n1\n2 1 5\n# part 3\n1\n1 0.5 0.5 0.25\n# part 4\n2\n1 0.1 0.1 0.1 3 -1\n"
    "2 0.2 0.2 0.2 -4.0\n";
inline const char* const kSmesh =
    "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1\n3 0 2 1 5\n3 0 1 3 6\n3 1 2 3 7\n3 2 0 3 8\n0\n0\n";
inline const char* const kDxf =
    "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n1\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n12\n0"
    "\n22\n1\n0\n"
    "ENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n8\nx\n2\nB\n10\n5\n50\n90\n41\n-"
    "1\n0\nPOLYLINE\n70\n64\n0\n"
    "VERTEX\n70\n192\n10\n0\n0\nVERTEX\n70\n192\n10\n1\n0\nVERTEX\n70\n192\n20\n1\n0\nVERTEX\n70\n128\n71\n1"
    "\n72\n2\n"
    "73\n-3\n0\nSEQEND\n0\nENDSEC\n0\nEOF\n";
inline const char* const kAc3d =
    "AC3Db\nMATERIAL \"red\" rgb 1 0 0\nOBJECT world\nkids 2\nOBJECT group\nloc 1 2 3\nkids 1\nOBJECT poly\n"
    "name \"a\"\ndata 2\n{}\nrot 0 1 0 -1 0 0 0 0 1\nnumvert 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnumsurf 2\n"
    "SURF 0x10\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nSURF 0x24\nrefs 4\n3 0 0\n2 0 0\n1 0 0\n0 0 0\n"
    "kids 0\nOBJECT poly\nnumvert 1\n5 5 5\nkids 0\n";
inline const char* const kGifti =
    "<?xml version=\"1.0\"?>\n<GIFTI Version=\"1.0\" NumberOfDataArrays=\"3\">\n"
    "<DataArray Intent=\"NIFTI_INTENT_POINTSET\" DataType=\"NIFTI_TYPE_FLOAT32\" "
    "ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"2\" Dim0=\"4\" Dim1=\"3\" Encoding=\"ASCII\" "
    "Endian=\"LittleEndian\">\n<MetaData><MD><Name><![CDATA[a]]></Name></MD></MetaData>\n"
    "<Data>0 0 0 1 0 0 0 1 0 0 0 1</Data></DataArray>\n"
    "<DataArray Intent=\"NIFTI_INTENT_TRIANGLE\" DataType=\"NIFTI_TYPE_INT32\" "
    "ArrayIndexingOrder=\"ColumnMajorOrder\" Dimensionality=\"2\" Dim0=\"4\" Dim1=\"3\" "
    "Encoding=\"Base64Binary\" Endian=\"LittleEndian\">\n"
    "<Data>AAAAAAAAAAAAAAAAAQAAAAIAAAABAAAAAwAAAAIAAAABAAAAAwAAAAIAAAADAAAA</Data></DataArray>\n"
    "<DataArray Intent=\"NIFTI_INTENT_SHAPE\" DataType=\"NIFTI_TYPE_FLOAT32\" Dimensionality=\"1\" "
    "Dim0=\"4\" "
    "Encoding=\"ASCII\"><Data>1 2 3 4</Data></DataArray>\n</GIFTI>\n";
/// A tetrahedron as FreeSurfer writes it, with a footer.
inline std::string freesurfer_bytes() {
  std::string bytes =
      "\xFF\xFF\xFE"
      "created by a test\n\n";
  const auto add = [&](auto value) { io::store(bytes, value, std::endian::big); };
  add(std::int32_t{4});
  add(std::int32_t{4});
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F}) add(x);
  for (const std::int32_t v : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) add(v);
  return bytes + "footer";
}
/// Two meshes of 3D Studio: a tetrahedron whose first two triangles are of one material, and points alone.
inline std::string threeds_bytes() {
  const auto chunk = [](std::uint16_t id, const std::string& data) {
    std::string bytes;
    io::store(bytes, id, std::endian::little);
    io::store(bytes, static_cast<std::uint32_t>(data.size() + 6), std::endian::little);
    return bytes + data;
  };
  const auto numbers = [](std::uint16_t count, auto... values) {
    std::string bytes;
    io::store(bytes, count, std::endian::little);
    (io::store(bytes, values, std::endian::little), ...);
    return bytes;
  };
  const auto u = [](int v) { return static_cast<std::uint16_t>(v); };
  const auto name = [](const char* text) { return std::string(text) + '\0'; };
  const std::string points =
      chunk(0x4110, numbers(4, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F));
  const std::string faces =
      chunk(0x4120, numbers(4, u(0), u(2), u(1), u(7), u(0), u(1), u(3), u(7), u(0), u(3), u(2), u(7), u(1),
                            u(2), u(3), u(7)) +
                        chunk(0x4130, name("red") + numbers(2, u(0), u(1))) + chunk(0x4150, "01234567"));
  return chunk(0x4D4D, chunk(0x0002, "\3\0\0") +
                           chunk(0x3D3D, chunk(0xAFFF, chunk(0xA000, name("blue"))) +
                                             chunk(0x4000, name("body") + chunk(0x4100, faces + points)) +
                                             chunk(0x4000, name("dots") + chunk(0x4100, points))) +
                           chunk(0xB000, ""));
}
inline const char* const kGts =
    "# tetrahedron\n4 6 4 GtsSurface GtsFace GtsEdge GtsVertex\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2\n2 3\n3 1\n1 "
    "4\n2 "
    "4\n3 4\n3 2 1 5\n1 5 4\n2 6 5\n3 4 6\n";
inline const char* const kMsh2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"wall\"\n$EndPhysicalNames\n$Nodes\n4\n"
    "10 0 0 0\n20 1 0 0\n40 0 0 1\n30 0 1 0\n$EndNodes\n$Elements\n4\n1 15 2 0 1 10\n2 1 2 0 3 10 20\n"
    "3 2 2 7 1 10 30 20\n4 4 2 9 1 10 20 30 40\n$EndElements\n";
inline const char* const kMsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 1 1\n1 0 0 0 0\n1 0 0 0 1 0 0 0 2 1 -1\n"
    "1 0 0 0 1 1 0 1 7 1 1\n4 0 0 0 1 1 1 0 1 1\n$EndEntities\n$Nodes\n2 4 1 4\n0 1 0 1\n4\n0 0 1\n2 1 1 3\n"
    "1\n2\n3\n0 0 0 0.1 0.2\n1 0 0 0.1 0.2\n0 1 0 0.1 0.2\n$EndNodes\n$Elements\n3 3 1 3\n1 1 1 1\n1 1 2\n"
    "2 1 2 1\n2 1 3 2\n3 4 4 1\n3 1 2 3 4\n$EndElements\n";
inline const char* const kVtk =
    "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 "
    "0\n"
    "0 0 1\nMETADATA\nINFORMATION 1\nNAME x LOCATION y\nDATA 1 2\n\nCELLS 4 9\nOFFSETS vtktypeint64\n0 4 7 "
    "9\n"
    "CONNECTIVITY vtktypeint64\n0 1 2 3 0 2 1 0 1\nCELL_TYPES 3\n10\n5\n3\nCELL_DATA 3\n"
    "SCALARS region int\nLOOKUP_TABLE default\n6 0 0\nFIELD FieldData 2\nmarker 1 3 int\n0 7 8\n"
    "other 2 3 double\n1 2 3 4 5 6\nPOINT_DATA 4\nVECTORS v float\n1 2 3 1 2 3 1 2 3 1 2 3\n";
inline const char* const kVtu =
    "<?xml version=\"1.0\"?>\n<!-- <Piece> -->\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
    "byte_order=\"LittleEndian\">\n<UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='3'>\n"
    "<PointData><DataArray type=\"Float32\" Name=\"region\" format=\"ascii\">9 9 9 "
    "9</DataArray></PointData>\n"
    "<CellData><DataArray type=\"Float64\" Name=\"region\" format=\"ascii\">6 0 0</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"marker\" format=\"ascii\">0 7 8</DataArray></CellData>\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
    "0 0 0 1 0 0\n0 1 0 0 0 1\n</DataArray></Points>\n<Cells>\n"
    "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 0 2 1 0 1</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 7 9</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 5 3</DataArray>\n"
    "</Cells></Piece></UnstructuredGrid></VTKFile>\n";

/// Polygonal data whose sections are not in the order of its cell data: vertices, lines, polygons, strips.
inline const char* const kStrips =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 "
    "1 2 1\n"
    "TRIANGLE_STRIPS 1 7\n6 0 1 2 3 4 5\nPOLYGONS 1 4\n3 0 2 1\nVERTICES 1 2\n1 5\n"
    "CELL_DATA 3\nSCALARS marker int\n3 1 2\nPOINT_DATA 6\nSCALARS heat float\n0 0 0 0 0 0\n";

/// Bytes of a number, in either byte order.
template <typename T>
std::string raw(T value, bool big_endian = false) {
  std::array<char, sizeof(T)> bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

/// A binary STL file of the given header and triangles.
inline std::string binary_stl(const std::string& header, const std::vector<std::array<float, 9>>& triangles) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes += raw(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    bytes.append(12, '\0');
    for (const float x : triangle) bytes += raw(x);
    bytes.append(2, '\0');
  }
  return bytes;
}

/// A binary PLY file of one triangle and one edge.
inline std::string binary_ply(bool big, const char* line_end = "\n") {
  const std::string n = line_end;
  std::string bytes = "ply" + n + "format binary_" + (big ? "big" : "little") + "_endian 1.0" + n +
                      "element vertex 3" + n + "property double x" + n + "property float y" + n +
                      "property double z" + n + "property list uchar short extra" + n + "element face 1" + n +
                      "property list ushort uint vertex_index" + n + "element edge 1" + n +
                      "property uchar vertex1" + n + "property int vertex2" + n + "end_header" + n;
  for (const double x : {0.1, 1.1, 2.1}) {
    bytes += raw(x, big) + raw(static_cast<float>(-x), big) + raw(10 * x, big);
    bytes += raw(std::uint8_t{2}, big) + raw(std::int16_t{-1}, big) + raw(std::int16_t{77}, big);
  }
  bytes += raw(std::uint16_t{3}, big) + raw(std::uint32_t{2}, big) + raw(std::uint32_t{0}, big) +
           raw(std::uint32_t{1}, big);
  return bytes + raw(std::uint8_t{1}, big) + raw(std::int32_t{2}, big);
}

/// A binary GMF file, section by section.
class BinaryGmf {
 public:
  BinaryGmf(std::int32_t version, bool big)
      : version_(version), big_(big), bytes_(raw(std::int32_t{1}, big) + raw(version, big)) {
    section(3, raw(std::int32_t{3}, big));
  }
  [[nodiscard]] std::string integer(std::int64_t value) const {
    return version_ >= 4 ? raw(value, big_) : raw(static_cast<std::int32_t>(value), big_);
  }
  [[nodiscard]] std::string real(double x) const {
    return version_ == 1 ? raw(static_cast<float>(x), big_) : raw(x, big_);
  }
  void section(std::int32_t keyword, const std::string& body) {
    const std::size_t next = bytes_.size() + 4 + (version_ >= 3 ? 8 : 4) + body.size();
    bytes_ += raw(keyword, big_);
    bytes_ += version_ >= 3 ? raw(static_cast<std::int64_t>(next), big_)
                            : raw(static_cast<std::int32_t>(next), big_);
    bytes_ += body;
  }
  [[nodiscard]] std::string ended() const {
    return bytes_ + raw(std::int32_t{54}, big_) + raw(std::int64_t{0}, big_);
  }

 private:
  std::int32_t version_;
  bool big_;
  std::string bytes_;
};

/// One tetrahedron, one triangle and one edge.
inline std::string binary_gmf(std::int32_t version, bool big) {
  BinaryGmf file(version, big);
  const auto integer = [&](std::int64_t value) { return file.integer(value); };
  std::string body = integer(4);
  for (int i = 0; i < 4; ++i) body += file.real(i == 1) + file.real(i == 2) + file.real(i == 3) + integer(0);
  file.section(4, body);
  file.section(99, "a section that nobody knows");
  file.section(5, integer(1) + integer(1) + integer(2) + integer(30));
  file.section(6, integer(1) + integer(1) + integer(3) + integer(2) + integer(-20));
  file.section(8, integer(1) + integer(1) + integer(2) + integer(3) + integer(4) + integer(10));
  return file.ended();
}

/// Values of one type a vertex (1: a scalar, 3: a symmetric tensor).
inline std::string binary_sol(std::int32_t version, bool big, std::int64_t vertices, std::int32_t type,
                              const std::vector<double>& values) {
  BinaryGmf file(version, big);
  std::string body = file.integer(vertices) + raw(std::int32_t{1}, big) + raw(type, big);
  for (const double x : values) body += file.real(x);
  file.section(62, body);
  return file.ended();
}

/// A binary legacy VTK file of one tetrahedron and one triangle.
inline std::string binary_vtk() {
  std::string bytes = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n";
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) bytes += raw(x, true);
  bytes += "\nCELLS 2 9\n";
  for (const std::int32_t i : {4, 0, 1, 2, 3, 3, 0, 2, 1}) bytes += raw(i, true);
  bytes += "\nCELL_TYPES 2\n" + raw(std::int32_t{10}, true) + raw(std::int32_t{5}, true);
  bytes += "\nCELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n" + raw(std::int32_t{6}, true) +
           raw(std::int32_t{0}, true);
  return bytes + "\nFIELD FieldData 1\nmarker 1 2 long\n" + raw(std::int64_t{0}, true) +
         raw(std::int64_t{7}, true) + "\n";
}

/// A binary .msh of one tetrahedron, one triangle and one quadrangle, one line and one marked vertex; in
/// version 4.1 sizes have `size_bytes`.
inline std::string binary_msh(bool modern, bool big, std::size_t size_bytes = 8) {
  const auto i = [&](std::int32_t value) { return raw(value, big); };
  const auto n = [&](std::uint64_t value) {
    return size_bytes == 8 ? raw(value, big) : raw(static_cast<std::uint32_t>(value), big);
  };
  const auto point = [&](double x, double y, double z) { return raw(x, big) + raw(y, big) + raw(z, big); };
  const std::string bounds = point(0, 0, 0) + point(1, 1, 1);
  std::string bytes = std::string("$MeshFormat\n") + (modern ? "4.1" : "2.2") + " 1 " +
                      std::to_string(size_bytes) + "\n" + i(1) + "\n$EndMeshFormat\n";
  bytes += "$PhysicalNames\n1\n2 7 \"wall\"\n$EndPhysicalNames\n";
  const std::array<std::string, 5> points = {point(0, 0, 0), point(1, 0, 0), point(0, 0, 1), point(0, 1, 0),
                                             point(1, 1, 0)};
  const std::array<std::int32_t, 5> tags = {10, 20, 40, 30, 50};
  if (!modern) {
    bytes += "$Nodes\n5\n";
    for (std::size_t k = 0; k < 5; ++k) bytes += i(tags[k]) + points[k];
    bytes += "\n$EndNodes\n$Elements\n5\n";
    bytes += i(15) + i(1) + i(2) + i(1) + i(6) + i(1) + i(20);
    bytes += i(1) + i(1) + i(2) + i(2) + i(0) + i(3) + i(10) + i(20);
    bytes += i(2) + i(1) + i(2) + i(3) + i(7) + i(1) + i(10) + i(30) + i(20);
    bytes += i(3) + i(1) + i(2) + i(4) + i(8) + i(2) + i(10) + i(20) + i(50) + i(30);
    bytes += i(4) + i(1) + i(2) + i(5) + i(9) + i(1) + i(10) + i(20) + i(30) + i(40);
    return bytes + "\n$EndElements\n";
  }
  bytes += "$Entities\n" + n(1) + n(1) + n(2) + n(1);
  bytes += i(1) + point(1, 0, 0) + n(1) + i(6);
  bytes += i(3) + bounds + n(0) + n(1) + i(-1);
  bytes += i(1) + bounds + n(1) + i(7) + n(0) + i(2) + bounds + n(1) + i(8) + n(0);
  bytes += i(4) + bounds + n(2) + i(9) + i(10) + n(0);
  bytes += "\n$EndEntities\n$Nodes\n" + n(2) + n(5) + n(10) + n(50);
  bytes += i(0) + i(1) + i(0) + n(1) + n(10) + points[0];
  bytes += i(2) + i(1) + i(1) + n(4);
  for (std::size_t k = 1; k < 5; ++k) bytes += n(static_cast<std::uint64_t>(tags[k]));
  for (std::size_t k = 1; k < 5; ++k) bytes += points[k] + raw(0.5, big) + raw(0.25, big);
  bytes += "\n$EndNodes\n$Elements\n" + n(5) + n(5) + n(1) + n(5);
  bytes += i(0) + i(1) + i(15) + n(1) + n(1) + n(20);
  bytes += i(1) + i(3) + i(1) + n(1) + n(2) + n(10) + n(20);
  bytes += i(2) + i(1) + i(2) + n(1) + n(3) + n(10) + n(30) + n(20);
  bytes += i(2) + i(2) + i(3) + n(1) + n(4) + n(10) + n(20) + n(50) + n(30);
  bytes += i(3) + i(4) + i(4) + n(1) + n(5) + n(10) + n(20) + n(30) + n(40);
  return bytes + "\n$EndElements\n";
}

/// A binary OFF file of a triangle, a coloured quadrangle and a segment; with a normal a vertex if wanted.
inline std::string binary_off(bool normals) {
  std::string bytes = normals ? "NOFF BINARY\n" : "OFF BINARY\n";
  const auto real = [](float x) { return raw(x, true); };
  const auto number = [](std::int32_t value) { return raw(value, true); };
  bytes += number(5) + number(3) + number(0);
  for (const std::array<float, 3>& p :
       {std::array<float, 3>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.1f, 1}}) {
    for (const float x : p) bytes += real(x);
    if (normals) bytes += real(0) + real(0) + real(1);
  }
  bytes += number(3) + number(0) + number(1) + number(4) + number(0);
  bytes +=
      number(4) + number(0) + number(3) + number(2) + number(1) + number(3) + real(1) + real(0) + real(0);
  return bytes + number(2) + number(3) + number(4) + number(0);
}

/// Volumes of texts, read as files of Abaqus in a folder of their own.
class AsInp {
 public:
  Volume volume(const std::string& text) {
    put(folder_ / "a.inp", text);
    return read_volume(folder_ / "a.inp");
  }
  std::string error(const std::string& text) {
    return refusal_of([&] { return volume(text); });
  }

 protected:
  TemporaryFolder folder_;
};

}  // namespace holdfast::samples
