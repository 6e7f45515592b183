#include "mesh_input.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>

#include "any_mesh.h"
#include "command.h"
#include "defects.h"
#include "files.h"
#include "holdfast/patches.h"
#include "holdfast/surface_io.h"
#include "limits.h"
#include "name_options.h"
#include "paste_options.h"
#include "paste_result.h"
#include "summary.h"
#include "unused_vertices.h"

namespace holdfast::cli {

MeshInput read_input(const MeshArguments& arguments, const Options& options) {
  MeshInput input;
  input.parts = read_parts(arguments.surfaces, reading(options, arguments.input_format, arguments.tolerance),
                           arguments.surface_of);
  if (input.parts.size() > 1) {
    input.surface = join(input.parts, stems(arguments.surfaces));
    return input;
  }
  input.surface = std::move(input.parts.front());
  input.parts.clear();
  return input;
}

void paste_parts(const MeshArguments& arguments, const Options& options, MeshInput& input) {
  if (input.parts.empty() && !arguments.paste) return;
  PasteOptions pasting;
  static_cast<Limits&>(pasting) = options;
  pasting.cut = arguments.paste.has_value();
  if (pasting.cut && !arguments.paste->empty()) pasting.tolerance = tolerance_of(*arguments.paste, "--paste");
  pasting.overlap = overlap_named(arguments.overlap);
  pasting.judge = false;
  pasting.labels = labels_of(arguments.surfaces);
  pasting.threads = options.threads;
  pasting.progress = goes_on;
  PasteResult pasted = input.parts.empty() ? paste_components(input.surface, pasting)
                                           : paste(input.parts, pasting, stems(arguments.surfaces));
  if (!pasting.cut && !arguments.overlap && pasted.shared_facets == 0) return;
  merge(pasted.surface.names, names_of(arguments.names));
  input.pasted = std::move(pasted);
}

void tell_defects_of_files(const MeshArguments& arguments, const MeshInput& input, Result& result) {
  if (!input.pasted || result.outcome != Outcome::invalid_input || is_valid(result.defects)) return;
  if (arguments.paste) return;
  const std::vector<Index>& part = input.pasted->part_of_facet;
  result.defects = diagnose(input.surface.view());
  std::erase_if(result.defects, [&](const Defect& defect) {
    return defect.kind == DefectKind::repeated_facet && defect.facets.size() == 2 &&
           part[defect.facets[0]] != part[defect.facets[1]];
  });
}

bool may_need_surface_of(const MeshArguments& arguments) {
  return !arguments.surface_of && std::any_of(arguments.surfaces.begin(), arguments.surfaces.end(),
                                              [&](const std::filesystem::path& path) {
                                                return may_be_volume(path, arguments.input_format);
                                              });
}

void split_by_angle(const MeshArguments& arguments, Surface& surface) {
  const std::size_t patches = markers_by_angle(surface, *arguments.markers_by_angle);
  if (patches == 0)
    throw UsageError("--markers-by-angle does nothing: every triangle of the surface has a marker already");
  if (!arguments.quiet) say("holdfast: {} by angle\n", counted(patches, "smooth patch", "smooth patches"));
}

void tell_of_lone_vertices(const MeshArguments& arguments, const Surface& surface, ProgressView& progress) {
  const std::size_t lone = arguments.drop_unused ? 0 : isolated_vertices(surface);
  if (lone == 0) return;
  progress.finish();
  say("holdfast: {} in {} on no triangle and no segment {} as the mesh's, too{}\n",
      counted(lone, "vertex", "vertices"),
      arguments.surfaces.size() == 1 ? arguments.surfaces[0].string() : "the files",
      lone == 1 ? "is kept" : "are kept",
      may_need_surface_of(arguments) ? "; --surface-of takes the surface of a volume alone"
                                     : "; --drop-unused leaves out all such");
}

void tell_unused_sizes(const MeshArguments& arguments, const Surface& surface) {
  const auto sizes = std::count_if(surface.regions.begin(), surface.regions.end(),
                                   [](const RegionSeed& seed) { return seed.size > 0; });
  if (arguments.fill && !arguments.quiet && sizes > 0)
    fmt::print(stderr, "holdfast: with --fill the sizes of {} in the file are unused\n",
               counted(static_cast<std::size_t>(sizes), "region"));
}

void tell_field_elsewhere(const MeshArguments& arguments, const Extent& field, const Surface& surface) {
  const Extent extent = extent_of(surface.vertices);
  const bool goes_further = arguments.keep && arguments.keep->starts_with("box");
  if (arguments.quiet || goes_further || field.meets(extent)) return;
  say("holdfast: warning: the sizes of {} have no effect: its mesh lies in {}, and the surface in {}\n",
      arguments.size_field.string(), words_for(field), words_for(extent));
}

void require_a_size_a_vertex(const MeshArguments& arguments, const Options& options, const Surface& surface) {
  if (!options.sizes || options.sizes->vertex_sizes.empty()) return;
  const std::size_t sizes = options.sizes->vertex_sizes.size();
  if (sizes != surface.vertices.size())
    throw FileError(arguments.size_field, "",
                    fmt::format("there are {} for {} of the surface", counted(sizes, "size"),
                                counted(surface.vertices.size(), "vertex", "vertices")));
}

}  // namespace holdfast::cli
