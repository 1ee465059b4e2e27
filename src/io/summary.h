/* Common functions of the parts of summary.json. */
#ifndef ZP_IO_SUMMARY_H
#define ZP_IO_SUMMARY_H

#include <zipact/io.h>

#include "io/json.h"

/* The value of a key: a number, a word, true or false. NULL if there is no memory. */
json_t *zp_json_key(int key, double value);

/* The distribution of each output over the samples: a list with an object per combination of the lists' values, with
 * the values of the keys and "outputs". For an interrupted report only complete combinations. NULL if there is no
 * memory. */
json_t *zp_sample_statistics(const ZpReport *report);

#endif
