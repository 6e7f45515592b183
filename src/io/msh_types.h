// Gmsh's elements of which only the corners are read; these precede all other nodes (Gmsh reference manual,
// "MSH file format": element types).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace holdfast::io {

enum class MshShape : std::size_t { line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };

[[nodiscard]] inline std::size_t corners_of(MshShape shape) {
  constexpr std::size_t kCorners[] = {2, 3, 4, 4, 8, 6, 5};
  return kCorners[static_cast<std::size_t>(shape)];
}

struct MshByCorners {
  std::int64_t type;
  MshShape shape;
  std::size_t nodes;
};

/// The description of a type, or null if it is none of these.
[[nodiscard]] inline const MshByCorners* by_corners(std::int64_t type) {
  using enum MshShape;
  static constexpr MshByCorners kTypes[] = {
      {5, hexahedron, 8},     {6, prism, 6},          {7, pyramid, 5},        // first order
      {10, quadrangle, 9},    {16, quadrangle, 8},    {12, hexahedron, 27},   // second
      {17, hexahedron, 20},   {13, prism, 18},        {18, prism, 15},        //
      {14, pyramid, 14},      {19, pyramid, 13},      {92, hexahedron, 64},   // and third
      {90, prism, 40},        {118, pyramid, 30},                             //
      {26, line, 4},          {21, triangle, 10},     {20, triangle, 9},      // third
      {36, quadrangle, 16},   {39, quadrangle, 12},   {29, tetrahedron, 20},  //
      {27, line, 5},          {23, triangle, 15},     {22, triangle, 12},     // fourth
      {37, quadrangle, 25},   {40, quadrangle, 16},   {30, tetrahedron, 35},  //
      {28, line, 6},          {25, triangle, 21},     {24, triangle, 15},     // fifth
      {38, quadrangle, 36},   {41, quadrangle, 20},   {31, tetrahedron, 56},  //
      {62, line, 7},          {42, triangle, 28},     {47, quadrangle, 49},   // sixth
      {71, tetrahedron, 84},  {63, line, 8},          {43, triangle, 36},     // and seventh
      {48, quadrangle, 64},   {72, tetrahedron, 120},                         //
      {64, line, 9},          {44, triangle, 45},     {49, quadrangle, 81},   // eighth
      {73, tetrahedron, 165}, {65, line, 10},         {45, triangle, 55},     // and ninth
      {50, quadrangle, 100},  {74, tetrahedron, 220},                         //
      {66, line, 11},         {46, triangle, 66},     {51, quadrangle, 121},  // tenth
      {75, tetrahedron, 286}};
  for (const MshByCorners& entry : kTypes)
    if (entry.type == type) return &entry;
  return nullptr;
}

struct MshKind {
  std::size_t dimension, nodes;
};

/// The same for all types that are read.
[[nodiscard]] inline std::optional<MshKind> kind_of(std::int64_t type) {
  switch (type) {
    case 1:
      return MshKind{1, 2};
    case 2:
      return MshKind{2, 3};
    case 3:
      return MshKind{2, 4};
    case 4:
      return MshKind{3, 4};
    case 8:
      return MshKind{1, 3};
    case 9:
      return MshKind{2, 6};
    case 11:
      return MshKind{3, 10};
    case 15:
      return MshKind{0, 1};
    default:
      break;
  }
  const MshByCorners* const other = by_corners(type);
  if (other == nullptr) return std::nullopt;
  const std::size_t dimension = other->shape == MshShape::line         ? 1
                                : other->shape < MshShape::tetrahedron ? 2
                                                                       : 3;
  return MshKind{dimension, other->nodes};
}

}  // namespace holdfast::io
