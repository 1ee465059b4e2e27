/* zipact bench: CPU time of steps, motions and equilibria on this machine, on one thread. */
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

/* A number of a row; null if there is none. */
static void print_member(const char *name, double value, const char *after) {
  printf("      \"%s\": ", name);
  if (isfinite(value))
    printf("%.6g", value);
  else
    printf("null");
  printf("%s\n", after);
}

static int print_json(const Row *row) {
  printf("{\n  \"version\": \"" ZP_VERSION "\",\n  \"rows\": [");
  for (int i = 0; i < ROWS; i++) {
    printf("%s\n    {\n      \"name\": \"%s\",\n", i ? "," : "", row[i].name);
    print_member("nodes", row[i].nodes, ",");
    print_member("ns_per_node_step", row[i].ns_per_node_step, ",");
    print_member("steps_per_simulated_second", row[i].steps, ",");
    print_member("seconds_per_simulated_second", row[i].seconds, ",");
    print_member("cpu_s", row[i].cpu, ",");
    print_member("error", row[i].error, ",");
    print_member("paper_cost_over_this", row[i].paper_ratio, "");
    printf("    }");
  }
  printf("\n  ]\n}\n");
  return EXIT_DONE;
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
