#include "io/inp_sets.h"

#include <algorithm>

#include "io/cells.h"
#include "io/mesh_sets.h"
#include "io/mid_nodes.h"
#include "numbers/sorted.h"

namespace holdfast::io {
namespace {

/// Sides S1 to S4 of a tetrahedron, by the corner opposite them.
constexpr std::array<std::size_t, 4> kOpposite{3, 2, 0, 1};

/// Sets may name an element several times; more often than this on average, the file is malicious.
constexpr std::size_t kMostPerElement = 16;

bool is_number(std::string_view field) { return !field.empty() && field[0] >= '0' && field[0] <= '9'; }

}  // namespace

void InpSets::add_listed(const std::string& name, const Members& members) {
  Members& all = listed_[name];
  if (std::find(order_.begin(), order_.end(), name) == order_.end()) order_.push_back(name);
  all.insert(all.end(), members.begin(), members.end());
}

void InpSets::read(InpText& text, const InpKeyword& key, std::size_t elements) {
  const std::string name = text.scope().given(key.values.at("elset"));
  const bool range = key.has("generate");
  if (!sets_.contains(name) && !key.has("internal")) order_.push_back(name);
  Members& members = sets_[name];
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    if (range) {
      add_range(text, fields, elements, members);
      continue;
    }
    for (const std::string_view field : fields) {
      if (field.empty()) continue;
      if (is_number(field))
        members.push_back(text.number(field, "an element's number"));
      else
        add_other(text, std::string(field), elements, members);
    }
  }
}

void InpSets::add_range(const InpText& text, const std::vector<std::string_view>& fields,
                        std::size_t elements, Members& members) const {
  const InpRange range = text.range(fields, "element");
  // Elements come first, and a range cannot have more numbers than there are elements.
  if (range.steps() >= static_cast<std::int64_t>(elements))
    text.reader().fail("a range of more elements than there are");
  range.append_to(members);
}

void InpSets::add_other(const InpText& text, const std::string& name, std::size_t elements,
                        Members& members) const {
  const Members* other = find(name, text.scope());
  if (other == nullptr) text.reader().fail("the set " + in_quotes(name) + " does not exist");
  if (members.size() + other->size() > kMostPerElement * (elements + 1))
    text.reader().fail("sets of more elements than there are");
  const Members copy = *other;  // a set may name itself
  members.insert(members.end(), copy.begin(), copy.end());
}

const InpSets::Members* InpSets::find(const std::string& name, const InpScope& scope) const {
  const Members* const own = scope.prefix.empty() ? nullptr : find(scope.prefix + name);
  return own != nullptr ? own : find(name);
}

const InpSets::Members* InpSets::find(const std::string& name) const {
  for (const auto* sets : {&sets_, &listed_})
    for (const auto& [known, members] : *sets)
      if (lower(known) == lower(name)) return &members;
  return nullptr;
}

std::size_t InpSets::size_of(const std::string& name) const {
  const auto found = sets_.find(name);
  return found == sets_.end() ? 0 : found->second.size();
}

std::vector<std::pair<std::string, const InpSets::Members*>> InpSets::largest_first() const {
  std::vector<std::string> by_size = order_;
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](const std::string& a, const std::string& b) { return size_of(a) > size_of(b); });
  std::vector<std::pair<std::string, const Members*>> result;
  for (const auto* sets : {&sets_, &listed_})
    for (const std::string& name : by_size)
      if (const auto found = sets->find(name); found != sets->end())
        result.emplace_back(name, &found->second);
  return result;
}

void InpSurfaces::read(InpText& text, const std::string& name) {
  if (scopes_.empty() || scopes_.back().prefix != text.scope().prefix) scopes_.push_back(text.scope());
  auto& sides = surfaces_[name];
  if (sides.empty()) order_.push_back(name);
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    sides.push_back({fields[0], fields.size() > 1 ? fields[1] : std::string_view(), text.reader().last(),
                     scopes_.size() - 1});
  }
}

/// The facets of a mesh with their markers, found by their corners.
class InpSurfaces::Facets {
 public:
  Facets(MeshData& mesh, const InpElements& elements)
      : mesh_(mesh), elements_(elements), markers_(mesh.facets.size()) {
    settle_quadrangles(mesh);  // so that the triangles of a cell's side match
    for (Index f = 0; f < mesh.facets.size(); ++f) facet_of_.emplace(ascending(mesh.facets[f]), f);
  }

