// Reads Abaqus's and CalculiX's .inp: nodes, tetrahedra, triangles and lines, element sets and surfaces of
// elements and sides (CalculiX CrunchiX user's manual, "Input deck format").
//
// Sets of tetrahedra are regions; sets of triangles, and surfaces, are markers. Where sets overlap, the
// smaller one counts. An instance of a part reads the part's lines again, with its own numbers and names.
#include "io/formats.h"
#include "io/inp_generate.h"
#include "io/inp_include.h"
#include "io/inp_parts.h"
#include "io/inp_sets.h"

namespace holdfast::io {
namespace {

class InpReader {
 public:
  explicit InpReader(const Source& source)
      : text_(source, names_),
        has_filled_(has_inp_keyword(source.bytes, "nfill")),
        elements_(mesh_, has_inp_keyword(source.bytes, "elgen")),
        generated_(elements_) {}

  MeshData read() {
    while (!text_.at_end()) read_block(text_.keyword());
    read_unused_parts();
    elements_.finish(text_.reader().source());
    const InpShownName shown = [&](const std::string& name) { return parts_.shown(name); };
    const std::vector<std::optional<int>> markers =
        surfaces_.apply(mesh_, text_, elements_, sets_, shown, names_.markers);
    apply_sets(markers);
    tell_skipped();
    return std::move(mesh_);
  }

 private:
  void read_block(const InpKeyword& key) {
    if (key.name == "node") {
      require_global(key);
      const std::vector<std::int64_t> numbers = elements_.read_nodes(text_);
      if (has_filled_) generated_.add_listed(text_, key, numbers);
    } else if (key.name == "ngen") {
      require_global(key);
      generated_.read_ngen(text_, key);
    } else if (key.name == "nfill") {
      generated_.read_nfill(text_, key);
    } else if (key.name == "nset" && has_filled_ && key.has("nset")) {
      ++skipped_[key.name];  // they are no markers
      generated_.read_set(text_, key);
    } else if (key.name == "elgen") {
      const std::vector<std::int64_t> numbers = elements_.read_copies(text_);
      if (key.has("elset")) sets_.add_listed(text_.scope().given(key.values.at("elset")), numbers);
    } else if (key.name == "element") {
      const std::vector<std::int64_t> numbers = elements_.read(text_, key);
      if (key.has("elset")) sets_.add_listed(text_.scope().given(key.values.at("elset")), numbers);
    } else if (key.name == "part") {
      parts_.skip(text_, key);
    } else if (key.name == "instance") {
      read_instance(key);
    } else if (key.name == "elset" && key.has("elset")) {
      const InpScope scope = text_.scope();
      if (key.has("instance")) text_.set_scope(parts_.scope_of(text_, key));
      sets_.read(text_, key, elements_.size());
      text_.set_scope(scope);
    } else if (key.name == "surface" && key.has("name") &&
               (!key.has("type") || lower(key.values.at("type")) == "element")) {
      surfaces_.read(text_, text_.scope().given(key.values.at("name")));
    } else {
      require_global(key);
      if (text_.is_data()) ++skipped_[key.name];
      while (text_.is_data()) text_.next();
    }
  }

  /// Local coordinates would change the shape, so they are refused.
  void require_global(const InpKeyword& key) {
    const auto fail = [&](const std::string& what) {
      text_.reader().fail_at(key.place,
                             "nodes in " + what + " are not read; save them in global coordinates");
    };
    if (key.name == "system" && text_.is_data()) fail("coordinates of their own (*SYSTEM)");
    const auto system = key.values.find("system");
    if ((key.name != "node" && key.name != "ngen") || system == key.values.end()) return;
    const std::string kind = lower(system->second);
    if (kind == "c") fail("cylindrical coordinates (SYSTEM=C)");
    if (kind == "s") fail("spherical coordinates (SYSTEM=S)");
  }

