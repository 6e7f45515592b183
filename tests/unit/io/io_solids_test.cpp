// Files that place copies of objects: 3MF and AMF.
#include <gtest/gtest.h>

#include "io/formats.h"
#include "io_archive_samples.h"

namespace holdfast::io_solids_test {
namespace {

using namespace samples;
using Facets = std::vector<Triangle>;
using FacetNames = std::map<int, std::string>;

class SolidsOfFiles : public ::testing::Test {
 protected:
  Surface surface(const std::string& bytes, const std::string& name) {
    put(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  std::string error(const std::string& bytes, const std::string& name) {
    try {
      static_cast<void>(surface(bytes, name));
    } catch (const FileError& failure) {
      return std::string(failure.what()).substr(folder_.path().string().size() + 1);
    }
    return "read";
  }
  Surface of_3mf(const std::string& resources, const std::string& build) {
    return surface(package_3mf(model_3mf(resources, build)), "a.3mf");
  }
  static std::string object(int id, const std::string& content, const std::string& attributes = "") {
    return "<object id=\"" + std::to_string(id) + "\" " + attributes + ">" + content + "</object>";
  }
  TemporaryFolder folder_;
};

const Facets kFacets = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST_F(SolidsOfFiles, ArchivesOfEveryKind) {
  for (const Packing packing : {Packing::stored, Packing::deflated, Packing::wide}) {
    const Surface s = surface(small_3mf(packing), "a.3mf");
    EXPECT_EQ(s.facets, kFacets);
    EXPECT_EQ(s.vertices[3], (Point{0, 0, 1}));
    EXPECT_TRUE(s.facet_markers.empty());
    EXPECT_EQ(s.names.facets, (FacetNames{{0, "corner"}}));
    const Surface amf = surface(zip({{"b.amf", kSmallAmf}}, packing), "b.amf");
    EXPECT_EQ(amf.facets, kFacets);
  }
  const Surface amf = surface(kSmallAmf, "a.AMF");
  EXPECT_EQ(amf.facets, kFacets);
  EXPECT_EQ(amf.names.facets, (FacetNames{{0, "corner"}}));
}

TEST_F(SolidsOfFiles, AModelIsFoundWithoutRelations) {
  const std::string model = model_3mf(object(1, kTetrahedronOf3mf), "<item objectid=\"1\"/>");
  EXPECT_EQ(surface(zip({{"3d/Other.MODEL", model}}), "a.3mf").facets, kFacets);
}

TEST_F(SolidsOfFiles, ItemsAreCopiesWithMarkers) {
  const Surface s =
      of_3mf(object(1, kTetrahedronOf3mf, "name=\"bolt\""),
             "<item objectid=\"1\"/><item objectid=\"1\" transform=\"0 2 0 -2 0 0 0 0 2 5 6 7\"/>");
  ASSERT_EQ(s.vertices.size(), 8u);
  EXPECT_EQ(s.vertices[5], (Point{5, 8, 7}));  // (1, 0, 0), turned by a quarter, doubled and moved
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(s.names.facets, (FacetNames{{1, "bolt"}, {2, "bolt"}}));
  EXPECT_EQ(s.facets[4], (Triangle{4, 6, 5}));
}

TEST_F(SolidsOfFiles, AMirroredCopyIsSeenFromOutside) {
  const Surface s =
      of_3mf(object(1, kTetrahedronOf3mf), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 -1 0 0 0\"/>");
  EXPECT_EQ(s.vertices[3], (Point{0, 0, -1}));
  EXPECT_EQ(s.facets[0], (Triangle{0, 1, 2}));
}

TEST_F(SolidsOfFiles, ComponentsArePlacedWithinTheirObject) {
  // The inner placement comes first: the tetrahedron moves by 1 along x, then x becomes y.
  const std::string components =
      "<components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"/><component "
      "objectid=\"1\"/></components>";
  const Surface s =
      of_3mf(object(1, kTetrahedronOf3mf, "name=\"a &amp; b\"") + object(2, components, "name=\"all\""),
             "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 10\"/>");
  ASSERT_EQ(s.facets.size(), 8u);
  EXPECT_EQ(s.vertices[0], (Point{0, 1, 10}));
  EXPECT_EQ(s.vertices[1], (Point{0, 2, 10}));
  EXPECT_EQ(s.vertices[4], (Point{0, 0, 10}));
  EXPECT_EQ(s.names.facets, (FacetNames{{1, "a & b"}, {2, "a & b"}}));
}

TEST_F(SolidsOfFiles, CharactersOfNamesMayBeGivenByTheirNumbers) {
  const auto name_of = [&](const std::string& text) {
    const std::string model = object(1, kTetrahedronOf3mf, "name=\"" + text + "\"");
    return of_3mf(model, "<item objectid=\"1\"/>").names.facets.at(0);
  };
  EXPECT_EQ(name_of("W&#252;rfel &#x20aC;&#128077;&#38;amp;"), "W\u00fcrfel \u20ac\U0001f44d&amp;");
  for (const char* text :
       {"&#;", "&#x;", "&#0;", "&#xD800;", "&#1114112;", "&#99999999999;", "&#12", "&#-5;"})
    EXPECT_EQ(name_of(text), text);
}

TEST_F(SolidsOfFiles, ObjectsWithoutABuildAreAllShown) {
  const Surface s =
      of_3mf(object(1, kTetrahedronOf3mf) +
                 object(2, "<components><component objectid=\"1\"/></components>", "name=\"outer\""),
             "");
  EXPECT_EQ(s.facets, kFacets);
  EXPECT_EQ(s.names.facets, (FacetNames{{0, "outer"}}));
}

TEST_F(SolidsOfFiles, SupportsAreLeftOut) {
  const Surface s = of_3mf(
      object(1, kTetrahedronOf3mf, "type=\"model\"") + object(2, kTetrahedronOf3mf, "type=\"support\""),
      "<item objectid=\"1\"/><item objectid=\"2\"/>");
  EXPECT_EQ(s.facets, kFacets);
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks[0].message, "1 support or other object that is no part of the model is left out");
  const std::string component = "<components><component objectid=\"1\"/></components>";
  EXPECT_EQ(of_3mf(object(1, kTetrahedronOf3mf) + object(2, component, "type=\"other\""),
                   "<item objectid=\"1\"/><item objectid=\"2\"/>")
                .facets,
            kFacets);
}

TEST_F(SolidsOfFiles, PartsInOtherFilesOfThePackage) {
  const std::string root = model_3mf(
      object(1, "<components><component p:path=\"/3D/Objects/part_1.model\" objectid=\"1\"/></components>"),
      "<item objectid=\"1\"/>");
  const std::string part = model_3mf(object(1, kTetrahedronOf3mf), "");
  EXPECT_EQ(surface(zip({{"3D/3dmodel.model", root}, {"3D/Objects/part_1.model", part}}), "a.3mf").facets,
            kFacets);
  EXPECT_NE(error(zip({{"3D/3dmodel.model", root}}), "a.3mf").find("part_1.model"), std::string::npos);
}

TEST_F(SolidsOfFiles, MaterialsOfOneObjectAreMarkers) {
  std::string mesh = replaced(kTetrahedronOf3mf, "v1=\"1\" v2=\"2\" v3=\"3\"",
                              "v1=\"1\" v2=\"2\" v3=\"3\" pid=\"5\" p1=\"1\"");
  const std::string materials =
      "<basematerials id=\"5\"><base name=\"PLA\" displaycolor=\"#FFF\"/><base "
      "name=\"TPU\"/></basematerials>";
  const Surface s = of_3mf(materials + object(1, mesh, "pid=\"5\" pindex=\"0\""), "<item objectid=\"1\"/>");
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 2, 1}));
  EXPECT_EQ(s.names.facets, (FacetNames{{1, "PLA"}, {2, "TPU"}}));
  // Colours are looks.
  mesh = replaced(mesh, "pid=\"5\"", "pid=\"6\"");
  EXPECT_TRUE(of_3mf("<m:colorgroup id=\"6\"><m:color color=\"#F00\"/></m:colorgroup>" + object(1, mesh),
                     "<item objectid=\"1\"/>")
                  .facet_markers.empty());
}

