/* Common functions of the parts of summary.json. */
#ifndef ZP_IO_SUMMARY_H
#define ZP_IO_SUMMARY_H

#include <zipact/io.h>

#include "io/json.h"

/* The value of a key as a member `name`: a number, a word, true or false. */
void zp_json_key(ZpJson *json, const char *name, int key, double value);

/* The distribution of each output over the samples, as member "statistics": a list with an object per combination of
 * the lists' values, with the values of the keys and "outputs". For an interrupted report only complete combinations.
 */
ZpStatus zp_sample_statistics(ZpJson *json, const ZpReport *report, ZpError *err);

#endif
