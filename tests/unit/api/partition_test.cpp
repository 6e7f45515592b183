// Volumes in pieces: every entity has one owner, ghosts are the neighbours of a piece, and both sides of an
// interface agree.
#include "holdfast/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "small_surfaces.h"

namespace holdfast::partition_test {
namespace {

Volume meshed(const Surface& surface, double size) {
  Options options;
  options.sizes = Sizes{};
  options.sizes->size = size;
  Result result = mesh(surface, options);
  EXPECT_EQ(result.outcome, Outcome::done) << result.message;
  return std::move(result.volume);
}

using Whole = std::array<std::uint64_t, 3>;
Whole in_whole(const MeshPiece& piece, const Triangle& face) {
  return {piece.vertices[face[0]], piece.vertices[face[1]], piece.vertices[face[2]]};
}

std::vector<MeshPiece> all(const PieceLoader& load, std::size_t parts) {
  std::vector<MeshPiece> pieces;
  for (std::size_t k = 0; k < parts; ++k) pieces.push_back(load(k));
  return pieces;
}

/// Whether the pieces have all entities of the volume, each once.
void expect_whole(const Volume& whole, const std::vector<MeshPiece>& pieces) {
  std::set<std::uint64_t> tetrahedra, vertices;
  std::size_t facets = 0, segments = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const MeshPiece& piece = pieces[k];
    EXPECT_GT(piece.own_tetrahedra, 0u);
    for (std::size_t t = 0; t < piece.tetrahedra.size(); ++t) {
      const bool own = t < piece.own_tetrahedra;
      EXPECT_EQ(piece.owners[t] == k, own);
      if (own) {
        EXPECT_TRUE(tetrahedra.insert(piece.tetrahedra[t]).second);
      }
      for (std::size_t i = 0; i < 4; ++i) {
        const Index v = piece.volume.tetrahedra[t][i];
        EXPECT_EQ(piece.vertices[v], whole.tetrahedra[piece.tetrahedra[t]][i]);
        if (own) {
          EXPECT_LT(v, piece.own_vertices);
        }
      }
    }
    for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
      EXPECT_EQ(piece.volume.vertices[v], whole.vertices[piece.vertices[v]]);
      if (piece.vertex_owners[v] == k) {
        EXPECT_TRUE(vertices.insert(piece.vertices[v]).second);
      }
    }
    facets += static_cast<std::size_t>(std::count(piece.facet_owners.begin(), piece.facet_owners.end(), k));
    segments +=
        static_cast<std::size_t>(std::count(piece.segment_owners.begin(), piece.segment_owners.end(), k));
  }
  EXPECT_EQ(tetrahedra.size(), whole.tetrahedra.size());
  EXPECT_EQ(vertices.size(), whole.vertices.size());
  EXPECT_EQ(facets, whole.facets.size());
  EXPECT_EQ(segments, whole.segments.size());
}

void expect_ghosts(const Volume& whole, const std::vector<MeshPiece>& pieces) {
  for (const MeshPiece& piece : pieces) {
    const std::set<std::uint64_t> own(
        piece.vertices.begin(), piece.vertices.begin() + static_cast<std::ptrdiff_t>(piece.own_vertices));
    const std::set<std::uint64_t> here(piece.tetrahedra.begin(), piece.tetrahedra.end());
    EXPECT_EQ(here.size(), piece.tetrahedra.size());
    for (std::size_t t = 0; t < whole.tetrahedra.size(); ++t) {
      const Tetrahedron& c = whole.tetrahedra[t];
      EXPECT_EQ(here.contains(t), std::any_of(c.begin(), c.end(), [&](Index v) { return own.contains(v); }));
    }
  }
}

void expect_interfaces_match(const std::vector<MeshPiece>& pieces) {
  std::size_t faces = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const MeshPiece::Interface& interface : pieces[k].interfaces) {
      const MeshPiece& other = pieces[interface.other];
      const auto back = std::find_if(other.interfaces.begin(), other.interfaces.end(),
                                     [&](const MeshPiece::Interface& i) { return i.other == k; });
      ASSERT_NE(back, other.interfaces.end());
      ASSERT_EQ(back->faces.size(), interface.faces.size());
      for (std::size_t f = 0; f < interface.faces.size(); ++f) {
        const Whole here = in_whole(pieces[k], interface.faces[f]), there = in_whole(other, back->faces[f]);
        EXPECT_EQ(here, (Whole{there[0], there[2], there[1]}));
        EXPECT_EQ(here[0], *std::min_element(here.begin(), here.end()));
      }
      faces += interface.faces.size();
    }
  EXPECT_GT(faces, 0u);
}

TEST(Partition, PartsAreOfEqualSizeAndTheSameEachTime) {
  if (!has_metis()) GTEST_SKIP() << "built without METIS";
  const Volume volume = meshed(small::box(), 0.12);
  for (const std::size_t parts : {1u, 2u, 5u, 12u}) {
    const std::vector<Index> part_of = partition(volume, parts);
    EXPECT_EQ(part_of, partition(volume, parts));
    std::vector<std::size_t> sizes(parts, 0);
    for (const Index part : part_of) ++sizes.at(part);
    const double mean = static_cast<double>(part_of.size()) / static_cast<double>(parts);
    EXPECT_GT(static_cast<double>(*std::min_element(sizes.begin(), sizes.end())), 0.8 * mean);
    EXPECT_LT(static_cast<double>(*std::max_element(sizes.begin(), sizes.end())), 1.1 * mean);
  }
}

