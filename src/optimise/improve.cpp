#include "optimise/improve.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "optimise/thin_out.h"
#include "optimise/tuning.h"
#include "optimise/ways_for_energy.h"

namespace holdfast {
namespace {

// Part of the elements that points may add beyond the limit on growth in patient rounds.
constexpr double kPartForTheWorst = 0.01;

class Improver {
 public:
  Improver(const VolumeData& volume, const tuning::Passes& passes, std::span<const std::uint8_t> spared,
           std::span<const std::uint8_t> fresh, Monitor& monitor)
      : mesh_(volume.mesh),
        volume_(volume, fresh, Threads(1).polling([&monitor] { monitor.poll_again(); }), passes.hopeless_sine,
                passes.saturation),
        passes_(passes),
        spared_(spared),
        monitor_(monitor),
        ways_(volume_, passes_.patient_aim),
        thinner_(volume_, fresh, [this] { poll(0); }),
        most_inserted_(
            static_cast<std::size_t>(passes_.inserted_per_tet * static_cast<double>(mesh_.tet_count()))) {}

  /// From now on, no figure may become worse.
  void keep(const Figures& figures) { volume_.keep(figures); }
  /// From now on, many bad elements may be left.
  void be_brief() { is_brief_ = true; }
  /// Points will be removed where that costs little, until only this part of the present tetrahedra is left;
  /// unless it is brief, only if more than the other part is bad.
  void thin_out(double least_part, double most_cost, double part_of_bad) {
    least_tets_ = thinner_.tets_where_left(least_part);
    most_cost_ = most_cost;
    part_of_bad_ = part_of_bad;
  }
  /// From now on, points are added only while the number of new elements is below this part of the present
  /// ones.
  void grow_at_most(double part) {
    std::size_t inside = 0;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (volume_.is_inside(t)) ++inside;
    const auto now = static_cast<double>(inside);
    most_tets_ = tets() + part * now;
    for_the_worst_ = kPartForTheWorst * now;
  }
  /// Progress is reported as this part of the stage's progress.
  void tell_as(std::array<double, 2> work) { work_ = work; }

  ImproveStats run() {
    const int steps = passes_.passes + passes_.rounds;
    for (int pass = 0; pass < passes_.passes || (pass < most_passes() && has_many_bad()); ++pass) {
      stage_ = {static_cast<double>(pass) / steps, 1.0 / steps};
      swap_pass();
      smooth_pass();
    }
    const double bad = share_of_bad();
    stats_.was_brief = is_brief_ && bad > tuning::kBrief.many_bad;
    if (stats_.was_brief) {
      work_briefly();
    } else {
      work_in_rounds(steps);
      if (!is_brief_ && bad > part_of_bad_) stats_.was_thinned = thin();
    }
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, stats_.worst)) stats_.worst = volume_.energy(t);
    return stats_;
  }

 private:
  using Patience = EnergyWays::Patience;
  using First = tuning::First;

  void work_in_rounds(int steps) {
    for (int round = 0; round < passes_.rounds; ++round) {
      stage_ = {static_cast<double>(passes_.passes + round) / steps, 1.0 / steps};
      if (passes_.points_must_pay) stats_.contracted += thinner_.run(0, tuning::kCostOfWhatMustGo);
      volume_.touch_all();
      if (!work_on_single_ones(passes_.aim, work(1), passes_.first, Patience::usual)) break;
    }
    if (passes_.aim_of_mild > 0) work_on_mild_ones();
    if (passes_.first != First::the_worst)
      work_on_single_ones(passes_.aim, work(passes_.share_of_the_worst), First::the_worst, Patience::usual);
    // The very worst are few: they get as many rounds as help, and points of their own.
    most_tets_ += for_the_worst_;
    volume_.judge_by(tuning::kHopelessSine);
    volume_.touch_all();
    for (int round = 0; round < passes_.patient_rounds * passes_.rounds; ++round) {
      volume_.touch_beside_touched();
      if (!work_on_single_ones(patient_aim(), work(tuning::kPatientShare), First::the_worst,
                               Patience::all_ways))
        break;
    }
  }

