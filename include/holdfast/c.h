/* Holdfast for C and for everything that calls C: the same library behind opaque handles.
 *
 * - Every function that can fail returns a holdfast_status and fills `error`, which may be NULL.
 *   No C++ exception leaves a function, and running out of memory is HOLDFAST_OUT_OF_MEMORY.
 * - Functions that make a handle write it to their last but one argument `out`, which stays NULL
 *   unless the status is HOLDFAST_OK (holdfast_mesh lists the exceptions).
 *   Release each handle by its own _free, which accepts NULL.
 * - Arrays that a handle returns belong to the handle, are read-only and valid until it is freed.
 *   None is copied. Shapes are given as (rows, columns); rows are contiguous.
 *   A count of 0 comes with NULL.
 * - A handle may be read from several threads at once.
 * - Callbacks get the context pointer given with them, run in the thread that made the call,
 *   and must not throw or jump out of it.
 */
#ifndef HOLDFAST_C_H
#define HOLDFAST_C_H

#include <stddef.h>
#include <stdint.h>

#include "holdfast/export.h"
#include "holdfast/version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a call ended. The numbers are stable. */
typedef enum holdfast_status {
  HOLDFAST_OK = 0,
  HOLDFAST_INVALID_INPUT = 1,     /* the surface breaks a rule: see the defects */
  HOLDFAST_TIME_LIMIT = 2,        /* the time limit ran out */
  HOLDFAST_MEMORY_LIMIT = 3,      /* the memory limit was reached */
  HOLDFAST_CANCELLED = 4,         /* progress returned 0, or the token was cancelled */
  HOLDFAST_NOT_REPRESENTABLE = 5, /* some added point has no position in doubles */
  HOLDFAST_BAD_ARGUMENT = 6,      /* options or arrays that make no sense */
  HOLDFAST_FILE_ERROR = 7,        /* a file cannot be read or written */
  HOLDFAST_OUT_OF_MEMORY = 8,
  HOLDFAST_TOO_LARGE = 9,      /* more vertices than can be numbered */
  HOLDFAST_INTERNAL_ERROR = 10 /* an invariant of the library broke: please report it */
} holdfast_status;

/* What went wrong, as text that ends with 0. Long text is cut. */
typedef struct holdfast_error {
  char message[512];
  char path[256]; /* of the file, for HOLDFAST_FILE_ERROR */
  char where[64]; /* in the file: "line 12", "byte 84", or empty */
} holdfast_error;

/* "ok", "invalid_input", ...; "unknown" for other numbers. */
HOLDFAST_API const char* holdfast_status_name(holdfast_status status);
/* Version of the library that runs, "major.minor.patch"; version.h has that of the headers. */
HOLDFAST_API const char* holdfast_version(void);

/* ---- Limits, progress, cancellation ---- */

/* Stops calls from another thread. */
typedef struct holdfast_cancel holdfast_cancel;
HOLDFAST_API holdfast_status holdfast_cancel_new(holdfast_cancel** out, holdfast_error* error);
/* May be called from any thread and from a signal handler. A cancelled token stays cancelled. */
HOLDFAST_API void holdfast_cancel_now(holdfast_cancel* cancel);
HOLDFAST_API void holdfast_cancel_free(holdfast_cancel* cancel);

/* Limits and progress of a call. Set it up by holdfast_control_init; a NULL control has no limits. */
typedef struct holdfast_control {
  size_t struct_size;    /* sizeof(holdfast_control) of the caller's headers */
  double time_limit;     /* seconds; 0: none */
  uint64_t memory_limit; /* bytes of the process; 0: none */
  unsigned threads;      /* 0: all available; default 1; results do not depend on it */
  /* Called every 20 ms or so with a stage ("" if the call has none) and the share of the call that is done, 0
   * to 1; returns 0 to cancel. */
  int (*progress)(void* context, const char* stage, double fraction);
  void* progress_context;
  const holdfast_cancel* cancel; /* may be NULL */
} holdfast_control;
HOLDFAST_API void holdfast_control_init(holdfast_control* control);

/* ---- Arrays ---- */

typedef enum holdfast_scalar {
  HOLDFAST_FLOAT32 = 0,
  HOLDFAST_FLOAT64 = 1,
  HOLDFAST_INT32 = 2,
  HOLDFAST_UINT32 = 3,
  HOLDFAST_INT64 = 4,
  HOLDFAST_UINT64 = 5
} holdfast_scalar;

/* Number j of row i is at data + i * row_stride + j * column_stride, in bytes. Both strides 0: rows are
 * contiguous, without gaps. No rows: there is no such array. */
typedef struct holdfast_array {
  const void* data;
  size_t rows;
  holdfast_scalar type;
  ptrdiff_t row_stride, column_stride;
} holdfast_array;

/* ---- Surfaces ---- */

typedef struct holdfast_surface holdfast_surface;

