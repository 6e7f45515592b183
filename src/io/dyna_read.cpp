// Reads the mesh of LS-DYNA's keyword files, .k (keyword user's manual, volume I: *NODE, *ELEMENT, *PART,
// *SET). Parts are regions and markers; sets of segments are markers, and those of nodes mark vertices.
#include <algorithm>
#include <array>
#include <map>

#include "io/cells.h"
#include "io/dyna_text.h"
#include "io/fields.h"
#include "io/file_sets.h"
#include "io/formats.h"
#include "io/labels.h"
#include "io/mid_nodes.h"
#include "io/numbered.h"
#include "io/polygon.h"

namespace holdfast::io {
namespace {

constexpr std::size_t kDynaMostNodes = 27;  // of an element

class DynaReader {
 public:
  explicit DynaReader(const Source& source) : text_(source), mesh_(source) {}

  MeshData read() {
    while (!text_.at_end()) {
      text_.read_keyword();
      use_keyword();
      text_.skip_keyword();
    }
    if (const auto twice = numbers_.finish())
      throw FileError(text_.source().path, "", "the node " + std::to_string(*twice) + " occurs twice");
    if (mesh_.vertices.empty()) throw FileError(text_.source().path, "", "the file has no *NODE");
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i)
      mesh_.vertices[i] = text_.exact_nodes().of(node_numbers_[i], mesh_.vertices[i]);
    name_sets();
    for (const Element& element : elements_) add(element);
    add_segments();
    mark_nodes();
    tell_skipped();
    mesh_.names = {markers_.take(), regions_.take(), beams_.take(), points_.take()};
    return std::move(mesh_);
  }

 private:
  enum class Kind : std::uint8_t { solid, shell, beam };
  struct Element {
    Kind kind;
    std::uint8_t count;
    int part;
    std::size_t first;  ///< in `nodes_of_elements_`
    std::size_t place;
  };
  struct Numbers {
    std::size_t place;
    std::vector<std::int64_t> of;
  };
  /// A set of segments, or of nodes; a line of numbers for each card.
  struct Set {
    int id;
    std::string name;
    std::vector<Numbers> cards;
    bool generates = false;  ///< pairs of a first and a last node
  };

  void use_keyword() {
    const std::string& keyword = text_.keyword();
    std::set<std::string> options;
    if (keyword == "node") {
      read_nodes();
    } else if (text_.options_after("element_solid", options) ||
               text_.options_after("element_tshell", options)) {
      read_solids(options);
    } else if (text_.options_after("element_shell", options)) {
      read_shells(options);
    } else if (keyword == "element_beam") {
      while (text_.is_data()) read_element(Kind::beam, text_.element_card(), 2, 4);
    } else if (text_.options_after("part", options)) {
      read_parts(options);
    } else if (text_.options_after("set_segment", options)) {
      read_set(options, {}, segments_);
    } else if (text_.options_after("set_node", options)) {
      read_set(options, "list", nodes_);
    } else if (keyword.starts_with("include")) {
      text_.reader().fail("*" + keyword + " is not followed; *INCLUDE is");
    } else if (keyword == "end") {
      text_.end_of_file();
    } else if (keyword != "keyword" && keyword != "title") {
      ++skipped_[keyword.substr(0, 24)];
    }
  }

  void read_nodes() {
    while (text_.is_data()) {
      const auto fields = text_.node_card();
      const TextReader& reader = text_.reader();
      node_numbers_.push_back(integer_of(reader, fields[0], "a node's number"));
      numbers_.add(node_numbers_.back());
      Point point{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis + 1 < fields.size() && !fields[axis + 1].empty())
          point[axis] = real_of(reader, fields[axis + 1], "a coordinate");
      mesh_.vertices.push_back(point);
    }
  }

  /// Adds the nodes in fields `first` to `end` of a card to the last element.
  void add_nodes(std::span<const std::string_view> fields, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < std::min(end, fields.size()); ++i) {
      nodes_of_elements_.push_back(dyna_integer(text_, fields, i, "a node's number"));
      ++elements_.back().count;
    }
  }

