#include "optimise/optimise.h"

#include "optimise/fill_anew.h"
#include "optimise/search.h"
#include "optimise/search_in_parts.h"
#include "optimise/shaking.h"
#include "optimise/tuning.h"
#include "optimise/walking.h"

namespace holdfast {

OptimiseStats optimise(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target,
                       const Threads& threads, Monitor& monitor, const OptimiseOptions& options) {
  Search search(mesh, tets, first_free, target, options.seed, threads, monitor);
  // If other elements of their regions are left alone, these elements are few and flat.
  if (options.remove == PointsToRemove::added_here)
    search.budget() = Budget(tuning::kWorkOfFlatTimes * tets.size());
  const std::size_t points_before = search.points().size();
  search.move_points();
  // If points are there for a size, some more do not matter.
  const bool saves_points = options.add_points && options.remove == PointsToRemove::all;
  const Ways::Points points_wanted = !options.add_points ? Ways::Points::none
                                     : saves_points      ? Ways::Points::later
                                                         : Ways::Points::now;
  search.compute(tets);
  // A part could not respect other elements of these regions or points that it adds.
  const bool is_whole = options.remove == PointsToRemove::all && points_wanted != Ways::Points::now;
  if (!is_whole || !work_off_in_parts(search, tets, points_wanted, options.seed, threads, monitor)) {
    search.push(tets);
    search.work_off(points_wanted);
  }
  if (!saves_points || !try_with_points(search)) shake_the_worst(search);
  if (options.remove == PointsToRemove::all) walk_from_the_worst(search);
  remove_points(search, options.remove == PointsToRemove::all ? 0 : points_before);
  if (options.fill_anew != nullptr && saves_points) {
    fill_anew_without_points(search, *options.fill_anew);
    fill_anew_round_the_worst(search, *options.fill_anew);
  }
  return search.stats();
}

}  // namespace holdfast