typedef struct holdfast_surface_arrays {
  size_t struct_size;              /* sizeof(holdfast_surface_arrays) */
  holdfast_array vertices;         /* (n, 3) */
  holdfast_array triangles;        /* (m, 3), indices from 0 */
  holdfast_array segments;         /* (k, 2), or none */
  holdfast_array vertex_markers;   /* (n, 1), or none */
  holdfast_array triangle_markers; /* (m, 1), or none */
  holdfast_array segment_markers;  /* (k, 1), or none */
} holdfast_surface_arrays;

/* Arrays of doubles, uint32 indices and int32 markers without gaps are not copied: they must stay valid
 * and unchanged until the surface is freed. Others are converted once. */
HOLDFAST_API holdfast_status holdfast_surface_from_arrays(const holdfast_surface_arrays* arrays,
                                                          holdfast_surface** out, holdfast_error* error);
/* `format` (".stl", ...) overrides the extension of the path; NULL: by the extension. */
HOLDFAST_API holdfast_status holdfast_surface_read(const char* path, const char* format,
                                                   const holdfast_control* control, holdfast_surface** out,
                                                   holdfast_error* error);
HOLDFAST_API const double* holdfast_surface_vertices(const holdfast_surface* surface,
                                                     size_t* rows); /* (n, 3) */
HOLDFAST_API const uint32_t* holdfast_surface_triangles(const holdfast_surface* surface,
                                                        size_t* rows); /* (m, 3) */
HOLDFAST_API const uint32_t* holdfast_surface_segments(const holdfast_surface* surface,
                                                       size_t* rows); /* (k, 2) */
HOLDFAST_API void holdfast_surface_free(holdfast_surface* surface);

/* ---- Volumes ---- */

/* A tetrahedral mesh. The volume of a result can outlive it: see holdfast_volume_retain. */
typedef struct holdfast_volume holdfast_volume;

HOLDFAST_API holdfast_status holdfast_volume_read(const char* path, const char* format,
                                                  const holdfast_control* control, holdfast_volume** out,
                                                  holdfast_error* error);
/* The file appears under its name complete or not at all. */
HOLDFAST_API holdfast_status holdfast_volume_write(const holdfast_volume* volume, const char* path,
                                                   const char* format, const holdfast_control* control,
                                                   holdfast_error* error);
HOLDFAST_API const double* holdfast_volume_vertices(const holdfast_volume* volume, size_t* rows); /* (n, 3) */
HOLDFAST_API const uint32_t* holdfast_volume_tetrahedra(const holdfast_volume* volume,
                                                        size_t* rows);                        /* (t, 4) */
HOLDFAST_API const int* holdfast_volume_regions(const holdfast_volume* volume, size_t* rows); /* (t) */
HOLDFAST_API const uint32_t* holdfast_volume_triangles(const holdfast_volume* volume,
                                                       size_t* rows); /* (m, 3) */
HOLDFAST_API const int* holdfast_volume_triangle_markers(const holdfast_volume* volume,
                                                         size_t* rows); /* (m) or 0 */
HOLDFAST_API const uint32_t* holdfast_volume_segments(const holdfast_volume* volume,
                                                      size_t* rows); /* (k, 2) */
HOLDFAST_API const int* holdfast_volume_segment_markers(const holdfast_volume* volume,
                                                        size_t* rows); /* (k) or 0 */
HOLDFAST_API const int* holdfast_volume_vertex_markers(const holdfast_volume* volume,
                                                       size_t* rows); /* (n) or 0 */
/* Adds an owner; each owner frees the volume once. Returns `volume`. */
HOLDFAST_API holdfast_volume* holdfast_volume_retain(holdfast_volume* volume);
HOLDFAST_API void holdfast_volume_free(holdfast_volume* volume);

/* ---- Meshing ---- */

typedef enum holdfast_keep {
  HOLDFAST_KEEP_AUTO = 0,
  HOLDFAST_KEEP_BOUNDED = 1,
  HOLDFAST_KEEP_WINDING = 2,
  HOLDFAST_KEEP_BOX = 3
} holdfast_keep;

typedef enum holdfast_effort { HOLDFAST_FAST = 0, HOLDFAST_GOOD = 1, HOLDFAST_BEST = 2 } holdfast_effort;

typedef struct holdfast_region_seed {
  double where[3];
  int id;
  double size; /* 0: no limit */
} holdfast_region_seed;