  /// Begins an element with the number and part of a card, and the nodes after them.
  void read_element(Kind kind, std::span<const std::string_view> fields, std::size_t first, std::size_t end) {
    const std::int64_t part = dyna_integer(text_, fields, 1, "a part");
    if (part < 0 || part > std::numeric_limits<int>::max())
      text_.reader().fail("the part does not fit 32 bits");
    elements_.push_back({kind, 0, static_cast<int>(part), nodes_of_elements_.size(), text_.place()});
    add_nodes(fields, first, end);
  }

  /// The nodes are on the first card, or on cards of their own.
  void read_solids(const std::set<std::string>& options) {
    std::size_t more = 0, cards = 1;
    for (const std::string& option : options) {
      if (option == "ortho")
        more += 2;
      else if (option == "dof")
        ++more;
      else if (option == "h20" || option == "h27")
        cards = option == "h20" ? 2 : 3;
      else if (option != "tet4totet10" && option != "h8toh20" && option != "h8toh27")
        text_.reader().fail("*ELEMENT_SOLID with the option " + in_quotes(option) + " is not read");
    }
    while (text_.is_data()) {
      const auto fields = text_.element_card();
      const bool has_nodes = std::any_of(fields.begin() + std::min<std::ptrdiff_t>(2, std::ssize(fields)),
                                         fields.end(), [](std::string_view field) { return !field.empty(); });
      read_element(Kind::solid, fields, 2, has_nodes ? 12 : 2);
      for (std::size_t card = 0; !has_nodes && card < cards; ++card) {
        if (!text_.is_data()) text_.reader().fail("the element has no card of nodes");
        add_nodes(text_.element_card(), 0, card == 2 ? kDynaMostNodes - 20 : 10);
      }
      text_.skip_cards(more);
    }
  }

  void read_shells(const std::set<std::string>& options) {
    std::size_t more = 0;
    bool has_thickness = false;
    for (const std::string& option : options) {
      if (option == "thickness" || option == "beta" || option == "mcid")
        has_thickness = true;
      else if (option == "offset" || option == "dof")
        ++more;
      else
        text_.reader().fail("*ELEMENT_SHELL with the option " + in_quotes(option) + " is not read");
    }
    while (text_.is_data()) {
      read_element(Kind::shell, text_.element_card(), 2, 10);
      const std::size_t corners = 4, count = nodes_of(elements_.back()).size();
      text_.skip_cards(more + (has_thickness ? (count > corners ? 2 : 1) : 0));
    }
  }

  /// A title and a card for each part; options add cards to the first.
  void read_parts(const std::set<std::string>& options) {
    do {
      const std::string title(text_.is_data() ? text_.title() : std::string_view());
      if (!text_.is_data()) return;
      const std::int64_t part = dyna_integer(text_, text_.other_card(), 0, "a part");
      if (part > 0 && part <= std::numeric_limits<int>::max()) titles_[static_cast<int>(part)] = title;
    } while (options.empty() && text_.is_data());
  }

  void read_set(std::set<std::string> options, const std::string& usual, std::vector<Set>& sets) {
    const bool has_title = options.erase("title") > 0;
    options.erase(usual);
    Set set;
    set.generates = options.erase("generate") > 0;
    if (!options.empty()) return void(++skipped_[text_.keyword().substr(0, 24)]);
    if (has_title && text_.is_data()) set.name = text_.title();
    if (!text_.is_data()) text_.reader().fail("the set has no number");
    set.id = id_of(text_.reader(), text_.other_card()[0], "a set's number");
    while (text_.is_data()) {
      const auto fields = text_.other_card();
      Numbers card{text_.place(), {}};
      const std::size_t most = &sets == &segments_ ? 4 : 8;  // after them, a segment has attributes
      for (std::size_t i = 0; i < std::min(most, fields.size()); ++i)
        card.of.push_back(dyna_integer(text_, fields, i, "a node's number"));
      set.cards.push_back(std::move(card));
    }
    sets.push_back(std::move(set));
  }

