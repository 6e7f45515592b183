#include "optimise/optimise.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <random>
#include <tuple>
#include <utility>

#include "mesh/traverse.h"
#include "optimise/badness.h"
#include "optimise/exchange.h"
#include "optimise/insert_point.h"
#include "optimise/qualities.h"
#include "optimise/reconnect.h"
#include "optimise/relocate.h"
#include "optimise/remove_flat.h"
#include "suppress/refill.h"
#include "suppress/shake.h"

namespace holdfast {
namespace {

class Optimiser {
 public:
  Optimiser(TetMesh& mesh, Vertex first_free, double target, const OptimiseOptions& options, Monitor& monitor)
      : mesh_(mesh),
        first_free_(first_free),
        options_(options),
        good_(std::max(kGood, target)),
        bad_from_(bad_from(target)),
        monitor_(monitor),
        qualities_(mesh),
        exchanger_(mesh, qualities_, bad_from_),
        flat_remover_(mesh) {}

  OptimiseStats run(const std::vector<Tet>& tets) {
    budget_ = kLeastWork + kWorkPerTet * tets.size();
    list_points(tets);
    const std::size_t points_before = points_.size();
    relocate_all();
    for (const Tet t : tets) push(t);
    note_others(tets);
    work_off_queue();
    shake_the_worst();
    remove_points(options_.remove == PointsToRemove::all ? 0 : points_before);
    return stats_;
  }

 private:
  struct Entry {
    double quality;
    Tet tet;
    TetMesh::Corners corners;  // a slot may have been given to another tetrahedron since
    friend bool operator<(const Entry& x, const Entry& y) {
      return x.quality != y.quality ? x.quality < y.quality : x.corners > y.corners;
    }
  };

  static BadFrom bad_from(double target) {
    const double hopeless = std::max(kHopeless, kHopelessForTarget * target);
    return {std::max(kFlat, kFlatForTarget * target), hopeless, std::max(kNull, hopeless)};
  }

  // Tetrahedra give way to others of the same region, so that a slot that was not another region's never is.
  void note_others(const std::vector<Tet>& tets) {
    is_others_.resize(mesh_.slot_count());
    for (Tet t = 0; t < mesh_.slot_count(); ++t) is_others_[t] = mesh_.alive(t);
    for (const Tet t : tets) is_others_[t] = false;
  }
  [[nodiscard]] bool is_ours(Tet t) const { return t >= is_others_.size() || !is_others_[t]; }

  void work_off_queue() {
    while ((!queue_.empty() || take_rest()) && !is_spent(queue_.top())) {
      const Entry worst = queue_.top();
      queue_.pop();
      if (is_current(worst)) improve(worst);
      if (!has_flat() && round_ < kRounds) try_again();
    }
  }

  // Elements that are not bad wait beside the heap, which would hold most of the mesh with them, and mostly
  // in vain.
  bool take_rest() {
    if (rest_.empty() || failures_ >= kMostFailures) return false;
    queue_ = std::priority_queue<Entry>({}, std::exchange(rest_, {}));
    takes_all_ = true;
    return true;
  }

  // The worst that is left may go from another mesh round it. What has not helped is undone.
  void shake_the_worst() {
    constexpr int kPatience = 2, kPatienceForFlat = 8;
    constexpr std::size_t kMostTrials = 40, kMostCopied = 1'000'000;
    const std::size_t trials =
        std::min(kMostTrials, kMostCopied / std::max<std::size_t>(1, mesh_.slot_count()));
    int vain = 0;
    for (std::size_t trial = 0; trial < trials; ++trial) {
      std::erase_if(stuck_, [&](const Entry& e) { return !is_current(e); });
      if (stuck_.empty()) return;
      const Entry worst = *std::max_element(stuck_.begin(), stuck_.end());
      if (worst.quality < kBad || vain >= (worst.quality < bad_from_.flat ? kPatience : kPatienceForFlat))
        return;
      const TetMesh mesh_before = mesh_;
      const std::vector<Vertex> points_before = points_;
      const std::vector<Entry> stuck_before = stuck_;
      const OptimiseStats stats_before = stats_;
      shake_and_improve(worst, mesh_before);
      if (is_better_than(mesh_before)) {
        ++stats_.changed;
        vain = 0;
        continue;
      }
      ++vain;
      mesh_ = mesh_before;
      qualities_.forget_all();
      points_ = points_before;
      stuck_ = stuck_before;
      stats_ = stats_before;
    }
  }

