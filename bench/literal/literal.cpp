#include "literal/literal.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>

#include "delaunay/box.h"
#include "delaunay/delaunay.h"
#include "enforce/partition.h"
#include "mesh/editor.h"
#include "recover/recover.h"
#include "recover/standing.h"

namespace holdfast::literal {
namespace {

constexpr double kMargin = 0.5;  // of the box, in extents of the surface

std::vector<Index> missing_in(const std::vector<std::uint8_t>& stands, numbers::Random& random) {
  std::vector<Index> missing;
  for (Index k = 0; k < stands.size(); ++k)
    if (stands[k] == 0) missing.push_back(k);
  numbers::shuffle(missing.begin(), missing.end(), random);
  return missing;
}

// The mesh of the box, with all constraints in pieces.
class Partitioned {
 public:
  Partitioned(const Surface& surface, const How& how, Told& told)
      : surface_(surface), how_(how), told_(told), random_(how.seed), table_(segment_table(surface.view())) {
    for (const Point& p : surface.vertices) MeshEditor(mesh).add_vertex(p);
    for (const Point& corner : box_corners(mesh.positions(), kMargin, {}))
      MeshEditor(mesh).add_vertex(corner);
    first_free = static_cast<Vertex>(mesh.vertex_count());
    if (!build_delaunay(mesh, {how.seed, 1}, nullptr)) throw std::logic_error("the box has no tetrahedra");
    standing_ = mark_present(mesh, table_);
    if (how.flips) FlipRecovery(mesh, {table_, surface.facets, standing_}, how.seed).run([](double) {});
    told.facets = surface.facets.size();
    told.segments = table_.segments.size();
    told.missing_facets = standing_.missing_facets();
    told.missing_segments = standing_.missing_segments();
    lay();
  }

  TetMesh mesh;
  Vertex first_free = 0;
  ConstraintPieces pieces;

  // Standing facets are faces of their own; of the others, the pieces.
  void tell_facets(Soup& soup) const {
    for (Index f = 0; f < surface_.facets.size(); ++f)
      if (standing_.facets[f] != 0) soup.set_facet(surface_.facets[f], f);
    for (const ConstraintPieces::SubFacets& sub : pieces.sub_facets)
      for (const auto& face : sub.faces) soup.set_facet(face, sub.facet);
  }

 private:
  void lay() {
    const std::function<void()> tell = [this] {
      if (told_.segment_points + told_.facet_points > how_.most_points)
        throw std::length_error("too many points");
    };
    Partition partition(mesh, table_, surface_.facets, first_free, random_, tell);
    for (const Index s : missing_in(standing_.segments, random_)) {
      const auto fresh = static_cast<Vertex>(mesh.vertex_count());
      told_.segment_points += partition.cut_segment(s);
      if (how_.grow) grow_from(fresh);
      tell();
    }
    for (const Index f : missing_in(standing_.facets, random_)) {
      told_.facet_points += partition.cut_facet(f);
      tell();
    }
    pieces = partition.take_pieces();
  }

  void grow_from(Vertex first) {
    for (Vertex p = first; p < mesh.vertex_count(); ++p) {
      InsertionPicture picture;
      grow_star(mesh, p, told_.insertion, &picture);
      if (picture.visible.size() + picture.delaunay.size() >
          told_.picture.visible.size() + told_.picture.delaunay.size())
        told_.picture = std::move(picture);
    }
  }

