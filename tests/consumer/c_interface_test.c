/* The C interface from C99: results, ownership, every status that can be provoked, and memory that runs out
 * at any allocation. */
#include <holdfast/c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;
#define EXPECT(condition)                                             \
  do {                                                                \
    if (!(condition)) {                                               \
      fprintf(stderr, "line %d: not so: %s\n", __LINE__, #condition); \
      ++failures;                                                     \
    }                                                                 \
  } while (0)

/* operator new asks malloc, which the tests take over: the allocations after the first `left` ones fail. */
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TAKES_MALLOC_OVER 1
static long left = -1; /* below 0: as many as are asked for */
extern void* __libc_malloc(size_t size);
void* malloc(size_t size) {
  if (left == 0) return NULL;
  if (left > 0) --left;
  return __libc_malloc(size);
}
#endif

static const double cube_vertices[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
static const uint32_t cube_triangles[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                               {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                               {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

static holdfast_array array(const void* data, size_t rows, holdfast_scalar type) {
  holdfast_array a;
  memset(&a, 0, sizeof a);
  a.data = data;
  a.rows = rows;
  a.type = type;
  return a;
}

static holdfast_surface_arrays cube_arrays(size_t triangles) {
  holdfast_surface_arrays arrays;
  memset(&arrays, 0, sizeof arrays);
  arrays.struct_size = sizeof arrays;
  arrays.vertices = array(cube_vertices, 8, HOLDFAST_FLOAT64);
  arrays.triangles = array(cube_triangles, triangles, HOLDFAST_UINT32);
  return arrays;
}

static holdfast_surface* cube(size_t triangles) {
  const holdfast_surface_arrays arrays = cube_arrays(triangles);
  holdfast_surface* surface = NULL;
  EXPECT(holdfast_surface_from_arrays(&arrays, &surface, NULL) == HOLDFAST_OK);
  return surface;
}

static void test_mesh(const char* folder) {
  holdfast_surface* surface = cube(12);
  holdfast_mesh_options options;
  holdfast_result* result = NULL;
  holdfast_error error;
  size_t rows = 0;
  size_t t, i;
  int holds = 0, front = 0, behind = 0;
  char path[1024];
  EXPECT(holdfast_surface_vertices(surface, &rows) == &cube_vertices[0][0] && rows == 8); /* not copied */
  EXPECT(holdfast_surface_triangles(surface, &rows) == &cube_triangles[0][0] && rows == 12);
  holdfast_mesh_options_init(&options);
  options.neighbours = 1;
  EXPECT(holdfast_mesh(surface, &options, NULL, &result, &error) == HOLDFAST_OK);
  holdfast_volume* volume = holdfast_volume_retain(holdfast_result_volume(result));
  size_t tetrahedra = 0;
  const uint32_t* corners = holdfast_volume_tetrahedra(volume, &tetrahedra);
  const uint32_t* neighbours = holdfast_result_neighbours(result, &rows);
  EXPECT(tetrahedra >= 5 && rows == tetrahedra);
  for (t = 0; t < tetrahedra; ++t)
    for (i = 0; i < 4; ++i) {
      const uint32_t other = neighbours[4 * t + i];
      EXPECT(other == UINT32_MAX || other < tetrahedra);
      if (other == UINT32_MAX) continue;
      EXPECT(neighbours[4 * other] == t || neighbours[4 * other + 1] == t || neighbours[4 * other + 2] == t ||
             neighbours[4 * other + 3] == t);
    }
  EXPECT(holdfast_result_triangle_regions(result, 0, &front, &behind) == 2 && behind == 1);
  EXPECT(holdfast_result_triangle_regions(result, 12, &front, &behind) == 0);
  EXPECT(holdfast_check(surface, volume, NULL, &holds, &error) == HOLDFAST_OK && holds == 1);
  holdfast_result_free(result);
  EXPECT(corners[0] < 8 + 20); /* the volume outlives the result */
  snprintf(path, sizeof path, "%s/cube.vtu", folder);
  EXPECT(holdfast_volume_write(volume, path, NULL, NULL, &error) == HOLDFAST_OK);
  holdfast_volume* read = NULL;
  EXPECT(holdfast_volume_read(path, NULL, NULL, &read, &error) == HOLDFAST_OK);
  EXPECT(holdfast_volume_tetrahedra(read, &rows) != NULL && rows == tetrahedra);
  holdfast_volume* untangled = NULL;
  EXPECT(holdfast_untangle(read, NULL, &untangled, &error) == HOLDFAST_OK);
  EXPECT(holdfast_volume_tetrahedra(untangled, &rows) != NULL && rows == tetrahedra);
  holdfast_volume_free(untangled);
  holdfast_volume_free(read);
  holdfast_volume_free(volume);
  holdfast_surface_free(surface);
}

static void test_other_arrays(void) {
  /* Floats among other columns, and 64-bit indices from the last row to the first. */
  float floats[8][5];
  int64_t indices[12][3];
  size_t i, j, rows;
  for (i = 0; i < 8; ++i)
    for (j = 0; j < 3; ++j) floats[i][2 * j > 4 ? 4 : 2 * j] = (float)cube_vertices[i][j];
  for (i = 0; i < 12; ++i)
    for (j = 0; j < 3; ++j) indices[11 - i][j] = cube_triangles[i][j];
  holdfast_surface_arrays arrays = cube_arrays(12);
  arrays.vertices = array(floats, 8, HOLDFAST_FLOAT32);
  arrays.vertices.row_stride = sizeof floats[0];
  arrays.vertices.column_stride = 2 * sizeof(float);
  arrays.triangles = array(indices[11], 12, HOLDFAST_INT64);
  arrays.triangles.row_stride = -(ptrdiff_t)sizeof indices[0];
  arrays.triangles.column_stride = sizeof(int64_t);
  holdfast_surface* surface = NULL;
  EXPECT(holdfast_surface_from_arrays(&arrays, &surface, NULL) == HOLDFAST_OK);
  EXPECT(memcmp(holdfast_surface_vertices(surface, &rows), cube_vertices, sizeof cube_vertices) == 0);
  EXPECT(memcmp(holdfast_surface_triangles(surface, &rows), cube_triangles, sizeof cube_triangles) == 0);
  holdfast_surface_free(surface);
  indices[3][1] = -1;
  holdfast_error error;
  EXPECT(holdfast_surface_from_arrays(&arrays, &surface, &error) == HOLDFAST_BAD_ARGUMENT && surface == NULL);
  EXPECT(strstr(error.message, "triangle 8") != NULL);
}

static void test_defects(void) {
  holdfast_surface* surface = cube(11);
  holdfast_result* result = NULL;
  holdfast_defect defect;
  holdfast_error error;
  EXPECT(holdfast_mesh(surface, NULL, NULL, &result, &error) == HOLDFAST_INVALID_INPUT &&
         error.message[0] != 0);
  EXPECT(result != NULL && holdfast_result_volume(result) == NULL);
  EXPECT(holdfast_defects_count(holdfast_result_defects(result)) == 1);
  EXPECT(holdfast_defects_get(holdfast_result_defects(result), 0, &defect) == 1);
  EXPECT(strcmp(defect.name, "encloses nothing") == 0 && defect.where_count == 6);
  EXPECT(holdfast_defects_get(holdfast_result_defects(result), 1, &defect) == 0);
  holdfast_result_free(result);
  holdfast_defects* defects = NULL;
  EXPECT(holdfast_diagnose(surface, SIZE_MAX, NULL, &defects, &error) == HOLDFAST_OK);
  EXPECT(holdfast_defects_count(defects) == 0); /* an open surface is a valid complex */
  holdfast_defects_free(defects);
  holdfast_surface_free(surface);
}

static int tell(void* context, const char* stage, double fraction) {
  int* calls = context;
  EXPECT(stage != NULL && fraction >= 0 && fraction <= 1);
  return ++*calls < 3;
}

static void sizes(void* context, size_t count, const double* points, double* out) {
  size_t i;
  *(size_t*)context += count;
  for (i = 0; i < count; ++i) out[i] = 0.2 + 0 * points[3 * i];
}

static void test_callbacks(void) {
  holdfast_surface* surface = cube(12);
  holdfast_result* result = NULL;
  holdfast_control control;
  holdfast_mesh_options options;
  holdfast_error error;
  int calls = 0;
  size_t asked = 0, rows = 0;
  holdfast_control_init(&control);
  control.progress = tell;
  control.progress_context = &calls;
  EXPECT(holdfast_mesh(surface, NULL, &control, &result, &error) == HOLDFAST_CANCELLED && calls == 3);
  EXPECT(holdfast_result_volume(result) == NULL);
  holdfast_result_free(result);
  holdfast_control_init(&control);
  holdfast_cancel* cancel = NULL;
  EXPECT(holdfast_cancel_new(&cancel, &error) == HOLDFAST_OK);
  holdfast_cancel_now(cancel);
  control.cancel = cancel;
  EXPECT(holdfast_mesh(surface, NULL, &control, &result, &error) == HOLDFAST_CANCELLED);
  holdfast_result_free(result);
  holdfast_volume* volume = NULL;
  const holdfast_array points = array(cube_vertices, 8, HOLDFAST_FLOAT64);
  EXPECT(holdfast_delaunay(&points, 1, &control, &volume, &error) == HOLDFAST_CANCELLED && volume == NULL);
  holdfast_cancel_free(cancel);
  EXPECT(holdfast_delaunay(&points, 1, NULL, &volume, &error) == HOLDFAST_OK);
  EXPECT(holdfast_volume_tetrahedra(volume, &rows) != NULL && rows >= 5);
  holdfast_volume_free(volume);
  holdfast_mesh_options_init(&options);
  options.field_points = 1;
  options.size_field = sizes;
  options.size_field_context = &asked;
  EXPECT(holdfast_mesh(surface, &options, NULL, &result, &error) == HOLDFAST_OK && asked > 0);
  EXPECT(holdfast_result_steiner_points(result) > 20);
  holdfast_result_free(result);
  holdfast_surface_free(surface);
}

static void test_failures(void) {
  holdfast_surface* surface = NULL;
  holdfast_volume* volume = NULL;
  holdfast_result* result = NULL;
  holdfast_error error;
  holdfast_mesh_options options;
  EXPECT(holdfast_surface_read("/nowhere/at all.stl", NULL, NULL, &surface, &error) == HOLDFAST_FILE_ERROR);
  EXPECT(surface == NULL && strcmp(error.path, "/nowhere/at all.stl") == 0 && error.message[0] != 0);
  EXPECT(holdfast_volume_read("a.xyz", NULL, NULL, &volume, &error) == HOLDFAST_FILE_ERROR);
  EXPECT(holdfast_mesh(NULL, NULL, NULL, &result, &error) == HOLDFAST_BAD_ARGUMENT);
  EXPECT(holdfast_mesh(NULL, NULL, NULL, NULL, NULL) == HOLDFAST_BAD_ARGUMENT);
  surface = cube(12);
  holdfast_mesh_options_init(&options);
  options.field_points = 1;
  options.gradation = 7;
  EXPECT(holdfast_mesh(surface, &options, NULL, &result, &error) == HOLDFAST_BAD_ARGUMENT && result == NULL);
  options.struct_size = 3;
  EXPECT(holdfast_mesh(surface, &options, NULL, &result, &error) == HOLDFAST_BAD_ARGUMENT);
  holdfast_surface_free(surface);
  holdfast_surface_free(NULL);
  holdfast_volume_free(NULL);
  holdfast_result_free(NULL);
  EXPECT(strcmp(holdfast_status_name(HOLDFAST_OUT_OF_MEMORY), "out_of_memory") == 0);
  EXPECT(strcmp(holdfast_status_name((holdfast_status)99), "unknown") == 0);
}

static void test_out_of_memory(void) {
#ifdef TAKES_MALLOC_OVER
  long most;
  for (most = 0; most < 100000; most += most < 300 ? 1 : 97) {
    const holdfast_surface_arrays arrays = cube_arrays(12);
    holdfast_surface* surface = NULL;
    holdfast_result* result = NULL;
    left = most;
    holdfast_status status = holdfast_surface_from_arrays(&arrays, &surface, NULL);
    if (status == HOLDFAST_OK) status = holdfast_mesh(surface, NULL, NULL, &result, NULL);
    left = -1;
    if (status == HOLDFAST_OK) break;
    EXPECT(status == HOLDFAST_OUT_OF_MEMORY && result == NULL);
    holdfast_surface_free(surface);
  }
  EXPECT(most > 100 && most < 100000);
#endif
}

int main(int count, char** arguments) {
  EXPECT(count == 2);
  EXPECT(strcmp(holdfast_version(), "0") > 0);
  test_mesh(arguments[1]);
  test_other_arrays();
  test_defects();
  test_callbacks();
  test_failures();
  test_out_of_memory();
  return failures == 0 ? 0 : 1;
}
