#include "optimise/search_in_parts.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

#include "mesh/editor.h"
#include "mesh/in_place_parts.h"
#include "mesh/measure.h"
#include "numbers/sorted.h"
#include "optimise/tuning.h"
#include "refine/cuts.h"
#include "refine/tuning.h"

namespace holdfast {
namespace {

class SearchInParts {
 public:
  SearchInParts(Search& search, const std::vector<Tet>& tets, Ways::Points points, std::uint64_t seed,
                const Threads& threads, Monitor& monitor)
      : search_(search),
        mesh_(search.mesh()),
        tets_(tets),
        points_(points),
        seed_(seed),
        threads_(threads),
        monitor_(monitor) {}

  bool run() {
    const Cuts cuts = cuts_by_work();
    if (cuts.part_count() == 1 || !work_off_apart(cuts)) return false;
    work_off_near_cuts();
    std::vector<Agenda> agendas;
    for (Done& done : done_) {
      agendas.push_back(std::move(*done.agenda));
      search_.budget().spend(done.spent);
    }
    search_.agenda().take_over(std::move(agendas));
    try_worst_again();
    return true;
  }

 private:
  // The results of the search of a part.
  struct Done {
    std::optional<Agenda> agenda;
    OptimiseStats stats;
    std::size_t spent = 0;
    std::vector<Vertex> points;  // that were added
    std::vector<Tet> near;       // bad ones at vertices of mixed tetrahedra
  };
  struct Lists {
    std::vector<std::vector<Tet>> of_part;  // tetrahedra to be improved
    std::vector<std::size_t> tets;          // number of all tetrahedra of a part
  };
  // Vertices for the points of a part.
  using Spare = std::vector<Vertex>;

  [[nodiscard]] Cuts cuts_by_work() const {
    std::vector<Cuts::Sample> samples;
    for (std::size_t k = 0; k < tets_.size(); k += 1 + tets_.size() / tuning::kCutSamples) {
      const double q = search_.qualities().of(tets_[k]);
      const std::size_t weight = q >= search_.bad_from().flat ? tuning::kWeightOfFlat
                                 : q >= tuning::kBad          ? tuning::kWeightOfBad
                                                              : 1;
      samples.push_back({centroid(mesh_, tets_[k]), static_cast<double>(weight)});
    }
    return {std::move(samples), levels_for(static_cast<double>(tets_.size()), tuning::kWorthCutting)};
  }

  [[nodiscard]] std::vector<InPlaceParts::PartNumber> parts_of_vertices(const Cuts& cuts) const {
    std::vector<InPlaceParts::PartNumber> part_of(mesh_.vertex_count());
    parallel_ranges(threads_, part_of.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v)
        part_of[v] =
            static_cast<InPlaceParts::PartNumber>(cuts.part_of(mesh_.position(static_cast<Vertex>(v))));
    });
    return part_of;
  }

  // If points may be added: one for each null element of a part, since each removes one at least.
  [[nodiscard]] std::vector<Spare> add_spare_vertices(const std::vector<InPlaceParts::PartNumber>& part_of,
                                                      std::size_t count) {
    std::vector<Spare> spare(count);
    if (points_ != Ways::Points::later) return spare;
    for (const Tet t : tets_)
      if (search_.qualities().of(t) >= search_.bad_from().null)
        spare[part_of[mesh_.corner(t, 0)]].push_back(MeshEditor(mesh_).add_vertex(Point{}));
    return spare;
  }

  [[nodiscard]] std::size_t spare_slots(const std::vector<Spare>& spare) const {
    std::size_t most_points = 0;
    for (const Spare& own : spare) most_points = std::max(most_points, own.size());
    return tuning::kSpareSlots + tets_.size() / (spare.size() * tuning::kTetsASpareSlot) +
           tuning::kSlotsAPoint * most_points;
  }

  // The last vertices of the mesh, as far as they are not used.
  void drop(const std::vector<Spare>& spare) {
    std::vector<Vertex> left;
    for (const Spare& own : spare) left.insert(left.end(), own.begin(), own.end());
    std::sort(left.begin(), left.end());
    for (; !left.empty() && left.back() + 1 == mesh_.vertex_count(); left.pop_back())
      MeshEditor(mesh_).remove_last_vertex();
  }

  // Works on each part by itself, including what is near the cuts as far as possible.
  bool work_off_apart(const Cuts& cuts) {
    const std::size_t count = cuts.part_count();
    const std::vector<InPlaceParts::PartNumber> part_of = parts_of_vertices(cuts);
    std::vector<Spare> spare = add_spare_vertices(part_of, count);
    const bool is_worth_it = work_off_apart(part_of, spare);
    drop(spare);
    return is_worth_it;
  }