  const Surface& surface_;
  const How& how_;
  Told& told_;
  numbers::Random random_;
  SegmentTable table_;
  Standing standing_;
};

// Regions by flooding across faces that are no pieces of facets: 0 is what reaches the box's corners.
std::vector<int> regions_of(const Soup& soup, Vertex first_corner, Vertex first_free) {
  const std::vector<Soup::Corners>& tets = soup.tets();
  std::map<FaceKey, std::vector<Soup::Number>> sides;
  for (Soup::Number t = 0; t < tets.size(); ++t)
    for (int i = 0; soup.alive(t) && i < 4; ++i) sides[face_key(tets[t], i)].push_back(t);
  std::vector<int> region(tets.size(), -1);
  const auto flood = [&](Soup::Number start, int id) {
    region[start] = id;
    for (std::vector<Soup::Number> stack{start}; !stack.empty();) {
      const Soup::Number t = stack.back();
      stack.pop_back();
      for (int i = 0; i < 4; ++i) {
        const FaceKey key = face_key(tets[t], i);
        if (soup.facet_of(key)) continue;
        const auto& both = sides.at(key);
        if (both.size() > 2) throw std::logic_error("a face has more than two tetrahedra");
        for (const Soup::Number other : both)
          if (region[other] < 0) {
            region[other] = id;
            stack.push_back(other);
          }
      }
    }
  };
  for (Vertex corner = first_corner; corner < first_free; ++corner)
    for (const Soup::Number t : soup.ball(corner))
      if (region[t] < 0) flood(t, 0);
  int next = 1;
  for (Soup::Number t = 0; t < tets.size(); ++t)
    if (soup.alive(t) && region[t] < 0) flood(t, next++);
  return region;
}

// Those that border on what is kept.
void take_constraints(const Surface& surface, Volume& volume) {
  std::set<FaceKey> faces;
  std::set<EdgeKey> edges;
  for (const Tetrahedron& t : volume.tetrahedra) {
    for (int i = 0; i < 4; ++i) faces.insert(face_key(t, i));
    for (int k = 0; k < 6; ++k) edges.insert(edge_key(t, k));
  }
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    if (!faces.contains(face_key(surface.facets[f]))) continue;
    volume.facets.push_back(surface.facets[f]);
    if (!surface.facet_markers.empty()) volume.facet_markers.push_back(surface.facet_markers[f]);
  }
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {  // one that is given twice is one
    if (edges.erase(edge_key(surface.segments[s][0], surface.segments[s][1])) == 0) continue;
    volume.segments.push_back(surface.segments[s]);
    if (!surface.segment_markers.empty()) volume.segment_markers.push_back(surface.segment_markers[s]);
  }
}

// What the surface encloses, or the whole box where it encloses nothing; positions in the nearest doubles.
Volume volume_of(const Soup& soup, const Surface& surface, Vertex first_free, Told& told) {
  const auto count = static_cast<Vertex>(surface.vertices.size());
  const std::vector<int> region = regions_of(soup, count, first_free);
  told.whole_box = std::all_of(region.begin(), region.end(), [](int r) { return r <= 0; });
  Volume volume;
  volume.vertices = surface.vertices;
  std::vector<Index> number(soup.mesh().vertex_count(), no_entity);
  for (Vertex v = 0; v < count; ++v) number[v] = v;
  for (Soup::Number t = 0; t < soup.tets().size(); ++t) {
    if (!soup.alive(t) || (region[t] == 0 && !told.whole_box)) continue;
    Tetrahedron tetrahedron{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vertex v = soup.tets()[t][i];
      if (number[v] == no_entity) {
        number[v] = static_cast<Index>(volume.vertices.size());
        volume.vertices.push_back(soup.mesh().position(v));
      }
      tetrahedron[i] = number[v];
    }
    volume.tetrahedra.push_back(tetrahedron);
    volume.regions.push_back(region[t]);
    const auto& [a, b, c, d] = soup.tets()[t];
    const int sign = soup.mesh().orient(a, b, c, d);
    ++(sign > 0 ? told.inside.positive : sign == 0 ? told.inside.null : told.inside.negative);
  }
  take_constraints(surface, volume);
  return volume;
}

void finish(const Surface& surface, const How& how, Run& run) {
  UntangleOptions options;
  options.seed = how.seed;
  options.time_limit = how.time_limit;
  // Vertices that no facet holds are the input's, too.
  for (Index v = 0; v < surface.vertices.size(); ++v) options.fixed.push_back(v);
  UntangleResult result = untangle(run.tangled, options);
  run.told.untangling = result.report;
  if (result.outcome != Outcome::done) {
    run.told.ended = "untangle";
    run.told.message = result.message;
    return;
  }
  run.volume = std::move(result.volume);
  CheckOptions checking;
  checking.box = run.told.whole_box;
  checking.outside_dropped = true;
  for (const Rule& rule : check(surface.view(), run.volume, checking).rules)
    if (!rule.holds && rule.kind != RuleKind::no_vertex_unused) {
      run.told.ended = "check";
      run.told.message = rule.name + ": " + rule.detail;
      return;
    }
  run.told.vertices = run.volume.vertices.size();
  run.told.tetrahedra = run.volume.tetrahedra.size();
  run.told.ended = "done";
}

}  // namespace

Run run(const Surface& surface, const How& how) {
  Run run;
  Told& told = run.told;
  try {
    Partitioned partitioned(surface, how, told);
    Soup soup(partitioned.mesh);
    partitioned.tell_facets(soup);
    told.before = soup.count();
    numbers::Random random(how.seed);
    told.elimination = eliminate(soup, partitioned.pieces, surface.facets, random);
    told.after = soup.count();
    run.tangled = volume_of(soup, surface, partitioned.first_free, told);
  } catch (const std::length_error&) {
    told.ended = "given up";
    told.message = "the partition has too many points";
    return run;
  } catch (const std::logic_error& error) {
    told.ended = "eliminate";
    told.message = error.what();
    return run;
  }
  if (told.elimination.left > 0) {
    told.ended = "eliminate";
    told.message = std::to_string(told.elimination.left) + " points could not be taken off";
    return run;
  }
  if (how.untangle) finish(surface, how, run);
  return run;
}

}  // namespace holdfast::literal