  void shake_and_improve(const Entry& worst, const TetMesh& before) {
    constexpr int kShakenEdges = 30;
    constexpr std::size_t kWork = 200;
    Flipper flipper(mesh_, random_);
    shake(
        mesh_, flipper, worst.corners, kShakenEdges, [this](Tet t) { return is_ours(t); }, random_);
    queue_ = {};
    rest_.clear();
    takes_all_ = false;
    qualities_.forget_all();
    for (const Tet t : changed_since(before))
      if (mesh_.alive(t)) push(t);
    round_ = kRounds - 1;
    failures_ = 0;
    worst_stuck_ = std::numeric_limits<double>::infinity();  // no point but for null elements
    budget_ = work_ + kWork;
    is_shaking_ = true;
    work_off_queue();
  }

  [[nodiscard]] std::vector<Tet> changed_since(const TetMesh& before) const {
    const auto is_new = [&](Tet t) {
      return t >= before.slot_count() || before.alive(t) != mesh_.alive(t) ||
             before.corners(t) != mesh_.corners(t);
    };
    std::vector<Tet> changed;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_ours(t) && is_new(t)) changed.push_back(t);
    return changed;
  }

  // No more hopeless elements than before, and the worst of all better; other flat ones are of less account.
  [[nodiscard]] bool is_better_than(const TetMesh& before) const {
    Badness was, is;
    for (const Tet t : changed_since(before)) {
      if (t < before.slot_count() && before.alive(t))
        was.add(quality_of(before, before.corners(t)), bad_from_);
      if (mesh_.alive(t)) is.add(quality_of(mesh_, mesh_.corners(t)), bad_from_);
    }
    return std::tuple(is.null, is.hopeless, is.worst) <
           std::tuple(was.null, was.hopeless, kLeastGain * was.worst);
  }

  // What is worth a point, which comes first, may take most of the budget, and several times as much where it
  // would better the worst of all, or where something has helped of late: heaps go one by one. What is no bad
  // element matters only as the worst of all, until that stays. After a shake nothing is worth more than
  // this.
  [[nodiscard]] bool is_spent(const Entry& e) const {
    if (e.quality < kBad && failures_ >= kMostFailures) return true;
    if (is_shaking_) return work_ >= budget_;
    const std::size_t budget = e.quality >= bad_from_.hopeless ? budget_ : budget_ / kUsualShare;
    const bool is_promising = e.quality >= worst_stuck_ || work_ < work_at_gain_ + kIdle;
    return work_ >= (is_promising ? kTimes * budget : budget);
  }

  [[nodiscard]] bool has_flat() const { return !queue_.empty() && queue_.top().quality >= bad_from_.flat; }

  // Flat tetrahedra that stayed: changes next to them may have made a way, and the search tries another.
  void try_again() {
    ++round_;
    worst_stuck_ = 0;
    std::erase_if(stuck_, [this](const Entry& e) {
      if (e.quality < bad_from_.flat) return false;
      if (is_current(e)) queue_.push(e);
      return true;
    });
  }

  void push(Tet t) {
    const double q = qualities_.of(t);
    if (!(q > good_)) return;
    const Entry entry{q, t, mesh_.corners(t)};
    if (takes_all_ || q >= kBad)
      queue_.push(entry);
    else
      rest_.push_back(entry);
  }
  [[nodiscard]] bool is_current(const Entry& e) {
    return mesh_.alive(e.tet) && mesh_.corners(e.tet) == e.corners && qualities_.of(e.tet) == e.quality;
  }

