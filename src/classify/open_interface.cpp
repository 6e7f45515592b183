#include "classify/open_interface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "classify/words.h"
#include "mesh/traverse.h"
#include "surface/describe.h"
#include "surface/facet_index.h"

namespace holdfast {
namespace {

using Tell = std::function<void()>;

// Facets connected at edges without further facets, all with the same region on both sides.
struct Sheet {
  RegionId region;
  std::vector<Index> facets;
  std::vector<bool> is_turned;  // by facet of the sheet: relative to the first one
  std::vector<Index> border;    // segments at only one facet
  bool is_attached = false;     // to facets that are not of the sheet
  bool has_two_sides = true;
};

class SheetFinder {
 public:
  SheetFinder(const Regions& regions, const Kept& kept, const Complex& complex, const SegmentTable& table)
      : regions_(regions), kept_(kept), complex_(complex), table_(table), seen_(complex.facets.size()) {}

  std::vector<Sheet> run() {
    std::vector<Sheet> sheets;
    for (Index f = 0; f < complex_.facets.size(); ++f)
      if (!seen_[f] && is_inside(f)) sheets.push_back(sheet_at(f));
    return sheets;
  }

 private:
  [[nodiscard]] bool is_inside(Index f) const {
    const auto& [front, back] = regions_.of_facet[f];
    return front == back && kept_.region[front];
  }

  Sheet sheet_at(Index first) {
    Sheet sheet{regions_.of_facet[first][0], {first}, {false}, {}};
    std::map<Index, bool> turned{{first, false}};
    seen_[first] = true;
    for (std::size_t k = 0; k < sheet.facets.size(); ++k) {
      const Index f = sheet.facets[k];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index s = table_.facet_segments[f][i];
        const auto around = table_.facets_of(s);
        if (around.size() == 1) sheet.border.push_back(s);
        if (around.size() > 2) sheet.is_attached = true;
        if (around.size() != 2) continue;
        const Index g = around[0] == f ? around[1] : around[0];
        // Two facets with the same orientation run through their common side in opposite directions.
        const bool is_turned = sheet.is_turned[k] != (direction(f, s) == direction(g, s));
        const auto [place, added] = turned.emplace(g, is_turned);
        if (added) {
          seen_[g] = true;
          sheet.facets.push_back(g);
          sheet.is_turned.push_back(is_turned);
        } else if (place->second != is_turned) {
          sheet.has_two_sides = false;
        }
      }
    }
    return sheet;
  }

  // Whether facet f runs through segment s from its first to its second end.
  [[nodiscard]] bool direction(Index f, Index s) const {
    const Triangle& t = complex_.facets[f];
    for (std::size_t i = 0; i < 3; ++i)
      if (table_.facet_segments[f][i] == s) return t[(i + 1) % 3] == table_.segments[s][0];
    return false;
  }

  const Regions& regions_;
  const Kept& kept_;
  const Complex& complex_;
  const SegmentTable& table_;
  std::vector<bool> seen_;
};

// The fewest faces that separate some tetrahedra of a region from others. Facets separate already.
class LeastCut {
 public:
  LeastCut(const TetMesh& mesh, const Tell& tell)
      : mesh_(mesh),
        tell_(tell),
        flow_(4 * static_cast<std::size_t>(mesh.slot_count())),
        level_(mesh.slot_count(), kUnseen),
        next_(mesh.slot_count()),
        is_sink_(mesh.slot_count()) {}

  // The number of these faces; none if it exceeds `most`, or if no faces can separate them.
  std::optional<std::size_t> run(const std::vector<Tet>& sources, const std::vector<Tet>& sinks,
                                 std::size_t most) {
    clear();
    for (const Tet t : sinks) is_sink_[t] = 1;
    std::size_t cut = 0;
    const bool apart = std::none_of(sources.begin(), sources.end(), [&](Tet t) { return is_sink_[t] != 0; });
    while (apart && cut <= most && reach(sources))
      for (const Tet t : sources)
        while (cut <= most && push_from(t)) ++cut;
    for (const Tet t : sinks) is_sink_[t] = 0;
    if (!apart || cut > most) return std::nullopt;
    return cut;
  }

