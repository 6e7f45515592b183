// *INCLUDE in .inp files.
#include <gtest/gtest.h>

#include "io_samples.h"

namespace holdfast::io_inp_include_test {
namespace {

using namespace samples;

class InpInclude : public ::testing::Test {
 protected:
  InpInclude() {
    put(folder_ / "nodes.inp", "** of cgx\n*NODE, NSET=Nall\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1");
    put(folder_ / "all.msh", "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=C3D4, ELSET=Eall\n1, 1, 2, 3, 4\n");
    put(folder_ / "load.sur", "*SURFACE, NAME=load\n1, S1\n");
  }

  Volume read(const std::string& text) const {
    put(folder_ / "job.inp", text);
    return read_volume(folder_ / "job.inp");
  }
  std::string error(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const FileError& e) {
      return replaced(e.what(), (folder_ / "").string(), "");
    }
    return "read";
  }

  const TemporaryFolder folder_;
};

TEST_F(InpInclude, FilesStandForTheirLines) {
  for (const char* text :
       {"*HEADING\nA job\n*INCLUDE, INPUT=all.msh\n*INCLUDE, INPUT=load.sur\n*STEP\n*END STEP\n",
        "*include,input=\"all.msh\"\r\n* Include , Input = load.sur\r\n",
        "*INCLUDE, INPUT=all.msh\n**INCLUDE, INPUT=none\n*INCLUDE, INPUT=load.sur"}) {
    const Volume volume = read(text);
    EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}})) << text;
    EXPECT_EQ(volume.facets, (std::vector<Triangle>{{0, 2, 1}})) << text;
    EXPECT_EQ(volume.names.facets.size(), 1u) << text;
  }
}

TEST_F(InpInclude, FilesOfNodesAndElementsStandBehindTheirKeywords) {
  put(folder_ / "nodes.txt", "1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1");
  put(folder_ / "elements.txt", "1, 1, 2, 3, 4\n");
  for (const char* text : {"*NODE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4, INPUT=elements.txt\n",
                           "*Node, nset=all,\r\n Input = \"nodes.txt\"\r\n*Element,\r\ntype=C3D4,\r\n"
                           "input=elements.txt\r\n*STEP"}) {
    const Volume volume = read(text);
    EXPECT_EQ(volume.vertices.size(), 4u) << text;
    EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}})) << text;
  }
  put(folder_ / "bad.txt", "2, 1, 2, 3, 4\n3, 1, 2, 3, 9\n");
  EXPECT_EQ(error("*NODE, INPUT=nodes.txt\n*ELEMENT, TYPE=C3D4, INPUT=bad.txt\n"),
            "bad.txt: line 2: the node 9 does not exist");
  EXPECT_EQ(error("*NODE, INPUT=none.txt\n"), "none.txt: no such file");
}

TEST_F(InpInclude, ErrorsNameTheFileAndItsLine) {
  put(folder_ / "bad.inp", "** a comment\n*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 9\n");
  EXPECT_EQ(error("*INCLUDE, INPUT=all.msh\n*INCLUDE, INPUT=bad.inp\n"),
            "bad.inp: line 3: the node 9 does not exist");
  const std::string first = "*HEADING\n*INCLUDE, INPUT=all.msh\n";
  EXPECT_EQ(error(first + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 9\n"),
            "job.inp: line 4: the node 9 does not exist");
  EXPECT_EQ(error(first + "*SURFACE, NAME=s\n5, S1\n"), "job.inp: line 4: the element 5 does not exist");
  put(folder_ / "bad.sur", "*SURFACE, NAME=s\n5, S1\n");
  EXPECT_EQ(error(first + "*INCLUDE, INPUT=bad.sur\n*STEP\n*STATIC\n"),
            "bad.sur: line 2: the element 5 does not exist");
  EXPECT_EQ(error("*INCLUDE, INPUT=none.inp\n"), "none.inp: no such file");
  EXPECT_EQ(error("*HEADING\n*INCLUDE\n"), "job.inp: line 2: *INCLUDE without INPUT");
  EXPECT_EQ(error("*HEADING\n*INCLUDE, INPUT=job.inp\n"),
            "job.inp: line 2: too many files are included, or they include each other");
}

TEST_F(InpInclude, TheFilesBelongToIt) {
  put(folder_ / "job.inp", "*INCLUDE, INPUT=all.msh\n");
  EXPECT_EQ(files_of_surface(folder_ / "job.inp"),
            (std::vector{folder_ / "job.inp", folder_ / "all.msh", folder_ / "nodes.inp"}));
  EXPECT_EQ(files_of_volume(folder_ / "job.inp"),
            (std::vector{folder_ / "job.inp"}));  // which is written alone
  EXPECT_EQ(files_of_surface(folder_ / "none.inp"), (std::vector{folder_ / "none.inp"}));
}

}  // namespace
}  // namespace holdfast::io_inp_include_test
