// Several threads work on the rounds of the insertion order one by one. A round has phases. Each phase cuts
// space into slabs with equally many of the remaining points, one per thread, across another axis each time.
// Points whose cavity leaves their slab wait for the next phase. When phases do not pay any more, one thread
// inserts the rest. (Marot, Pellerin, Remacle 2019 cut a space-filling curve instead, and do not wait for the
// end of a round. Waiting is needed here, because of equal points the first must be the one that is
// inserted.)
#include "delaunay/schedule.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <vector>

#include "delaunay/insert.h"
#include "mesh/parallel.h"

namespace holdfast {
namespace {

constexpr std::size_t kPollInterval = 2048;  // faces of cavities; most have some thirty
constexpr std::size_t kFewPoints = 200;      // a thread: so few are not worth a phase
constexpr std::size_t kSamplePerSlab = 512;  // sample points that define the slabs
constexpr double kMostShare = 1.7;           // of points in a slab, over the mean
constexpr std::size_t kEntrances = 8;        // points from which to try to enter a slab

class Schedule {
 public:
  Schedule(Triangulation& triangulation, std::uint64_t seed, const Threads& threads,
           const InsertionProgress& progress)
      : triangulation_(triangulation), progress_(progress), threads_(threads) {
    for (unsigned k = 0; k < threads.count(); ++k)
      inserters_.push_back(std::make_unique<Inserter>(triangulation, k, seed));
  }

  void run() {
    std::size_t first = 4;
    for (const std::size_t end : triangulation_.order().ends) {
      if (end <= first) continue;
      if (threads_.count() > 1 && first >= kFewPoints * threads_.count() &&
          end - first >= kFewPoints * threads_.count())
        run_round(static_cast<Vertex>(first), static_cast<Vertex>(end));
      else
        run_alone(static_cast<Vertex>(first), static_cast<Vertex>(end));
      first = end;
    }
    for (auto& inserter : inserters_) inserter->give_slots_back();
  }

 private:
  void run_alone(Vertex first, Vertex end) {
    Inserter& inserter = *inserters_[0];
    for (Vertex k = first; k < end; ++k) {
      tell();
      inserter.insert(k);
    }
  }

  void run_round(Vertex first, Vertex end) {
    std::vector<Vertex> points(end - first);
    std::iota(points.begin(), points.end(), first);
    for (std::size_t axis = 0; axis < 3 && points.size() >= kFewPoints * threads_.count(); ++axis) {
      const std::vector<Slab> slabs = slabs_across(axis, points);
      if (!slabs.empty()) points = run_phase(slabs, points);
    }
    for (const Vertex k : points) {
      tell();
      inserters_[0]->insert_late(k);
    }
  }

  // One slab a thread; none if too many points have the same coordinate.
  [[nodiscard]] std::vector<Slab> slabs_across(std::size_t axis, const std::vector<Vertex>& points) const {
    std::vector<double> sample;
    const std::size_t step = std::max<std::size_t>(1, points.size() / (kSamplePerSlab * threads_.count()));
    for (std::size_t i = 0; i < points.size(); i += step)
      sample.push_back(triangulation_.at(points[i])[axis]);
    std::sort(sample.begin(), sample.end());
    std::vector<Slab> slabs(threads_.count(), Slab{.axis = axis});
    for (std::size_t k = 1; k < threads_.count(); ++k)
      slabs[k - 1].high = slabs[k].low = sample[sample.size() * k / threads_.count()];
    const auto most =
        static_cast<std::ptrdiff_t>(kMostShare * static_cast<double>(sample.size()) / threads_.count());
    for (const Slab& slab : slabs) {
      const auto low = std::lower_bound(sample.begin(), sample.end(), slab.low);
      if (std::lower_bound(low, sample.end(), slab.high) - low > most) return {};
    }
    return slabs;
  }