TEST_F(SolidsOfFiles, ColoursAreLeftOutAndTold) {
  const std::string painted = replaced(kTetrahedronOf3mf, "v1=\"1\" v2=\"2\" v3=\"3\"",
                                       "v1=\"1\" v2=\"2\" v3=\"3\" slic3rpe:mmu_segmentation=\"4\"");
  const Surface s = of_3mf(
      "<m:colorgroup id=\"6\"><m:color color=\"#F00\"/><m:color color=\"#0F0\"/></m:colorgroup>"
      "<m:texture2d id=\"7\" path=\"/3D/a.png\"/><m:texture2dgroup id=\"8\" texid=\"7\"><m:tex2coord u=\"0\" "
      "v=\"0\"/></m:texture2dgroup>" +
          object(1, painted, "pid=\"6\" pindex=\"0\""),
      "<item objectid=\"1\"/>");
  std::string said;
  for (const Remark& remark : s.remarks) said += remark.message + "\n";
  EXPECT_EQ(said, "2 colours are left out\n1 painted triangle's paint is left out\n1 texture is left out\n");
}

TEST_F(SolidsOfFiles, ATriangleWithoutAGroupHasThatOfItsObject) {
  const std::string mesh = replaced(replaced(kTetrahedronOf3mf, "v1=\"0\" v2=\"2\" v3=\"1\"",
                                             "v1=\"0\" v2=\"2\" v3=\"1\" pid=\"6\" p1=\"0\""),
                                    "v1=\"0\" v2=\"1\" v3=\"3\"", "v1=\"0\" v2=\"1\" v3=\"3\" p1=\"1\"");
  const Surface s = of_3mf(
      "<basematerials id=\"5\"><base name=\"a\"/><base name=\"b\"/></basematerials><basematerials "
      "id=\"6\"><base name=\"c\"/></basematerials>" +
          object(1, mesh, "pid=\"5\" pindex=\"0\""),
      "<item objectid=\"1\"/>");
  ASSERT_EQ(s.facet_markers.size(), 4u);
  EXPECT_EQ(s.names.facets.at(s.facet_markers[0]), "c");
  EXPECT_EQ(s.names.facets.at(s.facet_markers[1]), "b");
  EXPECT_EQ(s.names.facets.at(s.facet_markers[2]), "a");
}