  /// Sets keep their numbers; parts of shells share them by name.
  void name_sets() {
    for (const Set& set : segments_) markers_.set(set.id, set.name);
    for (const Set& set : nodes_) points_.set(set.id, set.name);
  }

  int id_of_part(Kind kind, int part) {
    const auto [there, is_new] = ids_of_parts_[static_cast<std::size_t>(kind)].try_emplace(part, 0);
    if (!is_new) return there->second;
    const auto found = titles_.find(part);
    const std::string title = found == titles_.end() ? "" : found->second;
    NamedIds& ids = kind == Kind::solid ? regions_ : kind == Kind::shell ? markers_ : beams_;
    const auto is_part = [part](const Set& set) { return set.id == part; };
    if (kind == Kind::shell && std::any_of(segments_.begin(), segments_.end(), is_part))
      return there->second = markers_.id_of(title.empty() ? "part " + std::to_string(part) : title);
    ids.set(part, title);
    return there->second = ids.resolve(part);
  }

  [[nodiscard]] Index vertex(std::int64_t number, std::size_t place) {
    const std::optional<Index> found = numbers_.find(number);
    if (!found) text_.reader().fail_at(place, "the node " + std::to_string(number) + " does not exist");
    return *found;
  }

  /// Without the zeros at the end.
  [[nodiscard]] std::span<const std::int64_t> nodes_of(const Element& element) const {
    std::span<const std::int64_t> nodes = std::span(nodes_of_elements_).subspan(element.first, element.count);
    while (!nodes.empty() && nodes.back() == 0) nodes = nodes.first(nodes.size() - 1);
    return nodes;
  }

  void add(const Element& element) {
    beat(mesh_.watch);
    std::array<Index, kDynaMostNodes> n{};
    const std::span<const std::int64_t> nodes = nodes_of(element);
    for (std::size_t i = 0; i < nodes.size(); ++i) n[i] = vertex(nodes[i], element.place);
    const int id = id_of_part(element.kind, element.part);
    const std::span<Index> all = std::span(n).first(nodes.size());
    switch (element.kind) {
      case Kind::solid:
        return add_solid(all, id, element.place);
      case Kind::shell:
        return add_shell(all, id, element.place);
      case Kind::beam:
        if (all.size() < 2) text_.reader().fail_at(element.place, "a beam of fewer than 2 nodes");
        return mesh_.add_segment({n[0], n[1]}, id);
    }
  }

