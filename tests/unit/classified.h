// A surface meshed up to its regions, for tests of what is kept.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "classify/keep.h"
#include "classify/regions.h"
#include "delaunay/delaunay.h"
#include "enforce/enforce.h"
#include "mesh/editor.h"
#include "recover/standing.h"
#include "small_surfaces.h"
#include "surface/complex.h"

namespace holdfast::testing {

// A surface, the mesh that conforms to it in a box from -9 to 9, and the mesh's regions.
struct Classified {
  Surface surface;
  SegmentTable table;
  TetMesh mesh;
  Regions regions;

  inline explicit Classified(Surface s, int scale = 0)
      : surface(std::move(s)), table(segment_table(surface.view())) {
    const auto add = [&](const Point& p) {
      MeshEditor(mesh).add_vertex(
          Point{std::ldexp(p[0], scale), std::ldexp(p[1], scale), std::ldexp(p[2], scale)});
    };
    for (const Point& p : surface.vertices) add(p);
    for (const Point& p : small::box({-9, -9, -9}, {9, 9, 9}).vertices) add(p);
    const auto first_free = static_cast<Vertex>(mesh.vertex_count());
    EXPECT_TRUE(build_delaunay(mesh, {}, nullptr));
    Standing standing = mark_present(mesh, table);
    const Options options;
    Monitor monitor(options);
    enforce(mesh, {table, surface.facets, standing}, first_free, {.seed = 1}, monitor);
    regions = find_regions(mesh, surface.facets);
  }

  [[nodiscard]] Kept choose(const Options& options, int scale = 0) const {
    const Wanted wanted{options.keep, options.holes, options.regions, options.drop_outside};
    return choose_regions(mesh, regions, {surface.view(), table}, wanted, scale);
  }
  [[nodiscard]] Kept choose(Keep keep) const {
    Options options;
    options.keep = keep;
    return choose(options);
  }
  [[nodiscard]] Located at(const Point& p) const { return locate(mesh, regions, {p.data(), nullptr}); }
};

}  // namespace holdfast::testing
