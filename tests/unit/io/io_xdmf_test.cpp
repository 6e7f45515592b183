// XDMF with values in raw files.
#include <gtest/gtest.h>

#include "io/byte_reader.h"
#include "io_samples.h"

namespace holdfast::io_xdmf_test {
namespace {

using namespace samples;

template <typename T>
std::string raw_values(std::initializer_list<T> values, std::endian order = std::endian::little) {
  std::string bytes;
  for (const T value : values) io::store(bytes, value, order);
  return bytes;
}

class XdmfRaw : public ::testing::Test {
 protected:
  XdmfRaw() {
    // As meshio writes them, each array in a file of its own.
    put(folder_ / "points.bin", raw_values<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
    put(folder_ / "cells.bin", raw_values<std::uint32_t>({0, 1, 2, 3}));
    put(folder_ / "region.bin", raw_values<std::int32_t>({7}));
  }

  static std::string item(const std::string& attributes, const std::string& file) {
    return "<DataItem " + attributes + " Format=\"Binary\">" + file + "</DataItem>";
  }
  static std::string points(const std::string& attributes = "DataType=\"Float\" Precision=\"8\"",
                            const std::string& file = "points.bin") {
    return item("Dimensions=\"4 3\" " + attributes, file);
  }
  static std::string cells(const std::string& attributes = "DataType=\"UInt\" Precision=\"4\"",
                           const std::string& file = "cells.bin") {
    return item("Dimensions=\"1 4\" " + attributes, file);
  }
  Volume read(const std::string& points, const std::string& cells) const {
    put(folder_ / "a.xdmf",
        "<Xdmf Version=\"3.0\"><Domain><Grid Name=\"Grid\">\n<Geometry GeometryType=\"XYZ\">" + points +
            "</Geometry>\n<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"1\">" + cells +
            "</Topology>\n<Attribute Name=\"region\" AttributeType=\"Scalar\" Center=\"Cell\">" +
            item("DataType=\"Int\" Dimensions=\"1\" Precision=\"4\"", "region.bin") +
            "</Attribute>\n</Grid></Domain></Xdmf>");
    return read_volume(folder_ / "a.xdmf");
  }
  std::string error(const std::string& points, const std::string& cells) const {
    try {
      static_cast<void>(read(points, cells));
    } catch (const FileError& e) {
      return replaced(e.what(), (folder_ / "").string(), "");
    }
    return "read";
  }
  static void expect_tetrahedron(const Volume& volume) {
    EXPECT_EQ(volume.vertices, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(volume.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
    EXPECT_EQ(volume.regions, (std::vector<int>{7}));
  }

  const TemporaryFolder folder_;
};

TEST_F(XdmfRaw, OfMeshio) {
  expect_tetrahedron(read(points(), cells()));
  // It writes names of files in the form in which its own was given.
  expect_tetrahedron(read(points("DataType=\"Float\" Precision=\"8\"", (folder_ / "points.bin").string()),
                          "\n  " + cells()));
}

TEST_F(XdmfRaw, OfOtherTypesPlacesAndByteOrders) {
  put(folder_ / "both.bin", "head" +
                                raw_values<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, std::endian::big) +
                                raw_values<std::int16_t>({0, 1, 2, 3}, std::endian::big) + "tail");
  expect_tetrahedron(
      read(points("NumberType=\"Float\" Endian=\"Big\" Seek=\"4\" Compression=\"Raw\"", "both.bin"),
           cells("NumberType=\"Int\" Precision=\"2\" Endian=\"Big\" Seek=\"52\"", " both.bin\n")));
  put(folder_ / "small.bin", raw_values<std::uint8_t>({0, 1, 2, 3}));
  expect_tetrahedron(read(points(), cells("NumberType=\"UChar\"", "small.bin")));
}

TEST_F(XdmfRaw, ErrorsNameTheFileAndThePlace) {
  EXPECT_EQ(error(points("DataType=\"Float\" Precision=\"8\"", "none.bin"), cells()),
            "none.bin: no such file");
  EXPECT_EQ(error(points("DataType=\"Float\" Precision=\"8\"", " "), cells()),
            "a.xdmf: line 2: the item names no file");
  EXPECT_EQ(error(points("DataType=\"Float\" Precision=\"8\" Seek=\"1\""), cells()),
            "points.bin: has 96 bytes, too few for 12 values of 8 bytes from byte 1 on");
  EXPECT_EQ(error(points("DataType=\"Float\" Precision=\"8\" Seek=\"97\""), cells()),
            "points.bin: has 96 bytes, too few for 12 values of 8 bytes from byte 97 on");
  EXPECT_EQ(error(points(), cells("DataType=\"Int\" Precision=\"3\"")),
            "a.xdmf: line 3: values of the type 'int' of 3 bytes are not read");
  EXPECT_EQ(error(points(), cells("DataType=\"Int\" Precision=\"4\" Compression=\"Zlib\"")),
            "a.xdmf: line 3: values packed by 'zlib' are not read");
}

}  // namespace
}  // namespace holdfast::io_xdmf_test
