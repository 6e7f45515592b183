// What is tried where a surface is not valid after it was cut and rounded. Found by experiment.
#pragma once

#include <array>
#include <cstddef>

namespace holdfast::repairing {

/// What is joined where a surface is still not valid after it was cut and rounded: what is nearer to each
/// other than some last bits of the largest coordinate.
struct Plan {
  double last_bits = 0;
  bool moves_input = false;
};
inline constexpr std::array kPlans{
    Plan{0x1p2, false},  Plan{0x1p3, false}, Plan{0x1p4, false}, Plan{0x1p5, false},
    Plan{0x1p6, false},  Plan{0x1p7, false}, Plan{0x1p8, false}, Plan{0x1p9, false},
    Plan{0x1p10, false}, Plan{0x1p8, true},  Plan{0x1p10, true}, Plan{0x1p12, true},
    Plan{0x1p14, true},  Plan{0x1p17, true}, Plan{0x1p20, true}, Plan{0x1p24, true}};

/// In a plane that is projected for `flatten`, where vertices of the input must stay, and where it is no loss
/// to give up.
inline constexpr double kMostInPlane = 0x1p6;

/// How many facets joining may make of so many in a plane. Where it makes more, it does not end well.
constexpr std::size_t most_in_plane(std::size_t facets) { return 64 + 2 * facets; }

/// How many new points so many facets in a plane may have. Those that lie in each other have some for each,
/// and a fan whose facets all overlap round its apex has some for each pair. Far more come of facets all of
/// which lie across each other along a line, and take long.
constexpr std::size_t most_points_in_plane(std::size_t facets) { return 20'000 + 32 * facets; }

/// With more points than that, a plane in which most facets are in trouble after the first cut is given up:
/// the second one takes long and has too many points.
constexpr std::size_t many_points_in_plane(std::size_t facets) { return 64 + 32 * facets; }
inline constexpr double kMostInTrouble = 2.0 / 3;  // of the facets

/// Last bits by which sheets that are made one may be apart. In the latter plans vertices of the input that
/// are as near to each other become one before.
inline constexpr std::array kFlatPlans{Plan{0x1p2, false}, Plan{0x1p6, false}};
inline constexpr std::array kWeldedPlans{Plan{0x1p3, true}, Plan{0x1p6, true}};

inline constexpr std::array kJoinedLastBits{0x1p3, 0x1p6};
inline constexpr std::array kWeldedLastBits{0x1p6,  0x1p8,  0x1p10, 0x1p12, 0x1p14, 0x1p16, 0x1p18,
                                            0x1p20, 0x1p22, 0x1p24, 0x1p26, 0x1p28, 0x1p30, 0x1p32};

/// The same where vertices in trouble are there twice: the least, and the most in parts of the extent.
inline constexpr double kTwinsLastBits = 0x1p5, kMostForTwins = 0x1p-40;

/// The widths of grids to whose points the vertices of what is in trouble go, in last bits.
inline constexpr std::array kGridLastBits{0x1p8, 0x1p12, 0x1p16, 0x1p20, 0x1p24, 0x1p28};

/// How many vertices joining may compare with sides and facets, on a surface of so many facets. The most that
/// a surface of `make repair` takes is 3 million, where it has 1,456 facets. A plan that spends more is left,
/// and others come: triangles that all cross their neighbours take some plans with much work.
struct MostWork {
  std::size_t once, for_each_facet;
  [[nodiscard]] constexpr std::size_t of(std::size_t facets) const { return once + for_each_facet * facets; }
};
inline constexpr std::size_t kPlansOfMuchWork = 5;
inline constexpr MostWork kMuchWork{8'000'000, 1000}, kLittleWork{1'000'000, 250};

/// How much in trouble is little, and much.
inline constexpr std::size_t kFew = 100, kMany = 400;

}  // namespace holdfast::repairing