  // After a cut: whether t is on the side of the sources.
  [[nodiscard]] bool is_on_near_side(Tet t) const { return level_[t] != kUnseen; }

 private:
  static constexpr std::int32_t kUnseen = -1;

  void clear() {
    for (const Face f : used_) flow_[f] = 0;
    used_.clear();
    forget_levels();
  }
  void forget_levels() {
    for (const Tet t : seen_) level_[t] = kUnseen;
    seen_.clear();
  }

  [[nodiscard]] bool has_room(Face f) const { return flow_[f] < 1 && !mesh_.is_facet(f); }

  // Computes levels by distance from the sources, until a sink is reached; returns whether one is.
  bool reach(const std::vector<Tet>& sources) {
    forget_levels();
    for (const Tet t : sources) see(t, 0);
    std::int32_t last = std::numeric_limits<std::int32_t>::max();
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      const Tet t = seen_[k];
      if (level_[t] >= last) break;
      tell_();
      for (int i = 0; i < 4; ++i) {
        const Face f = face_code(t, i);
        const Tet n = tet_of(mesh_.neighbour(f));
        if (!has_room(f) || mesh_.is_ghost(n) || level_[n] != kUnseen) continue;
        see(n, level_[t] + 1);
        if (is_sink_[n] != 0) last = level_[n];
      }
    }
    return last != std::numeric_limits<std::int32_t>::max();
  }
  void see(Tet t, std::int32_t level) {
    if (level_[t] != kUnseen) return;
    level_[t] = level;
    next_[t] = 0;
    seen_.push_back(t);
  }

  // Finds one more path to a sink, level by level.
  bool push_from(Tet source) {
    path_.clear();
    Tet t = source;
    while (is_sink_[t] == 0) {
      std::uint8_t& i = next_[t];
      if (i == 4) {
        if (path_.empty()) return false;
        t = tet_of(path_.back());
        path_.pop_back();
        ++next_[t];
        continue;
      }
      const Face f = face_code(t, i);
      const Tet n = tet_of(mesh_.neighbour(f));
      if (has_room(f) && !mesh_.is_ghost(n) && level_[n] == level_[t] + 1) {
        path_.push_back(f);
        t = n;
      } else {
        ++i;
      }
    }
    for (const Face f : path_) {
      ++flow_[f];
      --flow_[mesh_.neighbour(f)];
      used_.push_back(f);
      used_.push_back(mesh_.neighbour(f));
    }
    return true;
  }

  const TetMesh& mesh_;
  const Tell& tell_;
  std::vector<std::int8_t> flow_;    // by face
  std::vector<std::int32_t> level_;  // by slot
  std::vector<std::uint8_t> next_;   // by slot: the next face to try
  std::vector<std::uint8_t> is_sink_;
  std::vector<Tet> seen_;
  std::vector<Face> used_, path_;
};

class Finder {
 public:
  Finder(TetMesh& mesh, const Regions& regions, const Kept& kept, const NamedComplex& input, const Tell& tell)
      : mesh_(mesh),
        regions_(regions),
        kept_(kept),
        complex_(input.complex),
        table_(input.table),
        names_(input.names),
        tell_(tell) {}

  std::vector<Warning> run() {
    std::vector<Warning> warnings;
    std::size_t looked_at = 0;
    for (const Sheet& sheet : SheetFinder(regions_, kept_, complex_, table_).run()) {
      if (!sheet.is_attached || !sheet.has_two_sides || sheet.border.empty()) continue;
      if (++looked_at > kMostSheets) break;
      if (const std::optional<std::size_t> cut = opening(sheet)) warnings.push_back(warn(sheet));
    }
    return warnings;
  }

 private:
  static constexpr std::size_t kMostSheets = 100;  // that are examined: each takes a cut

