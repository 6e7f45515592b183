#include "divide/wanted_size.h"

#include <algorithm>
#include <limits>

#include "numbers/vector.h"

namespace holdfast::division {
namespace {

constexpr std::size_t kLeaf = 8;
/// Factor: the returned size may be larger than the least by its inverse. In the middle of a ball all of its
/// surface is about as near, and would have to be examined to find the very least.
constexpr double kSlack = 0.9;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

}  // namespace

WantedSize::WantedSize(const Complex& complex, double gradation, std::function<double(const Point&)> limit)
    : gradation_(gradation), limit_(std::move(limit)) {
  std::vector<double> sum(complex.vertices.size(), 0);
  std::vector<std::size_t> count(complex.vertices.size(), 0);
  const auto add = [&](Index a, Index b) {
    const double length = distance(complex.vertices[a], complex.vertices[b]);
    for (const Index v : {a, b}) {
      sum[v] += length;
      ++count[v];
    }
  };
  // An edge counts once for each of its facets: accurate enough, and it saves a table of edges.
  for (const Triangle& t : complex.facets)
    for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
  for (const Segment& s : complex.segments) add(s[0], s[1]);
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0) sources_.push_back({complex.vertices[v], sum[v] / static_cast<double>(count[v])});
  if (!sources_.empty()) build(0, sources_.size());
}

std::size_t WantedSize::build(std::size_t begin, std::size_t end) {
  const std::size_t at = boxes_.size();
  Box box{sources_[begin].where, sources_[begin].where, kUnlimited, begin, end};
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], sources_[i].where[k]);
      box.high[k] = std::max(box.high[k], sources_[i].where[k]);
    }
    box.least = std::min(box.least, sources_[i].size);
  }
  boxes_.push_back(box);
  if (end - begin <= kLeaf) return at;
  const Vector extent = box.high - box.low;
  const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = sources_.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                   first + static_cast<std::ptrdiff_t>(end), [axis](const Source& a, const Source& b) {
                     // All other values break ties, so that the tree depends on the surface alone.
                     if (a.where[axis] != b.where[axis]) return a.where[axis] < b.where[axis];
                     return a.where != b.where ? a.where < b.where : a.size < b.size;
                   });
  build(begin, middle);
  const std::size_t second = build(middle, end);
  boxes_[at].second = second;
  return at;
}

double WantedSize::bound(const Box& box, const Point& p) const {
  Vector away{};
  for (std::size_t k = 0; k < 3; ++k) away[k] = std::max({box.low[k] - p[k], p[k] - box.high[k], 0.0});
  return box.least + gradation_ * length(away);
}

double WantedSize::operator()(const Point& p) const {
  double least = limit_ ? limit_(p) : kUnlimited;
  if (!(least > 0)) least = kUnlimited;
  if (boxes_.empty()) return least;
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const std::size_t at = open.back();
    const Box& box = boxes_[at];
    open.pop_back();
    if (bound(box, p) >= kSlack * least) continue;
    if (box.second == 0) {
      for (std::size_t i = box.begin; i < box.end; ++i)
        least = std::min(least, sources_[i].size + gradation_ * distance(sources_[i].where, p));
      continue;
    }
    // Push the nearer half last, so that it is visited first.
    const std::size_t halves[2] = {at + 1, box.second};
    const bool first_nearer = bound(boxes_[halves[0]], p) < bound(boxes_[halves[1]], p);
    open.push_back(halves[first_nearer ? 1 : 0]);
    open.push_back(halves[first_nearer ? 0 : 1]);
  }
  return least;
}

}  // namespace holdfast::division
