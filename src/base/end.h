/* How a callback of a solver ended. Instead of numbers that are not finite it answers what the solver can do. */
#ifndef ZP_BASE_END_H
#define ZP_BASE_END_H

typedef enum ZpEnd {
  ZP_END_FOUND,   /* done */
  ZP_END_SHORTER, /* no result here: a shorter step may find one */
  ZP_END_STOP     /* no result, and no shorter step would find one; the system knows why */
} ZpEnd;

#endif
