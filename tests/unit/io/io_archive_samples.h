// ZIP archives for tests, and small 3MF and AMF files.
#pragma once

#include <zlib.h>

#include <string>
#include <utility>
#include <vector>

#include "io_samples.h"

namespace holdfast::samples {

enum class Packing { stored, deflated, wide };  ///< wide: deflated, with sizes and offsets in 64 bits

inline std::string deflated(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()) + 64, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// An archive of files: names and contents (PKWARE's specification, sections 4.3.7, 4.3.12 and 4.3.16).
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files,
                       Packing packing = Packing::deflated) {
  const auto u16 = [](std::size_t x) { return raw(static_cast<std::uint16_t>(x)); };
  const auto u32 = [](std::size_t x) { return raw(static_cast<std::uint32_t>(x)); };
  const auto u64 = [](std::size_t x) { return raw(static_cast<std::uint64_t>(x)); };
  const bool wide = packing == Packing::wide;
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    const std::string packed = packing == Packing::stored ? content : deflated(content);
    const auto* const data = reinterpret_cast<const Bytef*>(content.data());
    const std::string extra =
        wide ? u16(1) + u16(24) + u64(content.size()) + u64(packed.size()) + u64(archive.size()) : "";
    const std::string head = u16(45) + u16(0) + u16(packing == Packing::stored ? 0 : 8) + u32(0) +
                             u32(crc32(0, data, static_cast<uInt>(content.size())));
    const std::string sizes = u32(packed.size()) + u32(content.size());
    directory += "PK\x01\x02" + u16(45) + head + (wide ? u32(0xFFFFFFFF) + u32(0xFFFFFFFF) : sizes) +
                 u16(name.size()) + u16(extra.size()) + u16(0) + u16(0) + u16(0) + u32(0) +
                 u32(wide ? 0xFFFFFFFF : archive.size()) + name + extra;
    archive += "PK\x03\x04" + head + sizes + u16(name.size()) + u16(0) + name + packed;
  }
  const std::size_t begin = archive.size();
  std::string end;
  if (wide)
    end = "PK\x06\x06" + u64(44) + u16(45) + u16(45) + u32(0) + u32(0) + u64(files.size()) +
          u64(files.size()) + u64(directory.size()) + u64(begin) + "PK\x06\x07" + u32(0) +
          u64(begin + directory.size()) + u32(1);
  return archive + directory + end + "PK\x05\x06" + u16(0) + u16(0) + u16(wide ? 0xFFFF : files.size()) +
         u16(wide ? 0xFFFF : files.size()) + u32(directory.size()) + u32(wide ? 0xFFFFFFFF : begin) + u16(0);
}

inline const std::string kTetrahedronOf3mf =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" "
    "y=\"1\" "
    "z=\"0\" /><vertex x=\"0\" y=\"0\" z=\"1e0\"></vertex></vertices>\n<triangles><triangle v1=\"0\" "
    "v2=\"2\" "
    "v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>\n<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle "
    "v1=\"0\" "
    "v2=\"3\" v3=\"2\"/></triangles></mesh>";

/// A model of these resources and this build.
inline std::string model_3mf(const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\"?>\n<model unit=\"millimeter\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<!-- a < b "
         "-->\n<resources>\n" +
         resources + "\n</resources>\n<build>" + build + "</build>\n</model>\n";
}

inline std::string package_3mf(const std::string& model, Packing packing = Packing::deflated) {
  const std::string relations =
      "<Relationships><Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  return zip({{"_rels/.rels", relations}, {"3D/3dmodel.model", model}}, packing);
}

inline std::string small_3mf(Packing packing = Packing::deflated) {
  return package_3mf(model_3mf("<object id=\"7\" name=\"corner\">" + kTetrahedronOf3mf + "</object>",
                               "<item objectid=\"7\"/>"),
                     packing);
}

/// The vertices of the same tetrahedron, and triangles of it: runs of three digits.
inline std::string amf_vertices() {
  std::string text;
  for (const char* p : {"000", "100", "010", "001"})
    text += std::string("<vertex><coordinates><x>") + p[0] + "</x>\n<y>" + p[1] + "</y><z> " + p[2] +
            " </z></coordinates></vertex>\n";
  return "<vertices>" + text + "</vertices>";
}
inline std::string amf_triangles(const std::vector<std::string>& triangles) {
  std::string text;
  for (const std::string& t : triangles)
    text +=
        std::string("<triangle><v1>") + t[0] + "</v1><v2>" + t[1] + "</v2><v3>" + t[2] + "</v3></triangle>\n";
  return text;
}
inline const std::string kSmallAmf =
    "<?xml version=\"1.0\"?><amf unit=\"millimeter\"><object id=\"a\"><metadata "
    "type=\"name\">corner</metadata>"
    "<mesh>" +
    amf_vertices() + "<volume>" + amf_triangles({"021", "013", "123", "032"}) +
    "</volume></mesh></object></amf>\n";

}  // namespace holdfast::samples
