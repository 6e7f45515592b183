#include "refine/volume_data.h"

namespace holdfast {

double VolumeData::length_in_metrics(Vertex v, Vertex w) const {
  return holdfast::length((*metrics)[v], (*metrics)[w], mesh.position(v) - mesh.position(w));
}

}  // namespace holdfast
