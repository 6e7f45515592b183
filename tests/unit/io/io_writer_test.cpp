// A file appears complete or not at all, and failures name the file and the reason.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "io/atomic_writer.h"
#include "io_samples.h"

namespace holdfast::io_writer_test {
namespace {

using namespace samples;
using io::AtomicWriter;

std::string reason_of(const std::filesystem::path& path) {
  try {
    write_volume(path, sample_volume());
  } catch (const FileError& error) {
    EXPECT_EQ(error.path().stem(), path.stem());
    return error.what();
  }
  return "written";
}

TEST(AtomicWriter, NothingHasTheNameBeforeCommit) {
  const TemporaryFolder folder;
  AtomicWriter out(folder / "a.txt");
  out << "one " << 0.1 << ' ' << -7 << ' ' << std::uint64_t{18446744073709551615u};
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  out.finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  out.commit();
  EXPECT_EQ(get(folder / "a.txt"), "one 0.1 -7 18446744073709551615");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(AtomicWriter, AnAbandonedFileLeavesNothing) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  try {
    AtomicWriter out(folder / "a.txt");
    out << std::string(1 << 20, 'x');
    throw std::runtime_error("cancelled");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(get(folder / "a.txt"), "old");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(AtomicWriter, LargeAndSmallPiecesKeepTheirOrder) {
  const TemporaryFolder folder;
  std::string expected;
  AtomicWriter out(folder / "a.txt");
  for (std::size_t size : {10u, 262143u, 1u, 262144u, 262145u, 5u, 1000000u, 7u}) {
    const std::string piece(size, static_cast<char>('a' + size % 26));
    out << piece;
    expected += piece;
  }
  out.commit();
  EXPECT_EQ(get(folder / "a.txt"), expected);
}

TEST(AtomicWriter, ReplacesAFileAndKeepsItsPermissions) {
  const TemporaryFolder folder;
  put(folder / "a.mesh", "old");
  ::chmod((folder / "a.mesh").c_str(), 0640);
  EXPECT_EQ(reason_of(folder / "a.mesh"), "written");
  struct stat status {};
  ::stat((folder / "a.mesh").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicWriter, WhatHasItsNameIsNoLongerCancelled) {
  const TemporaryFolder folder;
  for (const char* name : {"a.vtu", "a.node"}) {
    WriteOptions options;
    options.progress = [](double share) { return share < 1; };
    EXPECT_NO_THROW(write_volume(folder / name, sample_volume(), options)) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

TEST(AtomicWriter, FollowsALink) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("sub/real.mesh", folder / "link.mesh");
  EXPECT_EQ(reason_of(folder / "link.mesh"), "written");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.mesh"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / "sub/real.mesh"));
}

TEST(AtomicWriter, WritesADeviceInPlace) {
  AtomicWriter out("/dev/null");
  out << "x";
  out.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicWriter, FailuresSayWhy) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.vtu");
  EXPECT_NE(reason_of(folder / "folder.vtu").find("is a directory"), std::string::npos);
  EXPECT_NE(reason_of(folder / "missing/a.vtu").find("folder does not exist"), std::string::npos);
  put(folder / "file", "");
  EXPECT_NE(reason_of(folder / "file/a.vtu").find("cannot be written"), std::string::npos);
  EXPECT_NE(reason_of(folder / "a.xyz").find("the formats are .mesh, .meshb, .vtu"), std::string::npos);
  EXPECT_NE(reason_of(folder / "noextension").find("a name without extension"), std::string::npos);
  EXPECT_NE(reason_of(folder / (std::string(300, 'x') + ".vtu")), "written");
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(AtomicWriter, AFullDeviceIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  AtomicWriter out("/dev/full");
  out << "x";
  EXPECT_THROW(out.commit(), FileError);
}

/// Exit status of a child that runs `action` under a limit of 64 KiB a file.
template <typename Action>
int status_under_limit(Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{65536, 65536};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(action());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(AtomicWriter, AFullDiskLeavesTheOldFilesAndNothingElse) {
  Volume volume = sample_volume();
  volume.vertices.resize(100000, {0.1, 0.2, 0.3});
  volume.vertex_markers.clear();
  for (const char* name : {"a.mesh", "a.vtk", "a.node"}) {
    const TemporaryFolder folder;
    put(folder / name, "old");
    const int status = status_under_limit([&] {
      try {
        write_volume(folder / name, volume);
      } catch (const FileError& error) {
        return std::string(error.what()).find("too large") != std::string::npos ? 0 : 2;
      }
      return 1;
    });
    EXPECT_EQ(status, 0) << name;
    EXPECT_EQ(get(folder / name), "old");
    EXPECT_EQ(folder.names().size(), 1u) << name;
  }
}

TEST(Marks, PointsLinesAndEntities) {
  const TemporaryFolder folder;
  Surface surface;
  surface.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  surface.facets = {{0, 1, 2}, {0, 1, 9}};
  surface.segments = {{0, 1}};
  const std::vector<Defect> defects = {
      {DefectKind::segments_cross, {}, {}, {}, {{1, 2, 3}}, ""},
      {DefectKind::facets_cross, {}, {}, {}, {{1, 2, 3}, {4, 5, 6}}, ""},
      {DefectKind::repeated_facet, {0, 77}, {0, 1, 88}, {0, 99}, {}, ""},
      {DefectKind::non_finite_coordinate, {3}, {}, {}, {}, ""},
  };
  write_marks(folder / "marks.vtu", surface.view(), defects);
  const Volume marks = read_volume(folder / "marks.vtu");
  // One line, then of the third defect one segment, three sides of facet 0 and one of facet 1.
  EXPECT_EQ(marks.segments.size(), 1u + 1 + 3 + 1);
  EXPECT_EQ(marks.vertices.size(), 1u + 2 + 1 + 2 * 5);
  EXPECT_NE(get(folder / "marks.vtu").find("Name=\"defect\""), std::string::npos);
  write_marks(folder / "none.vtu", surface.view(), {});
  EXPECT_EQ(read_volume(folder / "none.vtu").vertices.size(), 0u);
}

}  // namespace
}  // namespace holdfast::io_writer_test
