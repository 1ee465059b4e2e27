/* For ParaView: shapes.pvd and shapes/shape_NNNN.vtp, the film of one run; field.vts, its electric field.
 *
 * Each .vtp is the PolyData of one frame: a polyline per ribbon with what a ZpShape says of its nodes.
 * Numbers follow the XML as raw bytes, each array after its length, so nothing is rounded. */
#include <dirent.h>
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "base/table.h"
#include "io/atomic.h"
#include "io/number.h"
#include "io/report.h"
#include "io/writers.h"
#include "study/result.h"

#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define BYTE_ORDER_NAME "LittleEndian"
#else
#define BYTE_ORDER_NAME "BigEndian"
#endif

/* Those of a shape that are no positions. */
static const ZpShapeArray *const data_arrays = &zp_shape_arrays[2];

/* Arrays of a frame in the order of their bytes; the offset increases from one to the next. */
typedef struct Layout {
  size_t ribbons, nodes, points;
  size_t lines; /* number of ribbons of all members */
  uint64_t offset;
} Layout;

static void declare(FILE *file, Layout *layout, const char *type, const char *name, int components, size_t bytes) {
  fprintf(
      file,
      "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%llu\"/>\n",
      type, name, components, (unsigned long long)layout->offset);
  layout->offset += sizeof(uint64_t) + bytes;
}

static void write_head(FILE *file, const ZpShape *shape, Layout *l) {
  fprintf(file,
          "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" BYTE_ORDER_NAME "\" header_type=\"UInt64\">\n"
          "  <PolyData>\n"
          "    <Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"0\" NumberOfLines=\"%zu\" NumberOfStrips=\"0\" "
          "NumberOfPolys=\"0\">\n"
          "      <PointData>\n",
          l->points, l->lines);
  declare(file, l, "Int64", "ribbon", 1, l->points * sizeof(int64_t));
  for (const ZpShapeArray *array = data_arrays; array->name; array++)
    if (zp_shape_array(shape, array)) declare(file, l, "Float64", array->name, 1, l->points * sizeof(double));
  fputs("      </PointData>\n      <Points>\n", file);
  declare(file, l, "Float64", "Points", 3, 3 * l->points * sizeof(double));
  fputs("      </Points>\n      <Lines>\n", file);
  declare(file, l, "Int64", "connectivity", 1, l->points * sizeof(int64_t));
  declare(file, l, "Int64", "offsets", 1, l->lines * sizeof(int64_t));
  fputs("      </Lines>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_", file);
}

static void put_length(FILE *file, size_t bytes) {
  uint64_t length = bytes;
  fwrite(&length, sizeof length, 1, file);
}

static void put_int(FILE *file, size_t value) {
  int64_t number = (int64_t)value;
  fwrite(&number, sizeof number, 1, file);
}

/* A value of each node, ribbon after ribbon; that of a pair of nodes once for each ribbon. */
static void put_values(FILE *file, const Layout *l, bool of_nodes, const double *value) {
  if (!value) return;
  put_length(file, l->points * sizeof(double));
  for (size_t r = 0; r < l->ribbons; r++)
    for (size_t i = 0; i < l->nodes; i++)
      fwrite(&value[of_nodes ? i * l->ribbons + r : i], sizeof *value, 1, file);
}

/* Points are written ribbon after ribbon, so that each polyline has consecutive numbers. */
static void put_points(FILE *file, const Layout *l, const ZpShape *shape) {
  put_length(file, 3 * l->points * sizeof(double));
  for (size_t r = 0; r < l->ribbons; r++)
    for (size_t i = 0; i < l->nodes; i++) {
      const double point[3] = {shape->x[i * l->ribbons + r], shape->y[i * l->ribbons + r], 0};
      fwrite(point, sizeof *point, 3, file);
    }
}

static void write_frame(FILE *file, const ZpShape *shape, const ZpShapes *film) {
  size_t ribbons = film->ribbons, nodes = film->nodes, lines = ribbons * film->members;
  Layout l = {.ribbons = ribbons, .nodes = nodes, .points = ribbons * nodes, .lines = lines};
  write_head(file, shape, &l);
  put_length(file, l.points * sizeof(int64_t));
  for (size_t i = 0; i < l.points; i++)
    put_int(file, i / nodes);
  for (const ZpShapeArray *array = data_arrays; array->name; array++)
    put_values(file, &l, array->of_nodes, zp_shape_array(shape, array));
  put_points(file, &l, shape);
  put_length(file, l.points * sizeof(int64_t));
  for (size_t i = 0; i < l.points; i++)
    put_int(file, i);
  put_length(file, lines * sizeof(int64_t));
  for (size_t line = 0; line < lines; line++)
    put_int(file, (line + 1) * (l.points / lines));
  fputs("\n  </AppendedData>\n</VTKFile>\n", file);
}

