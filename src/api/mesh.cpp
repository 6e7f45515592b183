// The pipeline (design §2): validate, Delaunay, flips, partition and elimination, classify, suppress,
// optimise.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "api/extract.h"
#include "api/forced.h"
#include "api/report.h"
#include "api/scale.h"
#include "classify/keep.h"
#include "classify/outside.h"
#include "classify/regions.h"
#include "delaunay/box.h"
#include "delaunay/delaunay.h"
#include "enforce/enforce.h"
#include "holdfast/holdfast.h"
#include "improve/improve_parts.h"
#include "improve/shape.h"
#include "mesh/monitor.h"
#include "mesh/parallel.h"
#include "mesh/quality.h"
#include "mesh/tet_mesh.h"
#include "optimise/optimise.h"
#include "recover/other_diagonals.h"
#include "recover/recover.h"
#include "recover/standing.h"
#include "refine/field_points.h"
#include "size/size_function.h"
#include "suppress/suppress.h"
#include "surface/complex.h"
#include "surface/diagnose.h"
#include "surface/elements.h"
#include "surface/search.h"

namespace holdfast {
namespace {

constexpr std::size_t kMostDefects = 100;  // `diagnose` gives them all
constexpr int kMostAttempts = 5;
constexpr double kHiddenMargin = 0.5;  // of the box that is cut away again

void require_sensible(const Complex& complex, const Options& options) {
  const auto finite = [](const Point& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  };
  if (!complex.facet_markers.empty() && complex.facet_markers.size() != complex.facets.size())
    throw std::invalid_argument("as many facet markers as facets are needed, or none");
  if (!complex.segment_markers.empty() && complex.segment_markers.size() != complex.segments.size())
    throw std::invalid_argument("as many segment markers as segments are needed, or none");
  if (!std::all_of(options.holes.begin(), options.holes.end(), finite))
    throw std::invalid_argument("a hole has a coordinate that is not finite");
  if (!std::all_of(options.regions.begin(), options.regions.end(),
                   [&](const RegionSeed& seed) { return finite(seed.where); }))
    throw std::invalid_argument("a region seed has a coordinate that is not finite");
  if (options.sizes) {
    const Sizes& sizes = *options.sizes;
    if (!(sizes.size >= 0) || !(sizes.gradation >= 0 && sizes.gradation <= 1))
      throw std::invalid_argument("a size must not be negative, and the gradation lie between 0 and 1");
    if (!sizes.vertex_sizes.empty() && sizes.vertex_sizes.size() != complex.vertices.size())
      throw std::invalid_argument("as many sizes as vertices are needed, or none");
  }
  if (options.keep == Keep::box && !(options.box_margin > 0 && options.box_margin < 1e6))
    throw std::invalid_argument("the margin of the box must be positive and below a million");
}

class Pipeline {
 public:
  Pipeline(const Complex& complex, const Options& options)
      : complex_(complex),
        options_(options),
        threads_(options.threads),
        monitor_(options),
        seed_(options.seed) {}

  Result run() {
    {
      const Stopwatch total(result_.report, "total");
      try {
        run_stages();
      } catch (const Interrupted& interrupted) {
        give_up(interrupted.outcome());
      } catch (const std::bad_alloc&) {
        if (options_.memory_limit == 0) throw;
        give_up(Outcome::memory_limit);
      }
    }
    result_.report.peak_memory_bytes = peak_memory_bytes();
    return std::move(result_);
  }

 private:
  struct Step {
    Stage stage;
    void (Pipeline::*run)();
  };
  void run_stages() {
    run_stage({Stage::validate, &Pipeline::validate});
    if (result_.outcome != Outcome::done) return;
    run_attempt();
    int attempt = 1;
    while (attempt++ < kMostAttempts && result_.outcome == Outcome::not_representable && try_again()) {
    }
  }

  void run_stage(const Step& step) {
    const Stopwatch watch(result_.report, name(step.stage));
    monitor_.enter(step.stage);
    (this->*step.run)();
  }

  void run_attempt() {
    // Elimination is part of the partition's loop (design §2.5).
    static constexpr std::array<Step, 8> kSteps{{{Stage::delaunay, &Pipeline::build_box_mesh},
                                                 {Stage::validate, &Pipeline::validate_missing},
                                                 {Stage::flips, &Pipeline::recover},
                                                 {Stage::partition, &Pipeline::enforce_missing},
                                                 {Stage::classify, &Pipeline::classify},
                                                 {Stage::suppress, &Pipeline::suppress_points},
                                                 {Stage::field_points, &Pipeline::add_points},
                                                 {Stage::optimise, &Pipeline::optimise_elements}}};
    for (const Step& step : kSteps) {
      if (step.stage > last_stage()) break;
      if (step.stage == Stage::field_points && !options_.sizes) continue;
      run_stage(step);
      if (result_.outcome != Outcome::done) return;
    }
    deliver();
  }

