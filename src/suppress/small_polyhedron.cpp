#include "suppress/small_polyhedron.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "exact/orient_among.h"
#include "mesh/measure.h"
#include "mesh/quality_below.h"
#include "numbers/sorted.h"

namespace holdfast {
namespace {

using Local = std::uint8_t;
using LocalFace = std::array<Local, 3>;

constexpr std::size_t kMostVertices = 31;  // a set of them is a mask of 32 bits

// Numbers the sets of four: a < b < c < d has the binomial sum (a 1) + (b 2) + (c 3) + (d 4). Without d, it
// numbers the sets of three.
constexpr std::array<std::array<std::uint16_t, 5>, kMostVertices + 1> kBinomial = [] {
  std::array<std::array<std::uint16_t, 5>, kMostVertices + 1> table{};
  for (std::size_t n = 0; n <= kMostVertices; ++n) {
    table[n][0] = 1;
    for (std::size_t k = 1; k <= 4 && n > 0; ++k)
      table[n][k] = static_cast<std::uint16_t>(table[n - 1][k - 1] + table[n - 1][k]);
  }
  return table;
}();

// The sets of three by number; the least corner comes first.
constexpr std::array<LocalFace, kBinomial[kMostVertices][3]> kTriangles = [] {
  std::array<LocalFace, kBinomial[kMostVertices][3]> table{};
  std::size_t number = 0;
  for (Local c = 2; c < kMostVertices; ++c)
    for (Local b = 1; b < c; ++b)
      for (Local a = 0; a < b; ++a) table[number++] = {a, b, c};
  return table;
}();

// Numbers oriented faces: twice the number of the three corners, plus one if sorting them takes an odd
// permutation.
using FaceNumber = std::uint16_t;

FaceNumber number_of(LocalFace f) {
  std::uint32_t odd = 0;
  const auto order = [&](std::size_t i, std::size_t j) {
    const bool swaps = f[j] < f[i];
    const Local lower = swaps ? f[j] : f[i], upper = swaps ? f[i] : f[j];
    f[i] = lower;
    f[j] = upper;
    odd ^= static_cast<std::uint32_t>(swaps);
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return static_cast<FaceNumber>(2 * (f[0] + kBinomial[f[1]][2] + kBinomial[f[2]][3]) + odd);
}
// The least corner comes first.
LocalFace corners_of(FaceNumber number) {
  const LocalFace f = kTriangles[number / 2];
  return number % 2 == 0 ? f : LocalFace{f[0], f[2], f[1]};
}
// The number of the set of a face and another vertex, which may be anywhere in their order.
std::size_t number_of_four(const LocalFace& triangle, Local d) {
  const auto [a, b, c] = triangle;
  if (d > c) return std::size_t{a} + kBinomial[b][2] + kBinomial[c][3] + kBinomial[d][4];
  if (d > b) return std::size_t{a} + kBinomial[b][2] + kBinomial[d][3] + kBinomial[c][4];
  if (d > a) return std::size_t{a} + kBinomial[d][2] + kBinomial[b][3] + kBinomial[c][4];
  return std::size_t{d} + kBinomial[a][2] + kBinomial[b][3] + kBinomial[c][4];
}
constexpr std::size_t face_numbers(std::size_t vertices) { return 2 * std::size_t{kBinomial[vertices][3]}; }

// A set of vertices, one bit each.
using Mask = std::uint32_t;

// Values by number, of which few are ever asked for. Numbers that have a value are marked, so memory is
// written only where it is used.
template <typename Value>
class Sparse {
 public:
  explicit Sparse(std::size_t count) : values_(new Value[count]), has_((count + 63) / 64, 0) {}

  /// The value of a number, and whether it was missing until now.
  std::pair<Value&, bool> take(std::size_t number) {
    std::uint64_t& word = has_[number / 64];
    const std::uint64_t bit = std::uint64_t{1} << number % 64;
    const bool is_new = (word & bit) == 0;
    if (is_new) word |= bit;
    return {values_[number], is_new};
  }

 private:
  std::unique_ptr<Value[]> values_;  // a vector would write to all of it
  std::vector<std::uint64_t> has_;
};

// The vertices above and below every triangle (from above, its corners turn counterclockwise), computed when
// a triangle is asked for. Signs that the filter leaves open are computed on demand, each once: most of those
// for coplanar vertices do not matter.
class Sides {
 public:
  Sides(const TetMesh& mesh, std::vector<Vertex> vertices)
      : mesh_(mesh),
        vertices_(std::move(vertices)),
        all_are_explicit_(
            std::all_of(vertices_.begin(), vertices_.end(), [&](Vertex v) { return mesh.is_explicit(v); })),
        filter_(vertices_.size(), [&](std::size_t i) { return mesh.position(vertices_[i]).data(); }),
        of_triangle_(kBinomial[vertices_.size()][3]) {}

  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }

  /// The vertices not known to be in the plane of f or below it.
  Mask maybe_above(FaceNumber f) {
    const Known& sides = of(f / 2);
    return (f % 2 != 0 ? sides.below : sides.above) | sides.open;
  }
  /// The vertices not known to be below the plane of f.
  Mask maybe_not_below(FaceNumber f) {
    const Known& sides = of(f / 2);
    return ~(f % 2 != 0 ? sides.above : sides.below);
  }
  bool is_above(FaceNumber f, Local d) {
    settle(f, Mask{1} << d);
    return (maybe_above(f) >> d & 1) != 0;
  }
  /// Makes the sides of these vertices known.
  void settle(FaceNumber f, Mask which) {
    Known& sides = of(f / 2);
    for (Mask open = sides.open & which; open != 0; open &= open - 1) {
      const auto d = static_cast<Local>(std::countr_zero(open));
      const int s = sign(kTriangles[f / 2], d);
      if (s > 0) sides.above |= Mask{1} << d;
      if (s < 0) sides.below |= Mask{1} << d;
    }
    sides.open &= ~which;
  }

 private:
  struct Known {
    Mask above, below, open;
  };
  static constexpr std::int8_t kUnknown = 2;

  Known& of(std::size_t triangle) {
    const auto [sides, is_new] = of_triangle_.take(triangle);
    if (is_new) sides = compute(kTriangles[triangle]);
    return sides;
  }

  [[nodiscard]] Known compute(const LocalFace& f) const {
    const Mask corners = Mask{1} << f[0] | Mask{1} << f[1] | Mask{1} << f[2];
    const Mask others = ~corners & ((Mask{1} << vertices_.size()) - 1);
    if (!all_are_explicit_) return {0, 0, others};
    const exact::OrientAmong::Signs known = filter_.of_all(f[0], f[1], f[2]);
    return {known.positive & others, known.negative & others, others & ~(known.positive | known.negative)};
  }

  int sign(const LocalFace& f, Local d) {
    if (sign_.empty()) sign_.assign(kBinomial[vertices_.size()][4], kUnknown);
    std::array<Local, 4> k{f[0], f[1], f[2], d};
    bool odd = false;
    for (std::size_t i = 3; i > 0 && k[i - 1] > k[i]; --i) {
      std::swap(k[i - 1], k[i]);
      odd = !odd;
    }
    std::int8_t& s = sign_[std::size_t{k[0]} + kBinomial[k[1]][2] + kBinomial[k[2]][3] + kBinomial[k[3]][4]];
    if (s == kUnknown)
      s = static_cast<std::int8_t>(
          mesh_.orient(vertices_[k[0]], vertices_[k[1]], vertices_[k[2]], vertices_[k[3]]));
    return odd ? -s : s;
  }

  const TetMesh& mesh_;
  const std::vector<Vertex> vertices_;
  const bool all_are_explicit_;
  const exact::OrientAmong filter_;  // of positions
  std::vector<std::int8_t> sign_;    // by the number of the four corners; empty until a sign is asked for
  Sparse<Known> of_triangle_;        // by the number of the three corners
};

// The faces still to be covered, seen positively from what is left to fill: by number, with the place of each
// in the list, so that every operation takes constant time.
class OpenFaces {
 public:
  using Number = FaceNumber;