static ZpStatus write_frames(const char *folder, const ZpShapes *shapes, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < shapes->frames && status == ZP_OK; i++) {
    ZpAtomic out;
    char name[64];
    snprintf(name, sizeof name, "shape_%04zu.vtp", i);
    status = zp_atomic_open(&out, folder, name, err);
    if (status != ZP_OK) break;
    const ZpShape shape = zp_shapes_get(shapes, i);
    write_frame(out.file, &shape, shapes);
    status = zp_atomic_commit(&out, err);
  }
  return status;
}

static ZpStatus write_collection(const ZpReport *report, const ZpShapes *shapes, ZpError *err) {
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
  if (mkdir(folder, 0777) != 0 && errno != EEXIST)
    return zp_fail(err, ZP_MACHINE, "cannot create the folder %s: %s", folder, strerror(errno));
  status = write_frames(folder, shapes, err);
  return status == ZP_OK ? write_collection(report, shapes, err) : status;
}

/* -- the field ------------------------------------------------------------------------------------- */

static void put_array(FILE *file, const double *value, size_t count) {
  put_length(file, count * sizeof(double));
  fwrite(value, sizeof *value, count, file);
}

/* The first index of VTK varies fastest: ours runs across the ribbons. */
static void write_map(FILE *file, const ZpFieldMap *map) {
  Layout l = {.points = map->nx * map->ny};
  size_t cells = (map->nx - 1) * (map->ny - 1);
  fprintf(file,
          "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"StructuredGrid\" version=\"1.0\" byte_order=\"" BYTE_ORDER_NAME
          "\" header_type=\"UInt64\">\n"
          "  <StructuredGrid WholeExtent=\"0 %zu 0 %zu 0 0\">\n    <Piece Extent=\"0 %zu 0 %zu 0 0\">\n      "
          "<PointData>\n",
          map->ny - 1, map->nx - 1, map->ny - 1, map->nx - 1);
  declare(file, &l, "Float64", "potential", 1, l.points * sizeof(double));
  fputs("      </PointData>\n      <CellData>\n", file);
  declare(file, &l, "Float64", "field_strength", 1, cells * sizeof(double));
  declare(file, &l, "Float64", "permittivity", 1, cells * sizeof(double));
  fputs("      </CellData>\n      <Points>\n", file);
  declare(file, &l, "Float64", "Points", 3, 3 * l.points * sizeof(double));
  fputs("      </Points>\n    </Piece>\n  </StructuredGrid>\n  <AppendedData encoding=\"raw\">\n_", file);
  put_array(file, map->potential, l.points);
  put_array(file, map->strength, cells);
  put_array(file, map->permittivity, cells);
  put_length(file, 3 * l.points * sizeof(double));
  for (size_t k = 0; k < l.points; k++)
    fwrite((const double[]){map->x[k], map->y[k], 0}, sizeof(double), 3, file);
  fputs("\n  </AppendedData>\n</VTKFile>\n", file);
}

static ZpStatus write_field(const ZpReport *report, const ZpFieldMap *map, ZpError *err) {
  ZpAtomic out;
  if (!map) return zp_remove_file(report->directory, "field.vts", err);
  ZpStatus status = zp_atomic_open(&out, report->directory, "field.vts", err);
  if (status != ZP_OK) return status;
  write_map(out.file, map);
  return zp_atomic_commit(&out, err);
}

ZpStatus zp_vtk_write(const ZpReport *report, ZpError *err) {
  const ZpResult *single = zp_report_single(report);
  const ZpShapes *shapes = single && single->shapes && single->shapes->frames > 0 ? single->shapes : NULL;
  char *folder = zp_path_join(report->directory, "shapes");
  if (!folder) return zp_fail_memory(err);
  ZpStatus status = write_shapes(report, shapes, folder, err);
  free(folder);
  return status == ZP_OK ? write_field(report, single ? single->map : NULL, err) : status;
}