  // Where no doubles were found for some point, others may be with another random order. The attempt with
  // the fewest such points counts, also where a limit ends the next one: then returns false.
  bool try_again() {
    Result best = std::move(result_);
    result_ = {};
    result_.report = best.report;
    mesh_ = {};
    ++seed_;
    try {
      run_attempt();
    } catch (const Interrupted& interrupted) {
      if (interrupted.outcome() == Outcome::cancelled) throw;
      result_ = std::move(best);
      return false;
    }
    if (result_.outcome == Outcome::not_representable &&
        result_.exact_vertices.size() >= best.exact_vertices.size()) {
      best.report.seconds = result_.report.seconds;
      result_ = std::move(best);
    }
    return true;
  }

  void give_up(Outcome outcome) {
    result_.outcome = outcome;
    result_.message = interruption_message(outcome, monitor_.stage(), options_);
    result_.volume = {};
    result_.facet_regions.clear();
    result_.exact_vertices.clear();
  }

  void refuse(std::vector<Defect> defects) {
    result_.outcome = Outcome::invalid_input;
    result_.message = defects.size() == 1 ? "1 defect was found"
                                          : std::to_string(defects.size()) + " defects were found" +
                                                (defects.size() == kMostDefects ? "; there may be more" : "");
    result_.defects = std::move(defects);
  }

  void validate() {
    result_.report.input = describe_input(complex_, nullptr);
    const Report::Input input = list_elements_and_segments();
    if (!elements_.flaws.empty() || last_stage() == Stage::validate) refuse_if_any_defect();
    if (result_.outcome != Outcome::done) return;
    result_.report.input = input;
    // Dangling facets enclose nothing wherever their vertices are; so say this before the long work.
    const bool encloses = result_.report.input.dangling_facets < complex_.facets.size();
    const bool must_enclose = options_.keep != Keep::box && last_stage() >= Stage::classify;
    if (encloses || !must_enclose) return;
    refuse_if_any_defect();
    if (result_.outcome == Outcome::done) refuse({encloses_nothing(complex_, table_)});
  }

  // Neither list asks for the other. That of segments needs indices in range.
  Report::Input list_elements_and_segments() {
    constexpr std::size_t kWorthThreads = 10'000;
    const Threads shared = threads_.at_most(complex_.facets.size() < kWorthThreads ? 1 : threads_.count());
    Report::Input input;
    parallel(shared, 2, [&](std::size_t task) {
      if (task == 0) {
        elements_ = elements_of(complex_, shared);
      } else if (has_indices_in_range(complex_)) {
        table_ = segment_table(complex_);
        input = describe_input(complex_, &table_);
      }
    });
    return input;
  }

  // What stands in the Delaunay mesh fits together, as faces of one triangulation do. So the exact test is
  // left for what is missing there: of a fine surface, next to nothing.
  void validate_missing() {
    if (std::exchange(elements_fit_, true)) return;
    const Standing fitting = with_other_diagonals(mesh_, complex_, table_, standing_);
    std::vector<std::uint8_t> fits(elements_.all.size());
    std::transform(elements_.all.begin(), elements_.all.end(), fits.begin(), [&](const Element& e) {
      if (e.corners == 3) return fitting.facets[e.id];
      return e.corners == 1 ? std::uint8_t{1} : fitting.segments[table_.find(e.vertex[0], e.vertex[1])];
    });
    if (!all_fit(complex_, elements_, fits, poll_validation(), threads_)) {
      refuse_if_any_defect();
      if (result_.outcome == Outcome::done) throw std::logic_error("holdfast: a misfit without a defect");
    }
    elements_ = {};
  }

  void refuse_if_any_defect() {
    std::vector<Defect> defects =
        find_defects(complex_, elements_, kMostDefects, poll_validation(), threads_);
    if (!defects.empty()) refuse(std::move(defects));
  }
  [[nodiscard]] std::function<void(double)> poll_validation() {
    return [this](double fraction) { monitor_.poll(Stage::validate, fraction); };
  }

