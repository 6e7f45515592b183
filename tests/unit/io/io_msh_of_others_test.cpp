// Files of other programs that end in .msh.
#include <gtest/gtest.h>

#include "io_volumes.h"

namespace holdfast::io_msh_of_others_test {
namespace {

using namespace samples;

/// As CalculiX's cgx writes "all.msh".
TEST(Msh, OfCalculixIsReadAsInp) {
  for (const char* before : {"", "** Names based on all\n", "\n \n"})
    EXPECT_EQ(
        volume(std::string(before) + "*NODE, NSET=Nall\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
                                     "*ELEMENT, TYPE=C3D4, ELSET=Eall\n1, 1, 2, 3, 4\n",
               "all.msh")
            .tetrahedra,
        (std::vector<Tetrahedron>{{0, 1, 2, 3}}))
        << before;
}

TEST(Msh, FilesOfOthersWithItsEnding) {
  EXPECT_EQ(error("(1 \"TGrid 2D\")\n(2 2)\n", "a.msh"),
            "line 2: a mesh of 2 dimensions; only those of 3 are read");
  EXPECT_EQ(error(" 112 184 40\n 4.0 0.8 1\n", "a.msh"),
            "line 1: a mesh of FreeFEM, not of Gmsh; save it as .mesh");
  EXPECT_EQ(error("hello\n", "a.msh"), "line 1: not a Gmsh mesh: it does not start with $MeshFormat");
}

}  // namespace
}  // namespace holdfast::io_msh_of_others_test