  void improve(const Entry& e) {
    monitor_.poll(Stage::optimise, static_cast<double>(work_) / static_cast<double>(budget_));
    created_.clear();
    if (try_ways(e))
      work_at_gain_ = work_;
    else
      give_up(e);
    // What did not help may have changed something, too.
    stats_.changed += created_.size();
    qualities_.forget(created_);
    for (const Tet t : created_)
      if (mesh_.alive(t)) push(t);
  }

  // The cheapest way that helps.
  bool try_ways(const Entry& e) {
    if (exchange(e.tet)) return ++stats_.exchanged;
    if (relocate_a_corner(e.tet)) return ++stats_.relocated;
    if (remove_flat(e)) return ++stats_.unflattened;
    if ((is_worth_reconnecting(e) && reconnect_round(e.tet)) ||
        (e.quality >= bad_from_.hopeless && reconnect_patiently(e.tet)))
      return ++stats_.reconnected;
    return options_.add_points && is_worth_a_point(e) && insert_at(e) && ++stats_.inserted;
  }

  // As long as a worse one stays, a point would not better the mesh's worst; but null elements are of no use
  // to anyone.
  [[nodiscard]] bool is_worth_a_point(const Entry& e) const {
    return e.quality >= std::max(bad_from_.hopeless, std::min(worst_stuck_, bad_from_.null));
  }

  void give_up(const Entry& e) {
    worst_stuck_ = std::max(worst_stuck_, e.quality);
    if (e.quality < kBad) ++failures_;
    stuck_.push_back(e);
  }

