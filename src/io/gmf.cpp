// .meshb and .solb, the binary form of GMF, versions 1 to 4 (Marechal, libMeshb: file format).
//
// A file is a chain of sections: a keyword, the position of the next section, and usually a count with as
// many entries. Positions have 32 bits in versions 1 and 2, and 64 from version 3 on; counts and indices have
// 32 bits up to version 3; coordinates are floats in version 1 and doubles from version 2 on.
#include <cmath>
#include <limits>
#include <optional>

#include "io/byte_reader.h"
#include "io/cells.h"
#include "io/formats.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"

namespace holdfast::io {
namespace {

enum Keyword : std::int32_t {
  kDimension = 3,
  kVertices = 4,
  kEdges = 5,
  kTriangles = 6,
  kQuadrilaterals = 7,
  kTrianglesP2 = 24,
  kEdgesP2 = 25,
  kTetrahedraP2 = 30,
  kTetrahedra = 8,
  kPrisms = 9,
  kHexahedra = 10,
  kPyramids = 49,
  kEnd = 54,
  kSolAtVertices = 62,
};

std::endian order_of(const Source& source) {
  if (source.bytes.empty()) throw FileError(source.path, "", "the file is empty");
  if (source.bytes.size() >= 8)
    for (const std::endian order : {std::endian::little, std::endian::big})
      if (load<std::int32_t>(source.bytes.data(), order) == 1) return order;
  throw FileError(source.path, "byte 0", "not a binary GMF file: it does not start with the number 1");
}

class GmfReader {
 public:
  explicit GmfReader(const Source& source)
      : bytes_(source, order_of(source), 4), finite_(source.finite), mesh_(source) {}

  MeshData read() {
    read_sections();
    return std::move(mesh_);
  }

  GmfSolution read_solution() {
    solution_.emplace();
    read_sections();
    if (solution_->columns == 0) bytes_.fail("there is no section SolAtVertices");
    return std::move(*solution_);
  }

 private:
  void read_sections() {
    version_ = bytes_.read<std::int32_t>();
    if (version_ < 1 || version_ > 4) bytes_.fail("version " + std::to_string(version_) + " is not read");
    while (read_section()) {
    }
  }

  std::int64_t position_word() {
    return version_ >= 3 ? bytes_.read<std::int64_t>() : bytes_.read<std::int32_t>();
  }
  std::int64_t integer() { return version_ >= 4 ? bytes_.read<std::int64_t>() : bytes_.read<std::int32_t>(); }
  double real() {
    const double value = version_ == 1 ? static_cast<double>(bytes_.read<float>()) : bytes_.read<double>();
    if (finite_ && !std::isfinite(value)) {
      bytes_.seek(bytes_.position() - (version_ == 1 ? sizeof(float) : sizeof(double)));
      bytes_.fail("a number is not finite");
    }
    return value;
  }

  [[nodiscard]] std::size_t integer_size() const { return version_ >= 4 ? 8 : 4; }

  std::size_t count(std::size_t bytes_each, const char* what) {
    const std::int64_t value = integer();
    if (value < 0) bytes_.fail("a negative number of " + std::string(what));
    bytes_.require_items(static_cast<std::uint64_t>(value), bytes_each, what);
    return static_cast<std::size_t>(value);
  }

  int tag() {
    const std::int64_t value = integer();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
      bytes_.fail("a reference beyond 32 bits");
    return static_cast<int>(value);
  }

  /// Reads one section; returns whether another follows.
  bool read_section() {
    const auto keyword = bytes_.read<std::int32_t>();
    if (keyword == kEnd) return false;
    const std::int64_t next = position_word();
    read_entries(keyword);
    if (next == 0) return false;
    // The chain must go forward, past what was read; otherwise entries could be counted many times.
    const std::size_t end = bytes_.position() + bytes_.left();
    if (next < static_cast<std::int64_t>(bytes_.position()) || static_cast<std::uint64_t>(next) > end)
      bytes_.fail("the next section's position is out of range; the file is truncated or damaged");
    bytes_.seek(static_cast<std::size_t>(next));
    return true;
  }

