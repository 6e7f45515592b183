// Damaged and hostile files give a FileError with a place: no crash, no hang, no giant allocation.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "dae_samples.h"
#include "ensight_samples.h"
#include "gltf_samples.h"
#include "io/formats.h"
#include "io_archive_samples.h"
#include "io_samples.h"
#include "vrml_samples.h"

namespace holdfast::io_hostile_test {
namespace {

using namespace samples;

struct Sample {
  std::string format;
  std::string bytes;
};

/// A valid file of every format and variant that is read from a single file.
std::vector<Sample> valid_files() {
  std::vector<Sample> files = {{".off", kOff},
                               {".obj", kObj},
                               {".ply", kPly},
                               {".stl", kStl},
                               {".mesh", kMesh},
                               {".poly", kPoly},
                               {".smesh", kSmesh},
                               {".msh", kMsh2},
                               {".msh", kMsh4},
                               {".vtk", kVtk},
                               {".vtk", binary_vtk()},
                               {".vtu", kVtu},
                               {".ply", binary_ply(false)},
                               {".ply", binary_ply(true)},
                               {".off", binary_off(false)},
                               {".off", binary_off(true)},
                               {".msh", binary_msh(false, true)},
                               {".msh", binary_msh(true, false)},
                               {".msh", binary_msh(true, true, 4)},
                               {".vtk", kStrips},
                               {".3mf", small_3mf(Packing::stored)},
                               {".3mf", small_3mf(Packing::wide)},
                               {".amf", kSmallAmf},
                               {".ts", kGocad},
                               {".gts", kGts},
                               {".ac", kAc3d},
                               {".3ds", threeds_bytes()},
                               {".gii", kGifti},
                               {".pial", freesurfer_bytes()},
                               {".dxf", kDxf},
                               {".dae", small_dae()},
                               {".wrl", kVrml1},
                               {".wrl", kVrml2},
                               {".x3dv", kX3dv},
                               {".inp", kAssembly},
                               {".gltf", gltf()},
                               {".glb", glb(gltf_json(""), gltf_buffer())}};
  files.push_back({".stl", binary_stl("solid", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}})});
  for (const std::int32_t version : {1, 2, 3, 4})
    files.push_back({".meshb", binary_gmf(version, version == 2)});
  const TemporaryFolder folder;
  const auto written = [&](const std::string& format, const WriteOptions& options) {
    write_volume(folder / ("a" + format), sample_volume(), options);
    files.push_back({format, get(folder / ("a" + format))});
  };
  written(".vtu", {});
  written(".vtu", uncompressed());
  written(".msh", {});
  WriteOptions binary;
  binary.binary = true;
  written(".msh", binary);
  WriteOptions whole = uncompressed();
  whole.one_file = true;
  written(".vtu", whole);
  for (const char* format : {".inp", ".unv", ".bdf", ".su2", ".mfem", ".vol", ".med", ".exo", ".cgns",
                             ".fluent", ".k", ".cdb", ".feb", ".xml"})
    written(format, {});
  return files;
}

/// Parses as a surface and as a volume if the format is one; returns whether the first succeeded.
bool parses(const Sample& file) {
  static const std::filesystem::path path = "/nonexistent/mutant";
  bool success = false;
  using Parse = io::MeshData (*)(const io::Source&, std::string_view);
  for (const Parse parse : {Parse{io::parse_surface}, Parse{io::parse_volume}}) {
    try {
      const io::MeshData mesh = parse({path, file.bytes}, file.format);
      for (const Triangle& facet : mesh.facets)
        for (const Index corner : facet) EXPECT_LT(corner, mesh.vertices.size());
      for (const Tetrahedron& tetrahedron : mesh.tetrahedra)
        for (const Index corner : tetrahedron) EXPECT_LT(corner, mesh.vertices.size());
      for (const Segment& segment : mesh.segments)
        for (const Index corner : segment) EXPECT_LT(corner, mesh.vertices.size());
      success = true;
    } catch (const FileError& error) {
      EXPECT_GT(std::string(error.what()).size(), path.string().size() + 4);
    }
  }
  return success;
}

TEST(Hostile, TheSamplesThemselvesParse) {
  for (const Sample& file : valid_files()) EXPECT_TRUE(parses(file)) << file.format << '\n' << file.bytes;
}

TEST(Hostile, EveryTruncationParsesOrFails) {
  for (const Sample& file : valid_files())
    for (std::size_t size = 0; size < file.bytes.size(); ++size)
      parses({file.format, file.bytes.substr(0, size)});
}

