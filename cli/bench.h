/* The rows of zipact bench: each is made by one function. */
#ifndef ZP_CLI_BENCH_H
#define ZP_CLI_BENCH_H

#include <zipact/zipact.h>

typedef struct Row {
  const char *name;
  int nodes;
  double ns_per_node_step; /* a node of either ribbon */
  double steps;            /* per simulated second */
  double seconds;          /* of one thread per simulated second */
  double cpu;              /* spent on the row; of studies of rest: on one study, s */
  double paper_ratio;      /* the paper's cost over this one; NAN where it gives none */
  double error;            /* relative; NAN where there is nothing to compare with */
} Row;

/* (nodes) => row. */
typedef ZpStatus (*RowMaker)(int nodes, Row *row, ZpError *err);

/* What one step costs (bench_steps.c); of the paper's sizes 21, 61 and 130. */
ZpStatus bench_plain(int nodes, Row *row, ZpError *err);
ZpStatus bench_paper_code(int nodes, Row *row, ZpError *err);
ZpStatus bench_explicit(int nodes, Row *row, ZpError *err);

/* What a motion costs (bench_motion.c). */
ZpStatus bench_swing(int nodes, Row *row, ZpError *err);
ZpStatus bench_swing_explicit(int nodes, Row *row, ZpError *err);
ZpStatus bench_zip(int nodes, Row *row, ZpError *err);
ZpStatus bench_use(int nodes, Row *row, ZpError *err);

/* What a state of rest costs (bench_rest.c). */
ZpStatus bench_strip(int nodes, Row *row, ZpError *err);
ZpStatus bench_table2(int nodes, Row *row, ZpError *err);
ZpStatus bench_field(int nodes, Row *row, ZpError *err);

/* What a case of a sweep costs (bench_cases.c). */
ZpStatus bench_rests(int nodes, Row *row, ZpError *err);
ZpStatus bench_limits(int nodes, Row *row, ZpError *err);
ZpStatus bench_zips(int nodes, Row *row, ZpError *err);

/* Add a key and its value to a list. */
void bench_set(ZpAssignment *list, size_t *count, const char *key, double value);

#endif
