/* The rows of zipact bench, one function per row. */
#ifndef ZP_CLI_BENCH_H
#define ZP_CLI_BENCH_H

#include <zipact/zipact.h>

typedef struct Row {
  const char *name;
  int nodes;
  double ns_per_node_step; /* time per node of both ribbons */
  double steps;            /* per simulated second */
  double seconds;          /* of one thread per simulated second */
  double cpu;              /* time spent on the row; for equilibria: on one study, s */
  double paper_ratio;      /* cost of the paper over this cost; NAN if the paper gives none */
  double error;            /* relative error; NAN without a reference */
} Row;

/* (nodes) => row. */
typedef ZpStatus (*RowMaker)(int nodes, Row *row, ZpError *err);

/* Cost of a step (bench_steps.c), at the sizes 21, 61 and 130 of the paper. */
ZpStatus bench_plain(int nodes, Row *row, ZpError *err);
ZpStatus bench_paper_code(int nodes, Row *row, ZpError *err);
ZpStatus bench_explicit(int nodes, Row *row, ZpError *err);

/* Cost of a motion (bench_motion.c). */
ZpStatus bench_swing(int nodes, Row *row, ZpError *err);
ZpStatus bench_swing_explicit(int nodes, Row *row, ZpError *err);
ZpStatus bench_zip(int nodes, Row *row, ZpError *err);
ZpStatus bench_use(int nodes, Row *row, ZpError *err);

/* Cost of an equilibrium (bench_rest.c). */
ZpStatus bench_strip(int nodes, Row *row, ZpError *err);
ZpStatus bench_table2(int nodes, Row *row, ZpError *err);
ZpStatus bench_field(int nodes, Row *row, ZpError *err);

/* Cost of a case of a sweep (bench_cases.c). */
ZpStatus bench_rests(int nodes, Row *row, ZpError *err);
ZpStatus bench_limits(int nodes, Row *row, ZpError *err);
ZpStatus bench_zips(int nodes, Row *row, ZpError *err);

/* Add a key and its value to a list. */
void bench_set(ZpAssignment *list, size_t *count, const char *key, double value);

#endif
