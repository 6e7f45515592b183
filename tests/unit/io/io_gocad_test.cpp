// GOCAD's surfaces, lines and points.
#include <gtest/gtest.h>

#include "holdfast/holdfast.h"
#include "io_samples.h"

namespace holdfast::io_gocad_test {
namespace {

using namespace samples;

class Gocad : public ::testing::Test {
 protected:
  Surface surface(const std::string& text) {
    put(folder_ / "a.ts", text);
    return read_surface(folder_ / "a.ts");
  }
  std::string error(const std::string& text) {
    return refusal_of([&] { return surface(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(Gocad, ObjectsAreMarkersWithVerticesOfTheirOwn) {
  const Surface s = surface(kGocad);
  EXPECT_EQ(s.vertices.size(), 9u);
  EXPECT_EQ(s.vertices[1], (Point{1, 0, 0}));
  EXPECT_EQ(s.facets, (std::vector<Triangle>{{0, 2, 1}, {3, 4, 6}, {4, 5, 6}, {3, 6, 5}}));
  EXPECT_EQ(s.facet_markers, (std::vector<int>{1, 2, 2, 2}));
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{1, "Top horizon"}, {2, "sides"}}));
  EXPECT_EQ(s.segments, (std::vector<Segment>{{7, 8}}));
  EXPECT_EQ(s.segment_markers, (std::vector<int>{3}));
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks[0].message, "1 set of properties of a vertex is left out");
  EXPECT_EQ(mesh(s.view()).outcome, Outcome::done);
}

TEST_F(Gocad, OneObjectHasANameAndNoMarker) {
  const std::string text = kGocad;
  const Surface s = surface(text.substr(0, text.find("GOCAD TSurf", 1)));
  EXPECT_TRUE(s.facet_markers.empty());
  EXPECT_EQ(s.names.facets, (std::map<int, std::string>{{0, "Top horizon"}}));
  const Surface cut = surface(text.substr(0, text.find("BSTONE")));
  EXPECT_EQ(cut.facets.size(), 1u);
  EXPECT_EQ(cut.remarks[0].message, "the file ends without 'END': triangles may be missing");
}

TEST_F(Gocad, ErrorsNameTheLine) {
  const std::string text = kGocad;
  EXPECT_EQ(error(replaced(text, "TRGL 1 3 2", "TRGL 1 3 9")),
            "line 17: the object has no vertex 9 before this line");
  EXPECT_EQ(error(replaced(text, "PVRTX 2", "PVRTX 1")),
            "line 15: the object has two vertices of the number 1");
  EXPECT_EQ(error(replaced(text, "PLine", "TSolid")),
            "line 35: objects of the kind 'TSolid' are not read; TSurf, PLine and VSet are");
  EXPECT_EQ(error("solid a\n"), "line 1: expected 'GOCAD', found 'solid'");
  EXPECT_EQ(error(text + "GOCAD VSet 1\nZPOSITIVE Depth\nEND\n").substr(0, 30),
            "line 44: z is the 'depth' here");
}

}  // namespace
}  // namespace holdfast::io_gocad_test
