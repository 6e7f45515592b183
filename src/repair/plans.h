// Plans for a surface that is not valid after it was cut and rounded. All numbers were found by experiment.
#pragma once

#include <array>
#include <cstddef>

namespace holdfast::repairing {

/// Joins elements within some last bits (of the largest coordinate) of each other, if a surface is still not
/// valid after it was cut and rounded.
struct Plan {
  double last_bits = 0;
  bool moves_input = false;
};
inline constexpr std::array kPlans{
    Plan{0x1p2, false},  Plan{0x1p3, false}, Plan{0x1p4, false}, Plan{0x1p5, false},
    Plan{0x1p6, false},  Plan{0x1p7, false}, Plan{0x1p8, false}, Plan{0x1p9, false},
    Plan{0x1p10, false}, Plan{0x1p8, true},  Plan{0x1p10, true}, Plan{0x1p12, true},
    Plan{0x1p14, true},  Plan{0x1p17, true}, Plan{0x1p20, true}, Plan{0x1p24, true}};

/// Limit in a plane that `flatten` projects. Input vertices must stay there, and giving up does no harm.
inline constexpr double kMostInPlane = 0x1p6;

/// Largest number of facets that joining may make of `facets` facets in a plane. With more, joining does not
/// succeed.
constexpr std::size_t most_in_plane(std::size_t facets) { return 64 + 2 * facets; }

/// Largest number of new points of so many facets in a plane. Facets that lie in each other have some new
/// points each, and a fan whose facets all overlap round its apex has some for each pair. Facets that all
/// cross each other along a line have far more, and take long.
constexpr std::size_t most_points_in_plane(std::size_t facets) { return 20'000 + 32 * facets; }

/// Largest number of pairs of so many facets in a plane that do not fit. Where facets lie in layers upon each
/// other, pairs are hundreds of times as many as points, and only these take long.
constexpr std::size_t most_pairs_in_plane(std::size_t facets) { return 1'000'000 + 8 * facets; }

/// With more new points than this, a plane is given up if most of its facets are in trouble after the first
/// cut: the second cut would take long and have too many points.
constexpr std::size_t many_points_in_plane(std::size_t facets) { return 64 + 32 * facets; }
inline constexpr double kMostInTrouble = 2.0 / 3;  // of the facets

/// Distances, in last bits, within which sheets are made one. In the second set of plans, input vertices as
/// near to each other become one first.
inline constexpr std::array kFlatPlans{Plan{0x1p2, false}, Plan{0x1p6, false}};
inline constexpr std::array kWeldedPlans{Plan{0x1p3, true}, Plan{0x1p6, true}};

inline constexpr std::array kJoinedLastBits{0x1p3, 0x1p6};
inline constexpr std::array kWeldedLastBits{0x1p6,  0x1p8,  0x1p10, 0x1p12, 0x1p14, 0x1p16, 0x1p18,
                                            0x1p20, 0x1p22, 0x1p24, 0x1p26, 0x1p28, 0x1p30, 0x1p32};
/// The same as shares of the tolerance that the user gave.
inline constexpr std::array kPartsOfTolerance{0x1p-12, 0x1p-9, 0x1p-6, 0x1p-3, 1.0};

/// The same for duplicated vertices in trouble: the least distance, and the largest as a share of
/// the extent.
inline constexpr double kTwinsLastBits = 0x1p5, kMostForTwins = 0x1p-40;

/// The widths, in last bits, of the grids to which vertices in trouble are rounded.
inline constexpr std::array kGridLastBits{0x1p8, 0x1p12, 0x1p16, 0x1p20, 0x1p24, 0x1p28};

/// How many comparisons of a vertex with a side or facet joining may make on a surface of so many facets. The
/// largest number for a surface of `make repair` is 3 million, with 1,456 facets. A plan that spends more is
/// given up for the next one: triangles that all cross their neighbours take some plans with much work.
struct MostWork {
  std::size_t once, for_each_facet;
  [[nodiscard]] constexpr std::size_t of(std::size_t facets) const { return once + for_each_facet * facets; }
};
inline constexpr std::size_t kPlansOfMuchWork = 5;
inline constexpr MostWork kMuchWork{8'000'000, 1000}, kLittleWork{1'000'000, 250};

/// Largest number of facets in clusters after a pass of flattening that began with so many. With more, each
/// pass makes new overlaps.
constexpr std::size_t most_in_later_passes(std::size_t facets) { return 1000 + facets; }

/// Largest number of places where sides of bodies pass each other that get a vertex by welding, for so many
/// vertices.
constexpr std::size_t most_passings(std::size_t vertices) { return 1000 + 2 * vertices; }

/// Largest number of facets that joining within the user's distance makes of so many, if much is in trouble
/// after that. With more, the distance is as long as features, and these parts of it are tried.
constexpr std::size_t most_when_joined(std::size_t facets) { return 1000 + 4 * facets; }
inline constexpr std::array kPartsOfJoin{1.0, 0x1p-3, 0x1p-6, 0.0};

/// How many elements in trouble count as few, and as many.
inline constexpr std::size_t kFew = 100, kMany = 400;

}  // namespace holdfast::repairing
