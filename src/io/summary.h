/* A part of summary.json in a file of its own. */
#ifndef ZP_IO_SUMMARY_H
#define ZP_IO_SUMMARY_H

#include <zipact/io.h>

#include "io/json.h"

/* Write "statistics", the distribution of each output over the samples: a list with an object per combination of the
 * lists' values, with the values of the keys and "outputs". For an interrupted report only complete combinations. */
void zp_sample_statistics(ZpJson *json, const ZpReport *report);

#endif
