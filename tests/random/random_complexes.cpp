// Meshes random complexes with and without flips, some also with field points, and checks the promise
// (docs/concepts.md) on every mesh.
//
//   random_complexes [--seed S] [--first N] [--count N] [--json] [--write DIR]
//
// Complex number N of a seed is always the same. What fails is told by its number, so that
// `--first N --count 1 --write DIR` makes it again, as a file. Exit code 1 if anything failed. With --json
// one line with the counts comes last (scripts/random_complexes.py adds up those of many processes).
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "families.h"
#include "holdfast/check.h"
#include "holdfast/holdfast.h"
#include "property/surface_truth.h"

namespace holdfast::random_complexes {
namespace {

constexpr double kTimeLimit = 60;  // seconds of one mesh; the slowest that is known takes less than two

struct Counts {
  std::size_t complexes = 0, valid = 0, meshes = 0, with_points = 0, not_in_doubles = 0, failed = 0;
  double seconds = 0;
};

void write_off(const std::string& path, const Surface& surface) {
  std::ofstream file(path);
  file.precision(17);
  file << "OFF\n"
       << surface.vertices.size() << ' ' << surface.facets.size() + surface.segments.size() << " 0\n";
  for (const Point& p : surface.vertices) file << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const Triangle& f : surface.facets) file << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  for (const Segment& s : surface.segments) file << "2 " << s[0] << ' ' << s[1] << '\n';
}

// Only the enclosing is amiss, not the complex.
bool is_complex_all_the_same(const Result& result) {
  return result.outcome == Outcome::invalid_input && !result.defects.empty() &&
         std::all_of(result.defects.begin(), result.defects.end(), [](const Defect& defect) {
           return defect.kind == DefectKind::encloses_nothing || defect.kind == DefectKind::outside_region;
         });
}

class Trial {
 public:
  Trial(const Sample& sample, Random random) : sample_(sample), random_(random) {}

  /// What is wrong; nothing if all is well.
  std::string run(Counts& counts) {
    const Complex complex = sample_.surface.view();
    const bool valid = diagnose(complex, 1).empty();
    if (!sample_.oracle_points.empty()) {
      const oracle::Truth truth =
          oracle::truth_of({sample_.oracle_points, sample_.surface.facets, sample_.surface.segments});
      if (truth.valid() != valid)
        return truth.valid() ? "diagnose() finds a defect where none is" : "diagnose() finds no defect";
    }
    counts.valid += valid ? 1 : 0;
    Options options;
    options.keep = sample_.keep;
    options.seed = random_();
    options.time_limit = kTimeLimit;
    options.optimise = !one_in(random_, 8);
    options.add_points = !one_in(random_, 8);
    options.threads = one_in(random_, 8) ? 2 : 1;
    for (const bool flips : {true, false}) {
      options.flips = flips;
      if (std::string wrong = mesh_once(options, valid, counts); !wrong.empty())
        return wrong + (flips ? "" : " (without flips)");
      if (!valid) return {};
    }
    if (one_in(random_, 4)) {
      options.flips = true;
      options.sizes = sizes();
      options.effort = one_in(random_, 2) ? Effort::fast : Effort::good;
      if (std::string wrong = mesh_once(options, valid, counts); !wrong.empty())
        return wrong + " (with sizes)";
    }
    return {};
  }

 private:
  // A share of the extent; so flat ones may take a large gradation, or there would be no end of points.
  Sizes sizes() {
    Sizes sizes;
    double extent = 0;
    for (const Point& p : sample_.surface.vertices)
      for (std::size_t k = 0; k < 3; ++k)
        extent = std::max(extent, std::abs(p[k] - sample_.surface.vertices[0][k]));
    if (one_in(random_, 2)) sizes.size = extent * uniform(random_, 0.3, 1);
    sizes.gradation = uniform(random_, 0.5, 1);
    return sizes;
  }

