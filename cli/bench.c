/* zipact bench: CPU time of steps, motions and equilibria on this machine, on one thread. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "cli.h"

static const struct {
  RowMaker make;
  int nodes;
} list[] = {{bench_plain, 21},
            {bench_plain, 61},
            {bench_plain, 130},
            {bench_paper_code, 21},
            {bench_paper_code, 61},
            {bench_paper_code, 130},
            {bench_explicit, 21},
            {bench_explicit, 61},
            {bench_explicit, 130},
            {bench_zip, 21},
            {bench_zip, 61},
            {bench_zip, 130},
            {bench_use, 21},
            {bench_use, 61},
            {bench_use, 130},
            {bench_swing, 21},
            {bench_swing, 61},
            {bench_swing, 131},
            {bench_swing_explicit, 21},
            {bench_swing_explicit, 61},
            {bench_swing_explicit, 131},
            {bench_strip, 14},
            {bench_strip, 21},
            {bench_strip, 33},
            {bench_strip, 45},
            {bench_table2, 130},
            {bench_field, 61},
            {bench_rests, 21},
            {bench_rests, 61},
            {bench_limits, 21},
            {bench_limits, 61},
            {bench_zips, 21},
            {bench_zips, 61}};

enum { ROWS = sizeof list / sizeof list[0] };

/* A number in a cell, "-" if there is none. */
static void print_cell(int width, int digits, double value) {
  if (isnan(value))
    printf(" %*s", width, "-");
  else
    printf(" %*.*f", width, digits, value);
}

static void print_table(const Row *row) {
  printf("%-26s %5s %11s %11s %12s %9s %12s\n", "", "nodes", "ns per node", "steps per", "CPU s per", "error",
         "times faster");
  printf("%-26s %5s %11s %11s %12s %9s %12s\n", "", "", "and step", "simulated s", "simulated s", "/ %", "than paper");
  for (int i = 0; i < ROWS; i++) {
    if (isnan(row[i].seconds)) continue;
    printf("%-26s %5d", row[i].name, row[i].nodes);
    print_cell(11, 2, row[i].ns_per_node_step);
    print_cell(11, 0, row[i].steps);
    print_cell(12, 4, row[i].seconds);
    print_cell(9, 3, 100 * row[i].error);
    print_cell(12, 0, row[i].paper_ratio);
    printf("\n");
  }
  printf("\n%-26s %5s %11s %11s %11s\n", "", "nodes", "CPU ms", "per CPU s", "error / %");
  for (int i = 0; i < ROWS; i++) {
    if (!isnan(row[i].seconds)) continue;
    printf("%-26s %5d %11.3f %11.0f", row[i].name, row[i].nodes, 1e3 * row[i].cpu, 1 / row[i].cpu);
    print_cell(11, 3, 100 * row[i].error);
    printf("\n");
  }
}

static json_t *real_or_null(double value) {
  return isfinite(value) ? json_real(value) : json_null();
}

static json_t *row_json(const Row *row) {
  return json_pack("{s:s, s:i, s:o, s:o, s:o, s:f, s:o, s:o}", "name", row->name, "nodes", row->nodes,
                   "ns_per_node_step", real_or_null(row->ns_per_node_step), "steps_per_simulated_second",
                   real_or_null(row->steps), "seconds_per_simulated_second", real_or_null(row->seconds), "cpu_s",
                   row->cpu, "error", real_or_null(row->error), "paper_cost_over_this", real_or_null(row->paper_ratio));
}

static int print_json(const Row *row) {
  json_t *array = json_array(), *all = json_pack("{s:s, s:o}", "version", ZP_VERSION, "rows", array);
  bool done = all != NULL;
  for (int i = 0; i < ROWS && done; i++)
    done = json_array_append_new(array, row_json(&row[i])) == 0;
  done = done && json_dumpf(all, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) == 0;
  json_decref(all);
  putchar('\n');
  return done ? EXIT_DONE : cli_fail(&(ZpError){ZP_MACHINE, "cannot write to standard output"});
}

int cli_bench(const Options *options) {
  Row row[ROWS];
  ZpError err;
  for (int i = 0; i < ROWS; i++)
    if (list[i].make(list[i].nodes, &row[i], &err) != ZP_OK) return cli_fail(&err);
  if (options->given & OPTION_JSON) return print_json(row);
  print_table(row);
  return EXIT_DONE;
}
