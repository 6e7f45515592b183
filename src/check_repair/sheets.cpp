#include "check_repair/sheets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace holdfast::checking {
namespace {

/// Larger than what denormal numbers may lose.
constexpr double kNoUnderflow = 0x1p-1000;

using Vector = std::array<double, 3>;

Vector minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double largest(const Vector& v) { return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])}); }
double square(const Vector& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// A multiple of a vector whose largest component is 1 or -1; zero if there is none.
Vector scaled(const Vector& v) {
  const double most = largest(v);
  if (!(most > 0) || !std::isfinite(most)) return {};
  return {v[0] / most, v[1] / most, v[2] / most};
}

/// The points x whose height h(x) = n (x - o) is at most `most` + `share` |x|, where |x| is the largest
/// coordinate, or size, of x.
///
/// Coordinates are rounded in relation to their size; where planes cross next to the origin, a layer as thick
/// as the rounding far from it would contain everything there. Therefore parts are one-sided or not: of a
/// one-sided part some coordinate k has one sign and at least a quarter of its size at all corners. Then
/// |x| <= 4 |x_k| on all of it, since |x| is convex and |x_k| linear there. So if |h(y)| <= t |y| at the
/// corners y, then |h(x)| <= 4 t |x_k| <= 4 t |x| on the part, and a sheet of one-sided parts has such a
/// layer.
///
/// Heights are computed with five roundings of numbers of at most 6 (|x| + |o|), as |n| <= 1 in each
/// component: `room` is some ten times what the error can be.
struct Layer {
  Vector normal{};  // zero: everything is in the layer
  Point origin{};
  double most = 0, share = 0;

  [[nodiscard]] double height(const Point& p) const {
    const Vector w = minus(p, origin);
    return normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2];
  }
  [[nodiscard]] double room(double size) const { return (size + largest(origin)) * 0x1p-47 + kNoUnderflow; }
};

class Pairs {
 public:
  Pairs(std::span<const Point> vertices, std::span<const Part> parts, std::span<const Index> sheet,
        const std::function<void(Index, Index)>& visit)
      : vertices_(vertices), parts_(parts), visit_(visit) {
    double most = 0;
    for (const Part& part : parts)
      for (const Index v : part.span()) most = std::max(most, largest(vertices[v]));
    constexpr double kNoOverflow = 0x1p1000;
    has_layers_ = most < kNoOverflow;
    boxes_.reserve(parts.size());
    for (const Part& part : parts) boxes_.push_back(box_of(part.span(), vertices));
    find_groups(sheet);
  }

  void run() {
    for (const Sheet& sheet : sheets_)
      sheet.tree.self_pairs([&](Index i, Index j) { visit_(sheet.parts[i], sheet.parts[j]); });
    std::vector<Box> boxes;
    boxes.reserve(groups_.size());
    for (const Group& group : groups_)
      boxes.push_back(group.sheet ? sheets_[*group.sheet].box : boxes_[group.part]);
    BoxTree(std::move(boxes)).self_pairs([&](Index i, Index j) { pair(groups_[i], groups_[j]); });
  }

 private:
  struct Sheet {
    std::vector<Index> parts;
    Box box;
    BoxTree tree;  // items are positions in `parts`
    Layer layer;
  };
  /// A sheet, or a single part.
  struct Group {
    Index part;
    std::optional<Index> sheet;
  };