  explicit OpenFaces(std::size_t vertices) : place_(face_numbers(vertices), kNowhere) {}

  [[nodiscard]] bool holds(Number f) const { return place_[f] != kNowhere; }
  [[nodiscard]] const std::vector<Number>& list() const { return list_; }
  void add(Number f) {
    place_[f] = static_cast<Number>(list_.size());
    list_.push_back(f);
  }
  void remove(Number f) {
    place_[list_.back()] = place_[f];
    list_[place_[f]] = list_.back();
    list_.pop_back();
    place_[f] = kNowhere;
  }

 private:
  static constexpr Number kNowhere = 0xFFFF;
  std::vector<Number> list_, place_;
};

class Search {
 public:
  Search(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces, std::vector<Vertex> vertices,
         const PolyhedronOptions& options)
      : mesh_(mesh),
        budget_(options.most_nodes),
        worst_quality_(options.worst_quality),
        measure_(options.measure),
        n_(vertices.size()),
        sides_(mesh, std::move(vertices)),
        apexes_(face_numbers(n_)),
        fits_(kBinomial[n_][4], Fits::unknown),
        open_(n_) {
    for (const auto& f : faces) open_.add(number_of({local(f[0]), local(f[1]), local(f[2])}));
  }

  [[nodiscard]] bool is_unfillable() { return !fill_all() && budget_ > 0; }

