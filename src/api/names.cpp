#include "holdfast/holdfast.h"

namespace holdfast {

const char* name(Stage stage) {
  switch (stage) {
    case Stage::validate:
      return "validate";
    case Stage::delaunay:
      return "delaunay";
    case Stage::flips:
      return "flips";
    case Stage::partition:
      return "partition";
    case Stage::eliminate:
      return "eliminate";
    case Stage::classify:
      return "classify";
    case Stage::suppress:
      return "suppress";
    case Stage::field_points:
      return "field_points";
    case Stage::optimise:
      return "optimise";
  }
  return "unknown";
}

const char* version() { return HOLDFAST_VERSION; }

}  // namespace holdfast
