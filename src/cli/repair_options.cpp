#include "repair_options.h"

#include "command.h"
#include "limits.h"
#include "number_list.h"

namespace holdfast::cli {

void add_repair_ways(CLI::App& command, RepairWays& ways, const std::string& beside) {
  command
      .add_option_function<std::string>(
          "--fill-holes",
          [&ways](const std::string& text) {
            if (text.empty()) {
              ways.fill_holes = SIZE_MAX;
              return;
            }
            std::size_t most = 0;
            if (!not_a_count(text).empty() || !CLI::detail::lexical_cast(text, most) || most < 3)
              throw CLI::ValidationError("--fill-holes", "'" + text + "' is no number of sides from 3 on");
            ways.fill_holes = most;
          },
          beside + "Close holes whose border has at most N sides (default: any number)")
      ->expected(0, 1)
      ->option_text("[N]");
  command.add_flag("--union", ways.unite,
                   beside + "Drop facets that have material on both sides, or on none");
}

void take_repair_ways(const RepairWays& ways, RepairOptions& options) {
  options.fill_holes = ways.fill_holes;
  options.unite = ways.unite;
}

double weld_of(const std::string& repair) {
  if (repair == "true") return 0;
  const double weld = numbers("--repair=", repair, 1, "a length, within which vertices are joined, is")[0];
  if (weld < 0) throw UsageError("--repair=" + repair + ": the length must not be negative");
  return weld;
}

Json sides_to_json(const std::optional<std::size_t>& most) { return most ? Json(*most) : Json(nullptr); }

}  // namespace holdfast::cli
