/* Numbers as decimal text. */
#ifndef ZP_IO_NUMBER_H
#define ZP_IO_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Enough for any text that zp_number_print writes, with the final 0. */
#define ZP_NUMBER_SIZE 40

/* (value) => text: the shortest decimal that reads back to the same bits, with a point in any locale;
 * "nan", "inf", "-inf" for what is not a number. `text` gets at most `size` bytes with the final 0. */
void zp_number_print(double value, char *text, size_t size);

/* Read a text that is a number, with blanks around it at most and a point in any locale. False if it is none, or there
 * is no memory. */
bool zp_number_read(const char *text, double *value);

#endif
