// VRML 1.0 and 2.0.
#include <gtest/gtest.h>

#include "holdfast/holdfast.h"
#include "holdfast/statistics.h"
#include "io_samples.h"
#include "vrml_samples.h"

namespace holdfast::io_vrml_test {
namespace {

using namespace samples;

class Vrml : public ::testing::Test {
 protected:
  Surface surface(const std::string& text) {
    put(folder_ / "a.wrl", text);
    return read_surface(folder_ / "a.wrl");
  }
  std::string error(const std::string& text) {
    return refusal_of([&] { return surface(text); });
  }
  std::vector<std::string> remarks(const Surface& surface) {
    std::vector<std::string> all;
    for (const Remark& remark : surface.remarks) all.push_back(remark.message);
    return all;
  }
  TemporaryFolder folder_;
};

TEST_F(Vrml, FacesStandWhereTheScenePlacesThem) {
  const Surface s = surface(kVrml2);
  ASSERT_EQ(s.facets.size(), 24u);
  ASSERT_EQ(s.vertices.size(), 16u);
  EXPECT_EQ(s.vertices[6], (Point{12, 2, 2}));
  // Mirrored in x, then turned by a right angle about z.
  EXPECT_EQ(s.vertices[8 + 1], (Point{0, -1, 0}));
  EXPECT_EQ(s.vertices[8 + 2], (Point{-1, -1, 0}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "cube"}, {2, "cube"}}));
  EXPECT_EQ(remarks(s),
            (std::vector<std::string>{"1 shape that is no set of faces (Cylinder) is left out",
                                      "1 scene of another file is left out",
                                      "1 node of a kind that the file defines is left out",
                                      "6 polygons of more than three corners are cut into triangles"}));
  // Seen from outside, the mirrored one too: the winding number keeps both.
  Options options;
  options.keep = Keep::winding;
  const Result result = mesh(s.view(), options);
  EXPECT_EQ(result.outcome, Outcome::done);
  EXPECT_EQ(result.report.regions, 2u);
}

TEST_F(Vrml, WithoutFacesTheErrorSaysWhatIsThere) {
  EXPECT_EQ(error("#VRML V2.0 utf8\nShape { geometry Sphere { } } Shape { geometry Cone { } }\n"),
            "the file holds no vertices; 2 shapes that are no sets of faces (Cone, Sphere) are left out");
}

TEST_F(Vrml, ShapesThatArePolyhedra) {
  const auto volume = [](const Surface& s) { return statistics(s).volume; };
  const auto shape = [&](const std::string& geometry) {
    return surface("#VRML V2.0 utf8\nDEF part Shape { geometry " + geometry + " }\n");
  };
  const Surface box = shape("Box { size 2 3 4 }");
  EXPECT_EQ(box.facets.size(), 12u);
  EXPECT_DOUBLE_EQ(volume(box), 24);
  EXPECT_EQ(box.names.facets.begin()->second, "part");
  EXPECT_DOUBLE_EQ(volume(surface("#VRML V1.0 ascii\nCube { width 3 }\n")), 12);
  EXPECT_DOUBLE_EQ(volume(shape("Extrusion { }")), 4);
  EXPECT_DOUBLE_EQ(volume(shape("Extrusion { ccw FALSE }")), -4);
  EXPECT_EQ(shape("Extrusion { beginCap FALSE endCap FALSE }").facets.size(), 8u);
  EXPECT_NEAR(volume(shape("Extrusion { spine [0 0 0, 0 0 3] scale [1 1, 0.5 0.5] }")), 7, 1e-12);
  EXPECT_NEAR(volume(shape("Extrusion { spine [0 0 0, 0 -2 0] orientation 0 1 0 0.785398 }")), 8, 1e-12);
  // A square ring, and a path with a bend.
  const Surface ring = shape(
      "Extrusion { crossSection [.5 .5, .5 -.5, -.5 -.5, -.5 .5, .5 .5] spine [4 0 4, 4 0 -4, -4 0 -4, -4 0 "
      "4, 4 0 4] }");
  EXPECT_EQ(ring.facets.size(), 32u);
  EXPECT_TRUE(diagnose(ring.view()).empty());
  EXPECT_GT(volume(ring), 0);
  EXPECT_GT(
      volume(shape(
          "Extrusion { crossSection [.5 .5, .5 -.5, -.5 -.5, -.5 .5, .5 .5] spine [0 0 0, 0 4 0, 4 4 0] }")),
      0);
  const Surface grid = shape("ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 height [0 1 0 0 0 1] }");
  EXPECT_EQ(grid.facets.size(), 4u);
  EXPECT_EQ(grid.vertices[4], (Point{2, 0, 1}));
  EXPECT_EQ(
      error("#VRML V2.0 utf8\nShape { geometry ElevationGrid { xDimension 3 zDimension 2 height [0 1] } }\n"),
      "line 2: an ElevationGrid with 2 heights, which are not xDimension times zDimension");
  for (const char* sizes : {"xDimension 0.5 zDimension 4", "xDimension -1 zDimension -2"})
    EXPECT_NE(error(std::string("#VRML V2.0 utf8\nShape { geometry ElevationGrid { height [0 1] ") + sizes +
                    " } }\n")
                  .find("2 heights"),
              std::string::npos);
  EXPECT_EQ(error("#VRML V2.0 utf8\nShape { geometry Extrusion { spine 0 0 } }\n"),
            "line 2: the field 'spine' has 2 numbers, no multiple of 3");
  EXPECT_EQ(error("#VRML V2.0 utf8\nShape { geometry Extrusion { spine 0 0 0 } }\n"),
            "line 2: an Extrusion needs two points of its spine and of its cross-section");
  put(folder_ / "a.x3d",
      "<X3D><Scene><Shape><Box size='1 2 3'/></Shape><Transform translation='9 0 0'><Shape>"
      "<Extrusion endCap='false' scale='2 2'/></Shape></Transform></Scene></X3D>");
  EXPECT_EQ(read_surface(folder_ / "a.x3d").facets.size(), 12u + 10u);
}