  void work_on_mild_ones() {
    volume_.touch_all();
    const double work = passes_.least_work + passes_.work_of_mild_per_tet * tets();
    work_on_single_ones(passes_.aim_of_mild, work, First::the_mildest, Patience::usual);
  }

  // Facets force most of the bad elements and make points useless. So this works only on elements that show
  // in figures and on the very worst.
  void work_briefly() {
    const tuning::Brief& brief = tuning::kBrief;
    thin();
    volume_.touch_all();
    work_on_single_ones(patient_aim(), brief.least_patient_work + brief.patient_work_per_tet * tets(),
                        First::the_worst, Patience::all_ways);
  }

  // Returns whether any points are removed.
  bool thin() {
    const std::size_t gone = thinner_.run(least_tets_, most_cost_);
    if (gone == 0) return false;
    stats_.contracted += gone;
    swap_pass();
    smooth_pass();
    return true;
  }

  [[nodiscard]] int most_passes() const {
    return is_brief_ ? tuning::kBrief.most_passes : tuning::kMostPasses;
  }
  [[nodiscard]] double tets() const { return static_cast<double>(mesh_.tet_count()); }
  /// The work of a round with this part of the usual work.
  [[nodiscard]] double work(double part) const {
    return passes_.least_work + part * passes_.work_per_tet * tets();
  }
  [[nodiscard]] double patient_aim() const { return passes_.patient_aim + tuning::kBeyondPatientAim; }

  struct Entry {
    double rank;
    Tet tet;
    friend bool operator<(const Entry& x, const Entry& y) {
      return x.rank != y.rank ? x.rank < y.rank : x.tet > y.tet;
    }
  };

  void poll(double fraction) {
    const double done = stage_[0] + stage_[1] * fraction;
    monitor_.poll(Stage::optimise, work_[0] + (work_[1] - work_[0]) * done);
  }

  // Whether t is worse than `from` and so is to be worked on.
  [[nodiscard]] bool is_worse(Tet t, double from) const {
    return volume_.energy(t) > from && volume_.is_inside(t) && !is_spared(t);
  }
  [[nodiscard]] bool is_spared(Tet t) const {
    const TetMesh::Corners& c = mesh_.corners(t);
    return std::any_of(c.begin(), c.end(), [&](Vertex v) { return v < spared_.size() && spared_[v] != 0; });
  }

