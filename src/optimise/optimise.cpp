#include "optimise/optimise.h"

#include <algorithm>
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
        flat_remover_(mesh),
        random_(options.seed) {}

  OptimiseStats run(const std::vector<Tet>& tets) {
    now_.budget = kLeastWork + kWorkPerTet * tets.size();
    now_.usual_budget = std::min(now_.budget / kUsualShare, kMostUsual);
    list_points(tets);
    const std::size_t points_before = now_.points.size();
    relocate_all();
    for (const Tet t : tets) push(t);
    note_others(tets);
    // Where points stand for a size, some more do not matter.
    saves_points_ = options_.add_points && options_.remove == PointsToRemove::all;
    work_off_queue();
    if (!std::exchange(saves_points_, false) || !try_with_points()) shake_the_worst();
    remove_points(options_.remove == PointsToRemove::all ? 0 : points_before);
    return now_.stats;
  }

 private:
  struct Entry {
    double quality;
    Tet tet;
    TetMesh::Corners corners;  // a slot may have been given to another tetrahedron since
    friend bool operator<(const Entry& x, const Entry& y) {
      return std::tie(x.quality, y.corners, y.tet) < std::tie(y.quality, x.corners, x.tet);
    }
  };

  // All that the search changes but for its patience.
  struct State {
    std::priority_queue<Entry> queue;
    std::vector<Entry> rest;
    bool takes_all = false, is_shaking = false;
    std::vector<Entry> stuck;
    std::vector<Vertex> points;  // all that may move, and some that are gone
    double worst_stuck = 0;      // in this round
    int round = 0, failures = 0;
    std::size_t work = 0, work_at_gain = 0, budget = 0;
    std::size_t usual_budget = 0;  // for what is not worth a point
    OptimiseStats stats;
  };
  struct Snapshot {
    TetMesh mesh;
    State state;
  };

  void restore(const Snapshot& snapshot) {
    mesh_ = snapshot.mesh;
    now_ = snapshot.state;
    qualities_.forget_all();
    ++now_.stats.changed;
  }

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

  // What has nothing else left gets points. They stay if they are worth it.
  bool try_with_points() {
    const Badness without = badness_of_all();
    if (without.hopeless == 0 || !may_points_be_worth_it(without)) return false;
    const Snapshot before{mesh_, now_};
    for (const Entry& e : std::exchange(now_.stuck, {}))
      if (is_current(e)) now_.queue.push(e);
    now_.worst_stuck = 0;
    now_.round = now_.failures = 0;
    now_.usual_budget = std::min(now_.usual_budget, kMostUsualAgain);
    now_.work = now_.work_at_gain = 0;
    work_off_queue();
    shake_the_worst();
    if (are_points_worth_it(before, without)) return true;
    restore(before);
    return false;
  }

  void work_off_queue() {
    while ((!now_.queue.empty() || take_rest()) && !is_spent(now_.queue.top())) {
      const Entry worst = now_.queue.top();
      now_.queue.pop();
      if (is_current(worst)) improve(worst);
      if (!has_flat() && now_.round < kRounds) try_again();
    }
  }

  // Elements that are not bad wait beside the heap, which would hold most of the mesh with them, and mostly
  // in vain.
  bool take_rest() {
    if (now_.rest.empty() || now_.failures >= kMostFailures) return false;
    now_.queue = std::priority_queue<Entry>({}, std::exchange(now_.rest, {}));
    now_.takes_all = true;
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
      std::erase_if(now_.stuck, [&](const Entry& e) { return !is_current(e); });
      if (now_.stuck.empty()) return;
      const Entry worst = *std::max_element(now_.stuck.begin(), now_.stuck.end());
      if (worst.quality < kBad || vain >= (worst.quality < bad_from_.flat ? kPatience : kPatienceForFlat))
        return;
      const Snapshot before{mesh_, now_};
      shake_and_improve(worst, before.mesh);
      if (is_better_than(before.mesh)) {
        ++now_.stats.changed;
        vain = 0;
        continue;
      }
      ++vain;
      restore(before);
    }
  }

  void shake_and_improve(const Entry& worst, const TetMesh& before) {
    constexpr int kShakenEdges = 30;
    constexpr std::size_t kWork = 200;
    Flipper flipper(mesh_, random_);
    shake(
        mesh_, flipper, worst.corners, kShakenEdges, [this](Tet t) { return is_ours(t); }, random_);
    now_.queue = {};
    now_.rest.clear();
    now_.takes_all = false;
    qualities_.forget_all();
    for (const Tet t : changed_since(before))
      if (mesh_.alive(t)) push(t);
    now_.round = kRounds - 1;
    now_.failures = 0;
    now_.budget = now_.work + kWork;
    now_.is_shaking = true;
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

  // Points take hopeless elements away, one or two each: so without null ones, the worst gets better as many
  // times as it is worse than hopeless, or little more.
  [[nodiscard]] bool may_points_be_worth_it(const Badness& was) const {
    constexpr double kCuredByOne = 2;
    const double factor = std::max(kLeastFactor, was.worst / bad_from_.hopeless);
    return was.null > 0 || static_cast<double>(was.hopeless) <= kCuredByOne * factor;
  }

  // As many null elements gone as there are more points, or the worst as many times better, and ten times at
  // least.
  [[nodiscard]] bool are_points_worth_it(const Snapshot& before, const Badness& was) const {
    const auto points_in = [](const TetMesh& mesh, const std::vector<Vertex>& points) {
      return std::count_if(points.begin(), points.end(), [&](Vertex p) { return mesh.in_mesh(p); });
    };
    const auto more =
        static_cast<double>(points_in(mesh_, now_.points) - points_in(before.mesh, before.state.points));
    const Badness is = badness_of_all();
    return more <= static_cast<double>(was.null) - static_cast<double>(is.null) ||
           std::max(kLeastFactor, more) * is.worst <= was.worst;
  }

  [[nodiscard]] Badness badness_of_all() const {
    Badness badness;
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (mesh_.alive(t) && is_ours(t)) badness.add(quality_of(mesh_, mesh_.corners(t)), bad_from_);
    return badness;
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
    if (e.quality < kBad && now_.failures >= kMostFailures) return true;
    if (now_.is_shaking) return now_.work >= now_.budget;
    const std::size_t budget = e.quality >= bad_from_.hopeless ? now_.budget : now_.usual_budget;
    const bool is_promising = e.quality >= now_.worst_stuck || now_.work < now_.work_at_gain + kIdle;
    return now_.work >= (is_promising ? kTimes * budget : budget);
  }

  [[nodiscard]] bool has_flat() const {
    return !now_.queue.empty() && now_.queue.top().quality >= bad_from_.flat;
  }

  // Flat tetrahedra that stayed: changes next to them may have made a way, and the search tries another.
  void try_again() {
    ++now_.round;
    now_.worst_stuck = 0;
    std::erase_if(now_.stuck, [this](const Entry& e) {
      if (e.quality < bad_from_.flat) return false;
      if (is_current(e)) now_.queue.push(e);
      return true;
    });
  }

  void push(Tet t) {
    const double q = qualities_.of(t);
    if (!(q > good_)) return;
    const Entry entry{q, t, mesh_.corners(t)};
    if (now_.takes_all || q >= kBad)
      now_.queue.push(entry);
    else
      now_.rest.push_back(entry);
  }
  [[nodiscard]] bool is_current(const Entry& e) {
    return mesh_.alive(e.tet) && mesh_.corners(e.tet) == e.corners && qualities_.of(e.tet) == e.quality;
  }

  void improve(const Entry& e) {
    monitor_.poll(Stage::optimise, static_cast<double>(now_.work) / static_cast<double>(now_.budget));
    created_.clear();
    if (try_ways(e))
      now_.work_at_gain = now_.work;
    else
      give_up(e);
    // What did not help may have changed something, too.
    now_.stats.changed += created_.size();
    qualities_.forget(created_);
    for (const Tet t : created_)
      if (mesh_.alive(t)) push(t);
  }

  // The cheapest way that helps.
  bool try_ways(const Entry& e) {
    if (exchange(e.tet)) return ++now_.stats.exchanged;
    if (relocate_a_corner(e.tet)) return ++now_.stats.relocated;
    if (remove_flat(e)) return ++now_.stats.unflattened;
    if ((is_worth_reconnecting(e) && reconnect_round(e.tet)) ||
        (adds_points() && e.quality >= bad_from_.hopeless && reconnect_patiently(e.tet)))
      return ++now_.stats.reconnected;
    return adds_points() && is_worth_a_point(e) && insert_at(e) && ++now_.stats.inserted;
  }

  [[nodiscard]] bool adds_points() const { return options_.add_points && !saves_points_ && !now_.is_shaking; }

  // As long as a worse one stays, a point would not better the mesh's worst; but null elements are of no use
  // to anyone.
  [[nodiscard]] bool is_worth_a_point(const Entry& e) const {
    return e.quality >= std::max(bad_from_.hopeless, std::min(now_.worst_stuck, bad_from_.null));
  }

  void give_up(const Entry& e) {
    now_.worst_stuck = std::max(now_.worst_stuck, e.quality);
    if (e.quality < kBad) ++now_.failures;
    now_.stuck.push_back(e);
  }

  void list_points(const std::vector<Tet>& tets) {
    for (const Tet t : tets)
      for (const Vertex v : mesh_.corners(t))
        if (v >= first_free_) now_.points.push_back(v);
    std::sort(now_.points.begin(), now_.points.end());
    now_.points.erase(std::unique(now_.points.begin(), now_.points.end()), now_.points.end());
  }

  void relocate_all() {
    for (const Vertex p : now_.points)
      if (now_.work < now_.budget / 2 && relocate_with_ball(p)) ++now_.stats.relocated;
    now_.stats.changed += created_.size();
    created_.clear();
  }

  bool exchange(Tet t) {
    ++now_.work;
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
    now_.work += tets.size() / 2;
    if (!relocate(mesh_, p, tets, random_)) return false;
    created_.insert(created_.end(), tets.begin(), tets.end());
    return true;
  }

  // What is not flat matters here only as the worst of all.
  bool remove_flat(const Entry& e) {
    if (e.quality < std::min(bad_from_.flat, now_.worst_stuck)) return false;
    const bool removed = flat_remover_.remove(e.tet, bad_from_.limit_for(e.quality), created_);
    now_.work += flat_remover_.work();
    return removed;
  }

  // A search is long and seldom finds anything: as long as it does so now and then, but always for what
  // would better the worst of all, or else get a point now.
  [[nodiscard]] bool is_worth_reconnecting(const Entry& e) const {
    constexpr int kMostInVain = 3, kMostInVainForFlat = 12;
    if (!saves_points_ && (e.quality >= now_.worst_stuck || is_worth_a_point(e))) return true;
    return reconnections_in_vain_ < (e.quality >= kWorthReconnecting ? kMostInVainForFlat : kMostInVain);
  }

  bool reconnect_round(Tet t) {
    constexpr std::size_t kWork = 50;
    now_.work += kWork;
    const bool reconnected = reconnect(mesh_, t, first_free_, bad_from_, false, random_, created_);
    reconnections_in_vain_ = reconnected ? 0 : reconnections_in_vain_ + 1;
    return reconnected;
  }

  // A point that would come next is worth some milliseconds, a few times.
  bool reconnect_patiently(Tet t) {
    constexpr std::size_t kWork = 200;
    constexpr int kMostPatient = 2;
    if (++patient_ > kMostPatient) return false;
    now_.work += kWork;
    return reconnect(mesh_, t, first_free_, bad_from_, true, random_, created_);
  }

  bool insert_at(const Entry& e) {
    constexpr std::size_t kWork = 20;
    now_.work += kWork;
    const double most = e.quality < bad_from_.null ? bad_from_.hopeless : bad_from_.null;
    const Vertex p = insert_point(mesh_, e.tet, first_free_, most, created_);
    if (p == kNone) return false;
    now_.points.push_back(p);
    relocate_with_ball(p);
    return true;
  }

  // Points that the mesh can do without now, as long as nothing comes of it that is worth a point: as long
  // as a worse one stays, that is nothing but null elements.
  void remove_points(std::size_t from) {
    if (from == now_.points.size()) return;
    constexpr std::size_t kWork = 30;
    const double limit = std::max(bad_from_.flat, std::min(badness_of_all().worst, bad_from_.null));
    Growth growth{.attempts = 2, .steps = 6, .search = {.most_vertices = 18, .most_nodes = 60}};
    const std::size_t most_work = std::max(now_.budget, now_.work) + kLeastWork;
    for (std::size_t k = from; k < now_.points.size(); ++k) {
      const Vertex p = now_.points[k];
      if (!mesh_.in_mesh(p)) continue;
      if (now_.work > most_work) return;
      now_.work += kWork;
      std::vector<Tet> tets;
      ball(mesh_, p, tets);
      growth.search.worst_quality = std::max(limit, badness_of(mesh_, tets, bad_from_).worst);
      if (!refill_without(mesh_, p, first_free_, growth, random_)) continue;
      ++now_.stats.removed;
      ++now_.stats.changed;
    }
  }

  // The paper's Q: of what is left alone, of bad elements, of what is worth a search, of what counts as flat,
  // as hopeless and as null.
  static constexpr double kGood = 2, kBad = 30, kWorthReconnecting = 200;
  static constexpr double kFlat = 100, kFlatForTarget = 2, kHopeless = 1000, kHopelessForTarget = 30,
                          kNull = 1e10;
  static constexpr double kLeastFactor = 10;  // by which points that stay better the worst
  static constexpr int kRounds = 3, kMostFailures = 12;
  // In exchanges tried, some 10 microseconds each.
  static constexpr std::size_t kLeastWork = 1200, kWorkPerTet = 4;
  // Of the work for what is not worth a point: the share, and the most, which millions of tetrahedra of a
  // smooth surface would use up in both searches.
  static constexpr std::size_t kUsualShare = 4, kMostUsual = 1'000'000, kMostUsualAgain = 200'000;
  static constexpr std::size_t kTimes = 10;  // as much for what is promising
  static constexpr std::size_t kIdle = 300;  // without a gain, until nothing is

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
  int reconnections_in_vain_ = 0, patient_ = 0;
  std::vector<Tet> created_;  // or changed
  State now_;
  bool saves_points_ = false;  // until all else has been tried
};

}  // namespace

OptimiseStats optimise(TetMesh& mesh, const std::vector<Tet>& tets, Vertex first_free, double target,
                       Monitor& monitor, const OptimiseOptions& options) {
  return Optimiser(mesh, first_free, target, options, monitor).run(tets);
}

}  // namespace holdfast
