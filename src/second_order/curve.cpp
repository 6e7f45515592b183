// Elements of second order on a smooth surface.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "holdfast/second_order.h"
#include "mesh/plain_monitor.h"
#include "numbers/float_environment.h"
#include "numbers/vector.h"
#include "second_order/edges_of.h"
#include "second_order/positive.h"
#include "surface/nearest.h"

namespace holdfast {
namespace {

constexpr double kShareOfEdge = 0.1;

void require_sound(const Volume& volume, const Complex& surface, const CurveOptions& options) {
  const auto finite = [](const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  if (!(options.tolerance >= 0 && std::isfinite(options.tolerance)))
    throw std::invalid_argument("the tolerance must be finite and not negative");
  for (const Triangle& t : surface.facets)
    for (const Index v : t) {
      if (v >= surface.vertices.size())
        throw std::out_of_range("a triangle of the smooth surface names a vertex that does not exist");
      if (!finite(surface.vertices[v]))
        throw std::invalid_argument("the smooth surface has a coordinate that is not finite");
    }
  if (!std::all_of(volume.vertices.begin(), volume.vertices.end(), finite))
    throw std::invalid_argument("the volume has a coordinate that is not finite");
}

class Curver {
 public:
  Curver(Volume& volume, const Complex& surface, const CurveOptions& options, PlainMonitor& monitor)
      : volume_(volume),
        options_(options),
        monitor_(monitor),
        nearest_(surface.vertices, surface.facets),
        curved_(volume.mid_nodes.points.size(), false) {}

  CurveReport run() {
    move_nodes();
    straighten();
    report_.moved = static_cast<std::size_t>(std::count(curved_.begin(), curved_.end(), true));
    for (std::size_t n = 0; n < curved_.size(); ++n)
      if (curved_[n]) report_.farthest = std::max(report_.farthest, distance(nodes()[n], straight_[n]));
    return report_;
  }

 private:
  std::vector<Point>& nodes() { return volume_.mid_nodes.points; }

  void move_nodes() {
    straight_ = nodes();
    std::vector<bool> seen(nodes().size(), false);
    for (std::size_t f = 0; f < volume_.facets.size(); ++f)
      for (std::size_t e = 0; e < kFacetEdges.size(); ++e) {
        monitor_.poll_again();
        const std::size_t n = volume_.mid_nodes.facets[f][e] - volume_.vertices.size();
        if (seen[n]) continue;
        seen[n] = true;
        ++report_.on_facets;
        const Point &a = volume_.vertices[volume_.facets[f][kFacetEdges[e][0]]],
                    &b = volume_.vertices[volume_.facets[f][kFacetEdges[e][1]]];
        double reach = options_.tolerance > 0 ? options_.tolerance : kShareOfEdge * distance(a, b);
        Point on_surface{};
        if (!nearest_.find(straight_[n], reach, on_surface)) {
          ++report_.beyond;
        } else if (on_surface != straight_[n]) {
          nodes()[n] = on_surface;
          curved_[n] = true;
        }
      }
  }

  // Nodes are only ever straightened, so the loop ends.
  void straighten() {
    std::vector<std::uint8_t> proven(volume_.tetrahedra.size(), 0);
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<bool> back(nodes().size(), false);
      report_.not_positive = 0;
      for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
        monitor_.poll_again();
        if (proven[t] != 0) continue;
        if (is_positive_everywhere(volume_, t)) {
          proven[t] = 1;
          continue;
        }
        bool has_curved = false;
        for (const Index node : volume_.mid_nodes.tetrahedra[t]) {
          const std::size_t n = node - volume_.vertices.size();
          if (!curved_[n]) continue;
          has_curved = true;
          back[n] = true;
        }
        if (!has_curved) ++report_.not_positive;
      }
      for (std::size_t n = 0; n < back.size(); ++n) {
        if (!back[n]) continue;
        changed = true;
        ++report_.straightened;
        curved_[n] = false;
        nodes()[n] = straight_[n];
      }
      // Elements that share a node with these have a new shape.
      if (changed)
        for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t)
          for (const Index node : volume_.mid_nodes.tetrahedra[t])
            if (back[node - volume_.vertices.size()]) proven[t] = 0;
    }
  }

  Volume& volume_;
  const CurveOptions& options_;
  PlainMonitor& monitor_;
  const NearestOnSurface nearest_;
  std::vector<bool> curved_;
  std::vector<Point> straight_;
  CurveReport report_;
};

}  // namespace

CurveReport curve_mid_nodes(Volume& volume, const Complex& surface, const CurveOptions& options) {
  const FloatEnvironment environment;
  PlainMonitor monitor(options, {});
  require_sound(volume, surface, options);
  if (volume.mid_nodes.tetrahedra.size() != volume.tetrahedra.size() ||
      volume.mid_nodes.facets.size() != volume.facets.size())
    add_mid_nodes(volume, options);
  return Curver(volume, surface, options, monitor).run();
}

}  // namespace holdfast
