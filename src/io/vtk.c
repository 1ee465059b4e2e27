/* For ParaView: shapes.pvd and shapes/shape_NNNN.vtp, the film of one run; field.vts, its electric field.
 *
 * Each .vtp is the PolyData of one frame: a polyline per ribbon with what a ZpShape says of its nodes.
 * shapes/counter.vtp is the polyline of a counter electrode, which is the same in every frame. Numbers follow the XML
 * as raw bytes, each array after its length, so nothing is rounded. */
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/table.h"
#include "def/check.h"
#include "io/file.h"
#include "io/number.h"
#include "io/report.h"
#include "study/result.h"

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define BYTE_ORDER_NAME "LittleEndian"
#else
#define BYTE_ORDER_NAME "BigEndian"
#endif

/* Those of a shape that are no positions. */
static const ZpShapeArray *const data_arrays = &zp_shape_arrays[2];

/* A file: XML that declares arrays, and their bytes, which follow it and are collected meanwhile. */
typedef struct Vtk {
  FILE *file, *bytes; /* bytes NULL: there was no memory */
  char *collected;
  size_t size;
} Vtk;

static void put_int(const Vtk *vtk, size_t value) {
  int64_t number = (int64_t)value;
  fwrite(&number, sizeof number, 1, vtk->bytes);
}

static void put_reals(const Vtk *vtk, const double *value, size_t count) {
  fwrite(value, sizeof *value, count, vtk->bytes);
}

/* Declare an array of `count` points, cells or lines; its numbers, of 8 bytes each, are put next. */
static void begin_array(const Vtk *vtk, const char *type, const char *name, int components, size_t count) {
  fprintf(vtk->file,
          "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%ld\"/>\n",
          type, name, components, ftell(vtk->bytes));
  put_int(vtk, 8 * (size_t)components * count);
}

/* A value of each node, ribbon after ribbon; that of a pair of nodes once for each ribbon. */
static void put_values(const Vtk *vtk, const ZpShapes *film, const ZpShapeArray *array, const double *value) {
  begin_array(vtk, "Float64", array->name, 1, film->ribbons * film->nodes);
  for (size_t r = 0; r < film->ribbons; r++)
    for (size_t i = 0; i < film->nodes; i++)
      put_reals(vtk, &value[array->of_nodes ? i * film->ribbons + r : i], 1);
}

/* A polyline per ribbon. Points are written ribbon after ribbon, so that each polyline has consecutive numbers. */
static void put_frame(const Vtk *vtk, const ZpShape *shape, const ZpShapes *film) {
  const size_t ribbons = film->ribbons, nodes = film->nodes, points = ribbons * nodes, lines = ribbons * film->members;
  fprintf(vtk->file,
          "  <PolyData>\n"
          "    <Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"0\" NumberOfLines=\"%zu\" NumberOfStrips=\"0\" "
          "NumberOfPolys=\"0\">\n"
          "      <PointData>\n",
          points, lines);
  begin_array(vtk, "Int64", "ribbon", 1, points);
  for (size_t i = 0; i < points; i++)
    put_int(vtk, i / nodes);
  for (const ZpShapeArray *array = data_arrays; array->name; array++)
    if (zp_shape_array(shape, array)) put_values(vtk, film, array, zp_shape_array(shape, array));
  fputs("      </PointData>\n      <Points>\n", vtk->file);
  begin_array(vtk, "Float64", "Points", 3, points);
  for (size_t r = 0; r < ribbons; r++)
    for (size_t i = 0; i < nodes; i++)
      put_reals(vtk, (const double[]){shape->x[i * ribbons + r], shape->y[i * ribbons + r], 0}, 3);
  fputs("      </Points>\n      <Lines>\n", vtk->file);
  begin_array(vtk, "Int64", "connectivity", 1, points);
  for (size_t i = 0; i < points; i++)
    put_int(vtk, i);
  begin_array(vtk, "Int64", "offsets", 1, lines);
  for (size_t line = 0; line < lines; line++)
    put_int(vtk, (line + 1) * (points / lines));
  fputs("      </Lines>\n    </Piece>\n  </PolyData>\n", vtk->file);
}

