#include "refine/field_inserter.h"

#include <algorithm>

#include "mesh/editor.h"
#include "numbers/vector.h"
#include "refine/circumcentre.h"
#include "refine/parts.h"
#include "refine/tuning.h"

namespace holdfast {
std::span<const Tet> FieldInserter::insert(const Point& x, Tet start) {
  const RegionId region = volume_.region_of[start];
  const Vertex p = MeshEditor(mesh_).add_vertex(x);
  if (!fits(p, start)) {
    MeshEditor(mesh_).remove_last_vertex();
    return {};
  }
  volume_.sizes.push_back(size_);
  if (volume_.metrics != nullptr) volume_.metrics->push_back(metric_);
  cavity_.insert();
  volume_.region_of.resize(mesh_.slot_count(), kNone);
  for (const Tet t : cavity_.created()) volume_.region_of[t] = region;
  return cavity_.created();
}

// Keeps the cavity if it returns true.
bool FieldInserter::fits(Vertex p, Tet start) {
  const RegionId region = volume_.region_of[start];
  const Tet base = cavity_.locate(p, start);
  if (base == kNone || mesh_.is_ghost(base) || volume_.region_of[base] != region) return false;
  if (!is_far_from(p, vertices_round(base), region)) return false;
  const bool found = cavity_.find(p, base, frame_);
  if (found && !is_near_an_interface(p) && is_far_from(p, cavity_.ring(), region) && !is_near_a_facet(p) &&
      !is_near_beyond(p) && !sizes_.of_facets().is_too_near(mesh_.position(p), asked_, by_))
    return true;
  wasted_ += cavity_.work();
  if (found) cavity_.abandon();
  return false;
}

// Whether p is in the smallest ball round a face of an interface: then spheres beyond the face may contain p.
bool FieldInserter::is_near_an_interface(Vertex p) const {
  return volume_.part != nullptr &&
         std::any_of(cavity_.rim().begin(), cavity_.rim().end(), [&](const RimFace& rim) {
           if (!volume_.part->is_beyond_interface(tet_of(rim.outer))) return false;
           if (!volume_.part->is_beyond_cut(tet_of(rim.outer))) return true;
           const Point& a = mesh_.position(rim.v[0]);
           const Vector centre = circle_centre(mesh_.position(rim.v[1]) - a, mesh_.position(rim.v[2]) - a);
           const Vector x = mesh_.position(p) - a;
           return !(dot(x, x) > 2 * dot(x, centre));
         });
}

// The vertices of t and the tetrahedra next to it. If p is too near to one of them, finding the cavity is
// saved.
std::span<const Vertex> FieldInserter::vertices_round(Tet t) {
  const auto& c = mesh_.corners(t);
  std::copy(c.begin(), c.end(), round_.begin());
  std::size_t count = c.size();
  for (int i = 0; i < 4; ++i) {
    const Face f = face_code(t, i);
    const Vertex v = mesh_.apex(mesh_.neighbour(f));
    if (!mesh_.is_facet(f) && v != kGhost) round_[count++] = v;
  }
  return {round_.data(), count};
}

// Whether p keeps its distance from these vertices. Leaves the wanted size in size_ and wanted_, and the
// metric and its frame if there are metrics.
bool FieldInserter::is_far_from(Vertex p, std::span<const Vertex> vertices, RegionId region) {
  const Point& x = mesh_.position(p);
  double nearest = std::numeric_limits<double>::infinity();
  size_ = sizes_.limit(x, region);
  double mean = 0, weights = 0;  // of the sizes; nearer vertices have larger weights
  for (const Vertex v : vertices) {
    const double d = distance(mesh_.position(v), x);
    nearest = std::min(nearest, d);
    size_ = std::min(size_, volume_.sizes[v] + sizes_.gradation() * d);
    mean += volume_.sizes[v] / d;
    weights += 1 / d;
  }
  if (!sizes_.grows() && weights > 0) size_ = std::min(size_, mean / weights);
  asked_ = size_;
  by_ = sizes_.decider(size_, region);
  if (!sizes_.of_facets().empty()) size_ = sizes_.of_facets().bearable(x, size_, by_);
  wanted_ = size_;
  if (volume_.metrics != nullptr) nearest = want_metric(p, vertices);
  return nearest >= tuning::kNearest * wanted_;
}

// Combines the size and the user's metric into one metric. Returns the distance of the nearest vertex in it.
double FieldInserter::want_metric(Vertex p, std::span<const Vertex> vertices) {
  const Point& x = mesh_.position(p);
  metric_ = sizes_.metric(x, size_);
  size_ = largest_size(metric_);
  frame_ = Frame(metric_, x);
  wanted_ = 1;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vertex v : vertices) nearest = std::min(nearest, length(metric_, mesh_.position(v) - x));
  return nearest;
}

// Where constraints cut the cavity, or where the mesh is not Delaunay, a near vertex may be just beyond the
// cavity.
bool FieldInserter::is_near_beyond(Vertex p) const {
  const double least = tuning::kNearest * wanted_;
  for (const RimFace& rim : cavity_.rim()) {
    const Vertex v = mesh_.apex(rim.outer);
    if ((rim.flags & facet_bit(3)) == 0 && v != kGhost &&
        distance(frame_.to(mesh_.position(v)), frame_.to(mesh_.position(p))) < least)
      return true;
  }
  return false;
}

bool FieldInserter::is_near_a_facet(Vertex p) const {
  for (const RimFace& rim : cavity_.rim()) {
    if ((rim.flags & facet_bit(3)) == 0) continue;
    const Point a = frame_.to(mesh_.position(rim.v[0]));
    const Vector n = cross(frame_.to(mesh_.position(rim.v[1])) - a, frame_.to(mesh_.position(rim.v[2])) - a);
    const double height = dot(n, frame_.to(mesh_.position(p)) - a);
    if (height * height < tuning::kLeastHeight * tuning::kLeastHeight * wanted_ * wanted_ * dot(n, n))
      return true;
  }
  return false;
}

}  // namespace holdfast