  void swap_pass() {
    const double from = volume_.energy_of_sine(passes_.sine);
    const auto count = static_cast<double>(mesh_.slot_count());
    // Slots that are filled during the pass are visited again, in this pass or the next.
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!is_worse(t, from) || !volume_.take_changed(t)) continue;
      poll(0.5 * t / count);
      if (ways_.swap_as_worst(t)) ++stats_.swapped;
    }
  }

  void smooth_pass() {
    const double from = volume_.energy_of_sine(passes_.smooth_sine);
    std::vector<std::uint8_t> bad(mesh_.vertex_count(), 0);
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, from))
        for (const Vertex v : mesh_.corners(t)) bad[v] = 1;
    for (Vertex v = volume_.first_free(); v < mesh_.vertex_count(); ++v) {
      if (bad[v] == 0 || !mesh_.in_mesh(v) || !volume_.take_touched(v)) continue;
      poll(0.5 + 0.5 * v / static_cast<double>(mesh_.vertex_count()));
      if (ways_.smooth(v)) ++stats_.moved;
    }
  }

  // So many that passes are faster.
  [[nodiscard]] bool has_many_bad() const { return share_of_bad() > tuning::kManyBad; }
  [[nodiscard]] double share_of_bad() const {
    const double from = volume_.energy_of_sine(passes_.aim);
    std::size_t bad = 0;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_worse(t, from)) ++bad;
    return static_cast<double>(bad) / tets();
  }

  // Nothing forces elements that touch no constraint. Where these are a good part of the volume and too many
  // of them are bad, more work pays. Where most elements touch a constraint, it hardly does.
  [[nodiscard]] bool has_many_bad_inside() const {
    std::size_t inside = 0, bad = 0;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!volume_.is_inside(t) || touches_a_constraint(t)) continue;
      ++inside;
      if (is_worse(t, volume_.energy_of_sine(tuning::kSineOfBad))) ++bad;
    }
    const auto all = static_cast<double>(mesh_.tet_count());
    return static_cast<double>(inside) > tuning::kMuchInside * all &&
           static_cast<double>(bad) > tuning::kManyBadInside * all;
  }
  [[nodiscard]] bool touches_a_constraint(Tet t) const {
    const TetMesh::Corners& c = mesh_.corners(t);
    return std::any_of(c.begin(), c.end(), [&](Vertex v) { return !volume_.may_move(v); });
  }

  [[nodiscard]] double rank_of(Tet t, First first) const {
    return first == First::the_worst ? volume_.energy(t) : -volume_.energy(t);
  }

  // Works on single elements as long as work is left. Returns whether any became better.
  bool work_on_single_ones(double aim, double share, First first, Patience patience) {
    const double from = volume_.energy_of_sine(aim);
    std::priority_queue<Entry> queue;
    const auto rank = [&](Tet t) { return rank_of(t, first); };
    const auto push = [&](Tet t) {
      if (is_worse(t, from)) queue.push({rank(t), t});
    };
    for (Tet t = 0; t < mesh_.slot_count(); ++t) push(t);
    const double count = 1 + static_cast<double>(queue.size());
    double work = 0, budget = share;
    ways_.points_must_pay(passes_.points_must_pay && patience != Patience::all_ways);
    if (patience == Patience::usual && has_many_bad_inside()) patience = Patience::contractions;
    bool any = false;
    while (!queue.empty()) {
      if (work >= budget) {
        if (patience == Patience::all_ways || budget >= passes_.most_shares * share || !has_many_bad_inside())
          break;
        budget += share;
      }
      const Entry next = queue.top();
      queue.pop();
      if (!volume_.is_inside(next.tet) || rank(next.tet) != next.rank) continue;
      if (!volume_.take_changed(next.tet)) continue;
      poll(std::max(work / budget, 1 - std::min(1.0, static_cast<double>(queue.size()) / count)));
      ways_.allow_points(volume_.may_add() && stats_.inserted < most_inserted_ && tets() < most_tets_);
      const EnergyWays::Outcome outcome = ways_.try_all(next.tet, patience, work);
      if (outcome.changed.empty()) continue;
      any = true;
      ++(stats_.*outcome.count);
      for (const Tet t : outcome.changed) push(t);
    }
    return any;
  }

  TetMesh& mesh_;
  ImprovedVolume volume_;
  const tuning::Passes passes_;
  const std::span<const std::uint8_t> spared_;  // by vertex
  Monitor& monitor_;
  EnergyWays ways_;
  Thinner thinner_;
  const std::size_t most_inserted_;
  double least_tets_ = 0, most_cost_ = 0, part_of_bad_ = 1;
  double most_tets_ = std::numeric_limits<double>::infinity(), for_the_worst_ = 0;
  std::array<double, 2> stage_{}, work_{0, 1};
  bool is_brief_ = false;
  ImproveStats stats_;
};

}  // namespace

ImproveStats improve(const VolumeData& volume, Extent extent, Monitor& monitor,
                     std::span<const std::uint8_t> spared, std::span<const std::uint8_t> fresh) {
  Improver improver(volume, tuning::passes_of(extent.effort), spared, fresh, monitor);
  if (extent.is_brief) improver.be_brief();
  if (extent.is_brief || extent.least_part < 1)
    improver.thin_out(extent.least_part, extent.most_cost, extent.part_of_bad);
  if (extent.most_growth < std::numeric_limits<double>::infinity()) improver.grow_at_most(extent.most_growth);
  return improver.run();
}

ImproveStats improve_further(const VolumeData& volume, Extent extent, const std::optional<Figures>& figures,
                             std::array<double, 2> work, Monitor& monitor,
                             std::span<const std::uint8_t> spared, std::span<const std::uint8_t> fresh) {
  Improver improver(volume, tuning::further_passes_of(extent.effort, extent.lowers_shares), spared, fresh,
                    monitor);
  improver.tell_as(work);
  improver.grow_at_most(extent.most_growth);
  if (figures) improver.keep(*figures);
  return improver.run();
}

}  // namespace holdfast
