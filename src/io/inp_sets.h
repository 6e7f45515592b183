// The sets of elements of an .inp file: sets from *ELSET, sets in which elements are listed, and surfaces of
// elements and their sides.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/inp_elements.h"

namespace holdfast::io {

/// Members are numbers of elements; such elements need not exist.
class InpSets {
 public:
  using Members = std::vector<std::int64_t>;

  /// Adds elements that were listed in a set.
  void add_listed(const std::string& name, const Members& members);
  /// The lines after *ELSET; there are `elements` elements.
  void read(InpText& text, const InpKeyword& key, std::size_t elements);

  /// The set with this name (in any case), preferably one of the scope; or null.
  [[nodiscard]] const Members* find(const std::string& name, const InpScope& scope) const;
  /// All sets except those marked as internal, from which surfaces are built. The largest set comes first, so
  /// that smaller sets overwrite it; sets in which elements are listed come last.
  [[nodiscard]] std::vector<std::pair<std::string, const Members*>> largest_first() const;

 private:
  [[nodiscard]] const Members* find(const std::string& name) const;
  [[nodiscard]] std::size_t size_of(const std::string& name) const;
  void add_range(const InpText& text, const std::vector<std::string_view>& fields, std::size_t elements,
                 Members& members) const;
  void add_other(const InpText& text, const std::string& name, std::size_t elements, Members& members) const;

  std::map<std::string, Members> sets_, listed_;
  std::vector<std::string> order_;  ///< in which names first occur
};

/// The name of a set as users see it.
using InpShownName = std::function<std::string(const std::string&)>;

/// Surfaces: sides of tetrahedra and other cells become facets; shells in a surface get its marker.
class InpSurfaces {
 public:
  void read(InpText& text, const std::string& name);
  /// Adds facets to the mesh. Returns the marker of each facet that is in a surface; it may be 0.
  [[nodiscard]] std::vector<std::optional<int>> apply(MeshData& mesh, InpText& text,
                                                      const InpElements& elements, const InpSets& sets,
                                                      const InpShownName& shown, NamedIds& names) const;

 private:
  struct Side {
    std::string_view element, side;
    std::size_t position;
    std::size_t scope;  ///< index in scopes_
  };
  class Facets;

  std::vector<InpScope> scopes_;
  std::map<std::string, std::vector<Side>> surfaces_;
  std::vector<std::string> order_;
};

}  // namespace holdfast::io
