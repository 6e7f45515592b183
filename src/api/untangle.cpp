// Untangling (paper §6.4): validate, relocate, swap, smooth, refill by the mesher itself, improve, check.
#include "holdfast/untangle.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "api/improve_tangle.h"
#include "api/mesh.h"
#include "api/scale.h"
#include "holdfast/check.h"
#include "mesh/limit_message.h"
#include "mesh/memory.h"
#include "mesh/monitor.h"
#include "numbers/float_environment.h"
#include "surface/diagnose.h"
#include "untangle/assemble.h"
#include "untangle/connectivity.h"
#include "untangle/make_positive.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostDefects = 100;
constexpr std::size_t kMostVertices = std::size_t{1} << 28;

void require_sensible(const Volume& volume, const UntangleOptions& options) {
  const auto fits = [](const auto& marks, const auto& entities) {
    return marks.empty() || marks.size() == entities.size();
  };
  if (!fits(volume.regions, volume.tetrahedra))
    throw std::invalid_argument("as many region ids as tetrahedra are needed, or none");
  if (!fits(volume.facet_markers, volume.facets))
    throw std::invalid_argument("as many facet markers as facets are needed, or none");
  if (!fits(volume.segment_markers, volume.segments))
    throw std::invalid_argument("as many segment markers as segments are needed, or none");
  if (!fits(volume.vertex_markers, volume.vertices))
    throw std::invalid_argument("as many vertex markers as vertices are needed, or none");
  for (const Index v : options.fixed)
    if (v >= volume.vertices.size())
      throw std::invalid_argument("vertex " + std::to_string(v) + " is to be fixed, but there are " +
                                  std::to_string(volume.vertices.size()) + " vertices");
  if (options.improve && !options.refill)
    throw std::invalid_argument("improving adds and removes vertices, so that it needs refill");
  if (volume.vertices.size() > kMostVertices) throw std::length_error("more than 2^28 vertices are too many");
}

// Free vertices may lie anywhere, but need a position: vertices that are not finite move to the middle.
std::vector<Point> finite_positions(const Volume& volume, const std::vector<bool>& fixed) {
  const auto finite = [](const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  std::vector<Point> points = volume.vertices;
  Point middle{};
  double count = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!fixed[v]) continue;
    ++count;
    for (std::size_t k = 0; k < 3; ++k) middle[k] += (points[v][k] - middle[k]) / count;
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!fixed[v] && !finite(points[v])) points[v] = finite(middle) ? middle : Point{};
  return points;
}

// The scale of the fixed vertices; the others may lie anywhere.
int scale_of_fixed(const Volume& volume, const std::vector<bool>& fixed) {
  std::vector<Point> points;
  for (std::size_t v = 0; v < fixed.size(); ++v)
    if (fixed[v]) points.push_back(volume.vertices[v]);
  return choose_scale(points);
}

// A volume and its boundary with the constrained vertices first, as `check` expects them.
struct Ordered {
  Volume volume;
  Surface boundary;
};

Ordered constrained_first(const Volume& volume, const Connectivity& connectivity) {
  const std::vector<bool>& fixed = connectivity.constraints.fixed;
  const auto is_fixed = [&](std::size_t v) { return v < fixed.size() && fixed[v]; };
  std::vector<bool> used(volume.vertices.size(), false);
  for (const Tetrahedron& t : volume.tetrahedra)
    for (const Index v : t) used[v] = true;
  Ordered out{volume, {}};
  out.volume.vertices.clear();
  std::vector<Index> index(volume.vertices.size(), 0);
  for (const bool first : {true, false})
    for (std::size_t v = 0; v < volume.vertices.size(); ++v) {
      if (!used[v] || is_fixed(v) != first) continue;
      index[v] = static_cast<Index>(out.volume.vertices.size());
      out.volume.vertices.push_back(volume.vertices[v]);
      if (first) out.boundary.vertices.push_back(volume.vertices[v]);
    }
  const auto renumber = [&](auto& entities) {
    for (auto& entity : entities)
      for (Index& v : entity) v = index[v];
  };
  out.volume.facets.insert(out.volume.facets.end(), connectivity.outer_faces.begin(),
                           connectivity.outer_faces.end());
  out.volume.vertex_markers.clear();
  out.volume.facet_markers.clear();
  out.volume.segment_markers.clear();
  renumber(out.volume.tetrahedra);
  renumber(out.volume.facets);
  renumber(out.volume.segments);
  out.boundary.facets = out.volume.facets;
  out.boundary.segments = out.volume.segments;
  return out;
}

