// Files of other programs with Gmsh's extension .msh.
#pragma once

#include <string>
#include <string_view>

namespace holdfast::io {

/// Whether the file is one of Abaqus or CalculiX, whose cgx writes "all.msh": it starts with a keyword or a
/// comment.
[[nodiscard]] bool is_inp(std::string_view bytes);

/// Why a file whose first word is not a section is not a Gmsh mesh.
[[nodiscard]] std::string why_no_gmsh_mesh(std::string_view first_word);

}  // namespace holdfast::io
