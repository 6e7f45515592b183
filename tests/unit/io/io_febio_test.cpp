// Models of FEBio.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_febio_test {
namespace {

using namespace samples;

const std::string kNodes =
    "<Nodes name=\"Object1\">\n<node id=\"1\">0,0,0</node>\n<node id=\"2\"> 1, 0, 0 </node>\n"
    "<node id=\"3\">0,1.0e0,0</node>\n<node id=\"40\">0,0,1</node>\n</Nodes>\n";

std::string version4(const std::string& mesh) {
  return "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<febio_spec version=\"4.0\">\n<Module "
         "type=\"solid\"/>\n"
         "<Material><material id=\"1\" name=\"m\" "
         "type=\"neo-Hookean\"><E>1</E></material></Material>\n<Mesh>\n" +
         mesh +
         "</Mesh>\n<MeshDomains><SolidDomain name=\"Part1\" mat=\"m\"/></MeshDomains>\n<Boundary>"
         "<bc node_set=\"fix\" type=\"zero displacement\"/></Boundary></febio_spec>\n";
}

const std::string kTetrahedron =
    "<Elements type=\"tet4\" name=\"Part1\">\n<elem id=\"1\">1,2,3,40</elem>\n</Elements>\n";

TEST(FebFile, PartsSurfacesAndSets) {
  const Volume read = volume(
      version4(kNodes + kTetrahedron +
               "<Elements type=\"TRI3G3\" name=\"membrane\"><elem id=\"2\">1,2,40</elem></Elements>\n"
               "<Surface name=\"load\"><tri3 id=\"1\">1,3,2</tri3><tri3 id=\"2\">1,2,40</tri3></Surface>\n"
               "<Surface name=\"a &amp; b\"><tri3 id=\"1\">2,3,40</tri3></Surface>\n"
               "<Edge name=\"rim\"><line2 id=\"1\">1,2</line2></Edge><NodeSet name=\"fix\">1, 3\n</NodeSet>\n"
               "<NodeSet name=\"empty\"/><ElementSet name=\"x\">1</ElementSet>"),
      "a.feb");
  EXPECT_EQ(read.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{0, 1, 3}, {0, 2, 1}, {1, 2, 3}}));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{2, 2, 3}));  // the surface counts more than the shell
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "membrane"}, {2, "load"}, {3, "a & b"}}));
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{1, "Part1"}}));
  EXPECT_EQ(read.names.segments, (std::map<int, std::string>{{1, "rim"}}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{1, 0, 1, 0}));
  EXPECT_EQ(read.names.vertices.at(1), "fix");
}

TEST(FebFile, OlderVersions) {
  const std::string head = "<febio_spec version=\"2.5\"><Geometry>" + kNodes,
                    tail = "</Geometry></febio_spec>";
  Volume read = volume(head +
                           "<Elements type=\"tet4\" mat=\"2\"><elem id=\"1\">1,2,3,40</elem></Elements>"
                           "<NodeSet name=\"fix\"><node id=\"1\"/><n id=\"40\"/></NodeSet>" +
                           tail,
                       "a.feb");
  EXPECT_EQ(read.names.regions, (std::map<int, std::string>{{1, "material 2"}}));
  EXPECT_EQ(read.vertex_markers, (std::vector<int>{1, 0, 0, 1}));
  read = volume(head + "<Elements><tet4 id=\"1\" mat=\"1\">1,2,3,40</tet4></Elements>" + tail, "a.feb");
  EXPECT_EQ(read.tetrahedra.size(), 1U);
}