/* One polyline, eq. (35.1). */
static void put_counter(const Vtk *vtk, const ZpActuatorDef *def) {
  enum { POINTS = 201 };
  fprintf(vtk->file,
          "  <PolyData>\n    <Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"1\" NumberOfStrips=\"0\" "
          "NumberOfPolys=\"0\">\n      <Points>\n",
          POINTS);
  begin_array(vtk, "Float64", "Points", 3, POINTS);
  for (size_t i = 0; i < POINTS; i++) {
    const double share = (double)i / (POINTS - 1);
    const double y = def->electro.gap_offset + def->counter.height * pow(share, def->counter.power);
    put_reals(vtk, (const double[]){share * def->ribbon.length, y, 0}, 3);
  }
  fputs("      </Points>\n      <Lines>\n", vtk->file);
  begin_array(vtk, "Int64", "connectivity", 1, POINTS);
  for (size_t i = 0; i < POINTS; i++)
    put_int(vtk, i);
  begin_array(vtk, "Int64", "offsets", 1, 1);
  put_int(vtk, POINTS);
  fputs("      </Lines>\n    </Piece>\n  </PolyData>\n", vtk->file);
}

/* The first index of VTK varies fastest: ours runs across the ribbons. */
static void put_map(const Vtk *vtk, const ZpFieldMap *map) {
  const size_t points = map->nx * map->ny, cells = (map->nx - 1) * (map->ny - 1);
  fprintf(vtk->file,
          "  <StructuredGrid WholeExtent=\"0 %zu 0 %zu 0 0\">\n    <Piece Extent=\"0 %zu 0 %zu 0 0\">\n      "
          "<PointData>\n",
          map->ny - 1, map->nx - 1, map->ny - 1, map->nx - 1);
  begin_array(vtk, "Float64", "potential", 1, points);
  put_reals(vtk, map->potential, points);
  fputs("      </PointData>\n      <CellData>\n", vtk->file);
  begin_array(vtk, "Float64", "field_strength", 1, cells);
  put_reals(vtk, map->strength, cells);
  begin_array(vtk, "Float64", "permittivity", 1, cells);
  put_reals(vtk, map->permittivity, cells);
  fputs("      </CellData>\n      <Points>\n", vtk->file);
  begin_array(vtk, "Float64", "Points", 3, points);
  for (size_t k = 0; k < points; k++)
    put_reals(vtk, (const double[]){map->x[k], map->y[k], 0}, 3);
  fputs("      </Points>\n    </Piece>\n  </StructuredGrid>\n", vtk->file);
}

/* The contents of a file: a frame of a film, a map, or a counter electrode; the others are NULL. */
typedef struct Shown {
  const ZpShape *shape;
  const ZpShapes *film;
  const ZpFieldMap *map;
  const ZpActuatorDef *counter;
} Shown;

static ZpStatus write_vtk(const char *folder, const char *name, Shown shown, ZpError *err) {
  ZpAtomic out;
  Vtk vtk = {.collected = NULL};
  ZpStatus status = zp_atomic_open(&out, folder, name, err);
  if (status != ZP_OK) return status;
  vtk.file = out.file;
  vtk.bytes = open_memstream(&vtk.collected, &vtk.size);
  fprintf(vtk.file,
          "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"" BYTE_ORDER_NAME "\" header_type=\"UInt64\">\n",
          shown.map ? "StructuredGrid" : "PolyData");
  if (vtk.bytes && shown.shape) put_frame(&vtk, shown.shape, shown.film);
  if (vtk.bytes && shown.map) put_map(&vtk, shown.map);
  if (vtk.bytes && shown.counter) put_counter(&vtk, shown.counter);
  if (!vtk.bytes || fclose(vtk.bytes) != 0) status = zp_fail_memory(err);
  fputs("  <AppendedData encoding=\"raw\">\n_", vtk.file);
  fwrite(vtk.collected, 1, vtk.size, vtk.file);
  fputs("\n  </AppendedData>\n</VTKFile>\n", vtk.file);
  free(vtk.collected);
  return zp_atomic_finish(&out, status, err);
}

static ZpStatus write_frames(const char *folder, const ZpShapes *shapes, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < shapes->frames && status == ZP_OK; i++) {
    char name[64];
    snprintf(name, sizeof name, "shape_%04zu.vtp", i);
    const ZpShape shape = zp_shapes_get(shapes, i);
    status = write_vtk(folder, name, (Shown){.shape = &shape, .film = shapes}, err);
  }
  return status;
}

