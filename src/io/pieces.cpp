// The public functions of holdfast/partition.h that write: formats by extension.
#include "io/pieces.h"

#include <algorithm>

#include "io/foam_mesh.h"
#include "io/formats.h"
#include "io/text_reader.h"
#include "numbers/float_environment.h"
#include "text/decimal.h"

namespace holdfast {
namespace io {
namespace {

struct PieceFormat {
  std::string_view extension;
  void (*write)(const std::filesystem::path&, std::size_t, const PieceLoader&, const WriteOptions&, Watch&);
};

constexpr PieceFormat kPieceFormats[] = {{".pvtu", write_pvtu},
                                         {".msh", write_msh_pieces},
                                         {".xdmf", write_xdmf_pieces},
                                         {".openfoam", write_processors}};

}  // namespace
}  // namespace io

std::vector<std::string> piece_formats() {
  std::vector<std::string> extensions;
  for (const io::PieceFormat& format : io::kPieceFormats) extensions.emplace_back(format.extension);
  return extensions;
}

std::vector<std::filesystem::path> files_of_pieces(const std::filesystem::path& path, std::size_t parts,
                                                   std::string_view format) {
  const std::string extension = volume_format_of(path, format);
  std::vector<std::filesystem::path> files;
  if (extension == ".pvtu") {
    files = {path, io::surface_beside(path)};
    for (std::size_t k = 0; k < parts; ++k) {
      const std::filesystem::path piece = io::pvtu_piece(path, k);
      files.push_back(piece);
      files.push_back(io::surface_beside(piece));
    }
  } else if (extension == ".openfoam") {
    for (std::size_t k = 0; k < parts; ++k)
      for (auto& file : io::files_of_poly_mesh(io::processor_mesh(path, k))) files.push_back(std::move(file));
  } else {
    files = files_of_volume(path, extension);
  }
  return files;
}

void write_pieces(const std::filesystem::path& path, std::size_t parts, const PieceLoader& load,
                  const WriteOptions& options) {
  const FloatEnvironment environment;
  const std::string extension = volume_format_of(path, options.format);
  const auto format = std::find_if(std::begin(io::kPieceFormats), std::end(io::kPieceFormats),
                                   [&](const io::PieceFormat& f) { return f.extension == extension; });
  if (format == std::end(io::kPieceFormats))
    throw FileError(path, "", "the format " + io::in_quotes(extension) + " is not written in pieces");
  io::Watch watch(options, options.progress);
  format->write(path, parts, load, options, watch);
  watch.finish_written();
}

}  // namespace holdfast
