// Parts and instances of Abaqus's .inp, as Abaqus/CAE writes them.
#include <gtest/gtest.h>

#include "io_samples.h"

namespace holdfast::io_inp_parts_test {
namespace {

using namespace samples;

class InpParts : public ::testing::Test, protected AsInp {
 protected:
  static std::string without(std::string text, const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from);
    return text.erase(begin, text.find(to, begin) + to.size() + 1 - begin);
  }
};

TEST_F(InpParts, InstancesArePlacedCopies) {
  const Volume v = volume(kAssembly);
  ASSERT_EQ(v.vertices.size(), 12u);
  EXPECT_EQ(v.vertices[3], (Point{0, 0, 1}));
  EXPECT_EQ(v.vertices[4], (Point{0, 0, -2}));
  EXPECT_EQ(v.vertices[9], (Point{5, 1, 0}));  // (1, 0, 0), moved by 5, then turned about z through (5, 0, 0)
  EXPECT_EQ(v.vertices[10], (Point{4, 0, 0}));
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {4, 6, 5, 7}, {8, 10, 9, 11}}));
}

TEST_F(InpParts, SetsAndSurfacesOfInstances) {
  const Volume v = volume(kAssembly);
  const auto region = [&](std::size_t t) { return v.names.regions.at(v.regions[t]); };
  EXPECT_EQ(region(0), "Block-1.Set-1");  // internal sets are no regions
  EXPECT_EQ(region(1), "Lid-1.Set-1");
  EXPECT_EQ(region(2), "Lid-2.Set-1");
  ASSERT_EQ(v.facets.size(), 1u);
  EXPECT_EQ(v.names.facets.at(v.facet_markers[0]), "top");
  EXPECT_EQ(v.facets[0], (Triangle{0, 2, 1}));
  // A set of the assembly, of sets of two instances.
  const std::string text = replaced(kAssembly, "*Elset, elset=_top_S1,",
                                    "*Elset, elset=lids\nLid-1.Set-1, Lid-2.Set-1\n*Elset, elset=_top_S1,");
  const Volume lids = volume(replaced(text, "*Elset, elset=Set-1\n", "*Elset, elset=Set-1, internal\n"));
  EXPECT_EQ(lids.names.regions.at(lids.regions[1]), "lids");
  EXPECT_EQ(lids.regions[1], lids.regions[2]);
  EXPECT_EQ(lids.regions[0], 0);
}

TEST_F(InpParts, OneInstanceNeedsNoPrefix) {
  std::string text = kAssembly;
  for (const char* instance : {"*Instance, name=Lid-1", "*Instance, name=Lid-2"})
    text = without(text, instance, "*End Instance");
  const Volume v = volume(text);
  EXPECT_EQ(v.tetrahedra.size(), 1u);
  EXPECT_EQ(v.names.regions.at(v.regions[0]), "Set-1");
}

TEST_F(InpParts, MeshesOfInstances) {
  // Independent instances have the mesh themselves.
  const Volume v = volume(
      "*Part, name=P\n*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n0, 0, 1\n*Node\n1, 0, 0, "
      "0\n2, 1, 0, "
      "0\n3, 0, 1, 0\n4, 0, 0, 1\n*Element, type=C3D4\n7, 1, 2, 3, 4\n*End Instance\n*Node\n1, 9, 9, 9\n*End "
      "Assembly\n");
  EXPECT_EQ(v.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(v.vertices[0], (Point{0, 0, 1}));
  EXPECT_EQ(v.vertices[4], (Point{9, 9, 9}));
}

TEST_F(InpParts, WithoutAnAssemblyEachPartIsThereOnce) {
  const std::string text = kAssembly;
  const Volume v = volume(text.substr(0, text.find("*Assembly")));
  EXPECT_EQ(v.tetrahedra.size(), 2u);
  EXPECT_EQ(v.names.regions.at(v.regions[1]), "Lid.Set-1");
}

TEST_F(InpParts, AKeywordThatGoesOnInTheLastLine) {
  EXPECT_EQ(volume("*Part, name=P\n*Solid Section,\n*End Part\n*Node\n1, 0, 0, 0").vertices.size(), 1u);
}

TEST_F(InpParts, ErrorsSpeakOfTheFile) {
  const std::string text = kAssembly;
  EXPECT_EQ(error(replaced(text, "1, 1, 3, 2, 4", "1, 1, 3, 2, 9")), "line 31: the node 9 does not exist");
  EXPECT_EQ(error(replaced(text, "part=Block\n", "part=Blok\n")), "line 40: the part 'Blok' does not exist");
  EXPECT_EQ(error(replaced(text, "instance=Block-1", "instance=Block-2")),
            "line 52: the instance 'Block-2' does not exist");
  EXPECT_EQ(
      error(replaced(text, "5.,           0.,          1.,    90.", "5.,           0.,          0.,    90.")),
      "line 49: an instance is rotated about an axis through two equal points");
  EXPECT_EQ(error(replaced(text, "*End Part\n**\n** ASSEMBLY",
                           "*Instance, name=Lid-3, part=Lid\n*End Instance\n*End Part\n** ASSEMBLY")),
            "line 34: an instance within a part or an instance");
  EXPECT_EQ(error(text.substr(0, text.find("*End Part"))),
            "line 7: the part 'Block' does not end with *END PART");
  EXPECT_EQ(error(replaced(text, "      4,           0.,           0.,           -1.",
                           "      3,           0.,           0.,           -1.")),
            "the node 3 occurs twice");
}

}  // namespace
}  // namespace holdfast::io_inp_parts_test