  /// The coordinate in which a part is one-sided.
  [[nodiscard]] std::optional<std::size_t> one_sided(Index i) const {
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t positive = 0, negative = 0;
      for (const Index v : parts_[i].span()) {
        const double x = vertices_[v][k], quarter = largest(vertices_[v]) / 4;
        positive += static_cast<std::size_t>(x > 0 && x >= quarter);
        negative += static_cast<std::size_t>(x < 0 && -x >= quarter);
      }
      if (positive == parts_[i].size || negative == parts_[i].size) return k;
    }
    return std::nullopt;
  }

  /// The one-sided parts of a sheet form a group of their own.
  void find_groups(std::span<const Index> sheet) {
    std::vector<std::pair<Index, bool>> number(parts_.size(), {no_entity, false});
    for (Index i = 0; i < sheet.size(); ++i)
      if (sheet[i] != no_entity) number[i] = {sheet[i], one_sided(i).has_value()};
    std::vector<Index> order(parts_.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return number[i] < number[j]; });
    for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
      const bool is_numbered = number[order[i]].first != no_entity;
      end = i + 1;
      while (is_numbered && end < order.size() && number[order[end]] == number[order[i]]) ++end;
      if (end == i + 1) {
        groups_.push_back({order[i], {}});
      } else {
        groups_.push_back({order[i], static_cast<Index>(sheets_.size())});
        sheets_.push_back(sheet_of({order.begin() + static_cast<std::ptrdiff_t>(i),
                                    order.begin() + static_cast<std::ptrdiff_t>(end)}));
      }
    }
  }

  [[nodiscard]] Sheet sheet_of(std::vector<Index> parts) const {
    std::vector<Box> boxes;
    boxes.reserve(parts.size());
    for (const Index i : parts) boxes.push_back(boxes_[i]);
    Box box = boxes[0];
    for (const Box& more : boxes) box.extend(more);
    Layer layer = layer_of(parts);
    return {std::move(parts), box, BoxTree(std::move(boxes)), layer};
  }

  /// The layer through the vertex nearest to the origin, the vertex farthest from that one, and the vertex
  /// farthest from the line through both.
  [[nodiscard]] Layer layer_of(std::span<const Index> parts) const {
    Layer layer;
    if (!has_layers_) return layer;
    const auto for_each_corner = [&](auto&& take) {
      for (const Index i : parts)
        for (const Index v : parts_[i].span()) take(vertices_[v]);
    };
    layer.origin = vertices_[parts_[parts[0]].corners[0]];
    for_each_corner([&](const Point& p) {
      if (largest(p) < largest(layer.origin)) layer.origin = p;
    });
    Vector farthest{};
    double far = 0;
    for_each_corner([&](const Point& p) {
      const Vector w = minus(p, layer.origin);
      if (largest(w) > far) {
        far = largest(w);
        farthest = w;
      }
    });
    farthest = scaled(farthest);
    double most = 0;
    for_each_corner([&](const Point& p) {
      const Vector w = minus(p, layer.origin);
      const Vector n = cross(farthest, {w[0] / far, w[1] / far, w[2] / far});
      if (square(n) > most) {
        most = square(n);
        layer.normal = n;
      }
    });
    layer.normal = scaled(layer.normal);
    const bool is_one_sided = one_sided(parts[0]).has_value();
    for_each_corner([&](const Point& p) {
      const double size = largest(p), height = std::fabs(layer.height(p)) + layer.room(size);
      if (is_one_sided)
        layer.share = std::max(layer.share, 4 * (1 + 0x1p-40) * height / size);
      else
        layer.most = std::max(layer.most, height);
    });
    return layer;
  }

  /// The portion of one group near another: its parts, and boxes round their portions.
  struct Near {
    std::vector<Index> parts;
    std::vector<Box> boxes;
  };

  void pair(const Group& x, const Group& y) {
    if (!x.sheet && !y.sheet) return visit_(x.part, y.part);
    const Near of_x = near(x, y);
    if (of_x.parts.empty()) return;
    const Near of_y = near(y, x);
    if (of_y.parts.empty()) return;
    constexpr std::size_t kFew = 64;
    if (of_x.parts.size() * of_y.parts.size() <= kFew) {
      for (std::size_t i = 0; i < of_x.parts.size(); ++i)
        for (std::size_t j = 0; j < of_y.parts.size(); ++j)
          if (of_x.boxes[i].meets(of_y.boxes[j])) visit_(of_x.parts[i], of_y.parts[j]);
      return;
    }
    BoxTree(of_x.boxes).pairs_with(BoxTree(of_y.boxes), [&](Index i, Index j) {
      visit_(of_x.parts[i], of_y.parts[j]);
    });
  }

  [[nodiscard]] Near near(const Group& of, const Group& to) const {
    Near near;
    const Layer layer = to.sheet ? sheets_[*to.sheet].layer : layer_of(std::array{to.part});
    const Box& box = to.sheet ? sheets_[*to.sheet].box : boxes_[to.part];
    const auto take = [&](Index i) {
      if (const std::optional<Box> cut = box_in(layer, i); cut && cut->meets(box)) {
        near.parts.push_back(i);
        near.boxes.push_back(*cut);
      }
    };
    if (!of.sheet) {
      take(of.part);
      return near;
    }
    const Sheet& sheet = sheets_[*of.sheet];
    sheet.tree.query([&](const Box& b) { return b.meets(box) && reaches(layer, b); },
                     [&](Index i) { take(sheet.parts[i]); });
    return near;
  }

  /// False only if no point of the box is in the layer.
  [[nodiscard]] static bool reaches(const Layer& layer, const Box& box) {
    Point centre{};
    double size = 0, reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      centre[k] = box.low[k] / 2 + box.high[k] / 2;
      size = std::max({size, std::fabs(box.low[k]), std::fabs(box.high[k])});
      reach += std::fabs(layer.normal[k]) * (box.high[k] / 2 - box.low[k] / 2);
    }
    reach += layer.most + layer.share * size + 4 * layer.room(size);
    return !(std::fabs(layer.height(centre)) > reach);
  }

  /// A corner of a part, and the distance from a plane up to which it counts as in a layer.
  struct Corner {
    const Point& point;
    double height, reach;
  };

  /// A box that contains the portion of a part in the layer; nothing if that is certainly empty. The reach is
  /// linear on the part and at least the layer's.
  [[nodiscard]] std::optional<Box> box_in(const Layer& layer, Index i) const {
    const Part& part = parts_[i];
    const std::optional<std::size_t> side = one_sided(i);
    double most_size = 0;
    for (const Index v : part.span()) most_size = std::max(most_size, largest(vertices_[v]));
    const auto corner = [&](std::size_t k) -> Corner {
      const Point& p = vertices_[part.corners[k]];
      const double size = side ? 4 * std::fabs(p[*side]) : most_size;
      return {p, layer.height(p), layer.most + layer.share * size + 2 * layer.room(largest(p))};
    };
    std::size_t above = 0, below = 0, inside = 0;
    for (std::size_t k = 0; k < part.size; ++k) {
      const Corner c = corner(k);
      above += static_cast<std::size_t>(c.height > c.reach);
      below += static_cast<std::size_t>(c.height < -c.reach);
      inside += static_cast<std::size_t>(std::fabs(c.height) <= c.reach);
    }
    if (above == part.size || below == part.size) return std::nullopt;
    if (inside == part.size) return boxes_[i];
    std::optional<Box> box;
    const auto take = [&](const Point& p) {
      if (box)
        box->extend(p);
      else
        box.emplace(p);
    };
    for (std::size_t k = 0; k < part.size; ++k) {
      const Corner a = corner(k), b = corner((k + 1) % part.size);
      if (std::fabs(a.height) <= a.reach) take(a.point);
      const bool a_first = largest(a.point) <= largest(b.point);
      for (const double sign : {-1.0, 1.0}) cut(a_first ? a : b, a_first ? b : a, sign, take);
    }
    if (!box) return boxes_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      box->low[k] = std::max(box->low[k], boxes_[i].low[k]);
      box->high[k] = std::min(box->high[k], boxes_[i].high[k]);
    }
    return box;
  }

  /// The point where a side leaves the layer. Computed from the end nearest to the origin, its errors are
  /// small in relation to the result.
  template <class Take>
  static void cut(const Corner& a, const Corner& b, double sign, Take&& take) {
    const double of_a = sign * a.height - a.reach, of_b = sign * b.height - b.reach;
    if ((of_a <= 0) == (of_b <= 0)) return;
    const double t = of_a / (of_a - of_b);
    Point low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double by = t * (b.point[k] - a.point[k]);
      const double error = (std::fabs(a.point[k]) + std::fabs(by)) * 0x1p-48 + kNoUnderflow;
      low[k] = a.point[k] + by - error;
      high[k] = a.point[k] + by + error;
    }
    take(low);
    take(high);
  }

  std::span<const Point> vertices_;
  std::span<const Part> parts_;
  const std::function<void(Index, Index)>& visit_;
  bool has_layers_ = false;
  std::vector<Box> boxes_;
  std::vector<Sheet> sheets_;
  std::vector<Group> groups_;
};

}  // namespace

void for_each_near_pair(std::span<const Point> vertices, std::span<const Part> parts,
                        std::span<const Index> sheet, const std::function<void(Index, Index)>& visit) {
  Pairs(vertices, parts, sheet, visit).run();
}

}  // namespace holdfast::checking
