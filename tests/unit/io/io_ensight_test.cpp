// EnSight Gold: a case and its geometry file.
#include <gtest/gtest.h>

#include "ensight_samples.h"
#include "io_volumes.h"

namespace holdfast::io_ensight_test {
namespace {

using namespace samples;

Volume read(const std::string& geometry, std::vector<Remark>* remarks = nullptr,
            const std::string& text = kEnsightCase) {
  const TemporaryFolder folder;
  put(folder / "a.case", text);
  put(folder / "a.geo", geometry);
  return read_volume(folder / "a.case", ReadOptions{}, remarks);
}
std::string error(const std::string& geometry, const std::string& text = kEnsightCase) {
  return refusal_of([&] { return read(geometry, nullptr, text); });
}

TEST(Ensight, PartsAreRegionsAndMarkers) {
  std::vector<Remark> remarks;
  const Volume found = read(kEnsightGeo, &remarks);
  EXPECT_EQ(found.vertices.size(), 5U);
  EXPECT_EQ(found.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 2, 1, 4}}));
  EXPECT_EQ(found.regions, (std::vector<int>{3, 7}));
  EXPECT_EQ(found.names.regions, (std::map<int, std::string>{{3, "upper"}, {7, "lower"}}));
  EXPECT_EQ(found.facets, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(found.facet_markers, (std::vector<int>{9}));
  ASSERT_EQ(remarks.size(), 3U);
  EXPECT_EQ(remarks[0].message, "6 nodes of parts are joined to one at the same place");
  EXPECT_EQ(remarks[1].message, "1 ghost cell is left out");
}

TEST(Ensight, BinaryInBothByteOrders) {
  for (const bool big : {false, true}) {
    const Volume found = read(binary_ensight(big));
    EXPECT_EQ(found.tetrahedra.size(), 6U);
    EXPECT_EQ(found.facets, (std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}}));
    EXPECT_EQ(found.names.facets, (std::map<int, std::string>{{2, "all"}}));
  }
}

TEST(Ensight, TheFileOfTheFirstStep) {
  const TemporaryFolder folder;
  put(folder / "b.case",
      "FORMAT\ntype:  ensight gold\nGEOMETRY\nmodel: 1 \"b.***.geo\"\nTIME\ntime set: 1\nnumber of steps: 2\n"
      "filename start number: 5\nfilename increment: 1\n");
  put(folder / "b.005.geo", kEnsightGeo);
  EXPECT_EQ(read_volume(folder / "b.case").tetrahedra.size(), 2U);
  EXPECT_EQ(files_of_volume(folder / "b.case").size(), 2U);
  EXPECT_EQ(files_of_surface(folder / "b.case")[1].filename(), "b.005.geo");
}

TEST(Ensight, ErrorsNameTheLine) {
  const auto with = [](std::string_view old, const std::string& replacement) {
    std::string text = kEnsightGeo;
    text.replace(text.find(old), old.size(), replacement);
    return error(text);
  };
  EXPECT_EQ(error(kEnsightGeo, "FORMAT\ntype: ensight\nGEOMETRY\nmodel: a.geo\n"),
            "line 2: a case of EnSight 6 or 5; only EnSight Gold is read");
  EXPECT_EQ(error(kEnsightGeo, "(2 3)\n"), "the case names no geometry (model: FILE); is it one of EnSight?");
  EXPECT_EQ(error("Fortran Binary  "), "in Fortran's binary; save it in C's binary or as text");
  EXPECT_EQ(with("node id given", "nodes"), "line 3: expected 'node id', found 'nodes'");
  EXPECT_EQ(with("coordinates", "block"),
            "line 12: parts with 'block' are not read; save them as unstructured");
  EXPECT_EQ(with("tetra4", "nfaced"), "line 30: elements of the type 'nfaced' are not read");
  EXPECT_EQ(with("         4\n 10", "4000000000\n 10").substr(0, 8), "line 13:");
  EXPECT_EQ(with("         1         2         3         4", " 1 2 3 5"),
            "line 32: names node 5, but the part has 4");
  EXPECT_EQ(error(kEnsightGeo.substr(0, kEnsightGeo.find("tetra4") + 7)),
            "line 31: the file ends where the number of elements is expected; it is truncated");
  const std::string bytes = binary_ensight(false);
  EXPECT_EQ(error(bytes.substr(0, bytes.size() - 2)),
            "byte 952: a number of corners is 4, but only 14 bytes follow; the file is truncated or damaged");
}

}  // namespace
}  // namespace holdfast::io_ensight_test