static const char counter_file[] = "counter.vtp";

/* => *has: is there a counter electrode, which one ribbon faces? Then its file is written, else an earlier one is
 * removed. Members of a network are where their bodies are: they have none. */
static ZpStatus write_counter(const ZpReport *report, const ZpShapes *shapes, const char *folder, bool *has,
                              ZpError *err) {
  ZpActuatorDef def = {0};
  ZpStatus status = zp_scenario_def(report->scenario, 0, &def, err);
  *has = status == ZP_OK && shapes->ribbons == 1 && shapes->facing && shapes->members == 1;
  if (status == ZP_OK)
    status = *has ? write_vtk(folder, counter_file, (Shown){.counter = &def}, err)
                  : zp_remove_file(folder, counter_file, err);
  zp_def_clear(&def);
  return status;
}

static ZpStatus write_collection(const ZpReport *report, const ZpShapes *shapes, bool counter, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, "shapes.pvd", err);
  if (status != ZP_OK) return status;
  fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"" BYTE_ORDER_NAME "\">\n"
        "  <Collection>\n",
        out.file);
  for (size_t i = 0; i < shapes->frames; i++) {
    char time[ZP_NUMBER_SIZE];
    zp_number_print(zp_shapes_get(shapes, i).time, time, sizeof time);
    fprintf(out.file, "    <DataSet timestep=\"%s\" part=\"0\" file=\"shapes/shape_%04zu.vtp\"/>\n", time, i);
    if (counter)
      fprintf(out.file, "    <DataSet timestep=\"%s\" part=\"1\" file=\"shapes/%s\"/>\n", time, counter_file);
  }
  fputs("  </Collection>\n</VTKFile>\n", out.file);
  return zp_atomic_commit(&out, err);
}

/* The number of a frame of an earlier report, or -1 for any other file. */
static long long frame_of(const char *name) {
  char again[64];
  unsigned long long number;
  if (sscanf(name, "shape_%12llu.vtp", &number) != 1) return -1;
  snprintf(again, sizeof again, "shape_%04llu.vtp", number);
  return strcmp(name, again) == 0 ? (long long)number : -1;
}

/* Remove frames from `kept` on. The folder may be missing. */
static ZpStatus remove_frames(const char *folder, size_t kept, ZpError *err) {
  DIR *list = opendir(folder);
  if (!list && (errno == ENOENT || errno == ENOTDIR)) return ZP_OK;
  if (!list) return zp_fail(err, ZP_MACHINE, "cannot read the folder %s: %s", folder, strerror(errno));
  ZpStatus status = ZP_OK;
  for (struct dirent *entry = readdir(list); entry && status == ZP_OK; entry = readdir(list))
    if (frame_of(entry->d_name) >= (long long)kept) status = zp_remove_file(folder, entry->d_name, err);
  closedir(list);
  return status;
}

static ZpStatus write_shapes(const ZpReport *report, const ZpShapes *shapes, const char *folder, ZpError *err) {
  ZpStatus status = zp_remove_file(report->directory, "shapes.pvd", err);
  if (status == ZP_OK) status = remove_frames(folder, shapes ? shapes->frames : 0, err);
  if (status != ZP_OK || !shapes) return status;
  status = zp_make_folder(folder, err);
  bool counter = false;
  if (status == ZP_OK) status = write_frames(folder, shapes, err);
  if (status == ZP_OK) status = write_counter(report, shapes, folder, &counter, err);
  return status == ZP_OK ? write_collection(report, shapes, counter, err) : status;
}

ZpStatus zp_vtk_write(const ZpReport *report, ZpError *err) {
  const ZpResult *single = zp_report_single(report);
  const ZpShapes *shapes = single && single->shapes && single->shapes->frames > 0 ? single->shapes : NULL;
  char *folder = zp_path_join(report->directory, "shapes");
  if (!folder) return zp_fail_memory(err);
  ZpStatus status = write_shapes(report, shapes, folder, err);
  free(folder);
  if (status != ZP_OK) return status;
  if (!single || !single->map) return zp_remove_file(report->directory, "field.vts", err);
  return write_vtk(report->directory, "field.vts", (Shown){.map = single->map}, err);
}
