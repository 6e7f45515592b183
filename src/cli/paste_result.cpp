#include "paste_result.h"

#include <fmt/core.h>

#include "command.h"
#include "summary.h"

namespace holdfast::cli {

void tell(const PasteResult& result, const std::filesystem::path& output) {
  for (const PartApart& apart : result.apart)
    say("holdfast: {} and {} do not touch: they are {:.6g} apart\n", result.parts[apart.part].name,
        result.parts[apart.nearest].name, apart.distance);
  say("{}: {}, {} ({} of several files, {} cut or joined), {} moved; at most {:.3g} from the input, {:.2f} "
      "s\n",
      output.string(), counted(result.surface.vertices.size(), "vertex", "vertices"),
      counted(result.surface.facets.size(), "triangle"), result.shared_facets, result.report.changed_facets,
      result.moved.size(), result.max_displacement, result.report.seconds.at("total"));
}

}  // namespace holdfast::cli
