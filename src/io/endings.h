// Other endings of the same formats.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace holdfast::io {

/// The ending by which the tables name a format: ".xdmf" for ".xmf". Endings are in lower case, with a dot.
[[nodiscard]] inline std::string usual_ending(std::string ending) {
  struct Other {
    std::string_view ending, usual;
  };
  // clang-format off
  static constexpr Other kOthers[] = {
      {".xmf", ".xdmf"},   {".vrml", ".wrl"}, {".x3dz", ".x3d"},  {".e", ".exo"}, {".ex2", ".exo"},
      {".g", ".exo"},      {".gen", ".exo"},  {".exoii", ".exo"}, {".key", ".k"}, {".dyn", ".k"},
      {".dolfin", ".xml"}, {".acc", ".ac"},   {".x3dv", ".x3d"},
      {".pial", ".freesurfer"},     {".white", ".freesurfer"},  {".inflated", ".freesurfer"},
      {".smoothwm", ".freesurfer"}, {".sphere", ".freesurfer"}, {".orig", ".freesurfer"}};
  // clang-format on
  const auto found = std::find_if(std::begin(kOthers), std::end(kOthers),
                                  [&](const Other& o) { return o.ending == ending; });
  return found == std::end(kOthers) ? ending : std::string(found->usual);
}

}  // namespace holdfast::io
