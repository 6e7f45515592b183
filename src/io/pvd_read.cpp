// Reads ParaView's .pvd, a list of the files of each time step (legacy DOLFIN and many others write one
// beside their .vtu): the parts of the first step (https://www.paraview.org/Wiki/ParaView/Data_formats, "PVD
// File Format").
#include <numeric>
#include <set>
#include <system_error>
#include <utility>

#include "io/file_bytes.h"
#include "io/formats.h"
#include "io/named_files.h"
#include "io/text_reader.h"
#include "io/vtu_block.h"
#include "io/xml_reader.h"

namespace holdfast::io {
namespace {

namespace fs = std::filesystem;

using DataSetReader = MeshData (*)(const Source&);

/// The formats of parts.
struct PartFormat {
  std::string_view ending;
  DataSetReader read;
};
constexpr PartFormat kParts[] = {{".vtu", read_vtu},   {".vtp", read_vtu}, {".pvtu", read_pvtu},
                                 {".pvtp", read_pvtu}, {".vtm", read_vtm}, {".vtk", read_vtk}};

struct NamedPart {
  XmlTag tag;
  fs::path path;
  DataSetReader read;
};

struct FirstStep {
  std::vector<NamedPart> parts;
  std::size_t later = 0;  ///< files of later steps
};

FirstStep first_step(const Source& source, XmlReader& xml) {
  FirstStep step;
  std::optional<std::string> time;
  std::set<fs::path> seen;
  bool is_index = false;
  while (std::optional<XmlTag> tag = xml.next()) {
    if (tag->closing) continue;
    if (tag->name == "VTKFile") is_index = tag->attribute("type") == "Collection";
    if (tag->name != "DataSet" || !is_index) continue;
    const std::string name = unescaped(tag->attribute("file")), now = tag->attribute("timestep");
    if (name.empty()) xml.fail(*tag, "the data set names no file");
    if (time && now != *time) {
      ++step.later;
      continue;
    }
    time = now;
    const fs::path path = source.path.parent_path() / name;
    if (!seen.insert(path.lexically_normal()).second)
      xml.fail(*tag, "the file " + in_quotes(name) + " is named twice");
    const std::string ending = lower(without_gz(path).extension().string());
    DataSetReader read = nullptr;
    for (const PartFormat& format : kParts)
      if (format.ending == ending) read = format.read;
    if (read == nullptr)
      xml.fail(*tag, "a part in the format " + in_quotes(ending) +
                         " is not read; .vtu, .vtp, .pvtu, .pvtp, .vtm and .vtk are");
    step.parts.push_back({*std::move(tag), path, read});
  }
  if (!is_index)
    throw FileError(source.path, "", "not a ParaView collection: it has no VTKFile of this type");
  if (step.parts.empty()) throw FileError(source.path, "", "the file names no parts");
  return step;
}

/// Adds a part whose vertices are numbered after those of the others.
void add_part(MeshData& mesh, MeshData&& part, const XmlReader& xml, const XmlTag& tag) {
  std::vector<Index> number(part.vertices.size());
  if (number.size() > no_entity - mesh.vertices.size()) xml.fail(tag, "more points than 32 bits count");
  std::iota(number.begin(), number.end(), static_cast<Index>(mesh.vertices.size()));
  const std::vector<int> markers = part.vertex_markers.take(number.size());
  for (std::size_t i = 0; i < number.size(); ++i) mesh.add_vertex(part.vertices[i], tag_of(markers, i));
  append(mesh, std::move(part), number);
}

}  // namespace

MeshData read_pvd(const Source& source) {
  XmlReader xml(source);
  const FirstStep step = first_step(source, xml);
  MeshData mesh(source);
  for (const NamedPart& part : step.parts) {
    std::error_code error;
    if (!fs::is_regular_file(part.path, error))
      xml.fail(part.tag, "the part " + in_quotes(part.path.string()) +
                             (fs::exists(part.path, error) ? " is no file" : ": there is no such file"));
    const FileBytes bytes(part.path, source.watch);
    MeshData read = part.read({part.path, bytes.view(), source.finite, source.watch, source.tolerance});
    if (step.parts.size() == 1)
      mesh = std::move(read);
    else
      add_part(mesh, std::move(read), xml, part.tag);
  }
  mesh.leave_out(step.later, "files of later time steps", "file of a later time step");
  return mesh;
}

std::vector<fs::path> pvd_files(const fs::path& path) {
  return with_named_files(path, [](const Source& source) {
    XmlReader xml(source);
    std::vector<fs::path> files;
    for (const NamedPart& part : first_step(source, xml).parts)
      for (fs::path& file : files_of_volume(part.path)) files.push_back(std::move(file));
    return files;
  });
}

}  // namespace holdfast::io