  std::optional<std::vector<TetMesh::Corners>> run() {
    if (!fill_all()) return std::nullopt;
    std::vector<TetMesh::Corners> tets;
    for (const auto& t : tets_) tets.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2]), vertex(t[3])});
    return tets;
  }

 private:
  using Number = OpenFaces::Number;
  // Of a face: the vertices known to make a positive, good, empty tetrahedron with it, and those not yet
  // examined.
  struct Apexes {
    Mask found, rest;
    int count;  // number of vertices found
  };
  enum class Fits : std::uint8_t { unknown, no, yes };

  [[nodiscard]] Vertex vertex(Local v) const { return sides_.vertices()[v]; }
  [[nodiscard]] Local local(Vertex v) const {
    const std::vector<Vertex>& all = sides_.vertices();
    return static_cast<Local>(std::lower_bound(all.begin(), all.end(), v) - all.begin());
  }

  // A tetrahedron whose closure contains another vertex of the polyhedron cannot be part of a filling.
  bool is_empty(FaceNumber number, Local d) {
    const LocalFace f = corners_of(number);
    std::array<FaceNumber, 4> faces{number};
    Mask inside = sides_.maybe_not_below(number) & ((Mask{1} << n_) - 1);
    for (const Local v : {f[0], f[1], f[2], d}) inside &= ~(Mask{1} << v);
    for (std::size_t k = 0; k < 3 && inside != 0; ++k) {
      faces[k + 1] = number_of({f[k], d, f[(k + 1) % 3]});
      inside &= sides_.maybe_not_below(faces[k + 1]);
    }
    for (std::size_t k = 0; k < 4 && inside != 0; ++k) {
      sides_.settle(faces[k], inside);
      inside &= sides_.maybe_not_below(faces[k]);
    }
    return inside == 0;
  }

  [[nodiscard]] bool is_good(const LocalFace& f, Local d) const {
    if (std::isinf(worst_quality_)) return true;
    const auto at = [&](Local v) -> const Point& { return mesh_.position(vertex(v)); };
    if (measure_ == quality) return is_quality_below(at(f[0]), at(f[1]), at(f[2]), at(d), worst_quality_);
    return measure_(at(f[0]), at(f[1]), at(f[2]), at(d)) < worst_quality_;
  }

  // Asked by each of the four faces, so the answer is kept.
  bool fits(FaceNumber number, Local d) {
    Fits& known = fits_[number_of_four(kTriangles[number / 2], d)];
    if (known == Fits::no || !sides_.is_above(number, d)) return false;
    if (known == Fits::unknown)
      known = is_good(corners_of(number), d) && is_empty(number, d) ? Fits::yes : Fits::no;
    return known == Fits::yes;
  }

  // Looks for apexes of the face until there are `most`, or until all are found.
  const Apexes& look_for_apexes(Number number, int most) {
    const auto [apexes, is_new] = apexes_.take(number);
    if (is_new) apexes = {0, sides_.maybe_above(number), 0};
    for (; apexes.count < most && apexes.rest != 0; apexes.rest &= apexes.rest - 1) {
      const auto d = static_cast<Local>(std::countr_zero(apexes.rest));
      if (!fits(number, d)) continue;
      apexes.found |= Mask{1} << d;
      ++apexes.count;
    }
    return apexes;
  }

  struct Ranking {
    std::array<std::pair<double, Local>, kMostVertices> list;
    std::size_t count = 0;
  };

  // Ranks the fattest tetrahedron first.
  [[nodiscard]] Ranking ranked(const LocalFace& f, Mask mask) const {
    Ranking order;
    for (; mask != 0; mask &= mask - 1) {
      const auto d = static_cast<Local>(std::countr_zero(mask));
      order.list[order.count++] = {
          -fatness(mesh_, vertex(f[0]), vertex(f[1]), vertex(f[2]), mesh_.point(vertex(d))), d};
    }
    std::sort(order.list.begin(), order.list.begin() + static_cast<std::ptrdiff_t>(order.count));
    return order;
  }

  // The open face with the fewest possible apexes, and these apexes, if every open face has one. Of the other
  // faces it is enough to know that they have as many.
  std::pair<Number, Mask> tightest() {
    std::pair<Number, Mask> found{0, 0};
    int fewest = kMostVertices + 1;
    for (const Number f : open_.list()) {
      const Apexes& own = look_for_apexes(f, fewest);
      if (own.count >= fewest) continue;
      fewest = own.count;
      found = {f, own.found};
      if (fewest == 1) break;
    }
    return found;
  }

  bool has_apexes(Number number) { return look_for_apexes(number, 1).count > 0; }

  bool fill_all() {
    const std::vector<Number>& open = open_.list();
    if (std::all_of(open.begin(), open.end(), [&](Number f) { return has_apexes(f); })) return fill();
    if (budget_ > 0) --budget_;
    return false;
  }

  // All open faces have apexes.
  bool fill() {
    if (open_.list().empty()) return true;
    if (budget_ == 0) return false;
    --budget_;
    const auto [number, mask] = tightest();
    const LocalFace face = corners_of(number);
    // Mostly there is only one.
    if (std::has_single_bit(mask)) return fill_at(number, face, static_cast<Local>(std::countr_zero(mask)));
    const Ranking order = ranked(face, mask);
    for (std::size_t k = 0; k < order.count; ++k)
      if (fill_at(number, face, order.list[k].second)) return true;
    return false;
  }

  // Fills with that tetrahedron. If a face that it opens has no apex, the search would find out at this node.
  bool fill_at(Number number, const LocalFace& face, Local apex) {
    Changes changes;
    if (place(number, apex, changes)) {
      if (have_apexes(changes)) {
        tets_.push_back({face[0], face[1], face[2], apex});
        if (fill()) return true;
        tets_.pop_back();
      } else if (budget_ > 0) {
        --budget_;
      }
    }
    undo(changes);
    return false;
  }

  struct Changes {
    struct Change {
      Number face;
      bool added;
    };
    std::array<Change, 4> list;
    std::size_t count = 0;
  };
  void change(Number f, bool add, Changes& changes) {
    add ? open_.add(f) : open_.remove(f);
    changes.list[changes.count++] = {f, add};
  }
  // Whether the opened faces have apexes: all others had some before.
  bool have_apexes(const Changes& changes) {
    return std::all_of(changes.list.begin(), changes.list.begin() + changes.count,
                       [&](const Changes::Change& c) { return !c.added || has_apexes(c.face); });
  }
  void undo(const Changes& changes) {
    for (std::size_t k = changes.count; k-- > 0;)
      changes.list[k].added ? open_.remove(changes.list[k].face) : open_.add(changes.list[k].face);
  }

  // Covers a face with the tetrahedron (f, d): its other faces close open ones or open new ones.
  bool place(FaceNumber number, Local d, Changes& changes) {
    const LocalFace f = corners_of(number);
    change(number, false, changes);
    for (std::size_t k = 0; k < 3; ++k) {
      const Number own = number_of({f[(k + 1) % 3], f[k], d});  // as the inside of the tetrahedron sees it
      const Number rest = own ^ Number { 1 };                   // as what is left to fill sees it
      if (open_.holds(own)) {
        change(own, false, changes);
      } else {
        if (open_.holds(rest)) return false;
        change(rest, true, changes);
      }
    }
    return true;
  }

  const TetMesh& mesh_;
  std::size_t budget_;
  const double worst_quality_;
  const PolyhedronOptions::Measure measure_;
  const std::size_t n_;
  Sides sides_;
  Sparse<Apexes> apexes_;   // by face
  std::vector<Fits> fits_;  // by the number of the four corners
  OpenFaces open_;
  std::vector<std::array<Local, 4>> tets_;
};

// None if the polyhedron is too large.
std::optional<Search> search_of(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces,
                                const PolyhedronOptions& options) {
  const std::size_t most = std::min(options.most_vertices, kMostVertices);
  // Euler: a sphere of triangles on n vertices has 2 n - 4 of them.
  if (faces.empty() || faces.size() > 2 * most) return std::nullopt;
  std::vector<Vertex> vertices = corners_of_all(faces);
  if (vertices.size() > most) return std::nullopt;
  return std::optional<Search>(std::in_place, mesh, faces, std::move(vertices), options);
}

}  // namespace

std::optional<std::vector<TetMesh::Corners>> fill_polyhedron(const TetMesh& mesh,
                                                             std::span<const std::array<Vertex, 3>> faces,
                                                             const PolyhedronOptions& options) {
  std::optional<Search> search = search_of(mesh, faces, options);
  return search ? search->run() : std::nullopt;
}

bool is_unfillable(const TetMesh& mesh, std::span<const std::array<Vertex, 3>> faces,
                   const PolyhedronOptions& options) {
  std::optional<Search> search = search_of(mesh, faces, options);
  return search && search->is_unfillable();
}

}  // namespace holdfast