  /// Reads the lines of the instance's part, then its own.
  void read_instance(const InpKeyword& key) {
    const std::optional<InpParts::Lines> part = parts_.begin_instance(text_, key);
    require_a_mesh();
    const std::size_t own = text_.place();
    if (part) read_part(*part);
    text_.go_to(own);
    while (!text_.at_end() && !text_.is_keyword("endinstance")) read_block(text_.keyword());
    if (!text_.at_end()) text_.next();
    text_.set_scope({});
  }

  /// The last keyword of the part may continue in the line that ends it.
  void read_part(const InpParts::Lines& lines) {
    text_.go_to(lines.begin);
    while (!text_.at_end() && text_.place() < lines.end) read_block(text_.keyword());
  }

  /// Without an assembly, each part occurs once; with one, unused parts are skipped.
  void read_unused_parts() {
    const std::vector<std::string> unused = parts_.unused();
    if (parts_.instances() > 0) {
      mesh_.leave_out(unused.size(), "parts without an instance", "part without an instance");
      return;
    }
    for (const std::string& name : unused) {
      read_part(parts_.begin_instance_of_part(text_, name));
      text_.set_scope({});
    }
  }

  /// A short file may create many instances of a large part.
  void require_a_mesh() const {
    constexpr std::size_t kHarmless = std::size_t{1} << 22, kMostTimes = 1000;
    const std::size_t size = mesh_.vertices.size() + elements_.size();
    if (size > kHarmless && size / kMostTimes > text_.reader().source().bytes.size())
      text_.reader().fail("the instances of the parts have more than " + std::to_string(size) +
                          " nodes and elements; such a file is damaged or malicious");
  }

  /// Gives the entities of sets their ids; `markers` are those of facets from surfaces, which take
  /// precedence.
  void apply_sets(const std::vector<std::optional<int>>& markers) {
    std::vector<int> regions(mesh_.tetrahedra.size(), 0), segments(mesh_.segments.size(), 0);
    std::vector<int> shells(mesh_.facets.size(), 0);
    for (const auto& [name, members] : sets_.largest_first()) {
      std::array<int, 4> id{};
      for (const std::int64_t number : *members) {
        const InpElement* element = elements_.find(number);
        if (element == nullptr)
          throw FileError(text_.reader().source().path, "",
                          "the element " + std::to_string(number_in_file(number)) + " of the set " +
                              in_quotes(name) + " does not exist");
        if (element->dimension == 0) continue;
        const auto d = static_cast<std::size_t>(element->dimension);
        NamedIds& ids = d == 3 ? names_.regions : d == 2 ? names_.markers : names_.segments;
        if (id[d] == 0) id[d] = ids.id_of(parts_.shown(name));
        std::vector<int>& of = d == 3 ? regions : d == 2 ? shells : segments;
        for (Index k = 0; k < element->count; ++k) of[element->entity + k] = id[d];
      }
    }
    for (std::size_t f = 0; f < markers.size(); ++f)
      mesh_.facet_markers.add(f, markers[f].value_or(shells[f]));
    for (std::size_t t = 0; t < regions.size(); ++t) mesh_.regions.add(t, regions[t]);
    for (std::size_t s = 0; s < segments.size(); ++s) mesh_.segment_markers.add(s, segments[s]);
    mesh_.names.facets = names_.markers.take();
    mesh_.names.regions = names_.regions.take();
    mesh_.names.segments = names_.segments.take();
  }

  void tell_skipped() {
    mesh_.leave_out(
        skipped_, [](const std::string& name) { return '*' + name; }, "blocks", "block");
    mesh_.leave_out(
        elements_.shapeless(), [](const std::string& name) { return name; }, "elements", "element");
  }

  MeshData mesh_;
  InpNames names_;
  InpText text_;
  const bool has_filled_;
  InpElements elements_;
  InpGenerated generated_;
  InpSets sets_;
  InpSurfaces surfaces_;
  InpParts parts_;
  std::map<std::string, std::size_t> skipped_;  ///< blocks by keyword
};

}  // namespace

MeshData read_inp(const Source& source) {
  if (is_avs(source.bytes)) return read_avs(source);
  const Includes whole(source, inp_includes());
  return InpReader(whole.source()).read();
}

}  // namespace holdfast::io
