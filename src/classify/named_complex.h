// The input as messages speak of it.
#pragma once

#include "surface/complex.h"
#include "surface/places.h"

namespace holdfast {

/// A complex, its segments, and what messages call its vertices. The references must outlive it.
struct NamedComplex {
  const Complex& complex;
  const SegmentTable& table;
  VertexNames names = {};
};

}  // namespace holdfast
