#include "mesh_refusal.h"

#include <algorithm>
#include <vector>

#include "command.h"
#include "defects.h"
#include "mesh_input.h"
#include "paste_result.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

/// Facets whose borders do not meet may enclose nothing or lie outside.
bool is_open(const DefectSummary& summary, const std::vector<Defect>& defects) {
  const auto has_border = [](const DefectGroup& group) { return group.cause == Cause::open_border; };
  const auto may_come_of_it = [](const Defect& defect) {
    return defect.kind == DefectKind::encloses_nothing || defect.kind == DefectKind::outside_region;
  };
  return std::any_of(summary.groups.begin(), summary.groups.end(), has_border) &&
         std::any_of(defects.begin(), defects.end(), may_come_of_it);
}

/// Advice if the tolerance for pasting is above the size of details.
void print_advice_on_tolerance(const MeshArguments& arguments) {
  if (arguments.paste && !arguments.paste->empty())
    say("--paste={} may be above the size of the parts' details, which are lost then: a smaller tolerance "
        "may help\n",
        *arguments.paste);
}

}  // namespace

void print_refusal(const MeshArguments& arguments, const Surface& surface, const Result& result) {
  if (result.defects.empty()) {
    say("holdfast: {}; nothing was written\n{}{}\n", result.message, overlap_advice,
        arguments.paste && !arguments.paste->empty() ? "" : "; --paste=T joins parts that are nearer than T");
    return;
  }
  const DefectSummary summary = summarise(surface.view(), result.defects);
  if (is_valid(result.defects)) {
    // The defects describe themselves; the likely reason is that borders do not meet.
    say("holdfast: the surface is valid, but cannot be filled so\n{}",
        list_text(summary, result.defects, shown_in_passing, "--report FILE.json has them"));
    print_advice_on_tolerance(arguments);
    if (surface.facets.empty() && may_need_surface_of(arguments))
      say("--surface-of takes the surface of a volume, where the file holds one\n");
    else if (is_open(summary, result.defects))
      say("`holdfast diagnose` lists the open borders and proposes what closes them\n");
    return;
  }
  say("holdfast: the surface is not valid: {}\n{}\n{}", result.message, summary_text(summary),
      list_text(summary, result.defects, shown_in_passing, "`holdfast diagnose` lists them"));
  say("`holdfast diagnose` lists every defect; --marks FILE.vtu shows them in a viewer\n");
  if (arguments.surfaces.size() > 1 && !arguments.paste)
    say("--paste makes one surface of files that touch each other\n");
}

}  // namespace holdfast::cli
