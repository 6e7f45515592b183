// The nodes and elements of an .inp file, by their numbers in the file.
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
  int dimension;  ///< 0: no shape, so no entity
  Index entity;   ///< in the mesh, among those of its dimension; the first of a polygon's
  Index count;    ///< of a polygon or cell that is split: its facets or tetrahedra
  Index cell;     ///< index of a hexahedron, prism or pyramid, otherwise no_entity
};

/// Counts generated nodes and elements: a few lines of a short file may generate very many.
class InpMade {
 public:
  /// Throws for the line if it exceeds what any mesh has.
  void count(const InpText& text, std::int64_t more);

 private:
  std::int64_t made_ = 0;
};

/// Every node is a vertex of the mesh; every element with a shape is an entity or a run of facets.
class InpElements {
 public:
  /// `has_copies`: the file generates elements from others.
  InpElements(MeshData& mesh, bool has_copies) : mesh_(mesh), has_copies_(has_copies) {}

  /// Returns their numbers in order.
  std::vector<std::int64_t> read_nodes(InpText& text);
  /// Adds a node at a position of the mesh.
  void add_node(std::int64_t number, const Point& point);
  /// The position of an earlier node. Throws for the line.
  [[nodiscard]] Point place_of_node(const InpText& text, std::int64_t number);
  /// The elements after a keyword. Returns their numbers in order.
  std::vector<std::int64_t> read(InpText& text, const InpKeyword& key);
  /// The lines after *ELGEN, which generate rows, layers and stacks of an element. Returns all numbers.
  std::vector<std::int64_t> read_copies(InpText& text);
  /// To be called before `find`. Throws if a number occurs twice.
  void finish(const Source& source);

  [[nodiscard]] std::size_t size() const { return elements_.size(); }
  /// Springs, masses and similar elements: their number by type.
  [[nodiscard]] const std::map<std::string, std::size_t>& shapeless() const { return shapeless_; }
  /// The element with this number, or null.
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
  /// Errors name the first line of the element, at `place`.
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

  /// A line of *ELGEN: elements in a row, rows in a layer, and layers, in steps from an existing element.
  struct Copies {
    std::int64_t first = 0;  ///< the existing element, which is counted too
    const Original* original = nullptr;
    std::array<std::int64_t, 3> counts{}, node_steps{}, steps{};
  };
  [[nodiscard]] Copies copies_of_line(const InpText& text) const;
  /// Throws for the line if a number is below 1 or there would be too many.
  void count(const InpText& text, const Copies& copies);
  void add_copies(const InpText& text, const Copies& copies, std::vector<std::int64_t>& numbers);

  MeshData& mesh_;
  const bool has_copies_;
  InpMade made_;
  std::map<std::int64_t, Original> originals_;  ///< by element number, if there are copies
  Numbered nodes_, numbers_;
  std::vector<InpElement> elements_;
  std::vector<Cell> cells_;
  std::map<std::string, std::size_t> shapeless_;
};

}  // namespace holdfast::io
