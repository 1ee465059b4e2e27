/* How many processors there are. */
#ifndef ZP_IO_PROCESSORS_H
#define ZP_IO_PROCESSORS_H

/* Processors that this process may use, 1 or more. */
int zp_processors(void);

#endif
