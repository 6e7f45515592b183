// glTF: where its buffers are, how nodes place meshes, modes of primitives, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_samples.h"
#include "io/formats.h"

namespace holdfast::io_gltf_test {
namespace {

using namespace samples;
using Facets = std::vector<Triangle>;
using Points = std::vector<Point>;

const Facets kFacets{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
const Points kPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

class Gltf : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name = "a.gltf") {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  std::string error(const std::string& bytes, const std::string& name = "a.gltf") {
    try {
      static_cast<void>(surface(bytes, name));
    } catch (const FileError& failure) {
      return std::string(failure.what()).substr(failure.path().string().size() + 2);
    }
    return "read";
  }
  static std::string said(const Surface& surface) {
    std::string all;
    for (const Remark& remark : surface.remarks) all += remark.message + "\n";
    return all;
  }
  TemporaryFolder folder_;
};

TEST_F(Gltf, BuffersInTheFileAndBesideIt) {
  put(folder_ / "a b.bin", gltf_buffer() + "more");
  for (const Surface& s : {surface(gltf()), surface(gltf_json("a%20b.bin")), surface("\xEF\xBB\xBF" + gltf()),
                           surface(glb(gltf_json(""), gltf_buffer()), "a.glb")}) {
    EXPECT_EQ(s.vertices, kPoints);
    EXPECT_EQ(s.facets, kFacets);
    EXPECT_TRUE(s.facet_markers.empty());
    EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{0, "n"}}));
    EXPECT_EQ(said(s), "");
  }
  EXPECT_EQ(said(surface(glb(gltf_json(""), gltf_buffer()) + "more", "a.glb")),
            "4 bytes after the file's end are left out\n");
}

TEST_F(Gltf, NodesPlaceTheirMeshes) {
  const Surface s = surface(gltf(
      R"("scene":1,"scenes":[{"nodes":[3]},{"nodes":[0,2]}],"nodes":[
{"translation":[10,0,0],"children":[1]},
{"mesh":0,"name":"one","rotation":[0,0,1,0],"scale":[2,2,2]},
{"mesh":0,"name":"\"two\" \u00e9\ud83d\ude00","matrix":[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,5,1]},{"mesh":0}])"));
  ASSERT_EQ(s.vertices.size(), 8u);
  EXPECT_EQ(s.vertices[1], (Point{8, 0, 0}));
  EXPECT_EQ(s.vertices[2], (Point{10, -2, 0}));
  EXPECT_EQ(s.vertices[3], (Point{10, 0, 2}));
  EXPECT_EQ(s.vertices[7], (Point{0, 0, 4}));
  EXPECT_EQ(s.facets[1], (Triangle{0, 1, 3}));
  EXPECT_EQ(s.facets[5], (Triangle{4, 7, 5}));  // mirrored
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(s.names.facets,
            (std::map<int, std::string>{{1, "one"}, {2, "\"two\" \xC3\xA9\xF0\x9F\x98\x80"}}));
}

TEST_F(Gltf, WithoutScenesOrNodes) {
  EXPECT_EQ(surface(gltf(R"("nodes":[{"mesh":0},{"children":[0],"translation":[1,0,0]}])")).vertices[0],
            (Point{1, 0, 0}));
  EXPECT_EQ(surface(gltf(R"("extras":{})")).facets, kFacets);
  EXPECT_EQ(error(gltf(R"("scenes":[{}],"nodes":[{"mesh":0}])")),
            "the file holds no vertices; 1 mesh that is not in the scene is left out");
}

