// COLLADA.
#include <gtest/gtest.h>

#include "dae_samples.h"
#include "io_samples.h"

namespace holdfast::io_dae_test {
namespace {

using namespace samples;

Surface surface(const std::string& bytes) {
  const TemporaryFolder folder;
  put(folder / "a.dae", bytes);
  return read_surface(folder / "a.dae");
}
std::string error(const std::string& bytes) {
  return refusal_of([&] { return surface(bytes); });
}
std::string scene(const std::string& nodes) {
  return "<library_visual_scenes><visual_scene id=\"s\">" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>";
}
const std::string kTriangle = dae_geometry("<triangles count=\"1\" material=\"red\">" + dae_inputs() +
                                           "<p>0 0 1 0 2 0</p></triangles>");

TEST(DaeFile, AllKindsOfFaces) {
  const auto facets = [](const std::string& parts) { return surface(dae_file(dae_geometry(parts))).facets; };
  EXPECT_EQ(facets("<triangles count=\"2\">" + dae_inputs() + "<p>0 9 1 9 2 9 0 8 3 8 1 8</p></triangles>"),
            (std::vector<Triangle>{{0, 1, 2}, {0, 3, 1}}));
  EXPECT_EQ(facets("<polylist count=\"2\">" + dae_inputs() +
                   "<vcount>4 3</vcount><p>0 0 1 0 4 0 2 0 0 0 3 0 1 0</p></polylist>"),
            (std::vector<Triangle>{{0, 1, 4}, {0, 4, 2}, {0, 3, 1}}));
  EXPECT_EQ(facets("<polygons>" + dae_inputs() + "<p>0 0 1 0 2 0</p><p>0 0 3 0 1 0</p></polygons>"),
            (std::vector<Triangle>{{0, 1, 2}, {0, 3, 1}}));
  EXPECT_EQ(facets("<tristrips>" + dae_inputs() + "<p>0 0 1 0 2 0 4 0</p></tristrips>"),
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 4}}));
  EXPECT_EQ(facets("<trifans>" + dae_inputs() + "<p>0 0 1 0 4 0 2 0</p></trifans><lines/>"),
            (std::vector<Triangle>{{0, 1, 4}, {0, 4, 2}}));
}

TEST(DaeFile, NodesPlaceCopies) {
  const Surface read = surface(dae_file(
      kTriangle +
      scene("<node name=\"left\"><translate>10 0 0</translate><rotate>0 0 2 90</rotate><scale>2 2 2</scale>"
            "<instance_geometry url=\"#g\"/><node name=\"inner\"><matrix>1 0 0 5 0 -1 0 0 0 0 1 0 0 0 0 "
            "1</matrix>"
            "<instance_geometry url=\"#g\"/></node></node>"
            "<node name=\"right &amp; up\"><instance_node url=\"#kept\"/></node>") +
      "<library_nodes><node id=\"kept\"><translate>0 0 7</translate><instance_geometry url=\"#g\"/></node>"
      "</library_nodes>"));
  ASSERT_EQ(read.facets.size(), 3U);
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "left"}, {2, "inner"}, {3, "kept"}}));
  EXPECT_EQ(read.vertices[1], (Point{10, 2, 0}));
  EXPECT_EQ(read.vertices[5 + 1], (Point{10, 12, 0}));
  EXPECT_EQ(read.facets[1], (Triangle{5, 7, 6}));  // mirrored
  EXPECT_EQ(read.vertices[10], (Point{0, 0, 7}));
}

TEST(DaeFile, MaterialsAndSkins) {
  const Surface read =
      surface(dae_file("<library_materials><material id=\"red\" name=\"Red\"/></library_materials>" +
                       dae_geometry("<triangles material=\"red\">" + dae_inputs() +
                                    "<p>0 0 1 0 2 0</p></triangles><triangles "
                                    "material=\"blue\">" +
                                    dae_inputs() + "<p>0 0 3 0 1 0</p></triangles>") +
                       "<library_controllers><controller id=\"c\"><skin source=\"#g\"><bind_shape_matrix>1 0 "
                       "0 3 0 1 0 0 0 0 1 0 0 0 0 1"
                       "</bind_shape_matrix></skin></controller></library_controllers>" +
                       scene("<node name=\"n\"><instance_controller url=\"#c\"/></node>")));
  EXPECT_EQ(read.facet_markers, (std::vector<int>{1, 2}));
  EXPECT_EQ(read.names.facets, (std::map<int, std::string>{{1, "Red"}, {2, "blue"}}));
  EXPECT_EQ(read.vertices[0], (Point{3, 0, 0}));
  EXPECT_EQ(read.remarks.front().message, "1 skin or morph, with the pose of its mesh is left out");
}

