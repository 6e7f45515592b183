// The C interface: surfaces and volumes, and the arrays in them.
#include <utility>

#include "c/controls.h"
#include "c/guard.h"
#include "c/handles.h"
#include "holdfast/io.h"

using holdfast::c::guarded;
using holdfast::c::require;

namespace {

holdfast::Scalar scalar(holdfast_scalar type) {
  if (type < HOLDFAST_FLOAT32 || type > HOLDFAST_UINT64)
    throw std::invalid_argument("an array of an unknown type of numbers");
  return static_cast<holdfast::Scalar>(type);
}

std::ptrdiff_t size_of(holdfast_scalar type) {
  return type == HOLDFAST_FLOAT32 || type == HOLDFAST_INT32 || type == HOLDFAST_UINT32 ? 4 : 8;
}

holdfast::ArrayView view_of(const holdfast_array& array, std::ptrdiff_t columns) {
  holdfast::ArrayView view{array.data, array.rows, scalar(array.type), array.row_stride, array.column_stride};
  if (view.row_stride == 0 && view.column_stride == 0) {
    view.column_stride = size_of(array.type);
    view.row_stride = columns * view.column_stride;
  }
  return view;
}

holdfast::ReadOptions read_options(const char* format, const holdfast_control* control) {
  const holdfast_control known = holdfast::c::known(control);
  holdfast::ReadOptions options;
  static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
  options.progress = holdfast::c::progress_of(known);
  if (format != nullptr) options.format = format;
  return options;
}

/// Rows of arrays, or of single numbers, as C has them.
template <class Range>
auto rows_of(const Range& rows, std::size_t* count) {
  if (count != nullptr) *count = rows.size();
  if constexpr (std::is_arithmetic_v<typename Range::value_type>) {
    return rows.empty() ? nullptr : rows.data();
  } else {
    return rows.empty() ? nullptr : rows.front().data();
  }
}

}  // namespace

holdfast_status holdfast_cancel_new(holdfast_cancel** out, holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the token");
    *out = nullptr;
    *out = new holdfast_cancel;
    return HOLDFAST_OK;
  });
}

void holdfast_cancel_now(holdfast_cancel* cancel) {
  if (cancel != nullptr) cancel->token.cancel();
}

void holdfast_cancel_free(holdfast_cancel* cancel) { delete cancel; }

holdfast_status holdfast_surface_from_arrays(const holdfast_surface_arrays* arrays, holdfast_surface** out,
                                             holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the surface");
    *out = nullptr;
    require(arrays, "there are no arrays");
    if (arrays->struct_size != sizeof *arrays)
      throw std::invalid_argument("struct_size of the arrays is not that of this version");
    auto surface = std::make_unique<holdfast_surface>();
    surface->arrays.set_vertices(view_of(arrays->vertices, 3));
    surface->arrays.set_facets(view_of(arrays->triangles, 3));
    surface->arrays.set_segments(view_of(arrays->segments, 2));
    surface->arrays.set_vertex_markers(view_of(arrays->vertex_markers, 1));
    surface->arrays.set_facet_markers(view_of(arrays->triangle_markers, 1));
    surface->arrays.set_segment_markers(view_of(arrays->segment_markers, 1));
    *out = surface.release();
    return HOLDFAST_OK;
  });
}

holdfast_status holdfast_surface_read(const char* path, const char* format, const holdfast_control* control,
                                      holdfast_surface** out, holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the surface");
    *out = nullptr;
    require(path, "there is no path");
    auto surface = std::make_unique<holdfast_surface>();
    surface->owned = holdfast::read_surface(path, read_options(format, control));
    surface->is_owned = true;
    *out = surface.release();
    return HOLDFAST_OK;
  });
}

const double* holdfast_surface_vertices(const holdfast_surface* surface, size_t* rows) {
  return rows_of(surface->view().vertices, rows);
}

const uint32_t* holdfast_surface_triangles(const holdfast_surface* surface, size_t* rows) {
  return rows_of(surface->view().facets, rows);
}

const uint32_t* holdfast_surface_segments(const holdfast_surface* surface, size_t* rows) {
  return rows_of(surface->view().segments, rows);
}

void holdfast_surface_free(holdfast_surface* surface) { delete surface; }

holdfast_status holdfast_volume_read(const char* path, const char* format, const holdfast_control* control,
                                     holdfast_volume** out, holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the volume");
    *out = nullptr;
    require(path, "there is no path");
    *out = new holdfast_volume(holdfast::read_volume(path, read_options(format, control)));
    return HOLDFAST_OK;
  });
}

holdfast_status holdfast_volume_write(const holdfast_volume* volume, const char* path, const char* format,
                                      const holdfast_control* control, holdfast_error* error) {
  return guarded(error, [&] {
    require(volume, "there is no volume");
    require(path, "there is no path");
    const holdfast_control known = holdfast::c::known(control);
    holdfast::WriteOptions options;
    static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
    options.progress = holdfast::c::progress_of(known);
    options.threads = known.threads;
    if (format != nullptr) options.format = format;
    holdfast::write_volume(path, volume->mesh, options);
    return HOLDFAST_OK;
  });
}

const double* holdfast_volume_vertices(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.vertices, rows);
}
const uint32_t* holdfast_volume_tetrahedra(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.tetrahedra, rows);
}
const int* holdfast_volume_regions(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.regions, rows);
}
const uint32_t* holdfast_volume_triangles(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.facets, rows);
}
const int* holdfast_volume_triangle_markers(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.facet_markers, rows);
}
const uint32_t* holdfast_volume_segments(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.segments, rows);
}
const int* holdfast_volume_segment_markers(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.segment_markers, rows);
}
const int* holdfast_volume_vertex_markers(const holdfast_volume* volume, size_t* rows) {
  return rows_of(volume->mesh.vertex_markers, rows);
}

holdfast_volume* holdfast_volume_retain(holdfast_volume* volume) {
  if (volume != nullptr) volume->owners.fetch_add(1, std::memory_order_relaxed);
  return volume;
}

void holdfast_volume_free(holdfast_volume* volume) {
  if (volume != nullptr && volume->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete volume;
}

holdfast_status holdfast_delaunay(const holdfast_array* points, uint64_t seed,
                                  const holdfast_control* control, holdfast_volume** out,
                                  holdfast_error* error) {
  return guarded(error, [&] {
    require(out, "there is no place for the volume");
    *out = nullptr;
    require(points, "there are no points");
    const holdfast_control known = holdfast::c::known(control);
    holdfast::DelaunayOptions options;
    static_cast<holdfast::Limits&>(options) = holdfast::c::limits_of(known);
    options.progress = holdfast::c::progress_of(known);
    options.seed = seed;
    options.threads = known.threads;
    holdfast::Arrays arrays;
    arrays.set_vertices(view_of(*points, 3));
    holdfast::Volume volume;
    volume.vertices.assign(arrays.view().vertices.begin(), arrays.view().vertices.end());
    volume.tetrahedra = holdfast::delaunay(volume.vertices, options);
    volume.regions.assign(volume.tetrahedra.size(), 1);
    *out = new holdfast_volume(std::move(volume));
    return HOLDFAST_OK;
  });
}