  std::string mesh_once(Options options, bool valid, Counts& counts) {
    const Complex complex = sample_.surface.view();
    Result result = mesh(complex, options);
    if (valid && is_complex_all_the_same(result)) {
      options.keep = Keep::box;
      options.box_margin = log_uniform(random_, 0.01, 2);
      result = mesh(complex, options);
    }
    if (!valid) {
      if (result.outcome == Outcome::invalid_input && !result.defects.empty()) return {};
      return "mesh() takes what diagnose() finds invalid";
    }
    ++counts.meshes;
    if (result.outcome == Outcome::not_representable) {
      if (sample_.mesh_known) return "no mesh in doubles was found, though one is known";
      if (!sample_.coarse) return result.message;
      ++counts.not_in_doubles;
      return {};
    }
    if (result.outcome != Outcome::done)
      return result.message + (result.defects.empty() ? "" : ": " + result.defects[0].message);
    if (result.report.steiner_points > 0) ++counts.with_points;
    return broken(result, options.keep == Keep::box);
  }

  std::string broken(const Result& result, bool box) const {
    CheckOptions options;
    options.box = box;
    for (const Rule& rule : check(sample_.surface.view(), result.volume, options).rules)
      if (!rule.holds) return rule.name + ": " + rule.detail;
    if (result.report.tetrahedra != result.volume.tetrahedra.size())
      return "the report counts other tetrahedra";
    if (result.report.unrounded_points != 0) return "the report tells of points without doubles";
    return {};
  }

  const Sample& sample_;
  Random random_;
};

std::string try_one(std::uint64_t seed, std::uint64_t number, const std::string& folder, Counts& counts) {
  Recipe recipe = recipe_of(seed, number);
  ++counts.complexes;
  const Sample sample = recipe.make();
  if (!folder.empty()) write_off(folder + "/" + std::to_string(number) + ".off", sample.surface);
  try {
    return Trial(sample, recipe.random).run(counts);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace
}  // namespace holdfast::random_complexes

int main(int count, char** arguments) {
  using namespace holdfast::random_complexes;
  std::uint64_t seed = 1, first = 0, complexes = 300;
  bool json = false;
  std::string folder;
  CLI::App app("Meshes random complexes and checks the promise on every mesh.");
  app.add_option("--seed", seed, "of all complexes")->capture_default_str();
  app.add_option("--first", first, "number of the first complex")->capture_default_str();
  app.add_option("--count", complexes, "of complexes")->capture_default_str();
  app.add_flag("--json", json, "a line of counts by family in the end");
  app.add_option("--write", folder, "writes each complex to this folder, NUMBER.off");
  CLI11_PARSE(app, count, arguments);

  std::map<std::string, Counts> by_family;
  std::size_t failed = 0;
  for (std::uint64_t number = first; number < first + complexes; ++number) {
    const Recipe recipe = recipe_of(seed, number);
    Counts& counts = by_family[recipe.family.name];
    const std::size_t not_in_doubles = counts.not_in_doubles;
    const auto begin = std::chrono::steady_clock::now();
    const std::string wrong = try_one(seed, number, folder, counts);
    counts.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (counts.not_in_doubles > not_in_doubles)
      std::cout << "not in doubles: --seed " << seed << " --first " << number << " --count 1 ("
                << recipe.family.name << recipe.map.name << ")" << std::endl;
    if (wrong.empty()) continue;
    ++counts.failed;
    ++failed;
    std::cout << "FAILED: --seed " << seed << " --first " << number << " --count 1 (" << recipe.family.name
              << recipe.map.name << "): " << wrong << std::endl;
  }
  nlohmann::json all;
  for (const auto& [family, c] : by_family) {
    all[family] = {{"complexes", c.complexes},
                   {"valid", c.valid},
                   {"meshes", c.meshes},
                   {"with_points", c.with_points},
                   {"not_in_doubles", c.not_in_doubles},
                   {"failed", c.failed},
                   {"seconds", c.seconds}};
  }
  if (json)
    std::cout << all.dump() << '\n';
  else
    std::cout << "seed " << seed << ", complexes " << first << " to " << first + complexes - 1 << ": "
              << failed << " failed\n";
  return failed == 0 ? 0 : 1;
}
