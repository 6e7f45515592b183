#include "improve/smooth.h"

#include <cmath>

#include "mesh/traverse.h"

namespace holdfast {

bool VertexSmoother::smooth(Vertex v, bool patient) {
  gather(v);
  if (tets_.size() > kMostBall) return false;
  const Point old = volume_.mesh().position(v);
  const double before = volume_.energy(tets_);
  at_ = old;
  energy_ = before;
  step_towards(ideal_place());
  if (patient) {
    constexpr int kSteps = 6;
    for (int k = 0; k < kSteps && descend(); ++k) {
    }
  }
  if (!is_less(energy_, before) || (patient && energy_ > 0.997 * before)) return false;
  return settle(v);
}

void VertexSmoother::gather(Vertex v) {
  TetMesh& mesh = volume_.mesh();
  tets_.clear();
  faces_.clear();
  holdfast::ball(mesh, v, tets_);
  double sum = 0;
  for (const Tet t : tets_) {
    const auto f = mesh.face_vertices(face_code(t, mesh.index_of(t, v)));
    faces_.push_back({mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2]), f});
    const Point& a = faces_.back().a;
    const Point& b = faces_.back().b;
    sum += std::sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                     (b[2] - a[2]) * (b[2] - a[2]));
  }
  size_ = sum / static_cast<double>(tets_.size());
}

// Of the ball with v at x; infinite, or at least `limit`, where it is not below that.
double VertexSmoother::energy_at(const Point& x, double limit) {
  double sum = 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const FaceOfLink& f = faces_[k];
    sum += holdfast::energy(f.a, f.b, f.c, x);
    if (sum >= limit) {
      if (k > 0) std::swap(faces_[k], faces_[k / 2]);  // what decides comes sooner next time
      return sum;
    }
  }
  return sum;
}

bool VertexSmoother::step_to(const Point& x) {
  const double e = energy_at(x, energy_);
  if (!(e < energy_)) return false;
  energy_ = e;
  at_ = x;
  return true;
}

// The whole way, or a half, or a quarter of it.
bool VertexSmoother::step_towards(const Point& target) {
  const Point from = at_;
  for (double part = 1; part > 0.2; part /= 2) {
    Point x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = from[k] + part * (target[k] - from[k]);
    if (step_to(x)) return true;
  }
  return false;
}

// The mean of the places that the faces of the link would have v at: over their centres, as high as a regular
// tetrahedron. Those whose tetrahedra are bad have more to say.
Point VertexSmoother::ideal_place() const {
  constexpr double kHeight = 0.8164965809277260;  // of a regular tetrahedron of unit edges
  Point sum{};
  double weights = 0;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto& [a, b, c, v] = faces_[k];
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double n2 = nx * nx + ny * ny + nz * nz;
    if (!(n2 > 0)) continue;
    // A triangle of this area has edges of length sqrt(4 / sqrt(3) * area).
    const double area = std::sqrt(n2);
    const double height = kHeight * std::sqrt(1.1547005383792515 * area) / area;
    const double weight = std::sqrt(std::sqrt(volume_.energy(tets_[k])));
    weights += weight;
    sum[0] += weight * ((a[0] + b[0] + c[0]) / 3 + height * nx);
    sum[1] += weight * ((a[1] + b[1] + c[1]) / 3 + height * ny);
    sum[2] += weight * ((a[2] + b[2] + c[2]) / 3 + height * nz);
  }
  if (!(weights > 0)) return at_;
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
}

// One step down the gradient, by differences: the length of the first trial is a part of the ball's size.
bool VertexSmoother::descend() {
  const double h = 1e-5 * size_;
  Point gradient;
  for (std::size_t k = 0; k < 3; ++k) {
    Point x = at_;
    x[k] += h;
    gradient[k] = energy_at(x, kNoEnergy) - energy_;
  }
  const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
  if (!(length > 0 && length < kNoEnergy)) return false;
  for (double step = 0.15 * size_; step > 0.004 * size_; step /= 2.5) {
    Point x = at_;
    for (std::size_t k = 0; k < 3; ++k) x[k] -= step * gradient[k] / length;
    const double before = energy_;
    if (step_to(x)) return energy_ < 0.995 * before;
  }
  return false;
}

// Makes the move if the exact signs agree.
bool VertexSmoother::settle(Vertex v) {
  TetMesh& mesh = volume_.mesh();
  const Point old = mesh.position(v);
  mesh.move_vertex(v, at_);
  for (const FaceOfLink& f : faces_)
    if (mesh.orient(f.v[0], f.v[1], f.v[2], v) <= 0) {
      mesh.move_vertex(v, old);
      return false;
    }
  for (const Tet t : tets_) volume_.note(t, volume_.energy_of(mesh.corners(t)));
  return true;
}

}  // namespace holdfast