TEST(Hostile, EveryFormatRefusesWhatItIsNot) {
  const std::vector<std::string> garbage = {"",
                                            "\n\n",
                                            std::string(1000, '\0'),
                                            std::string(5000, '\xFF'),
                                            "<html><body>Not found</body></html>",
                                            "\x89PNG\r\n\x1A\n0000IHDR",
                                            std::string(300000, '9'),
                                            std::string(100000, ' '),
                                            "\xFF\xFEO\0F\0F\0",
                                            "-1 -1 -1",
                                            "nan nan nan"};
  for (const Sample& file : valid_files())
    for (const std::string& bytes : garbage)
      EXPECT_FALSE(parses({file.format, bytes})) << file.format << bytes;
}

/// One change to a file, as an editor, a transfer or an attacker might make.
std::string mutated(const std::string& original, std::mt19937_64& random) {
  static const std::vector<std::string> kTokens = {
      "4294967295", "4294967296", "-1",     "0",        "1",  "2147483648", "9223372036854775807",  "1e400",
      "nan",        "-inf",       "x",      "",         "\n", "#",          "99999999999999999999", "\\\n",
      "</",         "\"",         "1e-400", " 3 0 1 2 "};
  std::string bytes = original;
  const auto pick = [&](std::size_t size) { return static_cast<std::size_t>(random() % size); };
  const std::size_t changes = 1 + pick(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = pick(bytes.size());
    switch (pick(8)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << pick(8)));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, 1 + pick(16));
        break;
      case 4:
        bytes.insert(at, bytes.substr(pick(bytes.size()), pick(64)));
        break;
      case 5: {  // a number of 32 bits, as counts and indices are
        const std::string number =
            raw(static_cast<std::uint32_t>(pick(2) ? random() : 0xFFFFFFFFu >> pick(32)));
        for (std::size_t k = 0; k < number.size() && at + k < bytes.size(); ++k) bytes[at + k] = number[k];
        break;
      }
      default: {  // another word
        const std::size_t end = bytes.find_first_of(" \n\"<", at);
        bytes.replace(at, end == std::string::npos ? 1 : end - at, kTokens[pick(kTokens.size())]);
      }
    }
  }
  return bytes;
}

TEST(Hostile, MutationsParseOrFail) {
  // HOLDFAST_FUZZ_SEEDS asks for a longer run than fits among the unit tests.
  const char* const wanted = std::getenv("HOLDFAST_FUZZ_SEEDS");
  const int seeds = wanted ? std::atoi(wanted) : 1500;
  std::size_t parsed = 0, total = 0;
  for (const Sample& file : valid_files()) {
    for (int seed = 0; seed < seeds; ++seed) {
      std::mt19937_64 random(static_cast<std::uint64_t>(seed));
      parsed += parses({file.format, mutated(file.bytes, random)}) ? 1u : 0u;
      ++total;
    }
  }
  // Both outcomes must occur often, or the mutations test nothing.
  EXPECT_GT(parsed, total / 20);
  EXPECT_LT(parsed, total - total / 20);
}

TEST(Hostile, TetgenFilesBesideOneAnother) {
  const TemporaryFolder folder;
  write_volume(folder / "a.node", sample_volume());
  const char* const names[] = {"a.node", "a.ele", "a.face", "a.edge"};
  std::vector<std::string> originals;
  for (const char* name : names) originals.push_back(get(folder / name));
  for (int seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const std::size_t which = random() % 4;
    put(folder / names[which], mutated(originals[which], random));
    try {
      static_cast<void>(read_volume(folder / "a.node"));
    } catch (const FileError&) {
    }
    put(folder / names[which], originals[which]);
  }
  EXPECT_EQ(read_volume(folder / "a.node").tetrahedra, sample_volume().tetrahedra);
}

/// Reads a.case and the geometry that it names; whether the volume or the surface is read.
bool parses_ensight(const TemporaryFolder& folder) {
  const std::filesystem::path path = folder / "a.case";
  bool success = false;
  for (const bool as_volume : {false, true}) {
    try {
      if (as_volume)
        static_cast<void>(read_volume(path));
      else
        static_cast<void>(read_surface(path));
      success = true;
    } catch (const FileError& error) {
      EXPECT_GT(std::string(error.what()).size(), path.string().size() + 2);
    }
  }
  return success;
}

TEST(Hostile, EnsightFilesBesideOneAnother) {
  const TemporaryFolder folder;
  std::size_t parsed = 0, total = 0;
  for (const std::string& geometry : {kEnsightGeo, binary_ensight(false), binary_ensight(true)}) {
    put(folder / "a.case", kEnsightCase);
    for (std::size_t size = 0; size < geometry.size(); size += 1 + geometry.size() / 100) {
      put(folder / "a.geo", geometry.substr(0, size));
      parses_ensight(folder);
    }
    for (int seed = 0; seed < 100; ++seed, ++total) {
      std::mt19937_64 random(static_cast<std::uint64_t>(seed));
      put(folder / "a.geo", mutated(geometry, random));
      parsed += parses_ensight(folder) ? 1u : 0u;
    }
    put(folder / "a.geo", geometry);
    for (int seed = 0; seed < 30; ++seed) {
      std::mt19937_64 random(static_cast<std::uint64_t>(seed));
      put(folder / "a.case", mutated(kEnsightCase, random));
      parses_ensight(folder);
    }
  }
  EXPECT_GT(parsed, total / 20);
  EXPECT_LT(parsed, total - total / 20);
}