TEST(FebFile, HexahedraAreSplitAndQuadranglesMatch) {
  std::string nodes = "<Nodes>";
  const char* const places[] = {"0,0,0", "1,0,0", "1,1,0", "0,1,0", "0,0,1", "1,0,1", "1,1,1", "0,1,1"};
  for (int i = 0; i < 8; ++i) nodes += "<node id=\"" + std::to_string(i + 1) + "\">" + places[i] + "</node>";
  const Volume read =
      volume(version4(nodes + "</Nodes><Elements type=\"hex8\" name=\"h\"><elem id=\"1\">1,2,3,4,5,6,7,8"
                              "</elem></Elements><Surface name=\"s\"><quad4 id=\"1\">5,6,7,8</quad4>"
                              "</Surface>"),
             "a.feb");
  EXPECT_EQ(read.tetrahedra.size(), 6U);
  EXPECT_EQ(read.facets, (std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}}));
}

TEST(FebFile, ErrorsNameTheLine) {
  const auto with = [&](const std::string& mesh) { return error(version4(kNodes + mesh), "a.feb"); };
  EXPECT_EQ(error("<gml></gml>", "a.feb"), "line 1: no file of FEBio: it does not begin with <febio_spec>");
  EXPECT_EQ(error("<febio_spec version=\"4.0\"><Mesh>", "a.feb"),
            "does not end with </febio_spec>; it is truncated or not FEBio's");
  EXPECT_EQ(error("<febio_spec></febio_spec>", "a.feb"), "the file has no nodes");
  EXPECT_EQ(error("<febio_spec><Geometry from=\"b.feb\"/></febio_spec>", "a.feb"),
            "line 1: the mesh is in another file, 'b.feb'; read that");
  EXPECT_EQ(with("<Nodes><node id=\"1\">0,0,0</node></Nodes>"), "the node 1 occurs twice");
  EXPECT_EQ(with("<Nodes><node id=\"9\">0,0</node></Nodes>"), "line 12: expected three coordinates");
  EXPECT_EQ(with("<Nodes><node id=\"9\">0,0,z</node></Nodes>"),
            "line 12: expected three coordinates, found 'z'");
  EXPECT_EQ(with("<Elements type=\"tet4\"><elem id=\"1\">1,2,3</elem></Elements>"),
            "line 12: an element of the type 'tet4' with 3 nodes");
  EXPECT_EQ(with("<Elements type=\"tet4\"><elem id=\"1\">1,2,3,4</elem></Elements>"),
            "line 12: the node 4 does not exist");
  EXPECT_EQ(with("<Elements type=\"tet4\"><elem id=\"1\">1,2,3,x</elem></Elements>"),
            "line 12: expected the number of a node, found 'x'");
  EXPECT_EQ(with("<Elements type=\"blob\"><elem id=\"1\">1</elem></Elements>"),
            "line 12: elements of the type 'blob' are not read");
  EXPECT_EQ(with("<Surface name=\"s\"><line2 id=\"1\">1,2</line2></Surface>"),
            "line 12: a side of a surface is no triangle or quadrangle");
  EXPECT_EQ(with("<Part name=\"p\">"),
            "line 12: parts and their instances are not read; save the model with one mesh");
}

TEST(FebFile, EverythingComesBack) {
  const TemporaryFolder folder;
  Volume original = sample_volume();
  original.names = {{{7, "in & out"}}, {{-3, "part"}}, {{9, "wire"}}, {{3, "tip"}}};
  write_volume(folder / "a.feb", original);
  const Volume read = read_volume(folder / "a.feb");
  EXPECT_EQ(bits(read.vertices), bits(original.vertices));
  EXPECT_EQ(read.vertex_markers, original.vertex_markers);
  EXPECT_EQ(read.segments.size(), original.segments.size());
  original.names.facets[7] = "in _ out";
  EXPECT_TRUE(read.names == original.names);
  original.tetrahedra.clear();
  original.regions.clear();
  write_volume(folder / "b.feb", original);
  const Surface surface = read_surface(folder / "b.feb");
  EXPECT_EQ(surface.facets, original.facets);
  EXPECT_EQ(surface.facet_markers, original.facet_markers);
}

}  // namespace
}  // namespace holdfast::io_febio_test
