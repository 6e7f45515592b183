#include "cures.h"

#include <fmt/core.h>

#include <algorithm>

#include "summary.h"

namespace holdfast::cli {
namespace {

std::string option_of(const Cure& cure) {
  switch (cure.kind) {
    case CureKind::weld:
      return fmt::format("--weld {}", cure.tolerance);
    case CureKind::cut:
      return "";
    case CureKind::fill_holes:
      return fmt::format("--fill-holes {}", cure.sides);
    case CureKind::unite:
      return "--union";
    case CureKind::join:
      return cure.has_faces ? fmt::format("--weld {0} --join {0}", cure.tolerance)
                            : fmt::format("--weld {}", cure.tolerance);
  }
  return "";
}

std::string text_of(const Cure& cure) {
  switch (cure.kind) {
    case CureKind::weld:
      return fmt::format("{} within {:.3g} of another or of a side: {}",
                         counted(cure.count, "vertex lies", "vertices lie"), cure.distance, option_of(cure));
    case CureKind::cut:
      return fmt::format("{}: `holdfast repair` cuts triangles where they meet and drops degenerate ones",
                         counted(cure.count, "defect"));
    case CureKind::fill_holes:
      return fmt::format("{} of at most {} sides: {}{}", counted(cure.count, "hole"), cure.sides,
                         option_of(cure), cure.left > 0 ? fmt::format(" ({} stay open)", cure.left) : "");
    case CureKind::unite:
      return fmt::format("parts overlap ({}): {}, if they are one body", counted(cure.count, "crossing"),
                         option_of(cure));
    case CureKind::join:
      return fmt::format("bodies pass each other within {:.3g} at {}: {}, if they touch", cure.distance,
                         cure.has_faces ? counted(cure.count, "triangle")
                                        : counted(cure.count, "pair of edges", "pairs of edges"),
                         option_of(cure));
  }
  return "";
}

bool is_for_the_user_to_decide(const Cure& cure) {
  return cure.kind == CureKind::unite || cure.kind == CureKind::join;
}

/// Without options that might change something intended.
std::string options_of(const Cures& cures) {
  std::string options;
  for (const Cure& cure : cures.cures)
    if (const std::string option = option_of(cure); !option.empty() && !is_for_the_user_to_decide(cure))
      options += (options.empty() ? "" : " ") + option;
  return options;
}

/// For holes that all stay open; otherwise the proposal to fill holes gives their number.
std::string left_open_text(const Cures& cures) {
  const bool some_are_filled = std::any_of(cures.cures.begin(), cures.cures.end(), [](const Cure& cure) {
    return cure.kind == CureKind::fill_holes;
  });
  if (cures.left_open == 0 || some_are_filled) return {};
  return fmt::format("no cure: {}: `--fill-holes` leaves open what would meet the surface\n",
                     counted(cures.left_open, "hole"));
}

/// The effect of all proposals together.
std::string effect_of(const Cures& cures) {
  if (!cures.tried)
    return fmt::format("may {} (not tried: too much meets)", cures.was_valid ? "close it" : "make it valid");
  const std::string left =
      cures.left_open == 0 ? ""
                           : fmt::format(", but for {} that stay{} open", counted(cures.left_open, "hole"),
                                         cures.left_open == 1 ? "s" : "");
  return (cures.was_valid ? "closes it" : "makes it valid") + left;
}

}  // namespace

std::string cures_text(const Cures& cures) {
  if (cures.cures.empty()) return left_open_text(cures);
  std::string text;
  for (const Cure& cure : cures.cures) text += fmt::format("cure: {}\n", text_of(cure));
  text += left_open_text(cures);
  if (std::all_of(cures.cures.begin(), cures.cures.end(), is_for_the_user_to_decide)) return text;
  const std::string options = options_of(cures);
  return text + fmt::format("cure: `holdfast repair IN -o OUT{}{}` {}\n", options.empty() ? "" : " ", options,
                            effect_of(cures));
}

Json to_json(const Cures& cures) {
  Json list = Json::array();
  for (const Cure& cure : cures.cures) {
    Json entry{{"kind", name(cure.kind)},
               {"option", option_of(cure)},
               {"count", cure.count},
               {"message", text_of(cure)}};
    if (cure.kind == CureKind::weld || cure.kind == CureKind::join) {
      entry["distance"] = cure.distance;
      entry["tolerance"] = cure.tolerance;
    }
    if (cure.kind == CureKind::fill_holes) {
      entry["sides"] = cure.sides;
      entry["left"] = cure.left;
    }
    list.push_back(std::move(entry));
  }
  return {{"tried", cures.tried},
          {"options", options_of(cures)},
          {"proposals", list},
          {"left_open", cures.left_open}};
}

}  // namespace holdfast::cli
