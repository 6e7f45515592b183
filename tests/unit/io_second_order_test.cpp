// Volumes of second order through every format that is read and written: nodes, markers and regions come
// back.
#include <gtest/gtest.h>

#include <filesystem>

#include "holdfast/check.h"
#include "holdfast/io.h"
#include "holdfast/second_order.h"

namespace holdfast {
namespace {

class SecondOrderFiles : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    volume_.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    volume_.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
    volume_.regions = {5, 5};
    volume_.facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {2, 3, 4}, {1, 4, 3}, {1, 2, 4}};
    volume_.facet_markers = {3, 3, 3, 7, 7, 7};
    volume_.segments = {{0, 1}};
    volume_.segment_markers = {4};
    surface_.vertices = volume_.vertices;
    surface_.facets = volume_.facets;
    surface_.facet_markers = volume_.facet_markers;
    surface_.segments = volume_.segments;
    surface_.segment_markers = volume_.segment_markers;
    add_mid_nodes(volume_);
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("second_order") + GetParam());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Surface surface_;
  Volume volume_;
  std::filesystem::path folder_;
};

TEST_P(SecondOrderFiles, ComeBack) {
  const std::filesystem::path path = folder_ / (std::string("a") + GetParam());
  write_volume(path, volume_);
  const Volume read = read_volume(path);
  ASSERT_EQ(read.vertices, volume_.vertices);
  ASSERT_EQ(read.tetrahedra.size(), volume_.tetrahedra.size());
  ASSERT_EQ(read.mid_nodes.points.size(), volume_.mid_nodes.points.size());
  const CheckResult checked = check(surface_.view(), read);
  EXPECT_EQ(checked.rules.size(), 15u);
  for (const Rule& rule : checked.rules) EXPECT_TRUE(rule.holds) << rule.name << ": " << rule.detail;
}

INSTANTIATE_TEST_SUITE_P(Formats, SecondOrderFiles,
                         testing::Values(".vtu", ".vtk", ".msh", ".mesh", ".meshb", ".node"),
                         [](const auto& named) { return std::string(named.param).substr(1); });

}  // namespace
}  // namespace holdfast