TEST(DaeFile, ErrorsNameTheLine) {
  EXPECT_EQ(error("<svg></svg>"), "line 1: no COLLADA: it does not begin with <COLLADA>");
  EXPECT_EQ(error("<COLLADA>\n"), "does not end with </COLLADA>; it is truncated or no COLLADA");
  EXPECT_EQ(error("<COLLADA>\n<a>\n</b>"), "line 3: </b> closes no <a>");
  EXPECT_EQ(error(dae_file("")), "the file holds no vertices");
  const auto part = [](const std::string& text) { return error(dae_file(dae_geometry("\n" + text))); };
  EXPECT_EQ(part("<triangles>" + dae_inputs() + "<p>0 0 1 0 5 0</p></triangles>"),
            "line 3: the vertex 5 is out of range; there are 5, and the first is 0");
  EXPECT_EQ(part("<triangles>" + dae_inputs() + "<p>0 0 1 0 2</p></triangles>"),
            "line 3: 5 numbers are no whole corners of 2");
  EXPECT_EQ(part("<triangles>" + dae_inputs() + "<p>0 0 1 0</p></triangles>"),
            "line 3: 2 corners, which make no triangles");
  EXPECT_EQ(part("<triangles>" + dae_inputs() + "<p>0 0 -1 0 2 0</p></triangles>"),
            "line 3: expected numbers from 0, found '-1'");
  EXPECT_EQ(part("<triangles><p>0 1 2</p></triangles>"), "line 3: <triangles> has no vertices");
  EXPECT_EQ(part("<polylist>" + dae_inputs() + "<vcount>4</vcount><p>0 0 1 0 2 0</p></polylist>"),
            "line 3: more corners than the list of vertices has");
  EXPECT_EQ(part("<polygons>" + dae_inputs() + "<ph><p>0 0</p></ph></polygons>"),
            "line 3: polygons with holes are not read; triangulate them");
  EXPECT_EQ(part("<triangles><input semantic=\"VERTEX\" source=\"#v\" offset=\"4000000000\"/></triangles>"),
            "line 3: an offset of 4000000000");
  std::string many = dae_file(kTriangle);
  many.replace(many.find("count=\"5\""), 9, "count=\"6148914691236517206\"");
  EXPECT_EQ(error(many), "line 2: 6148914691236517206 positions, every 3 numbers, do not fit an array of 15");
  EXPECT_EQ(error(dae_file(kTriangle + scene("<node><instance_geometry url=\"b.dae#g\"/></node>"))),
            "line 2: 'b.dae#g' is in another file, which is not read");
  EXPECT_EQ(error(dae_file(kTriangle + scene("<node><instance_geometry url=\"#h\"/></node>"))),
            "line 2: '#h' does not exist");
  EXPECT_EQ(error(dae_file(kTriangle + scene("<node><matrix>1 2</matrix></node>"))),
            "line 2: <matrix> has 2 numbers instead of 16");
  EXPECT_EQ(error(dae_file(kTriangle + scene("<node id=\"n\"><instance_node url=\"#n\"/></node>"))),
            "line 2: nodes stand more than 256 deep");
  std::string doubled = "<library_nodes><node id=\"n0\"><instance_geometry url=\"#g\"/></node>";
  for (int i = 1; i < 60; ++i) {
    const std::string twice = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
    doubled += "<node id=\"n" + std::to_string(i) + "\">" + twice + twice + "</node>";
  }
  EXPECT_NE(error(dae_file(kTriangle + doubled + "</library_nodes>" +
                           scene("<node><instance_node url=\"#n59\"/></node>")))
                .find("damaged or malicious"),
            std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_dae_test
