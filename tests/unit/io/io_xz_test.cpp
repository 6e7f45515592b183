// Streams of .xz, and VTK files compressed by LZMA.
#include <gtest/gtest.h>

#include <random>

#include "io/xz_block.h"
#include "io_volumes.h"

namespace holdfast::io_xz_test {
namespace {

using namespace samples;

/// What the stream holds, or "damaged".
std::string unpacked(const std::string& stream, std::size_t size) {
  std::string bytes = "before";
  if (!io::append_xz(bytes, stream, size)) return "damaged";
  EXPECT_EQ(bytes.substr(0, 6), "before");
  return bytes.substr(6);
}

/// By liblzma 5.4: literals, matches, matches at the last distance and at earlier ones.
const std::string kStream(
    "\xfd\x37\x7a\x58\x5a\x00\x00\x01\x69\x22\xde\x36\x02\x00\x21\x01\x16\x00\x00\x00\x74\x2f\xe5\xa3\xe0\x02"
    "\x07\x00"
    "\x48\x5d\x00\x30\x98\x88\xe2\x52\xfe\x3d\xec\x62\xfc\x08\x9a\x0a\x0c\xe2\x87\x6c\x7a\xb0\x45\x70\xe2\xff"
    "\x95\x39"
    "\x6b\x90\x59\x0e\x1a\x62\xef\xc5\x92\x64\xe8\x91\x40\x25\x5a\xb5\x4b\x83\xda\xc4\x76\x4c\x99\x26\x98\x40"
    "\xcf\x5a"
    "\xf7\x16\xbc\x55\xd5\x8e\x33\x73\x47\x3a\x85\xcf\xc6\x1a\xac\xb1\xfb\x34\x00\x00\x66\x3f\x26\xa9\x00\x01"
    "\x60\x88"
    "\x04\x00\x00\x00\x83\xb7\x55\xc5\x3e\x30\x0d\x8b\x02\x00\x00\x00\x00\x01\x59\x5a",
    132);

std::string what_it_holds() {
  std::string text;
  for (int i = 0; i < 40; ++i) text += static_cast<char>(i * i % 7 + 97);
  for (int i = 0; i < 12; ++i) text += "hold fast, hold fast, hold fast!";
  for (int i = 0; i < 12; ++i) {
    const double value = i / 3.0;
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return text;
}

/// 100,000 zeros, without a checksum: as many bytes as one may have.
const std::string kZeros(
    "\xfd\x37\x7a\x58\x5a\x00\x00\x00\xff\x12\xd9\x41\x02\x00\x21\x01\x16\x00\x00\x00\x74\x2f\xe5\xa3\xe1\x86"
    "\x9f\x00"
    "\x53\x5d\x00\x00\x6f\xfd\xff\xff\xa3\xb7\xff\x47\x3e\x48\x15\x72\x39\x61\x51\xb8\x92\x28\xe6\xa3\x86\x07"
    "\xf9\xee"
    "\xe4\x1e\x82\xd3\x2f\xc5\x3a\x3c\x01\x4b\xb1\x7e\xc9\x8a\x8a\x4d\x2f\xa3\x0d\xd9\x7f\xa6\xe3\x8c\x23\x11"
    "\x53\xe0"
    "\x59\x18\xc5\x75\x8a\xe2\x77\xf8\xb6\x94\x7f\x0c\x6a\xc0\xde\x74\x49\x64\xe2\xe9\x5c\x53\xb2\x04\xd6\xb1"
    "\xf5\x97"
    "\x00\x00\x00\x00\x00\x01\x67\xa0\x8d\x06\x00\x00\xfd\x66\x3d\xbd\xa8\x00\x0a\xfc\x02\x00\x00\x00\x00\x00"
    "\x59\x5a",
    140);

TEST(Xz, LiteralsAndMatches) {
  if (!io::has_xz()) GTEST_SKIP() << "without liblzma";
  EXPECT_EQ(unpacked(kStream, 520), what_it_holds());
  EXPECT_EQ(unpacked(kZeros, 100000), std::string(100000, '\0'));
}

TEST(Xz, DamagedStreams) {
  if (!io::has_xz()) GTEST_SKIP() << "without liblzma";
  EXPECT_EQ(unpacked(kStream, 519), "damaged");
  EXPECT_EQ(unpacked(kStream, 521), "damaged");
  for (std::size_t size = 0; size < kStream.size(); ++size)
    EXPECT_EQ(unpacked(kStream.substr(0, size), 520), "damaged") << size;
  std::string wrong = kStream;
  wrong[60] = static_cast<char>(wrong[60] ^ 1);
  EXPECT_EQ(unpacked(wrong, 520), "damaged");
}

TEST(Xz, ArbitraryBytesDoNoHarm) {
  if (!io::has_xz()) GTEST_SKIP() << "without liblzma";
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string stream = k % 4 == 0 ? kZeros : kStream;
    for (std::size_t i = random() % 4 + 1; i > 0; --i)
      stream[k % 2 == 0 ? random() % stream.size() : 12 + random() % 40] = static_cast<char>(random());
    if (random() % 4 == 0) stream.resize(random() % stream.size());
    std::string bytes;
    const std::size_t size = random() % 600;
    const bool whole = io::append_xz(bytes, stream, size);
    EXPECT_TRUE(!whole || bytes.size() == size);
    EXPECT_LE(bytes.size(), size);
  }
}

TEST(Xz, PacksArraysOfVtu) {
  if (!io::has_xz()) GTEST_SKIP() << "without liblzma";
  const std::string packed =
      "AQAAAAwAAAAAAAAAQAAAAA==/"
      "Td6WFoAAAFpIt42AgAhARYAAAB0L+WjAQALBAAAAAcAAAAJAAAAAIO7Hg8AASAMot20vJBCmQ0BAAAAAAFZWg==";
  const std::string text = replaced(replaced(kVtu, "Name=\"offsets\" format=\"ascii\">4 7 9",
                                             "Name=\"offsets\" format=\"binary\">\n" + packed + "\n"),
                                    "byte_order", "compressor=\"vtkLZMADataCompressor\" byte_order");
  EXPECT_EQ(volume(text, "a.vtu").segments, (std::vector<Segment>{{0, 1}}));
  EXPECT_NE(error(replaced(text, "/Td6WFo", "/Te6WFo"), "a.vtu")
                .find("a block that cannot be decompressed; the file is damaged"),
            std::string::npos);
}

}  // namespace
}  // namespace holdfast::io_xz_test
