// Wavefront OBJ: v, f, l and p; groups or materials are markers; the rest concerns appearance (Wavefront
// Advanced Visualizer, appendix B1).
#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>

#include "io/formats.h"
#include "io/labels.h"
#include "io/polygon.h"
#include "io/text_reader.h"

namespace holdfast::io {
namespace {

/// Statements that do not affect the mesh. Any other unknown one is an error, so that no facet is lost.
constexpr std::string_view kLooks[] = {
    "vt",       "vn",       "vp",     "vc",     "g",    "o",     "s",          "mg",
    "usemtl",   "mtllib",   "usemap", "maplib", "lod",  "bevel", "shadow_obj", "trace_obj",
    "c_interp", "d_interp", "ctech",  "stech",  "deg",  "bmat",  "step",       "cstype",
    "curv2",    "parm",     "trim",   "hole",   "scrv", "sp",    "end",        "con"};

class ObjReader {
 public:
  explicit ObjReader(const Source& source) : source_(source), mesh_(source) {}

  MeshData read() {
    // Two passes, because an element may name a later vertex.
    read_id_comments();
    each_line([&](std::string_view keyword, TextReader& text) {
      if (keyword != "v") return;
      mesh_.vertices.push_back(text.point());
      if (!text.at_line_end() && !has_weight_of_one(text)) ++coloured_;
    });
    each_line([&](std::string_view keyword, TextReader& text) { read_element(keyword, text); });
    if (free_forms_ > 0 && mesh_.facets.empty())
      TextReader(source_).fail_at(
          first_free_form_,
          "free-form curves and surfaces are not read, and there are no faces besides; export them as "
          "triangles");
    mark_facets();
    tell_looks();
    mesh_.leave_out(free_forms_, "free-form curves and surfaces", "free-form curve or surface");
    return std::move(mesh_);
  }

 private:
  template <typename Visit>
  void each_line(Visit&& visit) {
    TextReader text(source_);
    while (!text.at_end()) {
      visit(text.word_on_line(), text);
      skip_logical_line(text);
    }
  }

  /// Our comments stand at the start of the file.
  void read_id_comments() {
    TextReader text(source_, '\0');
    while (!text.remaining().empty() && text.remaining()[0] == '#')
      read_id_comment(text.rest_of_line().substr(1), std::array{&ids_});
  }

  /// Whether the line ends with a backslash and so continues.
  static bool continues(TextReader& text) {
    if (text.at_line_end() || text.remaining()[0] != '\\') return false;
    const std::string_view behind = text.remaining().substr(1);
    return behind.empty() || behind[0] == '\n' || behind[0] == '\r';
  }
  /// Whether a vertex has the weight 1, the only one allowed.
  static bool has_weight_of_one(TextReader& text) {
    return text.real("a weight or colour") == 1 && text.at_line_end();
  }
  static void skip_logical_line(TextReader& text) {
    while (text.rest_of_line().ends_with('\\') && !text.remaining().empty()) {
    }
  }

  /// The rest of the line, without consuming it.
  static std::string_view rest_on_line(const TextReader& text) {
    const std::string_view rest = text.remaining();
    return rest.substr(0, rest.find_first_of("\r\n#"));
  }

  void read_element(std::string_view keyword, TextReader& text) {
    if (keyword == "v") {
      ++seen_;
    } else if (keyword == "f" || keyword == "fo") {
      const std::size_t start = text.last();
      read_corners(text);
      add_face(mesh_, corners_, 0, [&](const std::string& reason) { text.fail_at(start, reason); });
      groups_.resize(mesh_.facets.size(), group_);
      materials_.resize(mesh_.facets.size(), material_);
    } else if (keyword == "l") {
      const std::size_t start = text.last();
      read_corners(text);
      if (corners_.size() < 2) text.fail_at(start, "a line of fewer than 2 vertices");
      for (std::size_t i = 0; i + 1 < corners_.size(); ++i) mesh_.add_segment({corners_[i], corners_[i + 1]});
    } else if (keyword == "p") {
      read_corners(text);  // isolated points are vertices already; this only checks the indices
    } else if (keyword == "curv" || keyword == "surf") {
      if (free_forms_++ == 0) first_free_form_ = text.last();
    } else if (const auto looks = std::find(std::begin(kLooks), std::end(kLooks), keyword);
               looks != std::end(kLooks)) {
      ++looks_[static_cast<std::size_t>(looks - std::begin(kLooks))];
      if (keyword == "g" || keyword == "o") group_ = labels_.number(cleaned_name(rest_on_line(text)));
      if (keyword == "usemtl") material_ = labels_.number(cleaned_name(rest_on_line(text)));
    } else {
      text.fail("unknown statement " + in_quotes(keyword));
    }
  }

