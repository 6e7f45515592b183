// Reads Abaqus's and CalculiX's .inp: nodes, tetrahedra, triangles and lines, element sets and surfaces of
// elements and sides (CalculiX CrunchiX user's manual, "Input deck format").
//
// Sets of tetrahedra are regions, those of triangles and surfaces markers. Where sets overlap, the smaller
// one counts.
#include "io/formats.h"
#include "io/inp_sets.h"

namespace holdfast::io {
namespace {

class InpReader {
 public:
  explicit InpReader(const Source& source) : text_(source, names_), elements_(mesh_) {}

  MeshData read() {
    while (!text_.at_end()) read_block(text_.keyword());
    elements_.finish(text_.reader().source());
    const std::vector<int> markers = surfaces_.apply(mesh_, text_, elements_, sets_, names_.markers);
    apply_sets(markers);
    tell_skipped();
    return std::move(mesh_);
  }

 private:
  void read_block(const InpKeyword& key) {
    if (key.name == "node") {
      elements_.read_nodes(text_);
    } else if (key.name == "element") {
      const std::vector<std::int64_t> numbers = elements_.read(text_, key);
      if (key.has("elset")) sets_.add_listed(key.values.at("elset"), numbers);
    } else if (key.name == "elset" && key.has("elset")) {
      sets_.read(text_, key, elements_.size());
    } else if (key.name == "surface" && key.has("name") &&
               (!key.has("type") || lower(key.values.at("type")) == "element")) {
      surfaces_.read(text_, key.values.at("name"));
    } else if (key.name == "include") {
      text_.reader().fail("*INCLUDE is not followed; read the file that it names");
    } else {
      if (text_.is_data()) ++skipped_[key.name];
      while (text_.is_data()) text_.next();
    }
  }

  /// The ids of the sets' entities; `markers` are those of facets by surfaces, which come before.
  void apply_sets(const std::vector<int>& markers) {
    std::vector<int> regions(mesh_.tetrahedra.size(), 0), segments(mesh_.segments.size(), 0);
    std::vector<int> shells(mesh_.facets.size(), 0);
    for (const auto& [name, members] : sets_.largest_first()) {
      std::array<int, 4> id{};
      for (const std::int64_t number : *members) {
        const InpElement* element = elements_.find(number);
        if (element == nullptr)
          throw FileError(
              text_.reader().source().path, "",
              "the element " + std::to_string(number) + " of the set " + in_quotes(name) + " does not exist");
        if (element->dimension == 0) continue;
        const auto d = static_cast<std::size_t>(element->dimension);
        NamedIds& ids = d == 3 ? names_.regions : d == 2 ? names_.markers : names_.segments;
        if (id[d] == 0) id[d] = ids.id_of(name);
        std::vector<int>& of = d == 3 ? regions : d == 2 ? shells : segments;
        for (Index k = 0; k < element->count; ++k) of[element->entity + k] = id[d];
      }
    }
    for (std::size_t f = 0; f < markers.size(); ++f)
      mesh_.facet_markers.add(f, markers[f] != 0 ? markers[f] : shells[f]);
    for (std::size_t t = 0; t < regions.size(); ++t) mesh_.regions.add(t, regions[t]);
    for (std::size_t s = 0; s < segments.size(); ++s) mesh_.segment_markers.add(s, segments[s]);
    mesh_.names.facets = names_.markers.take();
    mesh_.names.regions = names_.regions.take();
    mesh_.names.segments = names_.segments.take();
  }

  void tell_skipped() {
    leave_out(skipped_, "block", "*");
    leave_out(elements_.shapeless(), "element", "");
  }

  void leave_out(const std::map<std::string, std::size_t>& counts, const std::string& what,
                 const char* before_names) {
    std::string names;
    std::size_t all = 0;
    for (const auto& [name, count] : counts) {
      names += (names.empty() ? "" : ", ") + (before_names + name);
      all += count;
    }
    mesh_.leave_out(all, what + "s (" + names + ")", what + " (" + names + ")");
  }

  MeshData mesh_;
  InpNames names_;
  InpText text_;
  InpElements elements_;
  InpSets sets_;
  InpSurfaces surfaces_;
  std::map<std::string, std::size_t> skipped_;  ///< blocks by keyword
};

}  // namespace

MeshData read_inp(const Source& source) {
  return is_avs(source.bytes) ? read_avs(source) : InpReader(source).read();
}

}  // namespace holdfast::io