  // The number of faces that close the sheet's opening, if it has one.
  std::optional<std::size_t> opening(const Sheet& sheet) {
    std::vector<Tet> before, behind;
    for (std::size_t k = 0; k < sheet.facets.size(); ++k) {
      const Triangle& c = complex_.facets[sheet.facets[k]];
      const Face face = find_face(mesh_, c[0], c[1], c[2]);
      const Tet near = tet_of(face), far = tet_of(mesh_.neighbour(face));
      const bool is_before = turns_alike(c, mesh_.face_vertices(face)) != sheet.is_turned[k];
      before.push_back(is_before ? near : far);
      behind.push_back(is_before ? far : near);
    }
    if (!cut_) cut_.emplace(mesh_, tell_);
    const std::optional<std::size_t> faces = cut_->run(before, behind, sheet.facets.size());
    if (!faces) return std::nullopt;
    const std::array<std::set<int>, 2> markers = markers_round(sheet);
    if (markers[0].empty() || markers[1].empty()) return std::nullopt;
    const bool is_small = 2 * *faces < sheet.facets.size();
    return is_small || markers[0] != markers[1] ? faces : std::nullopt;
  }

  static bool turns_alike(const Triangle& f, const Triangle& g) {
    for (std::size_t k = 0; k < 3; ++k)
      if (f[0] == g[k]) return f[1] == g[(k + 1) % 3];
    return false;
  }

  // The markers of facets outside the sheet, at each of the two parts into which the cut divides its region.
  std::array<std::set<int>, 2> markers_round(const Sheet& sheet) {
    if (!index_) index_.emplace(complex_.vertices.size(), complex_.facets);
    const std::set<Index> own(sheet.facets.begin(), sheet.facets.end());
    std::array<std::set<int>, 2> markers;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      tell_();
      if (!mesh_.alive(t) || mesh_.is_ghost(t) || (mesh_.flags(t) & kFacetBits) == 0) continue;
      if (regions_.of_tet[t] != sheet.region) continue;
      for (int i = 0; i < 4; ++i) {
        if (!mesh_.is_facet(face_code(t, i))) continue;
        const Index f = index_->find(mesh_.face_vertices(face_code(t, i)));
        if (own.contains(f)) continue;
        const int marker = complex_.facet_markers.empty() ? 0 : complex_.facet_markers[f];
        markers[cut_->is_on_near_side(t) ? 0 : 1].insert(marker);
      }
    }
    return markers;
  }

  [[nodiscard]] Warning warn(const Sheet& sheet) const {
    Warning warning{WarningKind::open_interface, sheet.facets, {}, {}, {}};
    std::sort(warning.facets.begin(), warning.facets.end());
    std::vector<Index> border = sheet.border;
    std::sort(border.begin(), border.end(),
              [&](Index a, Index b) { return table_.segments[a] < table_.segments[b]; });
    for (const Index s : border)
      warning.border.push_back({names_(table_.segments[s][0]), names_(table_.segments[s][1])});
    const Index first = warning.border.front()[0];
    warning.where.push_back(complex_.vertices[table_.segments[border.front()][0]]);
    const bool one = warning.facets.size() == 1;
    const std::size_t edges = warning.border.size();
    warning.message = "region " + std::to_string(kept_.id[sheet.region]) + " would be two, parted by " +
                      listed("triangle", "triangles", warning.facets) + ", but " +
                      (one ? "it has" : "they have") + " an open border of " + std::to_string(edges) +
                      (edges == 1 ? " edge" : " edges") + " at vertex " + std::to_string(first) + " " +
                      place(warning.where[0]) + "; triangles may be missing there";
    return warning;
  }

  TetMesh& mesh_;
  const Regions& regions_;
  const Kept& kept_;
  const Complex& complex_;
  const SegmentTable& table_;
  const VertexNames& names_;
  const Tell& tell_;
  std::optional<LeastCut> cut_;
  std::optional<FacetIndex> index_;
};

}  // namespace

std::vector<Warning> find_open_interfaces(TetMesh& mesh, const Regions& regions, const Kept& kept,
                                          const NamedComplex& input, const std::function<void()>& tell) {
  return Finder(mesh, regions, kept, input, tell).run();
}

}  // namespace holdfast
