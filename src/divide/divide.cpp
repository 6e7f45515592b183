// A surface in parts: mesh coarsely, bisect the work, mesh coarsely except for the walls, cut there.
#include "holdfast/divide.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "divide/bisection.h"
#include "divide/centre.h"
#include "divide/labels.h"
#include "divide/part_surfaces.h"
#include "divide/seeds.h"
#include "divide/wanted_size.h"
#include "holdfast/io.h"
#include "numbers/float_environment.h"
#include "numbers/vector.h"
#include "size/tuning.h"

namespace holdfast {
namespace division {
namespace {

/// Growth of sizes per unit of length away from the surface and the walls, where no element is kept.
constexpr double kCoarse = 1;
/// Around walls, this many layers of elements are as fine as in the parts.
constexpr double kLayers = 2;
/// The number of regular tetrahedra with edges of length one in a unit of volume.
constexpr double kTetrahedra = 8.48528137423857;
/// Of the work of a part.
constexpr double kSamples = 200;
constexpr int kMostHalvings = 40;

/// A failure inside a step.
struct Ended {
  Outcome outcome;
  std::string message;
  std::vector<Defect> defects;
};

class Divider {
 public:
  Divider(const Complex& complex, const DivideOptions& options) : complex_(complex), options_(options) {}

  SurfaceDivision run() {
    SurfaceDivision division;
    try {
      divide(division);
    } catch (Ended& ended) {
      division = {};
      division.outcome = ended.outcome;
      division.message = std::move(ended.message);
      division.defects = std::move(ended.defects);
    }
    return division;
  }

 private:
  void divide(SurfaceDivision& division) {
    const WantedSize wanted(complex_, tuning::kGradation, coarse_limit());
    const double in_all = expected(wanted);
    const std::size_t parts = sensible_parts(in_all);
    const Bisection cells(work(wanted, in_all / (kSamples * static_cast<double>(parts))), parts);
    coarse_ = {};
    const Result fine = mesh_near(wanted, cells);
    const std::vector<Neighbours> beside = neighbours(fine.volume.tetrahedra);
    const std::vector<Index> labels = label(fine.volume, beside, cells);
    division.interface_marker = free_marker();
    std::vector<CutSurface> surfaces = part_surfaces(fine.volume, beside, labels, division.interface_marker);
    std::vector<double> tetrahedra(surfaces.size(), 0);
    for (std::size_t t = 0; t < labels.size(); ++t)
      tetrahedra[labels[t]] += expected(fine.volume, fine.volume.tetrahedra[t], wanted);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      seed(surfaces[k], 0.6 + 0.4 * static_cast<double>(k) / static_cast<double>(surfaces.size()));
      surfaces[k].part.tetrahedra = tetrahedra[k];
      if (complex_.names != nullptr) surfaces[k].part.surface.names = *complex_.names;
      division.parts.push_back(std::move(surfaces[k].part));
    }
  }

  // A mesh that shows where the volume and its regions are, so that sizes by region become sizes by place.
  std::function<double(const Point&)> coarse_limit() {
    Options options = options_of_mesh(0, 0.25);
    options.sizes->gradation = kCoarse;
    options.effort = Effort::fast;
    coarse_ = run_mesh(complex_, options).volume;
    const double size = options_.size > 0 ? options_.size : std::numeric_limits<double>::infinity();
    std::map<int, double> of_region;
    for (const RegionSeed& seed : options_.regions)
      if (seed.size > 0) {
        const auto [at, is_new] = of_region.try_emplace(seed.id, seed.size);
        if (!is_new) at->second = std::min(at->second, seed.size);
      }
    if (of_region.empty()) return [size](const Point&) { return size; };
    const auto field = size_function(sizes_by_region(of_region, size));
    return [field, size](const Point& p) {
      const double h = field(p);
      return h > 0 ? std::min(h, size) : size;
    };
  }

  // Each tetrahedron of the coarse mesh gets the size of its region; vertices are not shared between regions.
  SizeField sizes_by_region(const std::map<int, double>& of_region, double size) const {
    constexpr double kAny = 1e300;
    SizeField field;
    std::map<std::pair<Index, int>, Index> number;
    for (std::size_t t = 0; t < coarse_.tetrahedra.size(); ++t) {
      const int region = coarse_.regions[t];
      const auto known = of_region.find(region);
      const double h = std::min({known == of_region.end() ? kAny : known->second, size, kAny});
      Tetrahedron corners{};
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [at, is_new] =
            number.try_emplace({coarse_.tetrahedra[t][k], region}, static_cast<Index>(field.vertices.size()));
        if (is_new) {
          field.vertices.push_back(coarse_.vertices[coarse_.tetrahedra[t][k]]);
          field.sizes.push_back(h);
        }
        corners[k] = at->second;
      }
      field.tetrahedra.push_back(corners);
    }
    return field;
  }

  double expected(const WantedSize& wanted) const {
    double sum = 0;
    for (const Tetrahedron& t : coarse_.tetrahedra) sum += expected(coarse_, t, wanted);
    return sum;
  }

  // A part has a tetrahedron at least; without this bound, the work would be cut into pieces without end.
  std::size_t sensible_parts(double tetrahedra) const {
    require_few_enough(tetrahedra / static_cast<double>(options_.parts));
    return static_cast<double>(options_.parts) <= tetrahedra
               ? options_.parts
               : static_cast<std::size_t>(std::max(1.0, tetrahedra));
  }

