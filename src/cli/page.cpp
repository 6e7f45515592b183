#include "page.h"

#include "defects.h"
#include "files_of_run.h"
#include "limits.h"

namespace holdfast::cli {

void add_html_option(CLI::App& command, std::filesystem::path& page) {
  command
      .add_option("--html", page,
                  "Write a page that shows the result in a browser, one file that needs no network")
      ->transform(or_standard_output)
      ->option_text("FILE.html");
}

Limits limits_of_page(const Limits& limits, Outcome outcome) {
  return outcome == Outcome::done ? Limits{} : limits;
}

PageOfRun::PageOfRun(std::filesystem::path path, const Limits& limits) : path_(std::move(path)) {
  static_cast<Limits&>(options_) = limits;
  options_.progress = goes_on;
}

void PageOfRun::add(const std::string& name, const Volume& volume) {
  if (!*this) return;
  PagePart part;
  part.name = name;
  part.volume = &volume;
  page_.parts.push_back(std::move(part));
}

void PageOfRun::add(const std::string& name, const Surface& surface, const std::vector<Defect>& defects) {
  if (!*this) return;
  PagePart part;
  part.name = name;
  part.complex = surface.view();
  if (!defects.empty()) {
    Told& told = told_.emplace_back(Told{defects, summarise(surface.view(), defects)});
    for (Defect& defect : told.defects)
      defect.message = std::string(holdfast::name(defect.kind)) + ": " + message_of(defect);
    part.defects = told.defects;
    part.summary = &told.summary;
  }
  page_.parts.push_back(std::move(part));
}

void PageOfRun::set_verdict(std::string verdict, bool good) {
  page_.verdict = std::move(verdict);
  page_.good = good;
}

void PageOfRun::set_rules(std::span<const Rule> rules) { page_.rules = rules; }

void PageOfRun::set_report(Json report) {
  if (!*this) return;
  for (const char* list : {"vertex_map", "defects", "parents", "summary"}) report.erase(list);
  page_.report = reports::text_of(report, 2);
}

void PageOfRun::set_title(std::string title) { page_.title = std::move(title); }

void PageOfRun::write() {
  if (*this) write_page(path_, page_, options_);
}

}  // namespace holdfast::cli