  /// Marks a side of an element, which becomes a facet if it is not one yet.
  void mark(const TextReader& text, const InpElement& element, const Side& side, int id) {
    if (element.dimension == 2) {
      for (Index k = 0; k < element.count; ++k) markers_[element.entity + k] = id;
      return;
    }
    if (element.dimension != 3) {
      ++without_area_;
      return;
    }
    if (element.cell != no_entity) {
      const std::span<const Index> corners = elements_.corners_of(element);
      for (const Triangle& facet : side_of_cell(corners, number_of(text, side, corners.size()))) {
        if (add_once(facet)) mesh_.add_facet(facet);
        markers_[facet_of_.at(ascending(facet))] = id;
      }
      return;
    }
    const std::size_t opposite = kOpposite[number_of(text, side, 4)];
    const Triangle facet = outward_face(mesh_.tetrahedra[element.entity], opposite);
    if (add_once(facet)) add_side(mesh_, element.entity, opposite, 0);
    markers_[facet_of_.at(ascending(facet))] = id;
  }

  /// The number of marked sides of elements without area.
  [[nodiscard]] std::size_t without_area() const { return without_area_; }
  [[nodiscard]] std::vector<std::optional<int>> take_markers() { return std::move(markers_); }

 private:
  /// The number after the S of a side, counted from 0, for an element with `corners` corners.
  static std::size_t number_of(const TextReader& text, const Side& side, std::size_t corners) {
    const char last = corners == 4 ? '4' : corners == 8 ? '6' : '5';
    const std::string name = lower(side.side);
    if (name.size() != 2 || name[0] != 's' || name[1] < '1' || name[1] > last)
      text.fail_at(side.position, std::string("expected a side S1 to S") + last + " of a " +
                                      (corners == 4   ? "tetrahedron"
                                       : corners == 5 ? "pyramid"
                                       : corners == 6 ? "prism"
                                                      : "hexahedron") +
                                      ", found " + in_quotes(side.side));
    return static_cast<std::size_t>(name[1] - '1');
  }

  /// Whether the facet is new and must be added to the mesh.
  bool add_once(const Triangle& facet) {
    const bool fresh = facet_of_.emplace(ascending(facet), static_cast<Index>(mesh_.facets.size())).second;
    if (fresh) markers_.emplace_back();
    return fresh;
  }

  MeshData& mesh_;
  const InpElements& elements_;
  std::map<Triangle, Index> facet_of_;
  std::vector<std::optional<int>> markers_;
  std::size_t without_area_ = 0;
};

std::vector<std::optional<int>> InpSurfaces::apply(MeshData& mesh, InpText& text, const InpElements& elements,
                                                   const InpSets& sets, const InpShownName& shown,
                                                   NamedIds& names) const {
  if (order_.empty()) return std::vector<std::optional<int>>(mesh.facets.size());
  Facets facets(mesh, elements);
  const auto mark = [&](std::int64_t number, const Side& side, int id) {
    const InpElement* element = elements.find(number);
    if (element == nullptr)
      text.reader().fail_at(side.position,
                            "the element " + std::to_string(number_in_file(number)) + " does not exist");
    facets.mark(text.reader(), *element, side, id);
  };
  for (const std::string& name : order_) {
    const int id = names.id_of(shown(name));
    for (const Side& side : surfaces_.at(name)) {
      text.set_scope(scopes_[side.scope]);
      if (is_number(side.element)) {
        text.seek(side.position);
        mark(text.number(side.element, "an element's number"), side, id);
        continue;
      }
      const InpSets::Members* set = sets.find(std::string(side.element), text.scope());
      if (set == nullptr)
        text.reader().fail_at(side.position, "the set " + in_quotes(side.element) + " does not exist");
      for (const std::int64_t number : *set) mark(number, side, id);
    }
  }
  mesh.leave_out(facets.without_area(), "sides of elements that are lines or have no shape",
                 "side of an element that is a line or has no shape");
  return facets.take_markers();
}

}  // namespace holdfast::io
