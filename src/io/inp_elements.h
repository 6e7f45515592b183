// The nodes and elements of an .inp file, by the numbers that it gives them.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/inp_text.h"
#include "io/numbered.h"

namespace holdfast::io {

struct InpElement {
  int dimension;  ///< 0: it has no shape, and is no entity
  Index entity;   ///< of the mesh: its index among those of the dimension, the first of a polygon
  Index count;    ///< of a polygon or cell that is cut: how many facets or tetrahedra
  Index cell;     ///< of a hexahedron, prism or pyramid: its index among the cells; else no_entity
};

/// What few lines make of others: a short file may make much.
class InpMade {
 public:
  /// Throws for the line where it is more than any mesh has.
  void count(const InpText& text, std::int64_t more);

 private:
  std::int64_t made_ = 0;
};

/// Every node is a vertex of the mesh, every element with a shape an entity of it, or a run of facets.
class InpElements {
 public:
  /// `has_copies`: the file makes elements of others.
  InpElements(MeshData& mesh, bool has_copies) : mesh_(mesh), has_copies_(has_copies) {}

  /// Their numbers in order.
  std::vector<std::int64_t> read_nodes(InpText& text);
  /// A node at a place of the mesh.
  void add_node(std::int64_t number, const Point& point);
  /// Where a node is that came before. Throws for the line.
  [[nodiscard]] Point place_of_node(const InpText& text, std::int64_t number);
  /// The elements behind a keyword: their numbers in order.
  std::vector<std::int64_t> read(InpText& text, const InpKeyword& key);
  /// The lines behind *ELGEN, which make rows, layers and stacks of an element: the numbers of all of them.
  std::vector<std::int64_t> read_copies(InpText& text);
  /// Before `find`. Throws if a number is there twice.
  void finish(const Source& source);

  [[nodiscard]] std::size_t size() const { return elements_.size(); }
  /// Springs, masses and the like: how many elements of a type.
  [[nodiscard]] const std::map<std::string, std::size_t>& shapeless() const { return shapeless_; }
  /// The element of a number, or null.
  [[nodiscard]] const InpElement* find(std::int64_t number) const {
    const std::optional<Index> found = numbers_.find(number);
    return found ? &elements_[*found] : nullptr;
  }
  /// The corners of a hexahedron, prism or pyramid.
  [[nodiscard]] std::span<const Index> corners_of(const InpElement& element) const {
    const Cell& cell = cells_[element.cell];
    return std::span(cell.corners).first(cell.count);
  }

 private:
  struct Cell {
    std::array<Index, 8> corners{};
    std::size_t count;
  };
  struct Type;
  static const Type& type_of(const TextReader& text, const InpKeyword& key);
  std::vector<std::int64_t> read_shapeless(InpText& text, const std::string& type);
  /// Errors are those of the element's first line, at `place`.
  [[nodiscard]] Index vertex(const TextReader& text, std::size_t place, std::int64_t number) const;
  using Nodes = std::array<Index, 27>;
  void add(const TextReader& text, std::size_t place, const Type& type, const Nodes& nodes,
           std::int64_t number);
  Index add_cell_of(const Type& type, const Nodes& nodes);
  struct Original {
    const Type* type;
    std::vector<std::int64_t> nodes;  ///< their numbers
  };
  void add_by_numbers(const TextReader& text, std::size_t place, std::int64_t number,
                      const Original& original, std::int64_t step);

  MeshData& mesh_;
  const bool has_copies_;
  InpMade copies_;
  std::map<std::int64_t, Original> originals_;  ///< by the element's number, where there are copies
  Numbered nodes_, numbers_;
  std::vector<InpElement> elements_;
  std::vector<Cell> cells_;
  std::map<std::string, std::size_t> shapeless_;
};

}  // namespace holdfast::io