TEST_F(SolidsOfFiles, VolumesOfASlicer) {
  const std::string model = model_3mf(object(1, kTetrahedronOf3mf), "<item objectid=\"1\"/>");
  const auto with = [&](const std::string& volumes) {
    return surface(zip({{"3D/3dmodel.model", model},
                        {"Metadata/Slic3r_PE_model.config",
                         "<config><object id=\"1\"><metadata type=\"object\" key=\"name\" value=\"box\"/>" +
                             volumes + "</object></config>"}}),
                   "a.3mf");
  };
  const auto volume = [](int first, int last, const std::string& name, const std::string& kind) {
    return "<volume firstid=\"" + std::to_string(first) + "\" lastid=\"" + std::to_string(last) +
           "\"><metadata type=\"volume\" key=\"name\" value=\"" + name +
           "\"/><metadata type=\"volume\" key=\"volume_type\" value=\"" + kind + "\"/></volume>";
  };
  const Surface two = with(volume(0, 1, "a", "ModelPart") + volume(2, 3, "b", "ModelPart"));
  EXPECT_EQ(two.facet_markers, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(two.names.facets, (FacetNames{{1, "a"}, {2, "b"}}));
  const Surface one = with(volume(0, 0, "a", "ModelPart") + volume(1, 3, "b", "ParameterModifier"));
  EXPECT_EQ(one.facets, (Facets{{0, 1, 2}}));
  EXPECT_EQ(one.vertices.size(), 3u);  // those of the modifier are no points of the mesh
  ASSERT_EQ(one.remarks.size(), 1u);
  EXPECT_EQ(one.remarks[0].message, "1 volume that modifies the print is left out");
  EXPECT_EQ(with(volume(0, 9, "a", "NegativeVolume")).facets, kFacets);  // of another mesh
}

TEST_F(SolidsOfFiles, VolumesAndInstancesOfAmf) {
  const std::string volumes = "<volume materialid=\"2\">" + amf_triangles({"021", "013"}) +
                              "</volume><volume><metadata type=\"name\">rest</metadata>" +
                              amf_triangles({"123", "032"}) + "</volume>";
  const std::string one =
      "<amf><material id=\"2\"><metadata type=\"name\">steel</metadata></material><object "
      "id=\"0\"><mesh>" +
      amf_vertices() + volumes + "</mesh></object>";
  const Surface s = surface(one + "</amf>", "a.amf");
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(s.names.facets, (FacetNames{{1, "steel"}, {2, "rest"}}));
  const Surface placed = surface(one +
                                     "<constellation id=\"1\"><instance "
                                     "objectid=\"0\"><deltax>3</deltax><rz>90</rz></instance><instance "
                                     "objectid=\"0\"><deltaz>-1</deltaz></instance></constellation></amf>",
                                 "a.amf");
  ASSERT_EQ(placed.vertices.size(), 8u);
  EXPECT_EQ(placed.vertices[1], (Point{3, 1, 0}));  // (1, 0, 0), turned about z by a right angle
  EXPECT_EQ(placed.vertices[4], (Point{0, 0, -1}));
  EXPECT_EQ(placed.facet_markers, (std::vector<int>{1, 1, 2, 2, 3, 3, 4, 4}));
}

TEST_F(SolidsOfFiles, ErrorsNameThePartAndTheLine) {
  const auto of = [&](const std::string& resources, const std::string& build) {
    return error(package_3mf(model_3mf(resources, build)), "a.3mf");
  };
  EXPECT_EQ(
      of(object(1, replaced(kTetrahedronOf3mf, "v1=\"1\"", "v1=\"4\"")), "<item objectid=\"1\"/>"),
      "a.3mf/3D/3dmodel.model: line 7: the vertex 4 is out of range; the object has 4, and the first is 0");
  EXPECT_EQ(of(object(1, replaced(kTetrahedronOf3mf, "z=\"1e0\"", "z=\"up\"")), "<item objectid=\"1\"/>"),
            "a.3mf/3D/3dmodel.model: line 5: the attribute z is no number: 'up'");
  EXPECT_EQ(of(object(1, kTetrahedronOf3mf), "<item objectid=\"2\"/>"),
            "a.3mf: the package has no object 2 of '3d/3dmodel.model', which it names");
  EXPECT_EQ(of(object(1, "<components><component objectid=\"1\"/></components>"), "<item objectid=\"1\"/>"),
            "a.3mf: object 1 of '3d/3dmodel.model' is a component of itself");
  EXPECT_EQ(error("solid", "a.3mf"), "a.3mf: is no 3MF package, which is a ZIP archive");
  EXPECT_EQ(error(zip({{"a.txt", "x"}}), "a.3mf"), "a.3mf: the archive holds no 3MF model");
  EXPECT_EQ(error(zip({{"a.txt", "x"}}), "a.amf"), "a.amf: the archive holds no .amf file");
  EXPECT_EQ(error(replaced(kSmallAmf, "</amf>", ""), "a.amf"),
            "a.amf: does not end with </amf>; it is truncated or no AMF file");
  EXPECT_EQ(error(replaced(kSmallAmf, "<v1>1</v1>", "<v1>9</v1>"), "a.amf").substr(0, 12), "a.amf: line ");
  EXPECT_NE(
      error(replaced(kSmallAmf, "<v1>1</v1>", ""), "a.amf").find("<triangle> without its three numbers"),
      std::string::npos);
}

TEST_F(SolidsOfFiles, DamagedArchives) {
  const std::string whole = small_3mf();
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(static_cast<void>(io::parse_surface({"a.3mf", whole.substr(0, size)}, "3mf")), FileError)
        << size;
  std::string wrong = whole;  // within the model's bytes
  wrong[wrong.find("3dmodel.model") + 40] ^= 0x55;
  EXPECT_NE(error(wrong, "a.3mf"), "read");
  const std::string stored = small_3mf(Packing::stored);
  EXPECT_NE(error(replaced(stored, "v1=\"0\"", "v1=\"1\""), "a.3mf").find("checksum"), std::string::npos);
}

TEST_F(SolidsOfFiles, CopiesOfCopiesWithoutEnd) {
  std::string objects = object(1, kTetrahedronOf3mf);
  for (int id = 2; id < 40; ++id) {
    const std::string one = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    objects += object(id, "<components>" + one + one + one + one + "</components>");
  }
  const std::string what = error(package_3mf(model_3mf(objects, "<item objectid=\"39\"/>")), "a.3mf");
  EXPECT_NE(what.find("damaged or malicious"), std::string::npos) << what;
}

}  // namespace
}  // namespace holdfast::io_solids_test
