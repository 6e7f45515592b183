#include "io/inp_elements.h"

#include <algorithm>
#include <span>

#include "io/cells.h"
#include "io/mid_nodes.h"
#include "io/polygon.h"
#include "text/count.h"

namespace holdfast::io {

struct InpElements::Type {
  std::string_view prefix;
  int dimension;
  std::size_t nodes;
};

namespace {

[[noreturn]] void fail_twice(const Source& source, const char* what, std::int64_t number) {
  throw FileError(
      source.path, "",
      "the " + std::string(what) + " " + std::to_string(number_in_file(number)) + " occurs twice");
}

// Elements that connect or load nodes but have no shape: springs, dashpots, gaps, masses, inertias, heat
// capacities, connectors and couplings, and the branches of CalculiX's networks.
bool has_no_shape(std::string_view type) {
  static constexpr std::string_view kPrefixes[] = {"spring",  "dashpot", "gap",     "mass",   "rotaryi",
                                                   "heatcap", "conn2d",  "conn3d2", "dcoup3d"};
  return type == "d" || std::any_of(std::begin(kPrefixes), std::end(kPrefixes),
                                    [&](std::string_view prefix) { return type.starts_with(prefix); });
}

}  // namespace

std::vector<std::int64_t> InpElements::read_nodes(InpText& text) {
  std::vector<std::int64_t> read;
  for (; text.is_data(); text.next()) {
    const std::vector<std::string_view> fields = text.fields();
    // Missing coordinates are zero (Abaqus and CalculiX, *NODE).
    read.push_back(text.number(fields[0], "a node's number"));
    Point point{};
    for (std::size_t axis = 0; axis < 3 && axis + 1 < fields.size(); ++axis)
      if (!fields[axis + 1].empty()) point[axis] = real_of(text.reader(), fields[axis + 1], "a coordinate");
    add_node(read.back(), text.scope().placement.of(text.exact_nodes().of(read.back(), point)));
  }
  return read;
}

void InpElements::add_node(std::int64_t number, const Point& point) {
  nodes_.add(number);
  mesh_.vertices.push_back(point);
}

Point InpElements::place_of_node(const InpText& text, std::int64_t number) {
  if (const auto twice = nodes_.finish()) fail_twice(text.reader().source(), "node", *twice);
  return mesh_.vertices[vertex(text.reader(), text.place(), number)];
}

const InpElements::Type& InpElements::type_of(const TextReader& text, const InpKeyword& key) {
  // The longest matching prefix of a type's name counts.
  static constexpr Type kTypes[] = {
      {"c3d5", 3, 5},    {"c3d6", 3, 6},    {"c3d8", 3, 8},   {"c3d13", 3, 13}, {"c3d15", 3, 15},
      {"c3d20", 3, 20},  {"c3d27", 3, 27},  {"dc3d5", 3, 5},  {"dc3d6", 3, 6},  {"dc3d8", 3, 8},
      {"dc3d15", 3, 15}, {"dc3d20", 3, 20}, {"ac3d5", 3, 5},  {"ac3d6", 3, 6},  {"ac3d8", 3, 8},
      {"ac3d15", 3, 15}, {"ac3d20", 3, 20}, {"sc6", 3, 6},    {"sc8", 3, 8},    {"f3d6", 3, 6},
      {"f3d8", 3, 8},    {"c3d4", 3, 4},    {"c3d10", 3, 10}, {"dc3d4", 3, 4},  {"dc3d10", 3, 10},
      {"ac3d4", 3, 4},   {"ac3d10", 3, 10}, {"s3", 2, 3},     {"ds3", 2, 3},    {"stri3", 2, 3},
      {"cps3", 2, 3},    {"cpe3", 2, 3},    {"m3d3", 2, 3},   {"sfm3d3", 2, 3}, {"r3d3", 2, 3},
      {"s6", 2, 6},      {"ds6", 2, 6},     {"stri65", 2, 6}, {"cps6", 2, 6},   {"cpe6", 2, 6},
      {"m3d6", 2, 6},    {"sfm3d6", 2, 6},  {"s4", 2, 4},     {"cps4", 2, 4},   {"cpe4", 2, 4},
      {"m3d4", 2, 4},    {"sfm3d4", 2, 4},  {"r3d4", 2, 4},   {"s8", 2, 8},     {"cps8", 2, 8},
      {"cpe8", 2, 8},    {"m3d8", 2, 8},    {"m3d9", 2, 9},   {"sfm3d8", 2, 8}, {"cax3", 2, 3},
      {"ds4", 2, 4},     {"ds8", 2, 8},     {"cax4", 2, 4},   {"cax6", 2, 6},   {"cax8", 2, 8},
      {"t3d2", 1, 2},    {"b31", 1, 2},     {"b21", 1, 2},    {"t2d2", 1, 2},   {"t3d3", 1, 3},
      {"b32", 1, 3}};
  const std::string& given = key.values.at("type");
  const std::string name = lower(given);
  const Type* best = nullptr;
  for (const Type& type : kTypes)
    if (name.starts_with(type.prefix) && (best == nullptr || type.prefix.size() > best->prefix.size()))
      best = &type;
  const char behind = best == nullptr || name.size() == best->prefix.size() ? ' ' : name[best->prefix.size()];
  if (best == nullptr || (behind >= '0' && behind <= '9'))
    text.fail_at(key.place, "elements of type " + in_quotes(given) +
                                " are not read; only tetrahedra, hexahedra, prisms, pyramids, triangles, "
                                "quadrangles and lines are");
  return *best;
}

std::vector<std::int64_t> InpElements::read(InpText& text, const InpKeyword& key) {
  const auto given = key.values.find("type");
  if (given == key.values.end()) text.reader().fail_at(key.place, "*ELEMENT without TYPE");
  if (has_no_shape(lower(given->second))) return read_shapeless(text, given->second);
  const Type& type = type_of(text.reader(), key);
  if (const auto twice = nodes_.finish()) fail_twice(text.reader().source(), "node", *twice);
  std::vector<std::int64_t> read;
  while (text.is_data()) {
    // An element may span several lines.
    const std::size_t place = text.place();
    std::vector<std::int64_t> numbers;
    for (; text.is_data() && numbers.size() < type.nodes + 1; text.next())
      for (const std::string_view field : text.fields())
        if (!field.empty()) numbers.push_back(text.number(field, "a number of an element or node"));
    if (numbers.size() != type.nodes + 1)
      text.reader().fail_at(place, "an element of " + counted(type.nodes, "node") + " has " +
                                       std::to_string(numbers.empty() ? 0 : numbers.size() - 1));
    const Original element{&type, {numbers.begin() + 1, numbers.end()}};
    add_by_numbers(text.reader(), place, numbers[0], element, 0);
    if (has_copies_) originals_[numbers[0]] = element;
    read.push_back(numbers[0]);
  }
  return read;
}

void InpElements::add_by_numbers(const TextReader& text, std::size_t place, std::int64_t number,
                                 const Original& original, std::int64_t step) {
  Nodes nodes{};
  for (std::size_t i = 0; i < original.nodes.size(); ++i)
    nodes[i] = vertex(text, place, original.nodes[i] + step);
  add(text, place, *original.type, nodes, number);
}

std::vector<std::int64_t> InpElements::read_copies(InpText& text) {
  std::vector<std::int64_t> all;
  if (const auto twice = nodes_.finish()) fail_twice(text.reader().source(), "node", *twice);
  for (; text.is_data(); text.next()) {
    const Copies copies = copies_of_line(text);
    count(text, copies);
    add_copies(text, copies, all);
  }
  return all;
}

InpElements::Copies InpElements::copies_of_line(const InpText& text) const {
  const std::vector<std::string_view> fields = text.fields();
  const auto value = [&](std::size_t k) {
    return k < fields.size() && !fields[k].empty()
               ? integer_of(text.reader(), fields[k], "a number of *ELGEN")
               : std::int64_t{1};
  };
  const auto step = [&](std::size_t k) { return text.increment(fields, k, "an increment of *ELGEN"); };
  Copies copies;
  copies.first = text.number(fields[0], "an element's number");
  const auto original = originals_.find(copies.first);
  if (original == originals_.end())
    text.reader().fail("the element " + std::to_string(number_in_file(copies.first)) +
                       ", of which *ELGEN makes others, does not exist");
  copies.original = &original->second;
  copies.counts = {value(1), value(4), value(7)};
  copies.node_steps = {step(2), step(5), step(8)};
  copies.steps = {step(3), step(6), step(9)};
  return copies;
}

void InpElements::count(const InpText& text, const Copies& copies) {
  const auto& [in_row, rows, layers] = copies.counts;
  if (std::min({in_row, rows, layers}) < 1) text.reader().fail("a number of elements below 1");
  // Each product is counted before the next, so that none overflows.
  constexpr std::int64_t kMost = 1 << 30;
  made_.count(text, in_row);
  made_.count(text, in_row * std::min(rows, kMost));
  made_.count(text, in_row * rows * std::min(layers, kMost));
}

void InpElements::add_copies(const InpText& text, const Copies& copies, std::vector<std::int64_t>& numbers) {
  const auto& [in_row, rows, layers] = copies.counts;
  const auto offset = [](const std::array<std::int64_t, 3>& steps, std::int64_t i, std::int64_t j,
                         std::int64_t k) { return i * steps[0] + j * steps[1] + k * steps[2]; };
  for (std::int64_t k = 0; k < layers; ++k)
    for (std::int64_t j = 0; j < rows; ++j)
      for (std::int64_t i = 0; i < in_row; ++i) {
        numbers.push_back(copies.first + offset(copies.steps, i, j, k));
        if (i + j + k > 0)
          add_by_numbers(text.reader(), text.place(), numbers.back(), *copies.original,
                         offset(copies.node_steps, i, j, k));
      }
}

// One element per line. Their numbers are kept, because sets may contain them.
std::vector<std::int64_t> InpElements::read_shapeless(InpText& text, const std::string& type) {
  std::vector<std::int64_t> read;
  for (; text.is_data(); text.next()) {
    read.push_back(text.number(text.fields()[0], "a number of an element or node"));
    numbers_.add(read.back());
    elements_.push_back({0, 0, 0, no_entity});
  }
  shapeless_[type] += read.size();
  return read;
}

Index InpElements::vertex(const TextReader& text, std::size_t place, std::int64_t number) const {
  const std::optional<Index> found = nodes_.find(number);
  if (!found) text.fail_at(place, "the node " + std::to_string(number_in_file(number)) + " does not exist");
  return *found;
}

void InpElements::add(const TextReader& text, std::size_t place, const Type& type, const Nodes& n,
                      std::int64_t number) {
  const std::size_t before[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
  const auto dimension = static_cast<std::size_t>(type.dimension);
  Index cell = no_entity;
  if (type.nodes == 10)
    add_second_order(mesh_, Tetrahedron{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6], n[7], n[8], n[9]}, 0);
  else if (type.dimension == 3 && type.nodes == 4)
    mesh_.add_tetrahedron({n[0], n[1], n[2], n[3]});
  else if (type.dimension == 3)
    cell = add_cell_of(type, n);
  else if (type.nodes == 6)
    add_second_order(mesh_, Triangle{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, 0);
  else if (type.dimension == 2) {
    add_polygon(mesh_, std::span(n).first(std::min<std::size_t>(type.nodes, 4)), 0,
                [&](const std::string& reason) { text.fail_at(place, reason); });
    if (type.nodes > 6) add_no_corners(mesh_, std::span(n).first(type.nodes).subspan(4));
  } else if (type.nodes == 3)  // Abaqus has the middle node between the ends
    add_second_order(mesh_, Segment{n[0], n[2]}, n[1], 0);
  else
    mesh_.add_segment({n[0], n[1]});
  const std::size_t after[] = {0, mesh_.segments.size(), mesh_.facets.size(), mesh_.tetrahedra.size()};
  numbers_.add(number);
  elements_.push_back({type.dimension, static_cast<Index>(before[dimension]),
                       static_cast<Index>(after[dimension] - before[dimension]), cell});
}

Index InpElements::add_cell_of(const Type& type, const Nodes& n) {
  const std::size_t corners = corners_of_cell(type.nodes);
  add_cell(mesh_, std::span(n).first(type.nodes), corners, 0);
  Cell cell{.count = corners};
  std::copy_n(n.begin(), corners, cell.corners.begin());
  cells_.push_back(cell);
  return static_cast<Index>(cells_.size() - 1);
}

void InpElements::finish(const Source& source) {
  if (const auto twice = nodes_.finish()) fail_twice(source, "node", *twice);
  if (const auto twice = numbers_.finish()) fail_twice(source, "element", *twice);
}

}  // namespace holdfast::io