TEST(Partition, AsManyPartsAsTetrahedraLeaveNoneEmpty) {
  if (!has_metis()) GTEST_SKIP() << "built without METIS";
  const Volume volume = mesh(small::box(), Options{}).volume;
  std::vector<Index> part_of = partition(volume, volume.tetrahedra.size());
  std::sort(part_of.begin(), part_of.end());
  for (std::size_t t = 0; t < part_of.size(); ++t) EXPECT_EQ(part_of[t], t);
  EXPECT_THROW(static_cast<void>(partition(volume, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(partition(volume, part_of.size() + 1)), std::invalid_argument);
}

TEST(Partition, PiecesHaveEveryEntityOnceAndTheGhostsRoundThem) {
  const Volume volume = meshed(small::box(), 0.2);
  std::vector<Index> part_of(volume.tetrahedra.size());
  for (std::size_t t = 0; t < part_of.size(); ++t) {  // slabs, and a part within one of them
    double x = 0;
    for (const Index v : volume.tetrahedra[t]) x += volume.vertices[v][0] / 4;
    part_of[t] = x < 0.3 ? 2 : x < 0.7 ? 0 : 1;
  }
  const std::vector<MeshPiece> pieces = all(pieces_of(volume, part_of, 3), 3);
  expect_whole(volume, pieces);
  expect_ghosts(volume, pieces);
  expect_interfaces_match(pieces);
  EXPECT_THROW(static_cast<void>(pieces_of(volume, {}, 3)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(pieces_of(volume, part_of, 2)), std::invalid_argument);
}

TEST(Partition, EntitiesOnNoTetrahedronAreInPieceZero) {
  Volume volume;
  volume.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {5, 5, 5}, {6, 5, 5}};
  volume.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  volume.regions = {1, 1};
  volume.facets = {{0, 2, 1}, {4, 5, 6}};
  volume.segments = {{5, 6}};
  const std::vector<MeshPiece> pieces = all(pieces_of(volume, {0, 1}, 2), 2);
  expect_whole(volume, pieces);
  EXPECT_EQ(pieces[0].volume.facets.size(), 2u);
  EXPECT_EQ(pieces[1].volume.facets.size(), 0u);
}

/// Facets by their numbers in the whole, with marker and owner.
std::multiset<std::tuple<Whole, int, Index>> facets_of(const MeshPiece& piece) {
  std::multiset<std::tuple<Whole, int, Index>> facets;
  for (std::size_t f = 0; f < piece.volume.facets.size(); ++f) {
    Whole key = in_whole(piece, piece.volume.facets[f]);
    std::sort(key.begin(), key.end());
    const auto& markers = piece.volume.facet_markers;
    facets.emplace(key, markers.empty() ? 0 : markers[f], piece.facet_owners[f]);
  }
  return facets;
}

void expect_pieces_of_parts_equal_those_of_the_joined_volume(const Surface& surface) {
  DivideOptions dividing;
  dividing.parts = 4;
  dividing.size = 0.2;
  dividing.drop_outside = true;
  const SurfaceDivision division = divide(surface, dividing);
  std::vector<Volume> volumes;
  std::vector<Index> part_of;
  for (const SurfacePart& part : division.parts) {
    Options options;
    options.sizes = Sizes{};
    options.holes = part.surface.holes;
    options.regions = part.surface.regions;
    volumes.push_back(mesh(part.surface, options).volume);
    part_of.insert(part_of.end(), volumes.back().tetrahedra.size(), static_cast<Index>(volumes.size() - 1));
  }
  const std::size_t parts = volumes.size();
  const Volume joined = join_parts(surface.view(), volumes, division.interface_marker);
  const std::vector<MeshPiece> expected = all(pieces_of(joined, part_of, parts), parts);
  const std::vector<MeshPiece> pieces =
      all(joined_pieces(
              surface.view(), parts, [&](std::size_t k) { return volumes[k]; }, division.interface_marker),
          parts);
  expect_whole(joined, pieces);
  expect_ghosts(joined, pieces);
  expect_interfaces_match(pieces);
  for (std::size_t k = 0; k < parts; ++k) {
    EXPECT_EQ(pieces[k].vertices, expected[k].vertices);
    EXPECT_EQ(pieces[k].vertex_owners, expected[k].vertex_owners);
    EXPECT_EQ(pieces[k].tetrahedra, expected[k].tetrahedra);
    EXPECT_EQ(pieces[k].volume.tetrahedra, expected[k].volume.tetrahedra);
    EXPECT_EQ(pieces[k].volume.regions, expected[k].volume.regions);
    EXPECT_EQ(pieces[k].volume.input_vertices, expected[k].volume.input_vertices);
    EXPECT_EQ(facets_of(pieces[k]), facets_of(expected[k]));
  }
}

TEST(Partition, PiecesOfPartsEqualThoseOfTheJoinedVolume) {
  expect_pieces_of_parts_equal_those_of_the_joined_volume(small::box());
}

TEST(Partition, VerticesInNoPartAreInTheFirstPiece) {
  Surface surface = small::box();
  surface.vertices.insert(surface.vertices.begin(), Point{7, 7, 7});
  for (Triangle& t : surface.facets)
    for (Index& v : t) ++v;
  surface.vertices.push_back({8, 8, 8});
  expect_pieces_of_parts_equal_those_of_the_joined_volume(surface);
}

}  // namespace
}  // namespace holdfast::partition_test
