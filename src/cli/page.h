// The page of --html, which shows the input and the output of a command in a browser.
#pragma once

#include <CLI/CLI.hpp>
#include <deque>
#include <filesystem>
#include <string>

#include "holdfast/summary.h"
#include "holdfast/view.h"
#include "report.h"

namespace holdfast::cli {

/// Adds --html.
void add_html_option(CLI::App& command, std::filesystem::path& page);

/// The limits for the page of a run with this outcome: none if the output is already in place.
Limits limits_of_page(const Limits& limits, Outcome outcome);

/// Collects the parts of a page and writes it. Its arguments must outlive it.
class PageOfRun {
 public:
  PageOfRun(std::filesystem::path path, const Limits& limits);

  /// Whether a page is wanted; otherwise the other functions do nothing.
  [[nodiscard]] explicit operator bool() const { return !path_.empty(); }
  void add(const std::string& name, const Volume& volume);
  void add(const std::string& name, const Surface& surface, const std::vector<Defect>& defects = {});
  void set_verdict(std::string verdict, bool good);
  void set_rules(std::span<const Rule> rules);
  /// Adds `report` without long lists of indices.
  void set_report(Json report);
  void set_title(std::string title);
  /// Throws FileError and Interrupted.
  void write();

 private:
  struct Told {
    std::vector<Defect> defects;
    DefectSummary summary;
  };
  std::filesystem::path path_;
  Page page_;
  PageOptions options_;
  std::deque<Told> told_;  // a deque, because parts point into it
};

}  // namespace holdfast::cli
