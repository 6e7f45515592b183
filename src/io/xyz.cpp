// Plain points, .xyz: three numbers per line, separated by blanks or commas; the rest of a line is ignored.
#include <algorithm>
#include <string>

#include "io/formats.h"
#include "io/text_reader.h"

namespace holdfast::io {

MeshData read_xyz(const Source& source) {
  std::string plain(source.bytes);
  std::replace(plain.begin(), plain.end(), ',', ' ');
  TextReader text({source.path, plain});
  MeshData mesh;
  while (!text.at_end()) {
    Point point{};
    for (double& x : point) {
      if (text.at_line_end()) text.fail("three coordinates are expected");
      x = text.real("a coordinate");
    }
    mesh.vertices.push_back(point);
    text.skip_line();
  }
  return mesh;
}

}  // namespace holdfast::io
