#include "io/cdb_elements.h"

#include <algorithm>
#include <iterator>

namespace holdfast::io {
namespace {

constexpr int kSolids[] = {5,   30,  45,  46,  62,  64,  65,  69,  70,  72,  73,  87,  90,
                           92,  95,  96,  97,  98,  117, 122, 123, 127, 128, 147, 148, 164,
                           168, 185, 186, 187, 190, 191, 215, 216, 217, 220, 221, 226, 227,
                           231, 232, 236, 237, 239, 240, 278, 279, 285, 291, 292};
/// Shells, and elements on the surface of solids: loads and contact.
constexpr int kSurfaces[] = {28,  41,  43,  57,  63,  91,  93,  99,  131, 132,
                             143, 150, 152, 154, 157, 163, 173, 174, 181, 281};
constexpr int kLines[] = {3,  4,  8,  10,  16,  23,  24,  31,  32,  33, 34,
                          44, 54, 68, 160, 161, 180, 188, 189, 288, 289};

template <std::size_t N>
bool has(const int (&types)[N], int type) {
  return std::binary_search(std::begin(types), std::end(types), type);
}

}  // namespace

CdbShape shape_of(const CdbType& type) {
  const int option = type.option;
  if (type.name == kMesh200)
    return option >= 8 ? CdbShape::solid : option >= kMesh200Triangle3 ? CdbShape::surface : CdbShape::line;
  return has(kSolids, type.name)     ? CdbShape::solid
         : has(kSurfaces, type.name) ? CdbShape::surface
         : has(kLines, type.name)    ? CdbShape::line
                                     : CdbShape::other;
}

}  // namespace holdfast::io