  /// Markers are groups if there are several of them, otherwise materials.
  void mark_facets() {
    const auto several = [](const std::vector<std::size_t>& labels) {
      return std::adjacent_find(labels.begin(), labels.end(), std::not_equal_to<>()) != labels.end();
    };
    const auto named = [&](const std::vector<std::size_t>& labels) {
      return !labels.empty() && !labels_.name(labels[0]).empty();
    };
    const bool by_group = several(groups_) || (!several(materials_) && named(groups_));
    const std::vector<std::size_t>& labels = by_group ? groups_ : materials_;
    if (!several(labels) && !named(labels)) return;
    const auto forget = [&](std::string_view keyword) {
      looks_[static_cast<std::size_t>(std::find(std::begin(kLooks), std::end(kLooks), keyword) -
                                      std::begin(kLooks))] = 0;
    };
    by_group ? (forget("g"), forget("o")) : forget("usemtl");
    if (!several(labels)) {  // no markers, but a name for facets without one
      mesh_.names.facets[0] = labels_.name(labels[0]);
      return;
    }
    for (std::size_t f = 0; f < labels.size(); ++f) {
      const std::string& name = labels_.name(labels[f]);
      mesh_.facet_markers.add(f, name.empty() ? 0 : ids_.id_of(name));
    }
    mesh_.names.facets = ids_.take();
  }

  void tell_looks() {
    std::string names;
    std::size_t lines = 0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (looks_[i] > 0) names += (names.empty() ? "" : ", ") + std::string(kLooks[i]);
      lines += looks_[i];
    }
    mesh_.leave_out(coloured_, "colours or weights of vertices", "colour or weight of a vertex");
    mesh_.leave_out(lines, "lines of looks, groups or names (" + names + ")",
                    "line of looks, groups or names (" + names + ")");
  }

  void read_corners(TextReader& text) {
    corners_.clear();
    for (;;) {
      while (continues(text)) text.skip_line();
      const std::string_view word = text.word_on_line();
      if (word.empty()) return;
      corners_.push_back(corner(text, word));
    }
  }

  /// The vertex of "v", "v/vt", "v//vn" or "v/vt/vn"; negative indices count back from the last vertex.
  [[nodiscard]] Index corner(const TextReader& text, std::string_view word) const {
    std::int64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value);
    if (result.ec != std::errc() || (result.ptr != end && *result.ptr != '/'))
      text.fail("expected a vertex index, found " + in_quotes(word));
    const auto size = static_cast<std::int64_t>(mesh_.vertices.size());
    if (value < -static_cast<std::int64_t>(seen_) || value > size || value == 0)
      text.fail("the vertex index " + std::to_string(value) + " is out of range; there are " +
                std::to_string(value < 0 ? seen_ : mesh_.vertices.size()) + " vertices" +
                (value < 0 ? " before it" : "") + " and the first is 1");
    return static_cast<Index>(value < 0 ? static_cast<std::int64_t>(seen_) + value : value - 1);
  }

  Source source_;
  MeshData mesh_;
  std::size_t coloured_ = 0;  ///< vertices with colours or weights
  std::size_t seen_ = 0;      ///< vertices before the current line
  std::size_t free_forms_ = 0, first_free_form_ = 0;
  std::vector<Index> corners_;
  std::array<std::size_t, std::size(kLooks)> looks_{};  ///< lines of each

  /// The names by marker number; number 0 means none.
  class NamesByNumber {
   public:
    std::size_t number(const std::string& name) {
      const auto [there, fresh] = numbers_.try_emplace(name, names_.size());
      if (fresh) names_.push_back(name);
      return there->second;
    }
    [[nodiscard]] const std::string& name(std::size_t number) const { return names_[number]; }

   private:
    std::map<std::string, std::size_t> numbers_{{"", 0}};
    std::vector<std::string> names_{""};
  } labels_;
  std::size_t group_ = 0, material_ = 0;         ///< of the following lines
  std::vector<std::size_t> groups_, materials_;  ///< of the facets
  NamedIds ids_{kFacetStem};
};

}  // namespace

MeshData read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace holdfast::io
