#include "paste_options.h"

#include <fmt/core.h>

#include <cmath>
#include <memory>

#include "command.h"
#include "holdfast/names.h"

namespace holdfast::cli {

void add_paste_option(CLI::App& command, std::optional<std::string>& tolerance) {
  const auto text = std::make_shared<std::string>();
  command
      .add_flag("--paste", *text,
                "Several files: make those that touch fit together; with T, also what is nearer than T to "
                "another file")
      ->option_text("[=T]");
  command.parse_complete_callback([text, &tolerance, &command] {
    if (command.count("--paste") > 0) tolerance = *text == "true" ? "" : *text;
  });
}

void add_overlap_option(CLI::App& command, std::optional<std::string>& overlap) {
  command
      .add_option("--overlap", overlap,
                  "Space in several files goes to the first of them, the last, or a new region; by default "
                  "files that overlap are refused (exit 4)")
      ->option_text("first|last|new");
}

Overlap overlap_named(const std::optional<std::string>& text) {
  if (!text) return Overlap::refuse;
  const std::optional<Overlap> overlap = from_name<Overlap>(*text);
  if (overlap && *overlap != Overlap::refuse) return *overlap;
  throw UsageError(fmt::format("--overlap {}: there is first, last and new", *text));
}

double tolerance_of(const std::string& text, const std::string& option) {
  double tolerance = 0;
  if (!CLI::detail::lexical_cast(text, tolerance) || !std::isfinite(tolerance) || !(tolerance > 0))
    throw UsageError(fmt::format("{}={}: the tolerance must be a positive length", option, text));
  return tolerance;
}

std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> labels;
  for (const auto& path : paths) labels.push_back(path.string());
  return labels;
}

}  // namespace holdfast::cli
