/* Numbers as decimal text. */
#ifndef ZP_IO_NUMBER_H
#define ZP_IO_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Large enough for any text of zp_number_print, with the final 0. */
#define ZP_NUMBER_SIZE 40

/* (value) => text: the shortest decimal that reads back to the same bits, with a decimal point in any locale; "nan",
 * "inf", "-inf" if it is not finite. `text` gets at most `size` bytes with the final 0. */
void zp_number_print(double value, char *text, size_t size);

/* Read a text that is a number, with optional blanks around it and a decimal point in any locale. False if it is not a
 * number, or there is no memory. */
bool zp_number_read(const char *text, double *value);

#endif
