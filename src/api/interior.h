// The steps of a call inside the kept regions: field points and better elements (paper §6.4, §9).
#pragma once

#include <memory>

#include "api/boundary.h"
#include "api/field.h"

namespace holdfast {

/// Adds points until edges have the requested sizes. Returns null if some vertex inside has no doubles,
/// because then the attempt has already failed.
[[nodiscard]] std::unique_ptr<Field> add_field_points(const Attempt& attempt, BoxMesh& box,
                                                      Division& division, Report& report);

/// Improves the elements of the kept regions; `field` is null without field points.
void improve_elements(const Attempt& attempt, BoxMesh& box, Division& division, Field* field, Report& report);

}  // namespace holdfast
