// 3D Studio's .3ds: the triangles of all meshes, each mesh a solid. A file is a tree of chunks: two bytes
// that say what it is, four with its length, its data and chunks in it (Autodesk, "3D Studio File Toolkit";
// J. van Velsen and others, "3D-Studio File Format"). Vertices are stored where they are in the scene; the
// matrix of a mesh only tells its axes.
#include "io/threeds_read.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "io/byte_reader.h"
#include "io/solids.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

enum Chunk : std::uint16_t {
  kMain = 0x4D4D,
  kLibrary = 0x3DAA,
  kProject = 0xC23D,
  kEditor = 0x3D3D,
  kMaterial = 0xAFFF,
  kMaterialName = 0xA000,
  kObject = 0x4000,
  kMesh = 0x4100,
  kVertexList = 0x4110,
  kFaces = 0x4120,
  kFaceMaterial = 0x4130,
};

class ThreeDsReader {
 public:
  explicit ThreeDsReader(const Source& source)
      : source_(source), bytes_(source, std::endian::little), solids_(source) {}

  MeshData read() {
    if (bytes_.left() == 0) bytes_.fail("the file is empty");
    const auto kind = bytes_.read<std::uint16_t>();
    if (kind != kMain && kind != kLibrary && kind != kProject) {
      bytes_.seek(0);
      bytes_.fail("expected the bytes 4D 4D with which a .3ds file begins");
    }
    const std::size_t end = end_of_chunk(source_.bytes.size());
    read_chunks(end, [&](std::uint16_t id, std::size_t at) {
      if (id == kEditor)
        read_chunks(at, [&](std::uint16_t inner, std::size_t to) { read_edited(inner, to); });
    });
    MeshData mesh = solids_.take();
    mesh.leave_out(without_faces_, "meshes without triangles", "mesh without triangles");
    mesh.leave_out(source_.bytes.size() - end, "bytes after the last chunk", "byte after the last chunk");
    return mesh;
  }

 private:
  /// Visits the chunks up to `end`, each with its own end.
  template <class Visit>
  void read_chunks(std::size_t end, Visit&& visit) {
    constexpr std::size_t kHead = 6;
    while (bytes_.position() + kHead <= end) {
      step(source_.watch);
      const auto id = bytes_.read<std::uint16_t>();
      const std::size_t at = end_of_chunk(end);
      visit(id, at);
      bytes_.seek(at);
    }
    bytes_.seek(end);
  }

  /// Reads the length of a chunk, which counts from before its identifier. It lies in another up to `most`.
  std::size_t end_of_chunk(std::size_t most) {
    constexpr std::size_t kBefore = 2, kHead = 6;
    const std::size_t begin = bytes_.position() - kBefore;
    const auto length = bytes_.read<std::uint32_t>();
    if (length < kHead || length > most - begin)
      bytes_.fail("a chunk of " + std::to_string(length) + " bytes does not fit where " +
                  std::to_string(most - begin) + " follow; the file is truncated or damaged");
    return begin + length;
  }

  /// A text that ends with a zero.
  std::string text_before(std::size_t end) {
    const std::string_view rest = source_.bytes.substr(bytes_.position(), end - bytes_.position());
    const std::size_t length = rest.find('\0');
    if (length == std::string_view::npos) bytes_.fail("a name without an end");
    bytes_.seek(bytes_.position() + length + 1);
    return std::string(rest.substr(0, length));
  }

  void read_edited(std::uint16_t id, std::size_t end) {
    if (id == kMaterial) {
      read_chunks(end, [&](std::uint16_t inner, std::size_t at) {
        if (inner == kMaterialName) (void)material(text_before(at));
      });
    } else if (id == kObject) {
      const std::string name = text_before(end);
      read_chunks(end, [&](std::uint16_t inner, std::size_t at) {
        if (inner == kMesh) read_mesh(name, at);
      });
    }
  }

  void read_mesh(const std::string& name, std::size_t end) {
    Solid solid;
    solid.name = name;
    std::optional<std::size_t> faces_end;
    std::size_t faces = 0;
    read_chunks(end, [&](std::uint16_t id, std::size_t at) {
      if (id == kVertexList) read_vertices(solid, at);
      if (id == kFaces) {
        faces = bytes_.position();
        faces_end = at;
      }
    });
    if (faces_end) {  // after the vertices, wherever these are
      bytes_.seek(faces);
      read_faces(solid, *faces_end);
      bytes_.seek(end);
    }
    if (solid.facets.empty()) {
      without_faces_ += solid.vertices.empty() ? 0 : 1;
      return;
    }
    solid.materials = materials_;
    solids_.add(solid, name, {});
  }

  /// A number of items, which must fit before the end of the chunk.
  std::size_t count_of(std::size_t end, std::size_t bytes_each, const char* what) {
    const auto count = bytes_.read<std::uint16_t>();
    if (bytes_.position() > end || count > (end - bytes_.position()) / bytes_each)
      bytes_.fail(std::to_string(count) + " " + what + " do not fit into their chunk; the file is damaged");
    return count;
  }

  void read_vertices(Solid& solid, std::size_t end) {
    const std::size_t count = count_of(end, 12, "vertices");
    solid.vertices.clear();
    solid.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      Point p{};
      for (double& x : p) x = static_cast<double>(bytes_.read<float>());
      solid.vertices.push_back(p);
    }
  }

  /// Each face has its corners and flags. Chunks in the same chunk name the materials of lists of faces.
  void read_faces(Solid& solid, std::size_t end) {
    const std::size_t count = count_of(end, 8, "faces");
    solid.facets.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      Triangle t{};
      for (Index& corner : t) {
        corner = bytes_.read<std::uint16_t>();
        if (corner >= solid.vertices.size())
          bytes_.fail("face " + std::to_string(i) + " of " + in_quotes(solid.name) + " has vertex " +
                      std::to_string(corner) + ", but there are " + std::to_string(solid.vertices.size()));
      }
      (void)bytes_.read<std::uint16_t>();
      solid.facets.push_back(t);
    }
    solid.facet_material.assign(count, 0);
    read_chunks(end, [&](std::uint16_t id, std::size_t at) {
      if (id != kFaceMaterial) return;
      const std::size_t number = material(text_before(at));
      const std::size_t faces = count_of(at, 2, "faces");
      for (std::size_t i = 0; i < faces; ++i)
        if (const auto face = bytes_.read<std::uint16_t>(); face < count) solid.facet_material[face] = number;
    });
  }

  /// The number of a material, from 1. Files name some that they do not describe.
  std::size_t material(const std::string& name) {
    const auto [at, is_new] = number_of_.try_emplace(name, materials_.size() + 1);
    if (is_new) materials_.push_back(name);
    return at->second;
  }

  Source source_;
  ByteReader bytes_;
  Solids solids_;
  std::vector<std::string> materials_;
  std::map<std::string, std::size_t> number_of_;
  std::size_t without_faces_ = 0;
};

}  // namespace

MeshData read_3ds(const Source& source) { return ThreeDsReader(source).read(); }

}  // namespace holdfast::io
