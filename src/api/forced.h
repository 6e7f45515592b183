// Elements with a small angle caused by facets.
#pragma once

#include "holdfast/holdfast.h"
#include "mesh/parallel.h"

namespace holdfast {

/// Counts the elements of a volume with a dihedral angle below 10 degrees, and finds those that facets force:
/// two facets meet at that angle, or faces of the element that are facets have such an angle themselves.
/// Counts the others whose corners are all below `first_added`. `tell` is called now and then, and may throw.
void find_forced(const Volume& volume, std::size_t first_added, Report::Field& report, const Threads& threads,
                 const std::function<void()>& tell);

}  // namespace holdfast