TEST_F(Vrml, TheFirstVersionHasAState) {
  const Surface s = surface(kVrml1);
  ASSERT_EQ(s.facets.size(), 9u);
  EXPECT_EQ(s.facets[0], (Triangle{2, 1, 0}));
  EXPECT_EQ(s.vertices[3], (Point{5, 0, 1}));
  EXPECT_EQ(s.vertices[4 + 3], (Point{0, 7, 3}));
  EXPECT_EQ(s.vertices[8 + 1], (Point{1, 0, 0}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "one"}, {2, "one"}, {3, "last"}}));
  EXPECT_EQ(remarks(s),
            (std::vector<std::string>{"2 shapes that are no sets of faces (Cone, Sphere) are left out"}));
}

TEST_F(Vrml, ErrorsNameTheLine) {
  const std::string text = kVrml2;
  EXPECT_EQ(error(replaced(text, "#VRML V2.0", "#VRML V3.0")),
            "line 1: a VRML file begins with '#VRML V1.0 ascii', '#VRML V2.0 utf8' or '#X3D V3.0 utf8'; this "
            "one does not");
  EXPECT_EQ(error(replaced(text, "1 2 6 5 -1", "1 2 6 8 -1")),
            "line 13: a face names point 8, but there are 8");
  EXPECT_EQ(error(replaced(text, "1 2 6 5 -1", "1 2 6 0.5 -1")),
            "line 13: a face names point 0.5, but there are 8");
  EXPECT_EQ(error(replaced(text, "0 1 1 ] }", "0 1 ] }")), "line 15: 23 coordinates are no whole points");
  EXPECT_EQ(error(replaced(text, "0 1 1 ] }", "0 1 1x ] }")), "line 15: '1x' is no number");
  EXPECT_EQ(error(replaced(text, "children USE cube", "children USE ball")),
            "line 24: no node before this one is named 'ball'");
  EXPECT_EQ(error(replaced(text, "translation 10 0 0", "translation 10 0")),
            "line 7: the field 'translation' has 2 numbers instead of 3");
  EXPECT_EQ(error("#VRML V1.0 ascii\nIndexedFaceSet { coordIndex [ 0 1 2 ] }"),
            "line 2: there is no Coordinate3 before the faces");
  for (const std::size_t end :
       {text.find("TRUE ccw"), text.find("Material"), text.find("0 3 2 1"), text.find("Knob { size 3")})
    EXPECT_NE(error(text.substr(0, end)).find("the file ends inside a node; it is truncated"),
              std::string::npos);
}

TEST_F(Vrml, TrapsAreRefused) {
  std::string deep = "#VRML V2.0 utf8\n", copies = deep + "DEF g0 Group { }\n";
  for (int i = 0; i < 1000; ++i) deep += "Group { children [ ";
  EXPECT_NE(error(deep).find("nodes stand more than 256 deep"), std::string::npos);
  for (int i = 1; i < 60; ++i)
    copies += "DEF g" + std::to_string(i) + " Group { children [ USE g" + std::to_string(i - 1) + " USE g" +
              std::to_string(i - 1) + " ] }\n";
  EXPECT_NE(error(copies).find("damaged or malicious"), std::string::npos);
  std::string chain = "#VRML V2.0 utf8\nDEF g0 Group { }\n";
  for (int i = 1; i < 100000; ++i)
    chain += "DEF g" + std::to_string(i) + " Group { children USE g" + std::to_string(i - 1) + " }\n";
  EXPECT_NE(error(chain).find("256 deep"), std::string::npos);
}

/// A scene of X3D.
Surface x3d(const std::string& scene) {
  const TemporaryFolder folder;
  put(folder / "a.x3d",
      "<?xml version=\"1.0\"?>\n<!DOCTYPE X3D>\n<X3D version='3.3'><head><meta name='a'/></head>\n<Scene>" +
          scene + "</Scene></X3D>");
  return read_surface(folder / "a.x3d");
}

std::string x3d_error(const std::string& scene) {
  return refusal_of([&] { return x3d(scene); });
}

