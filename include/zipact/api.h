/* Which functions a program may call: those marked ZP_API. All others are hidden in the shared libraries. */
#ifndef ZIPACT_API_H
#define ZIPACT_API_H

/* In front of a function of the interface. */
#if defined(__GNUC__)
#define ZP_API __attribute__((visibility("default")))
#else
#define ZP_API
#endif

/* Behind a function that takes a format and its values as printf does; places count from 1. */
#if defined(__GNUC__)
#define ZP_PRINTF(format_place, values_place) __attribute__((format(printf, format_place, values_place)))
#else
#define ZP_PRINTF(format_place, values_place)
#endif

#endif
