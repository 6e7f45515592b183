// VRML 1.0 and 2.0.
#include <gtest/gtest.h>

#include "holdfast/holdfast.h"
#include "io_samples.h"
#include "vrml_samples.h"

namespace holdfast {
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
            (std::vector<std::string>{"1 shape that is no set of faces is left out",
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

TEST_F(Vrml, TheFirstVersionHasAState) {
  const Surface s = surface(kVrml1);
  ASSERT_EQ(s.facets.size(), 9u);
  EXPECT_EQ(s.facets[0], (Triangle{2, 1, 0}));
  EXPECT_EQ(s.vertices[3], (Point{5, 0, 1}));
  EXPECT_EQ(s.vertices[4 + 3], (Point{0, 7, 3}));
  EXPECT_EQ(s.vertices[8 + 1], (Point{1, 0, 0}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "one"}, {2, "one"}, {3, "last"}}));
  EXPECT_EQ(remarks(s), (std::vector<std::string>{"2 shapes that are no sets of faces are left out"}));
}

TEST_F(Vrml, ErrorsNameTheLine) {
  const std::string text = kVrml2;
  EXPECT_EQ(error(replaced(text, "#VRML V2.0", "#VRML V3.0")),
            "line 1: a VRML file begins with '#VRML V1.0 ascii' or '#VRML V2.0 utf8'; this one does not");
  EXPECT_EQ(error(replaced(text, "1 2 6 5 -1", "1 2 6 8 -1")),
            "line 13: a face names point 8, but there are 8");
  EXPECT_EQ(error(replaced(text, "1 2 6 5 -1", "1 2 6 0.5 -1")),
            "line 13: a face names point 0.5, but there are 8");
  EXPECT_EQ(error(replaced(text, "1 2 6 5 -1", "1 2 -1")), "line 13: a face of fewer than 3 corners");
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

}  // namespace
}  // namespace holdfast