  void add_solid(std::span<Index> n, int region, std::size_t place) {
    if (n.size() == 10)
      return add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]},
                              {n[4], n[5], n[6], n[7], n[8], n[9]}, region);
    if (n.size() == 20 || n.size() == 27) return add_cell(mesh_, n, 8, region);
    if (n.size() < 4 || n.size() > 8)
      text_.reader().fail_at(place, "a solid of " + std::to_string(n.size()) + " nodes");
    std::array<Index, 8> corners{};
    for (std::size_t i = 0; i < 8; ++i) corners[i] = n[std::min(i, n.size() - 1)];
    if (n.size() == 6) corners = {n[0], n[1], n[2], n[3], n[4], n[4], n[5], n[5]};
    if (const auto tetrahedron = degenerate_tetrahedron(corners))
      return mesh_.add_tetrahedron(*tetrahedron, region);
    add_cell(mesh_, corners, 8, region);
  }

  void add_shell(std::span<Index> n, int marker, std::size_t place) {
    if (n.size() < 3) text_.reader().fail_at(place, "a shell of fewer than 3 nodes");
    const bool is_triangle = n.size() == 3 || n[3] == n[2];
    if (is_triangle && n.size() >= 7)
      return add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[4], n[5], n[6]}, marker);
    add_polygon(mesh_, n.first(is_triangle ? 3 : 4), marker,
                [&](const std::string& reason) { text_.reader().fail_at(place, reason); });
    if (n.size() > 4) add_no_corners(mesh_, n.subspan(4));
  }

  void add_segments() {
    if (segments_.empty()) return;
    settle_quadrangles(mesh_);  // so that the triangles of a segment match
    const NodesOnEdges on_edges(mesh_);
    FacetSets facets(mesh_);
    for (const Set& set : segments_) {
      const SetOfFile of{markers_.resolve(set.id), set.cards.size()};
      for (const Numbers& card : set.cards) add_segment(facets, on_edges, of, card);
    }
    facets.finish();
  }

  void add_segment(FacetSets& facets, const NodesOnEdges& on_edges, const SetOfFile& set,
                   const Numbers& card) {
    beat(mesh_.watch);
    std::vector<Index> n;
    for (const std::int64_t node : card.of)
      if (node != 0) n.push_back(vertex(node, card.place));
    if (n.size() == 4 && n[3] == n[2]) n.pop_back();
    if (n.size() < 3) return void(++short_segments_);
    for (const Triangle& facet : facets.triangles_of(n))
      facets.mark(facet, set, [&] { on_edges.add_facet(mesh_, facet, set.marker); });
  }

  void mark_nodes() {
    std::vector<VertexSet> sets;
    for (const Set& set : nodes_) {
      VertexSet vertices{points_.resolve(set.id), {}};
      if (set.generates)
        vertices.vertices = vertices_between(set);
      else
        for (const Numbers& card : set.cards)
          for (const std::int64_t node : card.of)
            if (node != 0) vertices.vertices.push_back(vertex(node, card.place));
      sets.push_back(std::move(vertices));
    }
    mark_vertices(mesh_, std::move(sets));
  }

  /// The vertices in any of the ranges of a set, which may overlap.
  [[nodiscard]] std::vector<Index> vertices_between(const Set& set) const {
    std::vector<std::pair<std::int64_t, std::int64_t>> ranges;
    for (const Numbers& card : set.cards)
      for (std::size_t i = 0; i + 1 < card.of.size(); i += 2)
        if (card.of[i] != 0) ranges.emplace_back(card.of[i], card.of[i + 1]);
    std::sort(ranges.begin(), ranges.end());
    for (std::size_t i = 1; i < ranges.size(); ++i)  // so that the last range before a number decides
      ranges[i].second = std::max(ranges[i].second, ranges[i - 1].second);
    std::vector<Index> vertices;
    for (Index v = 0; v < node_numbers_.size(); ++v) {
      const std::int64_t number = node_numbers_[v];
      const auto behind = std::upper_bound(ranges.begin(), ranges.end(), number,
                                           [](std::int64_t n, const auto& range) { return n < range.first; });
      if (behind != ranges.begin() && number <= behind[-1].second) vertices.push_back(v);
    }
    return vertices;
  }

  void tell_skipped() {
    mesh_.leave_out(short_segments_, "segments of two nodes in sets", "segment of two nodes in a set");
    mesh_.leave_out(
        skipped_, [](const std::string& name) { return in_quotes(name); }, "keywords", "keyword");
  }

  DynaText text_;
  MeshData mesh_;
  Numbered numbers_;
  std::vector<std::int64_t> node_numbers_;
  std::vector<Element> elements_;
  std::vector<std::int64_t> nodes_of_elements_;
  std::map<int, std::string> titles_;               ///< of parts
  std::array<std::map<int, int>, 3> ids_of_parts_;  ///< by kind of element
  std::vector<Set> segments_, nodes_;
  NamedIds regions_{kRegionStem}, markers_{kFacetStem}, beams_{kSegmentStem}, points_{kVertexStem};
  std::map<std::string, std::size_t> skipped_;
  std::size_t short_segments_ = 0;
};

}  // namespace

MeshData read_dyna(const Source& source) {
  const Includes whole(source, dyna_includes());
  return DynaReader(whole.source()).read();
}

}  // namespace holdfast::io