TEST_F(Gltf, ModesOfPrimitives) {
  const auto facets = [&](const std::string& primitive) {
    return surface(gltf(kGltfScene,
                        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},)" + primitive + "}]}]"))
        .facets;
  };
  EXPECT_EQ(facets(R"("mode":5)"), (Facets{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(facets(R"("mode":6)"), (Facets{{0, 1, 2}, {0, 2, 3}}));
  // Triangles that name a vertex twice only join strips.
  EXPECT_EQ(facets(R"("mode":5,"indices":1)"),
            (Facets{{0, 2, 1}, {1, 2, 0}, {1, 0, 3}, {1, 3, 0}, {0, 3, 2}, {2, 3, 1}, {2, 1, 3}}));
  const std::string both =
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0},"indices":1},
{"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"mode":0}]}])";
  const Surface s = surface(gltf(kGltfScene, both));
  EXPECT_EQ(s.facets, kFacets);
  EXPECT_EQ(s.vertices, kPoints);
  EXPECT_EQ(said(s),
            "1 attribute of vertices (NORMAL) is left out\n1 primitive of points is left out\n"
            "1 primitive of lines is left out\n");
  EXPECT_NE(error(gltf(kGltfScene, R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"))
                .find("4 corners, which make no triangles"),
            std::string::npos);
}

TEST_F(Gltf, MaterialsAreMarkers) {
  const std::string two =
      R"("materials":[{"name":"steel"},{}],"meshes":[{"primitives":[
{"attributes":{"POSITION":0},"mode":6,"material":1},{"attributes":{"POSITION":0},"indices":1,"material":0}]}])";
  const Surface s = surface(gltf(kGltfScene, two));
  EXPECT_EQ(s.vertices.size(), 4u);
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "material 1"}, {2, "steel"}}));
}

TEST_F(Gltf, IntegersAndSparseValues) {
  const std::string numbers =
      R"("bufferViews":[{"buffer":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":1},
{"buffer":0,"byteOffset":34,"byteLength":6}],"accessors":[{"bufferView":0,"componentType":5122,"count":4,
"type":"VEC3","normalized":true,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},
"values":{"bufferView":2}}}])";
  const std::string buffer = packed<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 0, 32767, 0, 9, 9, 9, 9, 9}) +
                             std::string("\x03\0", 2) + packed<std::int16_t>({0, 0, -32768});
  const Surface s = surface(gltf(
      kGltfScene, R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}])", numbers, buffer));
  EXPECT_EQ(s.vertices, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}));
}

TEST_F(Gltf, Errors) {
  EXPECT_EQ(error("", "a.glb"), "the file is empty");
  EXPECT_EQ(error("{\"asset\":{\"version\":\"1.0\"}}"),
            "/asset/version: glTF of version '1.0' is not read; save it as 2.0");
  EXPECT_EQ(error("{}"), "not a glTF file: it has no asset with a version");
  EXPECT_EQ(error("{\"asset\":{\"version\":\"2.0\"},\n\"a\" 1}"),
            "line 2: syntax error while parsing object separator - unexpected number literal; expected ':'");
  EXPECT_EQ(error(gltf_json("none.bin")), "no such file");
  EXPECT_NE(error(gltf_json("https://a.org/a.bin")).find("is no file beside this one"), std::string::npos);
  EXPECT_NE(error(gltf_json("/etc/passwd")).find("is no file beside this one"), std::string::npos);
  EXPECT_EQ(error(gltf_json("")).substr(0, 47), "/buffers/0: the buffer is not in the file (it m");
  EXPECT_EQ(error(replaced(gltf(), "\"count\":12", "\"count\":15")),
            "/accessors/1: 15 elements of 2 bytes do not fit into the 24 bytes of their view");
  EXPECT_EQ(error(replaced(gltf(), "\"count\":4,", "\"count\":3,")),
            "/meshes/0/primitives/0: the vertex 3 is out of range; the primitive has 3, and the first is 0");
  EXPECT_EQ(error(replaced(gltf(), "5123,\"count\":12", "5126,\"count\":6")).substr(0, 45),
            "/meshes/0/primitives/0: the vertex 1.83670992");
  EXPECT_EQ(error(replaced(gltf(), "\"nodes\":[0]", "\"nodes\":[1]")),
            "/scenes/0/nodes/0: '1' is not the number of any of the 1 nodes");
  EXPECT_EQ(error(gltf(R"("nodes":[{"mesh":0},{"children":[1]}],"scenes":[{"nodes":[1]}])")),
            "/nodes/1: node 1 is a child of two nodes, or of itself");
  EXPECT_EQ(error(gltf(R"("extensionsRequired":["KHR_draco_mesh_compression"])")),
            "/extensionsRequired/0: the file needs the extension 'KHR_draco_mesh_compression', which is not "
            "read; save it without "
            "compression");
  EXPECT_EQ(
      surface(gltf(std::string(kGltfScene) + R"(,"extensionsRequired":["KHR_materials_unlit"])")).facets,
      kFacets);
  const std::string binary = glb(gltf_json(""), gltf_buffer());
  EXPECT_EQ(error(binary.substr(0, binary.size() - 1), "a.glb").substr(0, 8), "byte 12:");
  EXPECT_EQ(error(replaced(binary, "\"count\":12", "\"count\":15"), "a.glb").substr(0, 15),
            "/accessors/1: 1");
  EXPECT_EQ(error(std::string(100000, '[')), "byte 129: values in values without end");
}

