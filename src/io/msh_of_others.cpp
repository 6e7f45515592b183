#include "io/msh_of_others.h"

namespace holdfast::io {

bool is_inp(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && bytes[start] == '*';
}

std::string why_no_gmsh_mesh(std::string_view first_word) {
  if (!first_word.empty() && first_word.find_first_not_of("0123456789") == std::string_view::npos)
    return "a mesh of FreeFEM, not of Gmsh; save it as .mesh";
  return "not a Gmsh mesh: it does not start with $MeshFormat";
}

}  // namespace holdfast::io