class Untangling {
 public:
  Untangling(const Volume& volume, const UntangleOptions& options)
      : volume_(volume), options_(options), limits_(limits()), monitor_(limits_), watch_(monitor_) {}

  UntangleResult run() {
    try {
      run_steps();
    } catch (const Interrupted& interrupted) {
      give_up(interrupted.outcome());
    } catch (const std::bad_alloc&) {
      if (options_.memory_limit == 0) throw;
      give_up(Outcome::memory_limit);
    }
    watch_.finish();
    result_.report.seconds = watch_.seconds();
    result_.report.seconds["total"] = seconds();
    result_.report.peak_memory_bytes = peak_memory_bytes();
    return std::move(result_);
  }

 private:
  // The monitor's options: limits, and a callback that reports the step and the progress.
  Options limits() {
    Options limits;
    static_cast<Limits&>(limits) = options_;
    if (options_.progress) limits.progress = [this](const Progress&) { return tell(); };
    return limits;
  }

  bool tell() {
    double fraction = 0;
    if (tangle_ && at_first_ > 0)
      fraction = 1 - std::min(1.0, static_cast<double>(tangle_->nonpositive_count()) /
                                       static_cast<double>(at_first_));
    return options_.progress({watch_.step(), fraction});
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  void run_steps() {
    watch_.enter(UntangleStep::validate);
    if (!validate()) return;
    const CavityFiller filler = [this](const Complex& complex) { return fill(complex); };
    const UntangleStats stats = make_positive(*tangle_, options_.refill ? &filler : nullptr, watch_);
    result_.report.rounds = stats.rounds;
    result_.report.swapped = stats.swapped;
    result_.report.cavities = stats.refill.cavities;
    count_signs(result_.report.negative_after, result_.report.null_after);
    if (tangle_->nonpositive_count() > 0) return conclude_tangled(stats.refill);
    if (options_.improve) {
      watch_.enter(UntangleStep::improve);
      improve();
    }
    watch_.enter(UntangleStep::check);
    deliver();
  }

  void improve() {
    const ImprovedTangle improved = improve_tangle(*tangle_, grid_after(scale_), options_.seed, monitor_);
    const auto told = [](const Figures& figures) -> UntangleReport::Improved::Figures {
      return {figures.least().degrees(), figures.mean_quality(), figures.below_10_deg(), figures.elements()};
    };
    const ImproveStats& stats = improved.stats;
    result_.report.improved = {stats.moved,    stats.swapped,         stats.contracted,
                               stats.inserted, told(improved.before), told(improved.after)};
  }

  bool validate() {
    result_.report.vertices = volume_.vertices.size();
    result_.report.tetrahedra = volume_.tetrahedra.size();
    connectivity_ = read_connectivity(volume_, options_.fixed);
    if (!connectivity_.fault.empty()) {
      refuse("the connectivity is not that of a mesh: " + connectivity_.fault);
      return false;
    }
    const Surface boundary = boundary_surface(volume_, connectivity_);
    result_.defects = find_defects(
        boundary.view(), kMostDefects, [this](double) { watch_.poll(); }, 1, SamePlace::defect);
    if (!result_.defects.empty()) {
      refuse("the boundary, which stays as it is, is not a valid surface");
      return false;
    }
    const std::vector<bool>& fixed = connectivity_.constraints.fixed;
    result_.report.free_vertices = static_cast<std::size_t>(std::count(fixed.begin(), fixed.end(), false));
    scale_ = scale_of_fixed(volume_, fixed);
    if (scale_ != 0) {
      scaled_ = volume_;
      scaled_.vertices = scaled(volume_.vertices, scale_);
    }
    const std::vector<Point> points = finite_positions(scaled_volume(), fixed);
    turn_outwards(connectivity_, points);
    result_.report.turned = connectivity_.turned;
    tangle_.emplace(points, connectivity_.tets, connectivity_.regions, connectivity_.constraints,
                    grid_after(scale_));
    at_first_ = tangle_->nonpositive_count();
    count_signs(result_.report.negative, result_.report.null);
    return true;
  }

  void count_signs(std::size_t& negative, std::size_t& null) const {
    for (const Tet t : tangle_->nonpositive()) ++(tangle_->sign(t) < 0 ? negative : null);
  }

  [[nodiscard]] const Volume& scaled_volume() const { return scale_ == 0 ? volume_ : scaled_; }

  // The mesher gets unscaled positions and chooses its own scale.
  Filled fill(Complex complex) {
    const std::vector<Point> points = scaled(complex.vertices, -scale_);
    complex.vertices = points;
    Options options;
    options.keep = Keep::bounded;
    options.drop_outside = true;  // free vertices may lie outside
    options.seed = options_.seed;
    if (options_.time_limit > 0) options.time_limit = std::max(1e-6, options_.time_limit - seconds());
    options.memory_limit = options_.memory_limit;
    options.cancel = options_.cancel;
    if (options_.progress) options.progress = [this](const Progress&) { return tell(); };
    Result result = mesh_as_given(complex, options);
    if (is_interruption(result.outcome)) throw Interrupted(result.outcome);
    if (result.outcome == Outcome::invalid_input) {
      Filled refused{.outcome = Filled::Outcome::invalid};
      for (const Defect& defect : result.defects)
        refused.faulty.insert(refused.faulty.end(), defect.vertices.begin(), defect.vertices.end());
      return refused;
    }
    std::vector<Point> found = scaled(result.volume.vertices, scale_);
    if (result.outcome != Outcome::done || scaled(found, -scale_) != result.volume.vertices)
      return {.outcome = Filled::Outcome::not_representable};
    result.volume.vertices = std::move(found);
    return {.volume = std::move(result.volume)};
  }

  void refuse(std::string why) {
    result_.outcome = Outcome::invalid_input;
    result_.message = std::move(why);
  }

  void give_up(Outcome outcome) {
    result_.outcome = outcome;
    result_.volume = {};
    result_.message = limit_message(outcome, options_) + " in step " + name(watch_.step());
  }

  void conclude_tangled(const RefillStats& refill) {
    if (refill.outside)
      return refuse(
          "the boundary is a valid surface, but a segment or a vertex that is to stay lies outside it");
    if (refill.overlaps)
      return refuse(
          "the boundary is a valid surface, but not that of this mesh: parts of the mesh lie within one "
          "another or inside out");
    result_.outcome = Outcome::not_representable;
    result_.message = options_.refill ? "no positive mesh in double precision was found"
                                      : "relocation and swaps leave tetrahedra that are not positive";
  }

  [[nodiscard]] std::vector<Rule> examined(const Ordered& ordered) {
    CheckOptions options;
    options.progress = [this](double) {
      watch_.poll_slow_loop();
      return true;
    };
    return check(ordered.boundary.view(), ordered.volume, options).rules;
  }

  void deliver() {
    Assembled assembled = assemble(scaled_volume(), *tangle_);
    if (scale_ != 0) undo_scale(assembled.volume.vertices);
    result_.report.moved = assembled.moved;
    result_.report.added = assembled.added;
    result_.report.removed = assembled.removed;
    const Ordered ordered = constrained_first(assembled.volume, connectivity_);
    for (const Rule& rule : examined(ordered)) {
      if (rule.holds) continue;
      if (rule.kind == RuleKind::no_overlap)
        return refuse("parts of the mesh overlap, though all of it is positive: " + rule.detail);
      if (rule.kind == RuleKind::volumes_positive || rule.kind == RuleKind::facets_kept ||
          rule.kind == RuleKind::segments_kept || rule.kind == RuleKind::faces_matched ||
          rule.kind == RuleKind::boundary_is_input || rule.kind == RuleKind::input_vertices_kept)
        throw std::logic_error("holdfast: untangling broke the mesh: " + rule.name + ": " + rule.detail);
    }
    result_.volume = std::move(assembled.volume);
  }

  // A vertex that did not move keeps its coordinates, even if scaling down rounded them.
  void undo_scale(std::vector<Point>& points) const {
    for (std::size_t v = 0; v < points.size(); ++v) {
      const bool stands = v < volume_.vertices.size() && points[v] == scaled_.vertices[v];
      points[v] = stands ? volume_.vertices[v] : scaled(points[v], -scale_);
    }
  }

  const Volume& volume_;
  const UntangleOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Options limits_;
  Monitor monitor_;
  Watch watch_;
  Connectivity connectivity_;
  int scale_ = 0;  // the tangle is the volume times 2^scale_
  Volume scaled_;  // the volume at that scale, if scale_ is not 0
  std::optional<Tangle> tangle_;
  std::size_t at_first_ = 0;  // number of tetrahedra that were not positive
  UntangleResult result_;
};

}  // namespace

UntangleResult untangle(const Volume& volume, const UntangleOptions& options) {
  const FloatEnvironment environment;
  require_sensible(volume, options);
  return Untangling(volume, options).run();
}

}  // namespace holdfast
