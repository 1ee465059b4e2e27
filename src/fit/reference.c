/* Area between the shape at rest and a reference curve, the measure of error in the paper. */
#include "fit/reference.h"

#include <math.h>
#include <stdlib.h>

#include "io/data.h"

void zp_reference_free(ZpReference *reference) {
  free(reference->x);
  free(reference->y);
  *reference = (ZpReference){0};
}

static ZpStatus take(const ZpData *data, ZpReference *reference, ZpError *err) {
  reference->count = data->rows;
  if (data->rows < 2)
    return zp_fail(err, ZP_BAD_INPUT, "data.file: %.200s: a reference curve needs at least two rows", data->path);
  reference->x = calloc(data->rows, sizeof(double));
  reference->y = calloc(data->rows, sizeof(double));
  if (!reference->x || !reference->y) return zp_fail_memory(err);
  ZpStatus status = zp_data_read_column(data, "x", "m", "x_mm", reference->x, err);
  if (status == ZP_OK) status = zp_data_read_column(data, "y", "m", "y_mm", reference->y, err);
  for (size_t i = 1; i < data->rows && status == ZP_OK; i++)
    if (!(reference->x[i] > reference->x[i - 1]))
      status = zp_fail(err, ZP_BAD_INPUT, "data.file: %.200s:%d: x must increase from row to row", data->path,
                       data->line[i + 1]);
  return status;
}

ZpStatus zp_reference_read(const char *path, ZpReference *reference, ZpError *err) {
  ZpData data;
  *reference = (ZpReference){0};
  ZpStatus status = zp_data_read("data.file", path, &data, err);
  if (status == ZP_OK) status = take(&data, reference, err);
  zp_data_destroy(&data);
  return status;
}

/* y of the reference at x inside its range. */
static double reference_at(const ZpReference *r, double x) {
  size_t i = 1;
  while (i + 1 < r->count && r->x[i] < x)
    i++;
  return r->y[i - 1] + (r->y[i] - r->y[i - 1]) * (x - r->x[i - 1]) / (r->x[i] - r->x[i - 1]);
}

/* Area of |d| over a width w, where d changes linearly from d0 to d1. */
static double piece(double w, double d0, double d1) {
  if (d0 * d1 >= 0) return 0.5 * w * (fabs(d0) + fabs(d1));
  return 0.5 * w * (d0 * d0 + d1 * d1) / (fabs(d0) + fabs(d1));
}

/* Area between the reference and one edge of our curve, divided at the points of the reference. */
static double edge(const ZpReference *r, double x0, double y0, double x1, double y1) {
  double from = fmax(x0, r->x[0]), to = fmin(x1, r->x[r->count - 1]), slope = (y1 - y0) / (x1 - x0), area = 0;
  size_t i = 0;
  while (from < to) {
    while (i < r->count && r->x[i] <= from)
      i++;
    double next = i < r->count ? fmin(to, r->x[i]) : to;
    area += piece(next - from, y0 + slope * (from - x0) - reference_at(r, from),
                  y0 + slope * (next - x0) - reference_at(r, next));
    from = next;
  }
  return area;
}

double zp_reference_area(const ZpReference *reference, const ZpTable *table) {
  double area = 0;
  bool shared = false;
  for (size_t i = 1; table && i < table->rows; i++) {
    double x0 = zp_table_get(table, i - 1, "x_m"), x1 = zp_table_get(table, i, "x_m");
    if (!(x1 > x0)) return NAN;
    shared |= x1 > reference->x[0] && x0 < reference->x[reference->count - 1];
    area += edge(reference, x0, zp_table_get(table, i - 1, "y_m"), x1, zp_table_get(table, i, "y_m"));
  }
  return shared ? area : NAN;
}
