// Files of other programs that end in .msh, as Gmsh's do.
#pragma once

#include <string>
#include <string_view>

namespace holdfast::io {

/// Whether they are those of Abaqus and CalculiX, whose cgx writes "all.msh": a keyword or a comment comes
/// first.
[[nodiscard]] bool is_inp(std::string_view bytes);

/// Why a file whose first word is no section is no mesh of Gmsh.
[[nodiscard]] std::string why_no_gmsh_mesh(std::string_view first_word);

}  // namespace holdfast::io