const std::string kPoints = "<Coordinate point='0 0 0, 1 0 0, 1 1 0, 0 1 0'/>";

TEST(X3d, SetsOfFacesOfEveryKind) {
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
  for (const std::string& set :
       {"<IndexedFaceSet coordIndex='0 1 2 -1, 0 2 3'>" + kPoints + "</IndexedFaceSet>",
        "<IndexedTriangleSet index=\"0 1 2 0 2 3\">" + kPoints + "</IndexedTriangleSet>",
        "<IndexedQuadSet index='0 1 2 3'>" + kPoints + "</IndexedQuadSet>",
        "<QuadSet>" + kPoints + "</QuadSet>"}) {
    const Surface s =
        x3d("<Shape><Appearance><Material diffuseColor='1 1 1'/></Appearance>" + set + "</Shape>");
    EXPECT_EQ(s.facets, two) << set;
    EXPECT_EQ(s.vertices[2], (Point{1, 1, 0}));
  }
  EXPECT_EQ(
      x3d("<Shape><TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape>").facets.size(),
      1U);
  EXPECT_EQ(
      x3d("<Shape><IndexedFaceSet ccw='false' coordIndex='0 1 2'>" + kPoints + "</IndexedFaceSet></Shape>")
          .facets,
      (std::vector<Triangle>{{2, 1, 0}}));
}

TEST(X3d, TransformsNamesUsesAndChoices) {
  const std::string shape =
      "<Shape DEF='leaf'><IndexedTriangleSet index='0 1 2'>" + kPoints + "</IndexedTriangleSet></Shape>";
  const Surface s = x3d(
      "<Transform DEF='moved' translation='0 0 5' scale='2 2 2'>" + shape +
      "</Transform><Shape USE='leaf'/>"
      "<Switch whichChoice='1'><Shape USE='leaf'/><CADPart><Shape USE='leaf'/></CADPart></Switch>"
      "<LOD><Shape USE='leaf'/><Shape USE='leaf'/></LOD><Collision><Box containerField='proxy'/></Collision>"
      "<Shape><Sphere radius='2'/></Shape>");
  EXPECT_EQ(s.facets.size(), 4U);
  EXPECT_EQ(s.vertices[1], (Point{2, 0, 5}));
  ASSERT_EQ(s.remarks.size(), 1U);
  EXPECT_EQ(s.remarks[0].message, "1 shape that is no set of faces (Sphere) is left out");
}

/// A scene of X3D in VRML's syntax.
Surface x3dv(const std::string& scene) {
  const TemporaryFolder folder;
  put(folder / "a.x3dv",
      "#X3D V3.0 utf8\nPROFILE Immersive\nCOMPONENT Geometry3D:2\nMETA \"a\" \"b\"\nUNIT angle degree "
      "0.017\n" +
          scene);
  return read_surface(folder / "a.x3dv");
}

TEST(X3d, InTheSyntaxOfVrml) {
  const std::string points = "coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] }";
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
  for (const std::string& set :
       {"IndexedFaceSet { coordIndex [0 1 2 -1 0 2 3 -1] " + points + " }",
        "IndexedTriangleSet { index [0 1 2 0 2 3] " + points + " }", "QuadSet { " + points + " }"}) {
    const Surface s = x3dv("DEF part Transform { translation 1 0 0 children Shape { geometry " + set +
                           " } }\nEXPORT part AS b\n"
                           "DEF new Effect { inputOutput SFVec3f a 0 1 0 inputOnly SFTime time parts [ ] }");
    EXPECT_EQ(s.facets, two) << set;
    EXPECT_EQ(s.vertices[2], (Point{2, 1, 0}));
  }
  const std::string shape = "Shape { geometry QuadSet { " + points + " } }";
  EXPECT_EQ(
      x3dv("Switch { whichChoice 1 children [ Group { children [" + shape + shape + "] } " + shape + " ] }")
          .facets.size(),
      2U);
  EXPECT_EQ(x3dv("LOD { children [" + shape + " " + shape + " ] }").facets.size(), 2U);
  EXPECT_EQ(refusal_of([&] { x3dv("META \"a\" }"); }), "line 6: expected what belongs to 'META', found '}'");
}

TEST(X3d, ErrorsNameTheLine) {
  EXPECT_EQ(x3d_error("<Shape USE='none'/>"), "line 4: USE of 'none', which no DEF before it names");
  EXPECT_EQ(x3d_error("<Shape></Group>"), "line 4: the element 'Group' ends, but is not open");
  EXPECT_EQ(x3d_error("<Shape>\n<IndexedTriangleSet index='0 1 x'/></Shape>"),
            "line 5: expected a number, found 'x'");
  EXPECT_EQ(x3d_error("<Shape><IndexedTriangleSet index='0 1'>" + kPoints + "</IndexedTriangleSet></Shape>"),
            "line 4: the corners of the last face are not whole");
  EXPECT_NE(x3d_error("<Shape>").find("is truncated or no X3D file"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_vrml_test