  void list_points(const std::vector<Tet>& tets) {
    for (const Tet t : tets)
      for (const Vertex v : mesh_.corners(t))
        if (v >= first_free_) points_.push_back(v);
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  void relocate_all() {
    for (const Vertex p : points_)
      if (work_ < budget_ / 2 && relocate_with_ball(p)) ++stats_.relocated;
    stats_.changed += created_.size();
    created_.clear();
  }

  bool exchange(Tet t) {
    ++work_;
    return exchanger_.improve(t, created_);
  }

  bool relocate_a_corner(Tet t) {
    const TetMesh::Corners corners = mesh_.corners(t);
    return std::any_of(corners.begin(), corners.end(),
                       [&](Vertex p) { return p >= first_free_ && relocate_with_ball(p); });
  }

  bool relocate_with_ball(Vertex p) {
    constexpr std::size_t kMostBall = 200;
    std::vector<Tet> tets;
    ball(mesh_, p, tets);
    if (tets.size() > kMostBall) return false;
    work_ += tets.size() / 2;
    if (!relocate(mesh_, p, tets, random_)) return false;
    created_.insert(created_.end(), tets.begin(), tets.end());
    return true;
  }

  // What is not flat matters here only as the worst of all.
  bool remove_flat(const Entry& e) {
    if (e.quality < std::min(bad_from_.flat, worst_stuck_)) return false;
    const bool removed = flat_remover_.remove(e.tet, bad_from_.limit_for(e.quality), created_);
    work_ += flat_remover_.work();
    return removed;
  }

  // A search is long and seldom finds anything: as long as it does so now and then, but always for what
  // would better the worst of all, or else get a point.
  [[nodiscard]] bool is_worth_reconnecting(const Entry& e) const {
    constexpr int kMostInVain = 3, kMostInVainForFlat = 12;
    if (e.quality >= worst_stuck_ || is_worth_a_point(e)) return true;
    return reconnections_in_vain_ < (e.quality >= kWorthReconnecting ? kMostInVainForFlat : kMostInVain);
  }

  bool reconnect_round(Tet t) {
    constexpr std::size_t kWork = 50;
    work_ += kWork;
    const bool reconnected = reconnect(mesh_, t, first_free_, bad_from_, false, random_, created_);
    reconnections_in_vain_ = reconnected ? 0 : reconnections_in_vain_ + 1;
    return reconnected;
  }

  // A point is worth some milliseconds, a few times.
  bool reconnect_patiently(Tet t) {
    constexpr std::size_t kWork = 200;
    constexpr int kMostPatient = 4;
    if (++patient_ > kMostPatient) return false;
    work_ += kWork;
    return reconnect(mesh_, t, first_free_, bad_from_, true, random_, created_);
  }

  bool insert_at(const Entry& e) {
    constexpr std::size_t kWork = 20;
    work_ += kWork;
    const double most = e.quality < bad_from_.null ? bad_from_.hopeless : bad_from_.null;
    const Vertex p = insert_point(mesh_, e.tet, first_free_, most, created_);
    if (p == kNone) return false;
    points_.push_back(p);
    relocate_with_ball(p);
    return true;
  }

  // Points that the mesh can do without now, as long as nothing comes of it that is worth a point: as long
  // as a worse one stays, that is nothing but null elements.
  void remove_points(std::size_t from) {
    if (from == points_.size()) return;
    constexpr std::size_t kWork = 30;
    const double limit = std::max(bad_from_.flat, std::min(worst_of_all(), bad_from_.null));
    Growth growth{.attempts = 2, .steps = 6, .search = {.most_vertices = 18, .most_nodes = 60}};
    for (std::size_t k = from; k < points_.size(); ++k) {
      const Vertex p = points_[k];
      if (!mesh_.in_mesh(p)) continue;
      if (work_ > budget_ + kLeastWork) return;
      work_ += kWork;
      created_.clear();
      ball(mesh_, p, created_);
      growth.search.worst_quality = std::max(limit, badness_of(mesh_, created_, bad_from_).worst);
      if (!refill_without(mesh_, p, first_free_, growth, random_)) continue;
      ++stats_.removed;
      ++stats_.changed;
    }
  }

  [[nodiscard]] double worst_of_all() {
    double worst = 0;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (mesh_.alive(t) && is_ours(t)) worst = std::max(worst, qualities_.of(t));
    return worst;
  }

  // The paper's Q: of what is left alone, of bad elements, of what is worth a search, of what counts as flat,
  // as hopeless and as null.
  static constexpr double kGood = 2, kBad = 30, kWorthReconnecting = 200;
  static constexpr double kFlat = 100, kFlatForTarget = 2, kHopeless = 1000, kHopelessForTarget = 30,
                          kNull = 1e10;
  static constexpr int kRounds = 3, kMostFailures = 12;
  // In exchanges tried, some 10 microseconds each.
  static constexpr std::size_t kLeastWork = 1200, kWorkPerTet = 4;
  static constexpr std::size_t kUsualShare = 4;  // of the work for what is not worth a point
  static constexpr std::size_t kTimes = 10;      // as much for what is promising
  static constexpr std::size_t kIdle = 300;      // without a gain, until nothing is

  TetMesh& mesh_;
  const Vertex first_free_;
  const OptimiseOptions options_;
  const double good_;
  const BadFrom bad_from_;
  Monitor& monitor_;
  Qualities qualities_;
  Exchanger exchanger_;
  FlatRemover flat_remover_;
  std::mt19937_64 random_;
  std::vector<bool> is_others_;
  std::priority_queue<Entry> queue_;
  std::vector<Entry> rest_;
  bool takes_all_ = false, is_shaking_ = false;
  std::vector<Entry> stuck_;
  std::vector<Vertex> points_;  // all that may move, and some that are gone
  double worst_stuck_ = 0;      // in this round
  int round_ = 0, failures_ = 0, reconnections_in_vain_ = 0, patient_ = 0;
  std::vector<Tet> created_;  // or changed
  std::size_t work_ = 0, work_at_gain_ = 0, budget_ = 0;
  OptimiseStats stats_;
};

}  // namespace

OptimiseStats optimise(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target,
                       Monitor& monitor, const OptimiseOptions& options) {
  return Optimiser(mesh, first_free, target, options, monitor).run(tets);
}

}  // namespace holdfast