  bool work_off_apart(const std::vector<InPlaceParts::PartNumber>& part_of, std::vector<Spare>& spare) {
    const std::size_t count = spare.size();
    const InPlaceParts parts(mesh_, tets_, part_of, count, spare_slots(spare), threads_);
    if (static_cast<double>(parts.mixed().size()) > tuning::kMostMixed * static_cast<double>(tets_.size()))
      return false;
    search_.qualities().make_room();
    const std::map<std::size_t, Lists> lists = bad_by_part(parts, count);

    done_.resize(count);
    parallel_monitored(threads_, count, monitor_, {0, 1},
                       [&](std::size_t k, Monitor& own) { work_off_part(parts, lists, k, spare[k], own); });

    near_ = parts.mixed();
    return true;
  }

  // By the first tetrahedron of a range.
  [[nodiscard]] std::map<std::size_t, Lists> bad_by_part(const InPlaceParts& parts, std::size_t count) const {
    std::mutex mutex;
    std::map<std::size_t, Lists> lists;
    parallel_ranges(threads_, tets_.size(), [&](std::size_t first, std::size_t last) {
      Lists own{std::vector<std::vector<Tet>>(count), std::vector<std::size_t>(count, 0)};
      for (std::size_t k = first; k < last; ++k) {
        const std::size_t part = parts.part_of(tets_[k]);
        if (part >= count) continue;
        ++own.tets[part];
        if (search_.qualities().of(tets_[k]) > search_.elements().good())
          own.of_part[part].push_back(tets_[k]);
      }
      const std::scoped_lock lock(mutex);
      lists[first] = std::move(own);
    });
    return lists;
  }

  void work_off_part(const InPlaceParts& parts, const std::map<std::size_t, Lists>& lists, std::size_t part,
                     Spare& spare, Monitor& monitor) {
    std::size_t tets = 0;
    for (const auto& [first, list] : lists) tets += list.tets[part];
    ElementSearch elements(mesh_, search_.qualities(), search_.first_free(), search_.target(), seed_,
                           Budget(tets, tets_.size()), monitor);
    elements.ways().hold(parts.at_mixed());
    for (const auto& [first, list] : lists) elements.push(list.of_part[part]);
    const auto has_slots = [&] { return parts.spare(part) >= tuning::kSpareSlots; };
    elements.work_off(points_, has_slots);
    Done& done = done_[part];
    done.spent = elements.budget().spent();
    if (!spare.empty()) {
      elements.ways().take_points_from(spare);
      done.spent += elements.work_off_null(has_slots);
    }
    elements.agenda().keep([&](Tet t) {
      if (!mesh_.alive(t)) return false;
      const TetMesh::Corners& c = mesh_.corners(t);
      if (std::none_of(c.begin(), c.end(), [&](Vertex v) { return parts.at_mixed()[v] != 0; })) return true;
      done.near.push_back(t);
      return false;
    });
    done.agenda = std::move(elements.agenda());
    done.stats = elements.stats();
    done.points = std::move(elements.points());
  }

  void work_off_near_cuts() {
    for (const Done& done : done_) {
      search_.stats() += done.stats;
      search_.add_points(done.points);
      near_.insert(near_.end(), done.near.begin(), done.near.end());
    }
    sort_unique(near_);
    const Budget whole = search_.budget();
    search_.budget() = Budget(near_.size(), tets_.size());
    search_.push(near_);
    search_.work_off(points_);
    std::size_t spent = search_.budget().spent();
    if (points_ == Ways::Points::later) spent += search_.work_off_null();
    search_.budget() = whole;
    search_.budget().spend(spent);
  }

  // So far the worst elements of the whole mesh have had no more patience than the worst of each part.
  void try_worst_again() {
    const Budget whole = search_.budget();
    const std::size_t before = whole.spent();
    search_.agenda().try_worst_again(tuning::kWorstTriedAgain);
    search_.budget().fix(tuning::kWorkOnWorst);
    search_.work_off(points_);
    const std::size_t spent = search_.budget().spent() - before;
    search_.budget() = whole;
    search_.budget().spend(spent);
  }

  Search& search_;
  TetMesh& mesh_;
  const std::vector<Tet>& tets_;
  const Ways::Points points_;
  const std::uint64_t seed_;
  const Threads& threads_;
  Monitor& monitor_;
  std::vector<Done> done_;
  std::vector<Tet> near_;
};

}  // namespace

bool work_off_in_parts(Search& search, const std::vector<Tet>& tets, Ways::Points points, std::uint64_t seed,
                       const Threads& threads, Monitor& monitor) {
  return SearchInParts(search, tets, points, seed, threads, monitor).run();
}

}  // namespace holdfast