  void build_box_mesh() {
    scale_ = choose_scale(complex_.vertices);
    constexpr std::size_t kTetsAVertex = 7;
    mesh_.reserve(complex_.vertices.size() + 8, kTetsAVertex * complex_.vertices.size());
    for (const Point& p : complex_.vertices) mesh_.add_vertex(scaled(p, scale_));
    const double margin = options_.keep == Keep::box ? options_.box_margin : kHiddenMargin;
    for (const Point& corner : box_corners(mesh_.positions(), margin)) mesh_.add_vertex(corner);
    first_free_ = static_cast<Vertex>(mesh_.vertex_count());
    if (!build_delaunay(mesh_, {seed_, threads_}, &monitor_))
      throw std::logic_error("holdfast: the box has no tetrahedra");
    standing_ = mark_present(mesh_, table_, threads_);
    result_.report.delaunay = missing();
  }

  void recover() {
    if (options_.flips) {
      const auto tell = [&](double part) { monitor_.poll(Stage::flips, part); };
      FlipRecovery(mesh_, table_, complex_.facets, standing_, seed_).run(tell);
    }
    result_.report.flips = missing();
  }

  void enforce_missing() {
    standing_before_partition_ = standing_;
    const bool eliminate = options_.stop_after != Stage::partition;
    const EnforceStats stats =
        enforce(mesh_, table_, complex_.facets, standing_, first_free_,
                {.seed = seed_, .flips = options_.flips, .eliminate = eliminate}, monitor_);
    result_.report.segment_points = stats.segment_points;
    result_.report.facet_points = stats.facet_points;
    if (!eliminate) standing_ = standing_before_partition_;  // the others are cut into pieces
  }

  void classify() {
    regions_ = find_regions(mesh_, complex_.facets, threads_);
    kept_ = choose_regions(mesh_, regions_, complex_, table_, options_, scale_);
    if (!kept_.defects.empty()) refuse(std::move(kept_.defects));
  }

  // Points outside the kept regions go with their tetrahedra.
  std::vector<Vertex> kept_points() const {
    if (mesh_.vertex_count() == first_free_) return {};
    std::vector<bool> inside(mesh_.vertex_count(), false);
    for (Tet t = 0; t < mesh_.slot_count(); ++t)
      if (is_kept(t))
        for (const Vertex v : mesh_.corners(t)) inside[v] = true;
    std::vector<Vertex> points;
    for (Vertex v = first_free_; v < mesh_.vertex_count(); ++v)
      if (inside[v]) points.push_back(v);
    return points;
  }

  void suppress_points() {
    std::vector<Vertex> points = kept_points();
    if (points.empty()) return;
    suppress(mesh_, std::move(points), first_free_, monitor_);
    find_regions_again(mesh_, complex_.facets, regions_);
    result_.report.forced_points = kept_points().size();
  }

  void add_points() {
    if (mesh_.exact_vertex_count() > 0)
      for (Tet t = 0; t < mesh_.slot_count(); ++t)
        if (is_kept(t))
          for (const Vertex v : mesh_.corners(t))
            if (!mesh_.is_explicit(v)) return;  // the outcome is not_representable
    size_function_.emplace(*options_.sizes, complex_, table_, options_, kept_, scale_);
    const std::size_t before = mesh_.vertex_count();
    parts_ = add_field_points(volume(), *size_function_, threads_, monitor_);
    if (!options_.optimise || last_stage() < Stage::optimise)
      join_filled(std::move(parts_), *size_function_, threads_, monitor_);
    result_.report.field.points = mesh_.vertex_count() - before + (parts_ ? parts_->new_vertices() : 0);
  }

  void optimise_elements() {
    if (!options_.optimise) return;
    if (!sizes_.empty()) return improve_volume();
    std::vector<Tet> tets;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!is_kept(t)) continue;
      const auto& v = mesh_.corners(t);
      if (!std::all_of(v.begin(), v.end(), [&](Vertex x) { return mesh_.is_explicit(x); })) return;
      tets.push_back(t);
    }
    optimise_worst_of(tets, PointsToRemove::all);
  }

  void optimise_worst_of(const std::vector<Tet>& tets, PointsToRemove remove) {
    const OptimiseStats stats = optimise(mesh_, tets, first_free_, target(), monitor_,
                                         {.add_points = options_.add_points, .remove = remove});
    result_.report.optimised = {stats.exchanged + stats.unflattened + stats.reconnected, stats.relocated,
                                stats.inserted};
    if (stats.changed > 0) find_regions_again(mesh_, complex_.facets, regions_);
  }