  // Returns the remaining points.
  std::vector<Vertex> run_phase(const std::vector<Slab>& slabs, const std::vector<Vertex>& points) {
    triangulation_.expect_points(points.size(), threads_.count());
    const Tet before = inserters_[0]->last();
    const std::vector<char> entered = enter_all(slabs, points);
    std::vector<Vertex> left = run_slabs(slabs, entered, points);
    triangulation_.settle_slots();
    // The next walk starts at a cell that an inserter left, since the one before may be gone.
    const auto valid =
        static_cast<std::size_t>(std::find(entered.begin(), entered.end(), 1) - entered.begin());
    inserters_[0]->set_last(valid == entered.size() ? before : inserters_[valid]->last());
    return left;
  }

  // By slab, whether its inserter can start there.
  [[nodiscard]] std::vector<char> enter_all(const std::vector<Slab>& slabs,
                                            const std::vector<Vertex>& points) const {
    std::vector<char> entered(slabs.size(), 0);
    Tet from = inserters_[0]->last();
    for (std::size_t k = 0; k < slabs.size(); ++k) {
      entered[k] = enter(*inserters_[k], slabs[k], points, from);
      if (entered[k] != 0) from = inserters_[k]->last();
    }
    return entered;
  }

  // Returns the remaining points, in order.
  std::vector<Vertex> run_slabs(const std::vector<Slab>& slabs, const std::vector<char>& entered,
                                const std::vector<Vertex>& points) {
    std::vector<std::vector<Vertex>> left(slabs.size());
    std::atomic<bool> stop = false;
    parallel(threads_, slabs.size(), [&](std::size_t k) {
      try {
        left[k] = run_slab(*inserters_[k], slabs[k], k == 0, entered[k] != 0, points, stop);
      } catch (...) {
        stop = true;
        throw;
      }
    });
    std::vector<Vertex> all;
    for (const auto& vertices : left) all.insert(all.end(), vertices.begin(), vertices.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  bool enter(Inserter& inserter, const Slab& slab, const std::vector<Vertex>& points, Tet from) const {
    std::size_t tried = 0;
    for (std::size_t i = 0; i < points.size() && tried < kEntrances; ++i) {
      if (!slab.holds(triangulation_.at(points[i]))) continue;
      if (inserter.enter(slab, points[i], from)) return true;
      i += points.size() / (2 * threads_.count() * kEntrances);
      ++tried;
    }
    return false;
  }

  std::vector<Vertex> run_slab(Inserter& inserter, const Slab& slab, bool calling_thread, bool entered,
                               const std::vector<Vertex>& points, const std::atomic<bool>& stop) {
    std::vector<Vertex> left;
    for (const Vertex k : points) {
      if (!slab.holds(triangulation_.at(k))) continue;
      if (calling_thread) tell(threads_.count());
      if (stop.load(std::memory_order_relaxed)) break;
      if (!entered || waits_for_equal(k, left) || !inserter.insert_in_slab(k)) left.push_back(k);
    }
    return left;
  }

  // Whether k is equal to an earlier point that is not yet inserted: of equal points the first is inserted
  // first.
  [[nodiscard]] bool waits_for_equal(Vertex k, const std::vector<Vertex>& left) const {
    const double* q = triangulation_.at(k);
    for (auto v = left.rbegin(); v != left.rend() && *v + kDuplicateDistance >= k; ++v)
      if (std::equal(q, q + 3, triangulation_.at(*v))) return true;
    return false;
  }

  void tell(std::size_t points = 1) {
    done_ += points;
    untold_ += kPollInterval / 64 + inserters_[0]->faces();
    if (untold_ < kPollInterval) return;
    untold_ = 0;
    if (progress_)
      progress_(std::min(1.0, static_cast<double>(done_) / static_cast<double>(triangulation_.size())));
  }

  Triangulation& triangulation_;
  const InsertionProgress& progress_;
  const Threads threads_;
  std::vector<std::unique_ptr<Inserter>> inserters_;
  std::size_t done_ = 4, untold_ = 0;
};

}  // namespace

void insert_all(Triangulation& triangulation, std::uint64_t seed, const Threads& threads,
                const InsertionProgress& progress) {
  Schedule(triangulation, seed, threads, progress).run();
}

}  // namespace holdfast
