#include "api/attempt.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "api/course.h"
#include "api/extract.h"
#include "api/forced.h"
#include "api/report.h"
#include "api/scale.h"
#include "classify/keep.h"
#include "classify/open_interface.h"
#include "classify/regions.h"
#include "delaunay/box.h"
#include "delaunay/delaunay.h"
#include "enforce/enforce.h"
#include "mesh/editor.h"
#include "mesh/shape_counts.h"
#include "mesh/target_quality.h"
#include "mesh/tet_mesh.h"
#include "optimise/improve_parts.h"
#include "optimise/optimise.h"
#include "optimise/shape.h"
#include "recover/recover.h"
#include "recover/standing.h"
#include "refine/field_points.h"
#include "size/size_function.h"
#include "suppress/suppress.h"

namespace holdfast {
namespace {

constexpr double kHiddenMargin = 0.5;  // of the box that is cut away again

class Attempt {
 public:
  Attempt(Input& input, const Options& options, std::uint64_t seed, const Threads& threads, Monitor& monitor,
          Result& result)
      : input_(input),
        options_(options),
        threads_(threads),
        monitor_(monitor),
        result_(result),
        seed_(seed) {}

  void run() {
    // Elimination is part of the partition's loop (docs/concepts.md).
    static constexpr std::array<Step, 8> kSteps{
        {{Stage::delaunay, CallStep::delaunay, &Attempt::build_box_mesh},
         {Stage::validate, CallStep::validate_missing, &Attempt::validate_missing},
         {Stage::flips, CallStep::flips, &Attempt::recover},
         {Stage::partition, CallStep::partition, &Attempt::enforce_missing},
         {Stage::classify, CallStep::classify, &Attempt::classify},
         {Stage::suppress, CallStep::suppress, &Attempt::suppress_points},
         {Stage::field_points, CallStep::field_points, &Attempt::add_points},
         {Stage::optimise, CallStep::optimise, &Attempt::optimise_elements}}};
    for (const Step& step : kSteps) {
      if (step.stage > last_stage()) break;
      if (step.stage == Stage::field_points && !options_.sizes) continue;
      run_step(step);
      if (result_.outcome != Outcome::done) return;
    }
    monitor_.begin_part(part_of_call(CallStep::deliver, monitor_.overall(), options_));
    deliver();
  }

 private:
  struct Step {
    Stage stage;
    CallStep step;
    void (Attempt::*run)();
  };

  void run_step(const Step& step) {
    const Stopwatch watch(result_.report, name(step.stage));
    monitor_.begin_part(part_of_call(step.step, monitor_.overall(), options_));
    monitor_.enter(step.stage);
    (this->*step.run)();
    monitor_.end_part();
  }

  void build_box_mesh() {
    scale_ = choose_scale(complex().vertices);
    constexpr std::size_t kTetsAVertex = 7;
    MeshEditor(mesh_).reserve(complex().vertices.size() + 8, kTetsAVertex * complex().vertices.size());
    for (const Point& p : complex().vertices) MeshEditor(mesh_).add_vertex(scaled(p, scale_));
    const double margin = options_.keep == Keep::box ? options_.box_margin : kHiddenMargin;
    const exact::DoubleGrid grid = grid_after(scale_);
    for (const Point& corner : box_corners(mesh_.positions(), margin, grid))
      MeshEditor(mesh_).add_vertex(corner);
    MeshEditor(mesh_).set_grid(grid);
    first_free_ = static_cast<Vertex>(mesh_.vertex_count());
    if (!build_delaunay(mesh_, {seed_, threads_}, &monitor_))
      throw std::logic_error("holdfast: the box has no tetrahedra");
    standing_ = mark_present(mesh_, input_.table(), threads_);
    result_.report.delaunay = missing();
  }

  void validate_missing() {
    if (auto defects = input_.validate_missing(mesh_, standing_); !defects.empty())
      refuse(result_, std::move(defects));
  }

  void recover() {
    if (options_.flips) {
      const auto tell = [&](double part) { monitor_.poll(Stage::flips, part); };
      FlipRecovery(mesh_, input_.table(), complex().facets, standing_, seed_).run(tell);
    }
    result_.report.flips = missing();
  }

  void enforce_missing() {
    standing_before_partition_ = standing_;
    const bool eliminate = options_.stop_after != Stage::partition;
    const EnforceStats stats =
        enforce(mesh_, input_.table(), complex().facets, standing_, first_free_,
                {.seed = seed_, .flips = options_.flips, .eliminate = eliminate}, monitor_);
    result_.report.segment_points += stats.segment_points;
    result_.report.facet_points += stats.facet_points;
    if (!eliminate) standing_ = standing_before_partition_;  // the others are cut into pieces
  }

