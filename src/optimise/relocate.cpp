#include "optimise/relocate.h"

#include <algorithm>
#include <cmath>

#include "mesh/editor.h"
#include "mesh/kernel.h"
#include "mesh/quality.h"
#include "numbers/random.h"
#include "optimise/badness.h"

namespace holdfast {
namespace {

class Relocation {
 public:
  Relocation(TetMesh& mesh, Vertex p, std::span<const Tet> ball)
      : mesh_(mesh), p_(p), kernel_(kernel_of_ball(mesh, p, ball)) {}

  bool run(std::mt19937_64& random) {
    at_ = mesh_.position(p_);
    const double before = worst_ = worst_at(at_, std::numeric_limits<double>::infinity());
    try_centre();
    search(random);
    if (!(worst_ < tuning::kLeastGain * before)) return false;
    MeshEditor(mesh_).move_vertex(p_, at_);
    return true;
  }

 private:
  // Infinite if it is not below `limit`.
  [[nodiscard]] double worst_at(const Point& x, double limit) const {
    double worst = 0;
    for (const auto& f : kernel_.faces()) {
      worst = std::max(worst, quality(mesh_.position(f[0]), mesh_.position(f[1]), mesh_.position(f[2]), x));
      if (!(worst < limit)) return std::numeric_limits<double>::infinity();
    }
    return worst;
  }

  bool step_to(const Point& to) {
    const Point x = mesh_.on_grid(to);
    const double worst = worst_at(x, worst_);
    if (!(worst < worst_) || !kernel_.holds({x.data(), nullptr})) return false;
    worst_ = worst;
    at_ = x;
    return true;
  }

  void try_centre() {
    const exact::PointRef origin = mesh_.point(p_);
    const Kernel::Centre centre = kernel_.centre(origin);
    size_ = centre.size;
    Point x = at_;
    for (std::size_t k = 0; k < 3; ++k) x[k] += centre.offset[k];
    step_to(x);
  }

  // Searches in random directions. The step doubles after a success and is halved after some failures.
  void search(std::mt19937_64& random) {
    double step = tuning::kFirstStep * size_;
    int failures = 0;
    for (int k = 0; k < tuning::kMoveTries; ++k) {
      Point x = at_;
      for (double& c : x) c += step * numbers::bell(random);
      if (step_to(x)) {
        step *= 2;
        failures = 0;
      } else if (++failures == tuning::kMovePatience) {
        step /= 2;
        failures = 0;
      }
    }
  }

  TetMesh& mesh_;
  const Vertex p_;
  Kernel kernel_;
  Point at_{};
  double worst_ = 0;
  double size_ = 0;
};

}  // namespace

bool relocate(TetMesh& mesh, Vertex p, std::span<const Tet> ball, std::mt19937_64& random) {
  return Relocation(mesh, p, ball).run(random);
}

}  // namespace holdfast