  void read_entries(std::int32_t keyword) {
    switch (keyword) {
      case kDimension:
        dimension_ = bytes_.read<std::int32_t>();
        if (dimension_ != 2 && dimension_ != 3) bytes_.fail("the dimension is neither 3 nor 2");
        return;
      case kVertices:
        return read_vertices();
      case kEdges:
        return read_entities<2>("edges", [&](const Segment& c, int tag) { mesh_.add_segment(c, tag); });
      case kTriangles:
        return read_entities<3>("triangles", [&](const Triangle& c, int tag) { mesh_.add_facet(c, tag); });
      case kTetrahedra:
        return read_entities<4>("tetrahedra",
                                [&](const Tetrahedron& c, int tag) { mesh_.add_tetrahedron(c, tag); });
      case kEdgesP2:
        return read_entities<3>("edges", [&](const std::array<Index, 3>& n, int tag) {
          add_second_order(mesh_, Segment{n[0], n[1]}, n[2], tag);
        });
      case kTrianglesP2:
        return read_entities<6>("triangles", [&](const std::array<Index, 6>& n, int tag) {
          add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, tag);
        });
      case kTetrahedraP2:
        return read_entities<10>("tetrahedra", [&](const std::array<Index, 10>& n, int tag) {
          add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7], n[8], n[9]},
                           tag);
        });
      case kQuadrilaterals:
        return read_entities<4>("quadrilaterals", [&](const std::array<Index, 4>& c, int tag) {
          add_polygon(mesh_, c, tag, [&](const std::string& reason) { bytes_.fail(reason); });
        });
      case kPrisms:
        return read_entities<6>("prisms",
                                [&](const std::array<Index, 6>& c, int tag) { add_cell(mesh_, c, 6, tag); });
      case kHexahedra:
        return read_entities<8>("hexahedra",
                                [&](const std::array<Index, 8>& c, int tag) { add_cell(mesh_, c, 8, tag); });
      case kPyramids:
        return read_entities<5>("pyramids",
                                [&](const std::array<Index, 5>& c, int tag) { add_cell(mesh_, c, 5, tag); });
      case kSolAtVertices:
        if (solution_) read_values();
        return;
      default:
        if (!solution_ && keyword != kSolAtVertices)
          mesh_.remarks.push_back({RemarkKind::left_out, 1,
                                   "the section of keyword " + std::to_string(keyword) + " is left out"});
        return;  // the position of the next section skips it
    }
  }

  void read_vertices() {
    if (!mesh_.vertices.empty()) bytes_.fail("a second section of vertices");
    const auto axes = static_cast<std::size_t>(dimension_);
    const std::size_t vertices = count(axes * (version_ == 1 ? 4 : 8) + integer_size(), "vertices");
    mesh_.vertices.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      Point point{};  // z is 0 in the plane
      for (std::size_t axis = 0; axis < axes; ++axis) point[axis] = real();
      mesh_.add_vertex(point, tag());
    }
  }

  void read_values() {
    if (solution_->columns != 0) bytes_.fail("a second section SolAtVertices");
    constexpr std::int32_t kScalar = 1, kTensor = 3;
    const std::int64_t vertices = integer();
    const auto solutions = bytes_.read<std::int32_t>();
    const std::int32_t type = solutions == 1 ? bytes_.read<std::int32_t>() : 0;
    if (type != kScalar && type != kTensor)
      bytes_.fail("one scalar (type 1) or one symmetric tensor (type 3) a vertex is read");
    solution_->columns = type == kScalar ? 1 : 6;
    if (vertices < 0) bytes_.fail("a negative number of vertices");
    solution_->vertices = static_cast<std::size_t>(vertices);
    bytes_.require_items(solution_->vertices, solution_->columns * (version_ == 1 ? 4 : 8), "vertices");
    solution_->values.resize(solution_->vertices * solution_->columns);
    for (double& value : solution_->values) value = real();
  }

  template <std::size_t N, typename Add>
  void read_entities(const char* what, Add&& add) {
    const std::size_t entities = count((N + 1) * integer_size(), what);
    for (std::size_t i = 0; i < entities; ++i) {
      std::array<Index, N> corners{};
      for (Index& corner : corners) {
        const std::int64_t value = integer();
        if (value < 1 || static_cast<std::uint64_t>(value) > mesh_.vertices.size())
          bytes_.fail("the vertex index " + std::to_string(value) + " is out of range (1 to " +
                      std::to_string(mesh_.vertices.size()) + ")");
        corner = static_cast<Index>(value - 1);
      }
      add(corners, tag());
    }
  }

  ByteReader bytes_;
  bool finite_;
  std::int32_t version_ = 0, dimension_ = 3;
  MeshData mesh_;
  std::optional<GmfSolution> solution_;  // if requested
};