  void classify() {
    regions_ = find_regions(mesh_, complex().facets, threads_);
    kept_ = choose_regions(mesh_, regions_, complex(), input_.table(), options_, scale_, input_.names());
    if (!kept_.defects.empty()) return refuse(result_, std::move(kept_.defects));
    tell_what_was_chosen();
  }

  void tell_what_was_chosen() {
    result_.report.keep = kept_.rule;
    if (kept_.conflict) result_.report.turned_facets.assign(kept_.conflict->begin(), kept_.conflict->end());
    if (!kept_.turned.empty()) result_.report.turned_facets = kept_.turned;
    if (!kept_.turned.empty()) result_.warnings.push_back(warn_of_turned(complex(), kept_.turned));
    for (Warning& warning : find_open_interfaces(mesh_, regions_, kept_, complex(), input_.table(),
                                                 input_.names(), [&] { monitor_.poll(Stage::classify, 1); }))
      result_.warnings.push_back(std::move(warning));
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
    suppress(mesh_, std::move(points), first_free_, monitor_, seed_);
    find_regions_again(mesh_, complex().facets, regions_);
    result_.report.forced_points = kept_points().size();
  }

  void add_points() {
    if (mesh_.exact_vertex_count() > 0)
      for (Tet t = 0; t < mesh_.slot_count(); ++t)
        if (is_kept(t))
          for (const Vertex v : mesh_.corners(t))
            if (!mesh_.is_explicit(v)) return;  // the outcome is not_representable
    size_function_.emplace(polling(input_.sizes()), complex(), input_.table(), options_, kept_, scale_);
    const std::size_t before = mesh_.vertex_count();
    FieldPoints added = add_field_points(volume(), *size_function_, threads_, monitor_);
    parts_ = std::move(added.parts);
    result_.report.field.stopped_early = added.stopped_early;
    if (!options_.optimise || last_stage() < Stage::optimise)
      result_.report.field.stopped_early |=
          join_filled(std::move(parts_), *size_function_, threads_, monitor_);
    result_.report.field.points = mesh_.vertex_count() - before + (parts_ ? parts_->new_vertices() : 0);
  }

  // Functions of the caller may be slow, and are called from the calling thread alone.
  [[nodiscard]] Sizes polling(Sizes sizes) const {
    if (sizes.field)
      sizes.field = [this, field = std::move(sizes.field)](const Point& p) {
        monitor_.poll_again();
        return field(p);
      };
    if (sizes.metric)
      sizes.metric = [this, metric = std::move(sizes.metric)](const Point& p) {
        monitor_.poll_again();
        return metric(p);
      };
    return sizes;
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
    const OptimiseStats stats =
        optimise(mesh_, tets, first_free_, input_.target(), monitor_,
                 {.add_points = options_.add_points, .remove = remove, .seed = seed_});
    result_.report.optimised = {stats.exchanged + stats.unflattened + stats.reconnected, stats.relocated,
                                stats.inserted};
    if (stats.changed > 0) find_regions_again(mesh_, complex().facets, regions_);
  }

  void improve_volume() {
    Report::Field& report = result_.report.field;
    report.before = describe_shape(parts_ ? shape_of(*parts_, threads_) : shape_of(volume(), threads_));
    std::optional<FilledParts> filled;
    if (parts_) filled.emplace(FilledParts{std::move(parts_), *size_function_});
    const ImproveStats stats =
        improve_in_parts(volume(), std::move(filled), options_.effort, threads_, monitor_);
    report.edge_lengths = edge_lengths_of(volume(), threads_);
    report.moves = stats.moved;
    report.swaps = stats.swapped;
    report.contractions = stats.contracted;
    report.insertions = stats.inserted;
    report.points += stats.filled_in;
    report.stopped_early |= stats.filling_stopped_early;
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
    return {mesh_, regions_.of_tet, sizes_, kept_.region, first_free_, nullptr, metrics, seed_};
  }
  [[nodiscard]] bool is_kept(Tet t) const {
    return mesh_.alive(t) && !mesh_.is_ghost(t) && kept_.region[regions_.of_tet[t]];
  }