  void improve_volume() {
    Report::Field& report = result_.report.field;
    report.before = parts_ ? shape_of(*parts_, threads_) : shape_of(volume(), threads_);
    std::optional<FilledParts> filled;
    if (parts_) filled.emplace(FilledParts{std::move(parts_), *size_function_});
    const ImproveStats stats =
        improve_in_parts(volume(), std::move(filled), options_.quality, threads_, monitor_);
    report.edge_lengths = edge_lengths_of(volume(), threads_);
    report.moves = stats.moved;
    report.swaps = stats.swapped;
    report.contractions = stats.contracted;
    report.insertions = stats.inserted;
    report.points += stats.filled_in;
    // Flat ones are told from others in space; in a metric they may be as they should be.
    if (stats.worst > kEnergyOfFlat && metrics_.empty()) remove_flat();
  }

  // Long thin facets may leave flat elements: what the other optimisation is made for.
  void remove_flat() {
    std::vector<Tet> flat;
    for (Tet t = 0; t < mesh_.slot_count(); ++t) {
      if (!is_kept(t)) continue;
      const auto& v = mesh_.corners(t);
      if (is_flat(mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2]), mesh_.position(v[3])))
        flat.push_back(t);
    }
    if (!flat.empty()) optimise_worst_of(flat, PointsToRemove::added_here);
  }

  [[nodiscard]] VolumeData volume() {
    std::vector<Metric>* const metrics = options_.sizes && options_.sizes->metric ? &metrics_ : nullptr;
    return {mesh_, regions_.of_tet, sizes_, kept_.region, first_free_, nullptr, metrics};
  }
  [[nodiscard]] bool is_kept(Tet t) const {
    return mesh_.alive(t) && !mesh_.is_ghost(t) && kept_.region[regions_.of_tet[t]];
  }

  void deliver() {
    const Stage last = last_stage();
    const Source source{mesh_, complex_, table_, scale_, first_free_};
    Extract extract = last >= Stage::classify ? extract_kept(source, regions_, kept_, threads_)
                                              : extract_all(source, standing_);
    result_.volume = std::move(extract.volume);
    result_.facet_regions = std::move(extract.facet_regions);
    result_.exact_vertices = std::move(extract.exact_vertices);
    result_.report.steiner_points = extract.steiner_points;
    fill_report();
    if (last >= Stage::suppress && !result_.exact_vertices.empty()) {
      result_.outcome = Outcome::not_representable;
      result_.message = "no positive mesh in double precision was found";
    }
  }

  void fill_report() {
    const Stage last = last_stage();
    Report& report = result_.report;
    const Volume& volume = result_.volume;
    report.unrounded_points = result_.exact_vertices.size();
    report.vertices = volume.vertices.size();
    report.tetrahedra = volume.tetrahedra.size();
    if (last >= Stage::classify)
      report.regions = static_cast<std::size_t>(std::count(kept_.region.begin(), kept_.region.end(), true));
    const bool has_all = volume.facets.size() == complex_.facets.size();
    Report::Shape shape;
    report.quality =
        measure(volume, has_all ? target() : target_quality(volume.vertices, volume.facets, threads_), &shape,
                threads_);
    if (sizes_.empty()) return;
    if (!metrics_.empty()) shape = shape_of(this->volume(), threads_);
    if (options_.optimise && last == Stage::optimise) report.field.after = shape;
    const auto& angles = shape.least_dihedral;  // in bins of five degrees
    if (metrics_.empty() && angles[0] + angles[1] > 0) find_forced(volume, report.field);
  }

  // Of all facets, computed once.
  double target() {
    if (!target_) target_ = target_quality(complex_.vertices, complex_.facets, threads_);
    return *target_;
  }

  [[nodiscard]] Stage last_stage() const { return options_.stop_after.value_or(Stage::optimise); }
  [[nodiscard]] Report::Missing missing() const {
    return {standing_.missing_segments(), standing_.missing_facets()};
  }

  const Complex& complex_;
  const Options& options_;
  const Threads threads_;
  Monitor monitor_;
  Result result_;

  Elements elements_;  // until they are known to fit together
  bool elements_fit_ = false;
  SegmentTable table_;
  std::uint64_t seed_;
  int scale_ = 0;  // the mesh is the complex times 2^scale_
  TetMesh mesh_;
  Vertex first_free_ = 0;  // after the input's and the box's
  Standing standing_, standing_before_partition_;
  std::optional<double> target_;
  Regions regions_;
  std::vector<double> sizes_;    // by vertex; empty without field points
  std::vector<Metric> metrics_;  // by vertex; empty without a metric of the user
  std::optional<SizeFunction> size_function_;
  std::unique_ptr<Parts> parts_;  // of a mesh with field points that is in the middle of its improvement
  Kept kept_;
};

}  // namespace

Result mesh(const Complex& complex, const Options& options) {
  require_sensible(complex, options);
  return Pipeline(complex, options).run();
}

}  // namespace holdfast
