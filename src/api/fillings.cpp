#include "api/fillings.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "api/fill_polyhedron.h"

namespace holdfast {
namespace {

// Bitwise, because 0 and -0 are equal numbers.
bool are_same(const Point& x, const Point& y) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(x) == std::bit_cast<Bits>(y);
}

bool are_same(const ToFill& x, const ToFill& y) {
  const Surface &p = x.polyhedron, &q = y.polyhedron;
  return x.points == y.points && p.facets == q.facets && p.segments == q.segments &&
         std::equal(p.vertices.begin(), p.vertices.end(), q.vertices.begin(), q.vertices.end(),
                    [](const Point& u, const Point& v) { return are_same(u, v); });
}

}  // namespace

std::vector<Fillings::Made>::iterator Fillings::find(const ToFill& asked) {
  return std::find_if(made_.begin(), made_.end(),
                      [&](const Made& made) { return are_same(made.asked, asked); });
}

std::optional<Filling> Fillings::fill(const ToFill& asked, const LikelyToFill& likely) {
  if (threads_.count() == 1) return fill_polyhedron(asked.polyhedron.view(), asked.points, limits_, monitor_);
  if (find(asked) == made_.end()) make_with_likely(asked, likely);
  const auto at = find(asked);
  Made made = std::move(*at);
  made_.erase(at);
  if (made.error) std::rethrow_exception(made.error);
  return std::move(made.filling);
}

// Fillings that are not asked for while many others are were wrong guesses; the oldest are dropped.
void Fillings::make_with_likely(const ToFill& asked, const LikelyToFill& likely) {
  const std::size_t most = threads_.count();
  std::vector<Made> fresh{{asked, {}, {}}};
  for (ToFill& next : likely(most - 1 + made_.size()))
    if (fresh.size() < most && find(next) == made_.end()) fresh.push_back({std::move(next), {}, {}});
  parallel_monitored(threads_, fresh.size(), monitor_, {monitor_.fraction(), monitor_.fraction()},
                     [&](std::size_t k, Monitor& own) {
                       Made& made = fresh[k];
                       try {
                         made.filling =
                             fill_polyhedron(made.asked.polyhedron.view(), made.asked.points, limits_, own);
                       } catch (const std::logic_error&) {
                         made.error = std::current_exception();
                       }
                     });
  std::move(fresh.begin(), fresh.end(), std::back_inserter(made_));
  if (made_.size() > 2 * most)
    made_.erase(made_.begin(), made_.end() - static_cast<std::ptrdiff_t>(2 * most));
}

}  // namespace holdfast
