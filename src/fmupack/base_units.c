/* SI units as powers of base units. */
#include "fmupack/base_units.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

typedef struct Symbol {
  const char *text;
  ZpBaseUnits powers;
} Symbol;

static const Symbol symbols[] = {
    {"kg", {1, 0, 0, 0}}, {"m", {0, 1, 0, 0}},    {"s", {0, 0, 1, 0}},   {"A", {0, 0, 0, 1}},    {"rad", {0, 0, 0, 0}},
    {"N", {1, 1, -2, 0}}, {"Pa", {1, -1, -2, 0}}, {"J", {1, 2, -2, 0}},  {"W", {1, 2, -3, 0}},   {"Hz", {0, 0, -1, 0}},
    {"C", {0, 0, 1, 1}},  {"V", {1, 2, -3, -1}},  {"F", {-1, -2, 4, 2}}, {"ohm", {1, 2, -3, -2}}};

static const Symbol *find(const char *text, size_t length) {
  for (size_t k = 0; k < sizeof symbols / sizeof symbols[0]; k++)
    if (strlen(symbols[k].text) == length && strncmp(symbols[k].text, text, length) == 0) return &symbols[k];
  return NULL;
}

static void multiply(ZpBaseUnits *powers, const ZpBaseUnits *by, int exponent) {
  powers->kg += exponent * by->kg;
  powers->m += exponent * by->m;
  powers->s += exponent * by->s;
  powers->A += exponent * by->A;
}

bool zp_base_units(const char *unit, ZpBaseUnits *powers) {
  int sign = 1;
  *powers = (ZpBaseUnits){0, 0, 0, 0};
  if (*unit == '1') unit++;
  while (*unit) {
    if (*unit == '/') sign = -1;
    if (*unit == '/' || *unit == ' ') unit++;
    size_t length = 0;
    while (isalpha((unsigned char)unit[length]))
      length++;
    const Symbol *symbol = find(unit, length);
    if (!symbol) return false;
    unit += length;
    int exponent = isdigit((unsigned char)*unit) ? *unit++ - '0' : 1;
    multiply(powers, &symbol->powers, sign * exponent);
  }
  return true;
}