TEST(Hostile, CountsBeyondTheFile) {
  const std::string zeros(64, '\0');
  const std::vector<Sample> files = {
      {".off", "OFF\n4294967295 4294967295 0\n"},
      {".off", "OFF\n1 1 0\n0 0 0\n4294967295 0 0 0\n"},
      {".off", "OFF\n18446744073709551617 1 0\n"},
      {".off", "OFF\n-1 1 0\n"},
      {".stl", std::string(80, 'x') + "\xFF\xFF\xFF\xFF" + zeros},
      {".ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\nproperty float "
       "y\nproperty float z\nend_header\n" +
           zeros},
      {".ply",
       "ply\nformat ascii 1.0\nelement junk 4000000000\nelement vertex 0\nproperty float x\nend_header\n"},
      {".ply",
       "ply\nformat binary_little_endian 1.0\nelement junk 1\nproperty list uint char a\nend_header\n" +
           std::string(4, '\xFF')},
      {".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 4000000000\n0 0 0 0\nEnd\n"},
      {".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nTetrahedra 4000000000\nEnd\n"},
      {".meshb", raw(std::int32_t{1}) + raw(std::int32_t{4}) + raw(std::int32_t{4}) + raw(std::int64_t{0}) +
                     raw(std::int64_t{1} << 61) + zeros},
      {".poly", "4000000000 3 0 0\n1 0 0 0\n"},
      {".smesh", "1 3 0 0\n1 0 0 0\n1 0\n4000000000 1 1 1\n"},
      {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4000000000\n"},
      {".msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4000000000 1 1\n"},
      {".msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 4000000000\n"},
      {".vtk",
       "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4000000000 double\n"},
      {".vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4000000000 double\n"},
      {".vtu",
       "<VTKFile type=\"UnstructuredGrid\"><Piece NumberOfPoints=\"18446744073709551615\" "
       "NumberOfCells=\"1\"><Points><DataArray format=\"ascii\"/></Points></Piece></VTKFile>"},
      {".vtu",
       "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\" "
       "compressor=\"vtkZLibDataCompressor\"><Piece "
       "NumberOfPoints=\"1\" NumberOfCells=\"0\"><Points><DataArray type=\"Float64\" format=\"appended\" "
       "offset=\"0\"/></Points></Piece><AppendedData encoding=\"raw\">_" +
           raw(std::uint64_t{1}) + raw(std::uint64_t{1} << 60) + raw(std::uint64_t{0}) +
           raw(std::uint64_t{20}) + zeros},
      {".vtu",
       "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"><Piece NumberOfPoints=\"1\" "
       "NumberOfCells=\"0\"><Points><DataArray type=\"Float64\" format=\"appended\" offset=\"0\"/></Points>"
       "</Piece><AppendedData encoding=\"raw\">_" +
           raw(std::uint64_t{1} << 60) + zeros},
  };
  for (const Sample& file : files)
    EXPECT_FALSE(parses(file)) << file.format << ' ' << file.bytes.substr(0, 80);
}

TEST(Hostile, AChainOfSectionsThatGoesBack) {
  std::string bytes = binary_gmf(3, false);
  const std::size_t unknown = bytes.find("a section") - 12;
  for (const std::int64_t next : {std::int64_t{8}, std::int64_t{-1}, std::int64_t{1} << 40}) {
    bytes.replace(unknown + 4, 8, raw(next));
    EXPECT_FALSE(parses({".meshb", bytes})) << next;
  }
}

TEST(Hostile, VeryLongLinesAndNames) {
  EXPECT_TRUE(parses({".off", "OFF 3 1 0 #" + std::string(5000000, 'x') + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " +
                                  std::string(5000000, '7')}));
  EXPECT_TRUE(parses({".off", "OFF 1 0 0\n0." + std::string(1000000, '3') + " 0 0\n"}));
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nvn 0";
  for (int i = 0; i < 500000; ++i) obj += "\\\n";
  EXPECT_TRUE(parses({".obj", obj}));
  const Sample word{".ply", "ply\nformat " + std::string(1000000, 'z')};
  try {
    static_cast<void>(io::parse_surface({"x.ply", word.bytes}, word.format));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_LT(std::string(error.what()).size(), 200u);  // messages quote only the start
  }
}

}  // namespace
}  // namespace holdfast::io_hostile_test