TEST_F(Gltf, FaultsOfItsJson) {
  const std::string start = "{\"asset\":{\"version\":\"2.0\"},\n";
  const std::string where = "line 2: syntax error while parsing ";
  EXPECT_EQ(
      error(start),
      "line 2: syntax error while parsing object key - unexpected end of input; expected string literal");
  EXPECT_EQ(error(start + "\"a\":\""), where + "value - invalid string: missing closing quote");
  EXPECT_EQ(error(start + "\"a\":\"" + std::string(1000, 'a') + "\xFF\"}"),
            where + "value - invalid string: ill-formed UTF-8 byte");
  EXPECT_EQ(error(start + "\"a\":1" + std::string(400, '0') + "}"),
            "line 2: a number that is beyond those of double precision");
  EXPECT_EQ(error(gltf() + "\n{"),
            "line 9: syntax error while parsing value - unexpected '{'; expected end of input");
  EXPECT_EQ(error(gltf() + std::string("\0{", 2)), "line 8: expected the end of the text");
  EXPECT_EQ(surface(gltf() + std::string(3, '\0')).facets, kFacets);
  EXPECT_EQ(error("\xEF\xBB\xBF{\n]").substr(0, 8), "line 2: ");
  EXPECT_EQ(error(replaced(gltf(), "\"nodes\":[0]", "\"nodes\":[]]")).substr(0, 8), "line 7: ");
  std::string many = "[0";
  for (int i = 0; i < 23; ++i) many += "," + many.substr(1);
  EXPECT_EQ(error(many + "]"), "byte 16777216: more than 8388608 values");
}

TEST_F(Gltf, ALongStringOfItsJsonCanBeStopped) {
  const std::filesystem::path path = "a.gltf";
  const std::string bytes = "{\"a\":\"" + std::string(4'000'000, 'a');
  Limits limits;
  limits.cancel = CancelToken();
  io::Watch watch(limits, {});
  limits.cancel->cancel();
  EXPECT_THROW(static_cast<void>(io::parse_surface({path, bytes, false, &watch}, ".gltf")), Interrupted);
}

// These would take an hour if all previous ones were examined for each of them.
TEST_F(Gltf, TheTimeGrowsWithTheNumberOfValues) {
  std::string extras = "\"extras\":[{}";
  for (int i = 0; i < 2000000; ++i) extras += ",{}";
  EXPECT_EQ(surface(gltf(std::string(kGltfScene) + "," + extras + "]")).facets, kFacets);
}

TEST_F(Gltf, CountsAndIndicesAreWholeNumbers) {
  const auto with_node = [&](const std::string& index) {
    return error(replaced(gltf(), "\"nodes\":[0]", "\"nodes\":[" + index + "]"));
  };
  for (const auto& [index, is_shown] :
       std::map<std::string, std::string>{{"0.0", "0.0"},
                                          {"-0.5", "-0.5"},
                                          {"-1", "-1"},
                                          {"\"0\"", "0"},
                                          {"null", "null"},
                                          {"[0]", "array"},
                                          {"18446744073709551615", "18446744073709551615"}})
    EXPECT_EQ(with_node(index),
              "/scenes/0/nodes/0: '" + is_shown + "' is not the number of any of the 1 nodes");
  for (const std::string count : {"4.0", "-4", "\"4\"", "1e400", "99999999999999", "true"})
    EXPECT_NE(error(replaced(gltf(), "\"count\":4,", "\"count\":" + count + ",")), "read") << count;
}