  void deliver() {
    const Stage last = last_stage();
    const Source source{mesh_, complex(), input_.table(), scale_, first_free_};
    Extract extract = last >= Stage::classify ? extract_kept(source, regions_, kept_, threads_)
                                              : extract_all(source, standing_);
    result_.volume = std::move(extract.volume);
    tell_vertices();
    result_.facet_regions = std::move(extract.facet_regions);
    result_.exact_vertices = std::move(extract.exact_vertices);
    result_.report.steiner_points = extract.steiner_points;
    fill_report();
    if (result_.report.field.stopped_early) result_.warnings.push_back(warn_of_field_points());
    if (last >= Stage::suppress && !result_.exact_vertices.empty()) {
      result_.outcome = Outcome::not_representable;
      result_.message = "no positive mesh in double precision was found";
    }
  }

  static Warning warn_of_field_points() {
    return {
        WarningKind::field_points,
        {},
        {},
        {},
        "field points stopped early: too many were tried in vain, so that edges may be longer than was asked "
        "for; the sizes differ too much from those of the surface's triangles"};
  }

  void tell_vertices() {
    result_.vertex_map = input_.vertex_map();
    std::vector<std::int64_t>& input = result_.volume.input_vertices;
    input.assign(result_.volume.vertices.size(), -1);
    for (Index v = 0; v < complex().vertices.size(); ++v) input[v] = input_.names()(v);
  }

  void fill_report() {
    const Stage last = last_stage();
    Report& report = result_.report;
    // Measures over- and underflow where the mesh was scaled.
    Volume scaled_volume;
    if (scale_ != 0) {
      scaled_volume = result_.volume;
      scaled_volume.vertices = scaled(result_.volume.vertices, scale_);
    }
    const Volume& volume = scale_ == 0 ? result_.volume : scaled_volume;
    report.unrounded_points = result_.exact_vertices.size();
    report.vertices = volume.vertices.size();
    report.tetrahedra = volume.tetrahedra.size();
    if (last >= Stage::classify)
      report.regions = static_cast<std::size_t>(std::count(kept_.region.begin(), kept_.region.end(), true));
    const bool has_all = volume.facets.size() == complex().facets.size();
    const VolumeShape shape = measure(volume, threads_);
    report.elements = describe_elements(
        shape, has_all ? input_.target() : target_quality(volume.vertices, volume.facets, threads_));
    if (sizes_.empty()) return;
    if (options_.optimise && last == Stage::optimise)
      report.field.after =
          describe_shape(metrics_.empty() ? shape.elements : shape_of(this->volume(), threads_));
    if (metrics_.empty() && report.elements.below_10_deg > 0)
      find_forced(volume, complex().vertices.size(), report.field, [&] { monitor_.poll_again(); });
  }

  [[nodiscard]] Stage last_stage() const { return options_.stop_after.value_or(Stage::optimise); }
  [[nodiscard]] Report::Missing missing() const {
    return {standing_.missing_segments(), standing_.missing_facets()};
  }
  [[nodiscard]] const Complex& complex() const { return input_.complex(); }

  Input& input_;
  const Options& options_;
  const Threads& threads_;
  Monitor& monitor_;
  Result& result_;
  const std::uint64_t seed_;

  int scale_ = 0;  // the mesh is the complex times 2^scale_
  TetMesh mesh_;
  Vertex first_free_ = 0;  // after the input's and the box's
  Standing standing_, standing_before_partition_;
  Regions regions_;
  std::vector<double> sizes_;    // by vertex; empty without field points
  std::vector<Metric> metrics_;  // by vertex; empty without a metric of the user
  std::optional<SizeFunction> size_function_;
  std::unique_ptr<Parts> parts_;  // of a mesh with field points that is in the middle of its improvement
  Kept kept_;
};

}  // namespace

void attempt(Input& input, const Options& options, std::uint64_t seed, const Threads& threads,
             Monitor& monitor, Result& result) {
  Attempt(input, options, seed, threads, monitor, result).run();
}

namespace {

std::string message_of(const std::vector<Defect>& defects) {
  // The last rules are not of the surface alone, but of what is to be kept of it.
  switch (defects[0].kind) {
    case DefectKind::encloses_nothing:
      return "nothing to fill: the surface encloses nothing";
    case DefectKind::outside_region:
      return defects.size() == 1
                 ? "a piece of the surface borders on no kept region"
                 : std::to_string(defects.size()) + " pieces of the surface border on no kept region";
    case DefectKind::inconsistent_orientation:
      return "the surface has no winding number";
    default:
      return defects.size() == 1 ? "1 defect was found"
                                 : std::to_string(defects.size()) + " defects were found" +
                                       (defects.size() == Input::kMostDefects ? "; there may be more" : "");
  }
}

}  // namespace

void refuse(Result& result, std::vector<Defect> defects) {
  result.outcome = Outcome::invalid_input;
  result.message = message_of(defects);
  result.defects = std::move(defects);
}

}  // namespace holdfast