/* Set it up by holdfast_mesh_options_init. */
typedef struct holdfast_mesh_options {
  size_t struct_size;         /* sizeof(holdfast_mesh_options) */
  int field_points;           /* 1: points inside, for computation; 0: only what the surface forces */
  double size;                /* for field points: no edge much longer; 0: that of the surface */
  double gradation;           /* negative, the default: 0.3 to 0.5, by the surface */
  int no_growth;              /* 1: sizes inside stay between those of the surrounding surface */
  const double* vertex_sizes; /* one per vertex of the surface, or NULL */
  /* Sizes at `count` points (count, 3), written to `sizes`; values that are not positive are no limit. May be
   * NULL. Each call gets all points known at the time, often one. */
  void (*size_field)(void* context, size_t count, const double* points, double* sizes);
  void* size_field_context;
  holdfast_effort effort;
  holdfast_keep keep;
  double box_margin;   /* of the largest extent, for HOLDFAST_KEEP_BOX; default 0.1 */
  const double* holes; /* (hole_count, 3) */
  size_t hole_count;
  const holdfast_region_seed* regions;
  size_t region_count;
  int drop_outside; /* 1: triangles outside every kept region are dropped instead of refused */
  int neighbours;   /* 1: fills holdfast_result_neighbours */
  uint64_t seed;    /* default 1 */
} holdfast_mesh_options;
HOLDFAST_API void holdfast_mesh_options_init(holdfast_mesh_options* options);

typedef struct holdfast_result holdfast_result;

/* Fills a surface with tetrahedra and keeps every triangle. A NULL `options` has the defaults. `out` gets a
 * result also for HOLDFAST_INVALID_INPUT (with defects), the limits, HOLDFAST_CANCELLED and
 * HOLDFAST_NOT_REPRESENTABLE. */
HOLDFAST_API holdfast_status holdfast_mesh(const holdfast_surface* surface,
                                           const holdfast_mesh_options* options,
                                           const holdfast_control* control, holdfast_result** out,
                                           holdfast_error* error);
/* The mesh, or NULL if there is none. The result owns it: retain it to keep it longer. */
HOLDFAST_API holdfast_volume* holdfast_result_volume(const holdfast_result* result);
/* (t, 4): the neighbour behind the face opposite each corner, or UINT32_MAX. */
HOLDFAST_API const uint32_t* holdfast_result_neighbours(const holdfast_result* result, size_t* rows);
/* Ids of the regions in front of and behind triangle i; returns bit 0 if there is one in front, bit 1 if
 * there is one behind. */
HOLDFAST_API unsigned holdfast_result_triangle_regions(const holdfast_result* result, size_t triangle,
                                                       int* front, int* behind);
HOLDFAST_API size_t holdfast_result_steiner_points(const holdfast_result* result);
HOLDFAST_API double holdfast_result_seconds(const holdfast_result* result);
HOLDFAST_API size_t holdfast_result_warning_count(const holdfast_result* result);
HOLDFAST_API const char* holdfast_result_warning(const holdfast_result* result,
                                                 size_t i); /* NULL beyond the last */
HOLDFAST_API void holdfast_result_free(holdfast_result* result);

/* ---- Defects ---- */

/* The broken rules of a surface. */
typedef struct holdfast_defects holdfast_defects;

typedef struct holdfast_defect {
  int kind;         /* holdfast/types.h, DefectKind; stable */
  const char* name; /* "facets cross", ... */
  const char* message;
  const uint32_t* vertices;
  size_t vertex_count;
  const uint32_t* triangles;
  size_t triangle_count;
  const uint32_t* segments;
  size_t segment_count;
  const double* where; /* (where_count, 3) */
  size_t where_count;
} holdfast_defect;

/* HOLDFAST_OK whether or not there are defects. At most `most`. */
HOLDFAST_API holdfast_status holdfast_diagnose(const holdfast_surface* surface, size_t most,
                                               const holdfast_control* control, holdfast_defects** out,
                                               holdfast_error* error);
/* The defects that holdfast_mesh found; they belong to the result. */
HOLDFAST_API const holdfast_defects* holdfast_result_defects(const holdfast_result* result);
HOLDFAST_API size_t holdfast_defects_count(const holdfast_defects* defects);
/* Defect i, whose pointers are valid as long as `defects`; returns 0 beyond the last. */
HOLDFAST_API int holdfast_defects_get(const holdfast_defects* defects, size_t i, holdfast_defect* defect);
HOLDFAST_API void holdfast_defects_free(holdfast_defects* defects);

/* ---- Check, Delaunay, untangle ---- */

/* Decides exactly whether a volume keeps a surface. `holds` gets 1 or 0; `error`, if given, the first broken
 * rule. */
HOLDFAST_API holdfast_status holdfast_check(const holdfast_surface* surface, const holdfast_volume* volume,
                                            const holdfast_control* control, int* holds,
                                            holdfast_error* error);

/* Delaunay tetrahedra of the convex hull of points (n, 3), all in region 1. */
HOLDFAST_API holdfast_status holdfast_delaunay(const holdfast_array* points, uint64_t seed,
                                               const holdfast_control* control, holdfast_volume** out,
                                               holdfast_error* error);

/* Makes every tetrahedron positive and keeps the boundary. */
HOLDFAST_API holdfast_status holdfast_untangle(const holdfast_volume* volume, const holdfast_control* control,
                                               holdfast_volume** out, holdfast_error* error);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif
