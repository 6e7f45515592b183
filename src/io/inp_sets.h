// The sets of elements of an .inp file: those of *ELSET, those that elements are listed in, and surfaces of
// elements and their sides.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/inp_elements.h"

namespace holdfast::io {

/// Members are numbers of elements, which need not exist.
class InpSets {
 public:
  using Members = std::vector<std::int64_t>;

  /// Elements that were listed in a set.
  void add_listed(const std::string& name, const Members& members);
  /// The lines behind *ELSET, where there are `elements` elements.
  void read(InpText& text, const InpKeyword& key, std::size_t elements);

  /// By a name in upper or lower case, or null.
  [[nodiscard]] const Members* find(const std::string& name) const;
  /// The largest set first, so that the smaller ones count; at last those that elements are listed in.
  [[nodiscard]] std::vector<std::pair<std::string, const Members*>> largest_first() const;

 private:
  [[nodiscard]] std::size_t size_of(const std::string& name) const;
  void add_range(const TextReader& text, const std::vector<std::string_view>& fields, std::size_t elements,
                 Members& members) const;
  void add_other(const TextReader& text, const std::string& name, std::size_t elements,
                 Members& members) const;

  std::map<std::string, Members> sets_, listed_;
  std::vector<std::string> order_;  ///< in which their names come first
};

/// Surfaces: sides of tetrahedra become facets, and those of shells give these their marker.
class InpSurfaces {
 public:
  void read(InpText& text, const std::string& name);
  /// Adds facets to the mesh; the marker of each facet, or 0.
  [[nodiscard]] std::vector<int> apply(MeshData& mesh, InpText& text, const InpElements& elements,
                                       const InpSets& sets, NamedIds& names) const;

 private:
  struct Side {
    std::string_view element, side;
    std::size_t position;
  };
  class Facets;

  std::map<std::string, std::vector<Side>> surfaces_;
  std::vector<std::string> order_;
};

}  // namespace holdfast::io