  // By tetrahedra with at most so much of the work each: the coarse ones may be large compared with the
  // parts.
  std::vector<division::Work> work(const WantedSize& wanted, double most) const {
    std::vector<division::Work> result;
    for (const Tetrahedron& t : coarse_.tetrahedra)
      add_work(corners_of(coarse_, t), wanted, most, kMostHalvings, result);
    return result;
  }

  // Same limit as in `mesh`, which would refuse the parts: with parts this fine, their interfaces would take
  // all memory.
  static void require_few_enough(double tetrahedra_of_part) {
    constexpr double kMost = 1u << 30, kLeastMade = 0.1;
    if (!(kLeastMade * tetrahedra_of_part < kMost))
      throw std::length_error(
          "the size asked for takes more than 2^30 tetrahedra in a part; a larger one, or another unit of "
          "length, or more parts are needed");
  }

  using Corners = std::array<Point, 4>;
  static Corners corners_of(const Volume& v, const Tetrahedron& t) {
    return {v.vertices[t[0]], v.vertices[t[1]], v.vertices[t[2]], v.vertices[t[3]]};
  }

  static void add_work(const Corners& corners, const WantedSize& wanted, double most, int halvings,
                       std::vector<division::Work>& result) {
    const Point middle = centre(corners);
    const double amount = expected(corners, wanted);
    if (amount <= most || halvings == 0) {
      result.push_back({middle, amount});
      return;
    }
    std::size_t a = 0, b = 1;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = i + 1; k < 4; ++k)
        if (distance(corners[i], corners[k]) > distance(corners[a], corners[b])) a = i, b = k;
    Corners half = corners, other = corners;
    for (std::size_t x = 0; x < 3; ++x) half[a][x] = other[b][x] = corners[a][x] / 2 + corners[b][x] / 2;
    add_work(half, wanted, most, halvings - 1, result);
    add_work(other, wanted, most, halvings - 1, result);
  }

  static double expected(const Volume& v, const Tetrahedron& t, const WantedSize& wanted) {
    return expected(corners_of(v, t), wanted);
  }
  static double expected(const Corners& c, const WantedSize& wanted) {
    const double h = wanted(centre(c));
    return dot(cross(c[1] - c[0], c[2] - c[0]), c[3] - c[0]) / 6 * kTetrahedra / (h * h * h);
  }

  Result mesh_near(const WantedSize& wanted, const Bisection& cells) {
    Options options = options_of_mesh(0.25, 0.6);
    options.sizes->gradation = kCoarse;
    options.sizes->concurrent = true;
    options.sizes->field = [&](const Point& p) {
      const double h = wanted(p), away = cells.distance_to_wall(p);
      return h + kCoarse * std::max(0.0, away - kLayers * h);
    };
    return run_mesh(complex_, options);
  }

  void seed(CutSurface& surface, double share) {
    Options options = options_of_mesh(share, share);
    options.sizes.reset();
    options.optimise = false;
    options.add_points = false;
    options.keep = Keep::bounded;
    options.holes.clear();
    options.regions.clear();
    options.drop_outside = false;
    const Outcome outcome = add_seeds(surface, options_.regions, options_.size, options);
    if (outcome != Outcome::done) throw Ended{outcome, "a part could not be filled", {}};
  }

  Options options_of_mesh(double from, double to) const {
    Options options;
    static_cast<Limits&>(options) = options_;
    options.sizes = Sizes{};
    options.keep = options_.keep;
    options.holes = options_.holes;
    options.regions = options_.regions;
    for (RegionSeed& seed : options.regions) seed.size = seed.max_volume = 0;
    options.drop_outside = options_.drop_outside;
    options.seed = options_.seed;
    options.threads = options_.threads;
    if (options_.progress)
      options.progress = [this, from, to](const Progress& p) {
        return options_.progress(from + (to - from) * p.overall);
      };
    return options;
  }

  static Result run_mesh(const Complex& complex, const Options& options) {
    Result result = mesh(complex, options);
    if (result.outcome != Outcome::done)
      throw Ended{result.outcome, std::move(result.message), std::move(result.defects)};
    return result;
  }

  [[nodiscard]] int free_marker() const {
    const auto& markers = complex_.facet_markers;
    const int most = markers.empty() ? 0 : std::max(0, *std::max_element(markers.begin(), markers.end()));
    if (most == std::numeric_limits<int>::max())
      throw std::invalid_argument(
          "a facet has the largest marker that there is; interfaces need one above it");
    return most + 1;
  }

  const Complex& complex_;
  const DivideOptions& options_;
  Volume coarse_;
};

}  // namespace
}  // namespace division

SurfaceDivision divide(const Complex& complex, const DivideOptions& options) {
  const FloatEnvironment environment;
  if (options.parts == 0) throw std::invalid_argument("a surface is divided into one part or more");
  if (options.keep == Keep::box) throw std::invalid_argument("a surface in a box cannot be divided");
  DivideOptions timed = options;
  if (!timed.started) timed.started = std::chrono::steady_clock::now();
  return division::Divider(complex, timed).run();
}

}  // namespace holdfast
