// What `repair` promises, checked on small surfaces that once broke it: found at random, and made as small as
// they are.
#include <gtest/gtest.h>

#include <string>

#include "holdfast/check_repair.h"
#include "holdfast/repair.h"

namespace holdfast {
namespace {

/// The rules that are broken.
std::string broken(const Surface& surface, const RepairOptions& options = {}) {
  const RepairResult repaired = repair(surface, options);
  if (repaired.outcome != Outcome::done) return repaired.message;
  std::string told;
  for (const RepairRule& rule :
       check_repaired(surface.view(), repaired.surface.view(), claims_of(repaired, options)).rules)
    if (!rule.holds()) told += std::string(name(rule.kind)) + ": " + rule.first[0] + "\n";
  return told;
}

Surface surface_of(std::vector<Point> vertices, std::vector<Triangle> facets) {
  Surface surface;
  surface.vertices = std::move(vertices);
  surface.facets = std::move(facets);
  return surface;
}

// A needle through a triangle: both points where its sides go through stand at the same doubles, so that what
// is beyond is a line.
TEST(RepairPromise, TheTipOfANeedleStays) {
  EXPECT_EQ(broken(surface_of({{-0.042760119712698219, 0.81403626276529684, -0.84924679661313152},
                               {-0.16722509948979833, -0.92416943101496107, -0.93303243102019351},
                               {0.79742528927720968, -0.58939826806344298, -0.2508157442973139},
                               {-0.51093912832326649, -0.44083699007483212, -0.56665491517057354},
                               {-0.20916613317857452, -0.86519173283188555, -0.88832592945844213},
                               {-0.16722509939094959, -0.92416943101496118, -0.93303243102019351}},
                              {{0, 1, 2}, {3, 4, 5}})),
            "");
  EXPECT_EQ(broken(surface_of({{0.054620670168461505, 0.46274513883706586, -0.37526349663058456},
                               {0.70252992573224138, 0.2110373780416146, 0.14019249578606263},
                               {0.58206299628390834, -0.57840828657031118, -0.023171813125046459},
                               {0.58206299628391345, -0.57840828659241206, -0.023171813125213298},
                               {0.19149658563316607, 0.69514551720432682, -0.21993601283858191},
                               {0.19149658563316557, 0.69514551720429174, -0.21993601284314868}},
                              {{3, 0, 1}, {5, 2, 4}})),
            "");
}

// Sheets that are made one come first: how far that moved them counts in whatever begins again from there.
TEST(RepairPromise, WhatJoiningMovedIsTold) {
  RepairOptions options;
  options.join = 1.72e-10;
  EXPECT_EQ(broken(surface_of({{0.78230180167084773, 0.91277626271049739, 0.014196584253915925},
                               {0.78230180167096208, 0.91277626271049062, 0.014196584246003958},
                               {-0.69567616982978953, 0.6907896849385109, -0.71471315715921779},
                               {-0.69567616987154302, 0.69078968495770687, -0.71471315715918649},
                               {-0.81806872662288943, -0.22983699459378948, 0.10288034837448359},
                               {-0.72732525057736508, -0.80227018814793483, 0.036665929576359835},
                               {-0.7273252506563348, -0.80227018814110151, 0.036665929588059434},
                               {0.33896922703516452, -0.22247887079805317, -0.51166402029211444}},
                              {{1, 3, 6}, {2, 5, 0}, {5, 0, 7}, {7, 1, 4}}),
                   options),
            "");
}

}  // namespace
}  // namespace holdfast