TEST_F(Gltf, ZerosKeepTheirSigns) {
  const Surface s =
      surface(gltf(R"("nodes":[{"mesh":0,"matrix":[-0,0,0,0, -0,1,0,0, -0,0,1,0, -0,0,0,1]}])"));
  EXPECT_TRUE(std::signbit(s.vertices[0][0]));
  EXPECT_FALSE(std::signbit(s.vertices[0][1]));
}

TEST_F(Gltf, MembersOfOtherKinds) {
  for (const auto& [from, to] :
       std::vector<std::array<std::string, 2>>{{"\"buffer\":0", "\"buffer\":{}"},
                                               {"\"type\":\"VEC3\"", "\"type\":3"},
                                               {"{\"POSITION\":0}", "[0]"},
                                               {"\"nodes\":[{", "\"nodes\":{\"a\":{"},
                                               {"\"uri\":\"", "\"uri\":0,\"extras\":\""},
                                               {"\"2.0\"", "[2]"}})
    EXPECT_NE(error(replaced(gltf(), from, to)), "read") << to;
  EXPECT_EQ(error(replaced(gltf(), "\"uri\":\"", "\"uri\":0,\"extras\":\"")),
            "/buffers/0/uri: expected a string");
  EXPECT_EQ(surface(replaced(gltf(), "\"name\":\"n\"", "\"name\":5")).names.facets,
            (std::map<int, std::string>{{0, "m"}}));
}

TEST_F(Gltf, FilesThatItIs) {
  const std::filesystem::path path = folder_ / "a.gltf", binary = folder_ / "c.glb";
  const std::vector<std::filesystem::path> both{path, folder_ / "a b.bin"};
  EXPECT_EQ(files_of_surface(path), (std::vector{path}));
  put(path, gltf());
  EXPECT_EQ(files_of_surface(path), (std::vector{path}));
  put(path, gltf_json("https://a.org/a.bin"));
  EXPECT_EQ(files_of_surface(path), (std::vector{path}));
  put(path, "{");
  EXPECT_EQ(files_of_surface(path), (std::vector{path}));
  put(path, gltf_json("a%20b.bin"));
  EXPECT_EQ(files_of_surface(path), both);
  EXPECT_EQ(files_of_surface(path, "stl"), (std::vector{path}));
  put(binary,
      glb(replaced(gltf_json(""), "\"buffers\":[", "\"buffers\":[{\"byteLength\":1,\"uri\":\"d.bin\"},"),
          ""));
  EXPECT_EQ(files_of_surface(binary), (std::vector{binary, folder_ / "d.bin"}));
}

// A small file with a large buffer beside it is not refused.
TEST_F(Gltf, PrimitivesOfTheSameNumbersAreATrap) {
  const std::string fans =
      R"("bufferViews":[{"buffer":0,"byteLength":12000000}],
"accessors":[{"bufferView":0,"componentType":5120,"count":3000000,"byteOffset":0,"type":"VEC3"}])";
  put(folder_ / "large.bin", std::string(12000000, '\1'));
  EXPECT_EQ(surface(gltf_json("large.bin", kGltfScene,
                              R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}])",
                              replaced(fans, "{\"buffer\":0,", "{\"buffer\":0,\"byteStride\":4,")))
                .facets.size(),
            2999998u);
  std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
  for (int i = 0; i < 12; ++i) primitives += "," + primitives;
  std::string zeros = packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  zeros += std::string(1200000, '\0');
  const std::string numbers =
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":1200000}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":1200000,"type":"SCALAR"}])";
  EXPECT_NE(error(gltf(kGltfScene, "\"meshes\":[{\"primitives\":[" + primitives + "]}]", numbers, zeros))
                .find("is damaged or malicious"),
            std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_gltf_test
