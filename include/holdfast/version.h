/* Holdfast: the version. This file is the one place that says it; CMakeLists.txt reads it from here.
 *
 * Versions are semantic (semver.org). As long as the major number is 0, a new minor number may change the
 * interface, and the name of the shared library changes with it; a new patch number changes neither. */
#ifndef HOLDFAST_VERSION_H
#define HOLDFAST_VERSION_H

#define HOLDFAST_VERSION_MAJOR 0
#define HOLDFAST_VERSION_MINOR 2
#define HOLDFAST_VERSION_PATCH 0

/* One number to compare in #if: 1002003 is version 1.2.3. */
#define HOLDFAST_VERSION_NUMBER \
  (HOLDFAST_VERSION_MAJOR * 1000000 + HOLDFAST_VERSION_MINOR * 1000 + HOLDFAST_VERSION_PATCH)

#endif