/// Writes version 2, which every program reads, if its 32-bit positions suffice, otherwise version 3, in the
/// machine's byte order.
class GmfWriter {
 public:
  explicit GmfWriter(AtomicWriter& out) : out_(out) {}

  void write(const Volume& volume) {
    wide_ = size_in_version_2(volume) > std::uint64_t{std::numeric_limits<std::int32_t>::max()};
    put<std::int32_t>(1);
    put<std::int32_t>(wide_ ? 3 : 2);
    start(kDimension, 4);
    put<std::int32_t>(3);
    const MidNodes& mid = volume.mid_nodes;
    start(kVertices, 4 + 28 * (volume.vertices.size() + mid.points.size()));
    put(static_cast<std::int32_t>(volume.vertices.size() + mid.points.size()));
    for (std::size_t i = 0; i < volume.vertices.size(); ++i) {
      for (const double x : volume.vertices[i]) put(x);
      put<std::int32_t>(tag_of(volume.vertex_markers, i));
    }
    for (const Point& p : mid.points) {
      for (const double x : p) put(x);
      put<std::int32_t>(0);
    }
    const bool second = !mid.empty();
    std::vector<std::array<Index, 1>> of_segments(mid.segments.size());
    for (std::size_t i = 0; i < of_segments.size(); ++i) of_segments[i] = {mid.segments[i]};
    write_entities(second ? kEdgesP2 : kEdges, volume.segments, of_segments, volume.segment_markers);
    write_entities(second ? kTrianglesP2 : kTriangles, volume.facets, mid.facets, volume.facet_markers);
    write_entities(second ? kTetrahedraP2 : kTetrahedra, volume.tetrahedra, mid.tetrahedra, volume.regions);
    put<std::int32_t>(kEnd);
    put_position(0);
  }

 private:
  static std::uint64_t size_in_version_2(const Volume& volume) {
    constexpr std::uint64_t kHeads = 64;  // for the headers of the sections, and the ends of the file
    const MidNodes& mid = volume.mid_nodes;
    return kHeads + 28 * (volume.vertices.size() + mid.points.size()) + 12 * volume.segments.size() +
           16 * volume.facets.size() + 20 * volume.tetrahedra.size() + 4 * mid.segments.size() +
           12 * mid.facets.size() + 24 * mid.tetrahedra.size();
  }

  void put_position(std::uint64_t position) {
    if (wide_)
      put(static_cast<std::int64_t>(position));
    else
      put(static_cast<std::int32_t>(position));
  }

  template <typename T>
  void put(T value) {
    std::string bytes;  // short enough to avoid an allocation
    store(bytes, value, std::endian::native);
    out_ << bytes;
    position_ += sizeof(T);
  }

  /// Starts a section with `size` bytes after its header.
  void start(Keyword keyword, std::uint64_t size) {
    put<std::int32_t>(keyword);
    put_position(position_ + (wide_ ? 8 : 4) + size);
  }

  /// Writes entities, with the nodes on their edges, if any, after the corners in our order.
  template <std::size_t N, std::size_t M>
  void write_entities(Keyword keyword, const std::vector<std::array<Index, N>>& entities,
                      const std::vector<std::array<Index, M>>& nodes, const std::vector<int>& tags) {
    if (entities.empty()) return;
    start(keyword, 4 + 4 * (N + (nodes.empty() ? 0 : M) + 1) * entities.size());
    put(static_cast<std::int32_t>(entities.size()));
    for (std::size_t i = 0; i < entities.size(); ++i) {
      for (const Index corner : entities[i]) put(static_cast<std::int32_t>(corner + 1));
      if (!nodes.empty())
        for (const Index node : nodes[i]) put(static_cast<std::int32_t>(node + 1));
      put<std::int32_t>(tag_of(tags, i));
    }
  }

  AtomicWriter& out_;
  bool wide_ = false;
  std::uint64_t position_ = 0;
};

}  // namespace

MeshData read_gmf(const Source& source) { return GmfReader(source).read(); }
GmfSolution read_gmf_solution(const Source& source) { return GmfReader(source).read_solution(); }

void write_gmf(AtomicWriter& out, const Volume& volume) {
  // Counts have 32 signed bits in version 3, and few programs read version 4.
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (volume.vertices.size() + volume.mid_nodes.points.size() >= kMost || volume.tetrahedra.size() >= kMost ||
      volume.facets.size() >= kMost)
    throw std::invalid_argument("a mesh of more than 2^31 entities does not fit .meshb");
  GmfWriter(out).write(volume);
}

}  // namespace holdfast::io
