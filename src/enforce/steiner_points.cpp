#include "enforce/steiner_points.h"

#include <utility>

#include "enforce/tuning.h"
#include "mesh/traverse.h"
#include "numbers/sorted.h"
#include "suppress/degree.h"
#include "suppress/remove_or_recentre.h"

namespace holdfast {

void SteinerPoints::add(std::span<const Vertex> fresh) {
  restless_.insert(restless_.end(), fresh.begin(), fresh.end());
  all_.insert(all_.end(), fresh.begin(), fresh.end());
}

void SteinerPoints::settle_new() { settle_restless(tuning::kQuickSearch); }

void SteinerPoints::settle(std::vector<Vertex> points) {
  restless_ = std::move(points);
  settle_restless(tuning::kQuickSearch);
}

void SteinerPoints::settle_all_now_and_then() {
  std::erase_if(all_, [&](Vertex p) { return !mesh_.in_mesh(p); });
  if (tuning::kSettleAllPerTimes * all_.size() < tuning::kSettleAllTimes * settled_ + tuning::kSettleAllSlack)
    return;
  restless_ = all_;
  std::erase_if(restless_, [&](Vertex p) { return held_.contains(p); });
  settle_restless(tuning::kThoroughSearch);
  std::erase_if(all_, [&](Vertex p) { return !mesh_.in_mesh(p); });
  settled_ = all_.size();
}

void SteinerPoints::settle_restless(const PolyhedronOptions& search) {
  for (int round = 1; round <= tuning::kSettleRounds && !restless_.empty(); ++round) {
    std::vector<Vertex> now;
    now.swap(restless_);
    sort_unique(now);
    for (const Vertex p : now) {
      if (!mesh_.in_mesh(p)) continue;
      std::vector<Vertex> around = link_vertices(mesh_, p);
      keep_added(around);
      lower_degree(mesh_, flipper_, p, tuning::kDegreeDepth, tuning::kDegreeBudget);
      const Fate fate = remove_or_recentre(mesh_, p, search);
      if (fate == Fate::collapsed || fate == Fate::filled)
        restless_.insert(restless_.end(), around.begin(), around.end());
      else if (fate == Fate::moved && round < tuning::kSettleRounds)
        restless_.push_back(p);
    }
  }
  restless_.clear();
}

}  // namespace holdfast
