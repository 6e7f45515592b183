#include "check_repaired.h"

#include <fmt/core.h>

#include "command.h"
#include "files.h"
#include "files_of_run.h"
#include "holdfast/check_repair.h"
#include "limits.h"
#include "repair_check.h"
#include "repair_claims.h"
#include "report.h"
#include "signals.h"

namespace holdfast::cli {
namespace {

constexpr std::size_t kMostListed = 20;  // of one rule

std::string listing_of(const RepairCheckResult& result, const std::vector<std::string>& disagreements) {
  std::string text;
  const auto list = [&](const auto& sentences, std::size_t all) {
    for (std::size_t i = 0; i < std::min(sentences.size(), kMostListed); ++i)
      text += fmt::format("    {}\n", sentences[i]);
    if (all > kMostListed) text += fmt::format("    and {} more\n", all - kMostListed);
  };
  for (const RepairRule& rule : result.rules) {
    text += rule.holds() ? fmt::format("holds   {}: {}\n", name(rule.kind), rule.detail)
                         : fmt::format("BROKEN  {}: {} violation{}\n", name(rule.kind), rule.violations,
                                       rule.violations == 1 ? "" : "s");
    list(rule.first, rule.violations);
  }
  if (!disagreements.empty()) text += "BROKEN  files agree\n";
  list(disagreements, disagreements.size());
  return text;
}

int examine(const RepairedFiles& named, const Limits& limits, bool quiet, const FilesOfRun& files) {
  const Surface input = read_surfaces(named.inputs, reading(limits, named.input_format));
  const Surface output = read_surface(named.output, reading(limits, named.format));
  const auto [claims, disagreements] = read_claims(named.parents, named.report, input, output);

  RepairCheckOptions options;
  static_cast<Limits&>(options) = limits;
  options.most = kMostListed;
  const RepairCheckResult result = check_repaired(input.view(), output.view(), claims, options);
  if (!quiet) files.list(listing_of(result, disagreements));
  Json json = reports::to_json(result);
  json["disagreements"] = disagreements;
  write_json(named.verdict, json);
  if (result.holds() && disagreements.empty()) return exit_done;
  say("holdfast: {} is not what `repair` promises; the rules marked BROKEN say where\n",
      named.output.string());
  return exit_check_failed;
}

}  // namespace

int check_repaired_files(const RepairedFiles& named, const Limits& limits, bool quiet) {
  if (named.parents.empty() && named.report.empty())
    throw UsageError(
        "check: --repaired needs what `holdfast repair` told: --parents FILE, --report FILE.json or both");
  FilesOfRun files;
  files.read_surfaces(named.inputs, named.input_format);
  files.read_surfaces({named.output}, named.format);
  files.read_file("--parents", named.parents);
  files.read_file("--report", named.report);
  files.write("--verdict", named.verdict);
  cancel_by_flag();
  return work_or_write_end(limits, [&] { return examine(named, limits, quiet, files); }, {named.verdict});
}

}  // namespace holdfast::cli
