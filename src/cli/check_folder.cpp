#include "check_folder.h"

#include <fmt/core.h>

#include "command.h"
#include "files_of_run.h"
#include "limits.h"
#include "manifest.h"
#include "signals.h"
#include "summary.h"

namespace holdfast::cli {
namespace {

/// The findings for a part or the whole, for the listing and the report.
struct FolderFindings {
  std::string listing;
  Json parts = Json::array(), fits = Json::array();
  bool hold = true;

  void add_part(const std::string& file, bool holds, const std::string& detail) {
    listing +=
        fmt::format("{}  {}{}{}\n", holds ? "holds " : "BROKEN", file, detail.empty() ? "" : ": ", detail);
    parts.push_back({{"volume", file}, {"holds", holds}, {"detail", detail}});
    hold = hold && holds;
  }
  void add_fit(const Fit& fit) {
    listing += fmt::format("{}  {}{}{}\n", fit.holds ? "holds " : "BROKEN", name(fit.kind),
                           fit.detail.empty() ? "" : ": ", fit.detail);
    fits.push_back({{"rule", name(fit.kind)}, {"holds", fit.holds}, {"detail", fit.detail}});
    hold = hold && fit.holds;
  }
};

std::string broken_rules(const CheckResult& result) {
  std::string text;
  for (const Rule& rule : result.rules)
    if (!rule.holds) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", rule.name, rule.detail);
  return text;
}

/// This also finds a part that is missing, foreign, or from an older division.
void check_part(const Manifest& manifest, std::size_t k, const CheckOptions& options, FitChecker& fits,
                FolderFindings& findings) {
  const std::string file = manifest.parts[k].volume.string();
  try {
    const Surface surface = surface_of_part(manifest, k, options);
    const Volume volume = volume_of(manifest, k, options);
    const CheckResult result = check(surface.view(), volume, options);
    findings.add_part(file, result.holds(),
                      result.holds() ? counted(volume.tetrahedra.size(), "tetrahedron", "tetrahedra")
                                     : broken_rules(result));
    if (result.holds()) fits.add(volume);
  } catch (const Stale& stale) {
    findings.add_part(file, false, stale.what());
  } catch (const FileError& error) {
    findings.add_part(file, false, error.what());
  }
}

FolderFindings examine(const Manifest& manifest, const CheckOptions& options) {
  FolderFindings findings;
  try {
    const Surface whole = whole_of(manifest, options);
    FitChecker fits(whole.view(), manifest.outside_dropped);
    for (std::size_t k = 0; k < manifest.parts.size(); ++k) check_part(manifest, k, options, fits, findings);
    // Broken parts say nothing about the whole.
    if (findings.hold)
      for (const Fit& fit : fits.finish()) findings.add_fit(fit);
  } catch (const Stale& stale) {
    findings.add_part(manifest.surface.string(), false, stale.what());
  }
  return findings;
}

}  // namespace

int check_folder(const FolderCheck& what) {
  FilesOfRun files;
  const Manifest manifest = read_manifest(what.folder);
  for (const ManifestPart& part : manifest.parts) files.read_volume(manifest.path_of(part.volume), {});
  files.write("--report", what.report);
  cancel_by_flag();
  const FolderFindings findings =
      work_or_write_end(what.options, [&] { return examine(manifest, what.options); }, {what.report});
  if (!what.quiet) files.list(findings.listing);
  write_json(what.report, {{"holds", findings.hold}, {"parts", findings.parts}, {"fit", findings.fits}});
  if (findings.hold) return exit_done;
  say("holdfast: {} does not hold a mesh of its surface; the lines marked BROKEN say where\n",
      what.folder.string());
  return exit_check_failed;
}

}  // namespace holdfast::cli
