/* Numbers as decimal text. */
#ifndef ZP_IO_NUMBER_H
#define ZP_IO_NUMBER_H

#include <stddef.h>

/* Enough for any text that zp_number_print writes, with the final 0. */
#define ZP_NUMBER_SIZE 40

/* (value) => text: the shortest decimal that reads back to the same bits, with a point in any locale;
 * "nan", "inf", "-inf" for what is not a number. `text` gets at most `size` bytes with the final 0. */
void zp_number_print(double value, char *text, size_t size);

#endif
